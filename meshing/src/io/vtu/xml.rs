//! The tags of an XML file, one after the other: [`next_tag`]. As much of XML as the files of VTK use: no entities of their own, no
//! `CDATA`; comments and declarations are passed over.

use std::io::Read;

use crate::io::error::{Place, ReadError, SHOWN};
use crate::io::source::Source;

/// Longest tag in bytes: attributes are names and numbers.
const LONGEST_TAG: usize = 1 << 16;

/// A tag.
pub(super) struct Tag {
    pub(super) at: Place,
    pub(super) name: String,
    /// Whether it closes an element that an earlier tag opened.
    pub(super) closes: bool,
    /// Whether its element is empty: `<a/>`.
    pub(super) empty: bool,
    attributes: Vec<(String, String)>,
}

impl Tag {
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str())
    }

    /// An attribute that is a count.
    pub(super) fn count(&self, name: &str) -> Result<Option<u64>, ReadError> {
        let Some(text) = self.attribute(name) else { return Ok(None) };
        let count = text.trim().parse::<u64>();
        let expected = || format!("a count as attribute `{name}` of `{}`", self.name);
        count.map(Some).map_err(|_| ReadError::unexpected(self.at, expected(), text.as_bytes()))
    }

    /// How a message calls it.
    pub(super) fn shown(&self) -> String {
        format!("`<{}{}>`", if self.closes { "/" } else { "" }, self.name)
    }
}

/// The next tag; none at the end of the file. Only white space may stand before it.
pub(super) fn next_tag<R: Read>(source: &mut Source<R>) -> Result<Option<Tag>, ReadError> {
    loop {
        skip_blank(source)?;
        let at = source.byte();
        let ahead = source.fill(4)?;
        if ahead.is_empty() {
            return Ok(None);
        }
        if ahead[0] != b'<' {
            let found = source.fill(SHOWN + 1)?.to_vec();
            return Err(ReadError::unexpected(at, "a tag", &found));
        }
        let passed_over = match ahead {
            [_, b'?', ..] => Some(&b"?>"[..]),
            [_, b'!', b'-', b'-', ..] => Some(&b"-->"[..]),
            [_, b'!', ..] => Some(&b">"[..]),
            _ => None,
        };
        match passed_over {
            Some(end) => source.skip_past(end)?,
            None => return tag(source, at).map(Some),
        }
    }
}

pub(super) fn skip_blank<R: Read>(source: &mut Source<R>) -> Result<(), ReadError> {
    loop {
        let ahead = source.fill(1)?;
        let blank = ahead.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let more = blank == ahead.len() && blank > 0;
        source.consume(blank);
        if !more {
            return Ok(());
        }
    }
}

/// The tag that begins here.
fn tag<R: Read>(source: &mut Source<R>, at: Place) -> Result<Tag, ReadError> {
    let (mut scanned, mut quote) = (1, None);
    let length = loop {
        let ahead = source.fill(scanned + 1)?;
        if ahead.len() <= scanned {
            let end = Place::Byte(source.offset() + scanned as u64);
            return Err(ReadError::Truncated { at: end, expected: "the end of a tag".to_owned() });
        }
        let end = ahead[scanned..].iter().position(|&byte| {
            match quote {
                Some(open) if open == byte => quote = None,
                None if byte == b'"' || byte == b'\'' => quote = Some(byte),
                _ => {}
            }
            byte == b'>' && quote.is_none()
        });
        if let Some(end) = end {
            break scanned + end + 1;
        }
        scanned = ahead.len();
        if scanned > LONGEST_TAG {
            let expected = format!("a tag of at most {LONGEST_TAG} bytes");
            return Err(ReadError::unexpected(at, expected, ahead));
        }
    };
    let text = source.take(length, String::new)?;
    parse(&text[1..length - 1])
        .ok_or_else(|| ReadError::unexpected(at, "a well-formed tag", text))
        .map(|tag| Tag { at, ..tag })
}

/// The tag between its brackets.
fn parse(text: &[u8]) -> Option<Tag> {
    let text = std::str::from_utf8(text).ok()?;
    let (closes, text) = text.strip_prefix('/').map_or((false, text), |text| (true, text));
    let (empty, text) = text.strip_suffix('/').map_or((false, text), |text| (true, text));
    let (name, mut rest) = text.split_at(text.find(char::is_whitespace).unwrap_or(text.len()));
    let mut attributes: Vec<(String, String)> = Vec::new();
    loop {
        rest = rest.trim_start();
        if rest.is_empty() {
            break;
        }
        let (key, after) = rest.split_once('=')?;
        let after = after.trim_start();
        let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, after) = after[1..].split_once(quote)?;
        attributes.push((key.trim_end().to_owned(), unescaped(value)?));
        rest = after;
    }
    let named = !name.is_empty() && !(closes && (empty || !attributes.is_empty()));
    named.then(|| Tag { at: Place::Byte(0), name: name.to_owned(), closes, empty, attributes })
}

/// The value of an attribute as it was meant.
fn unescaped(value: &str) -> Option<String> {
    let mut text = String::with_capacity(value.len());
    let mut rest = value;
    while let Some((before, after)) = rest.split_once('&') {
        let (entity, after) = after.split_once(';')?;
        text.push_str(before);
        text.push(match entity {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "apos" => '\'',
            _ => {
                let number = entity.strip_prefix('#')?;
                let code = match number.strip_prefix('x') {
                    Some(hex) => u32::from_str_radix(hex, 16),
                    None => number.parse(),
                };
                char::from_u32(code.ok()?)?
            }
        });
        rest = after;
    }
    text.push_str(rest);
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(text: &str) -> Result<Option<Tag>, ReadError> {
        next_tag(&mut Source::new(text.as_bytes()))
    }

    #[test]
    fn attributes_are_read_in_either_quotes_and_unescaped() {
        let tag = first(
            "<?xml version=\"1.0\"?>\n<!-- <a> --><!DOCTYPE x><Data Name='a \"&lt;&#65;&#x42;>' b = \"2\" />",
        );
        let tag = tag.unwrap().unwrap();
        assert_eq!((tag.name.as_str(), tag.closes, tag.empty), ("Data", false, true));
        assert_eq!(tag.attribute("Name"), Some("a \"<AB>"));
        assert_eq!(tag.count("b").unwrap(), Some(2));
        assert_eq!(tag.count("c").unwrap(), None);
        let tag = first(" </Data >").unwrap().unwrap();
        assert!(tag.closes && tag.name == "Data");
        assert!(first("  \n").unwrap().is_none());
    }

    #[test]
    fn malformed_tags_are_named() {
        for (text, message) in [
            ("x", "byte 0: expected a tag, found `x`"),
            (" <a", "byte 3: the file ends here, expected the end of a tag"),
            ("<a b>", "byte 0: expected a well-formed tag, found `<a b>`"),
            ("<a b=1>", "byte 0: expected a well-formed tag, found `<a b=1>`"),
            ("<a b=\"&nbsp;\">", "byte 0: expected a well-formed tag, found `<a b=\\\"&nbsp;\\\">`"),
            ("<>", "byte 0: expected a well-formed tag, found `<>`"),
            ("</a/>", "byte 0: expected a well-formed tag, found `</a/>`"),
            ("<!-- a", "byte 6: the file ends here, expected `-->`"),
        ] {
            assert_eq!(first(text).err().unwrap().to_string(), message, "{text}");
        }
        let long = format!("<{}", "a".repeat(1 << 20));
        assert!(matches!(first(&long), Err(ReadError::Unexpected { .. })));
    }
}
