//! `DataArray` elements and what they hold, in place or appended: [`ArrayReader`], [`DataArrayElement`].

use std::io::Read;

use super::numbers::{Block, Collector, Scalar};
use super::xml::{self, Tag};
use super::zlib::{Bytes, ZlibBlocks};
use crate::io::FieldValues;
use crate::io::error::{Place, ReadError, shown};
use crate::io::source::Source;
use crate::io::vtk::Decoder;

/// Longest word of text that may be a number: all digits of any f64 fit.
const LONGEST_WORD: usize = 2048;
/// Bytes taken at once.
const PIECE: u64 = 1 << 16;

/// An array of which the element was read.
pub(super) struct DataArrayElement {
    pub(super) at: Place,
    pub(super) name: String,
    pub(super) components: usize,
    scalar: Scalar,
    /// Number of numbers, where it is known beforehand.
    expected: Option<u64>,
    pub(super) body: Body,
}

/// Where the numbers of an array are.
pub(super) enum Body {
    Read(FieldValues<'static>),
    /// That many bytes behind the underscore.
    Appended(u64),
}

/// How the binary blocks of a file are laid out.
#[derive(Clone, Copy)]
pub(super) struct ArrayReader {
    pub(super) big_endian: bool,
    /// Size of the length before a block: 4 or 8 bytes.
    pub(super) header: usize,
    /// Whether they are compressed by zlib.
    pub(super) compressed: bool,
}

impl ArrayReader {
    /// Where the bytes of an array go.
    fn bytes(self, collector: Collector, expected: Option<u64>) -> Bytes {
        if self.compressed {
            Bytes::Zlib(ZlibBlocks::new(collector, self.header, expected))
        } else {
            Bytes::Plain(Block::new(collector, self.header, expected))
        }
    }

    /// Reads the element that `tag` opens, of an array for so many places; none if it holds no numbers.
    pub(super) fn element<R: Read>(
        self,
        source: &mut Source<R>,
        tag: &Tag,
        places: Option<u64>,
    ) -> Result<Option<DataArrayElement>, ReadError> {
        let at = tag.at;
        let kind = tag.attribute("type").unwrap_or_default();
        let Some(scalar) = Scalar::of_name(kind) else {
            if !matches!(kind, "String" | "Bit") {
                return Err(ReadError::unexpected(at, "a number type of VTK as `type`", kind.as_bytes()));
            }
            skip_element(source, tag)?;
            return Ok(None);
        };
        let components = tag.count("NumberOfComponents")?.unwrap_or(1);
        let (Some(components), true) = (usize::try_from(components).ok(), components > 0) else {
            let expected = "a number of components".to_owned();
            return Err(ReadError::Unexpected { at, expected, found: components.to_string() });
        };
        let expected = match places.map(|places| places.checked_mul(components as u64)) {
            Some(None) => {
                let found = format!("{components} components");
                return Err(ReadError::Unexpected { at, expected: "an array that can be".to_owned(), found });
            }
            known => known.flatten(),
        };
        let collector = Collector::new(scalar, self.big_endian);
        let body = match tag.attribute("format").unwrap_or("ascii") {
            "appended" => {
                let offset = tag.count("offset")?;
                let offset = offset
                    .ok_or_else(|| ReadError::unexpected(at, "the offset of an appended array", b""))?;
                skip_element(source, tag)?;
                Body::Appended(offset)
            }
            "ascii" => Body::Read(inline_text(source, tag, collector, expected)?),
            "binary" => {
                let block = self.bytes(collector, expected);
                Body::Read(inline_base64(source, tag, block)?)
            }
            other => {
                let expected = "`ascii`, `binary` or `appended` as `format`";
                return Err(ReadError::unexpected(at, expected, other.as_bytes()));
            }
        };
        let name = tag.attribute("Name").unwrap_or_default().to_owned();
        Ok(Some(DataArrayElement { at, name, components, scalar, expected, body }))
    }

    /// Reads the numbers of an appended array, which begin here.
    pub(super) fn appended<R: Read>(
        self,
        source: &mut Source<R>,
        array: &mut DataArrayElement,
        base64: bool,
    ) -> Result<(), ReadError> {
        let collector = Collector::new(array.scalar, self.big_endian);
        let mut block = self.bytes(collector, array.expected);
        let name = || format!("the numbers of array {:?}", array.name);
        if base64 {
            let mut decoder = Decoder::default();
            while !(block.is_complete() && decoder.is_whole()) {
                let character = source.take(1, name)?[0];
                decode(&mut decoder, &mut block, character, source.byte())?;
            }
        } else {
            while !block.is_complete() {
                let piece = block.wanted().min(PIECE) as usize;
                let end = Place::Byte(source.offset() + piece as u64);
                block.push(source.take(piece, name)?, end)?;
            }
        }
        array.body = Body::Read(block.into_collector().into_values());
        Ok(())
    }
}

/// One character more.
fn decode(decoder: &mut Decoder, block: &mut Bytes, character: u8, at: Place) -> Result<(), ReadError> {
    let mut bytes = Vec::new();
    decoder
        .push(character, &mut bytes)
        .ok_or_else(|| ReadError::unexpected(at, "a character of base64", &[character]))?;
    if bytes.is_empty() { Ok(()) } else { block.push(&bytes, at) }
}

/// The words of an element as numbers.
fn inline_text<R: Read>(
    source: &mut Source<R>,
    tag: &Tag,
    mut numbers: Collector,
    expected: Option<u64>,
) -> Result<FieldValues<'static>, ReadError> {
    if !tag.empty {
        loop {
            while let Some((word, at)) = next_word(source)? {
                if expected == Some(numbers.count()) {
                    let count = numbers.count();
                    return Err(ReadError::unexpected(at, format!("no more than {count} numbers"), word));
                }
                numbers
                    .push_word(word)
                    .ok_or_else(|| ReadError::unexpected(at, "a number of its type", word))?;
            }
            if !element_goes_on(source, tag)? {
                break;
            }
        }
    }
    match expected {
        Some(count) if count != numbers.count() => {
            let found = format!("{} numbers", numbers.count());
            Err(ReadError::Unexpected { at: tag.at, expected: format!("an array of {count} numbers"), found })
        }
        _ => Ok(numbers.into_values()),
    }
}

/// The next word of text with its place; none before a tag.
fn next_word<R: Read>(source: &mut Source<R>) -> Result<Option<(&[u8], Place)>, ReadError> {
    xml::skip_blank(source)?;
    let at = source.byte();
    let mut length = 0;
    loop {
        let ahead = source.fill(length + 1)?;
        let more = ahead[length..].iter().take_while(|b| !b.is_ascii_whitespace() && **b != b'<').count();
        let ends = length + more < ahead.len() || more == 0;
        length += more;
        if length > LONGEST_WORD {
            return Err(ReadError::unexpected(at, "a number", ahead));
        }
        if ends {
            break;
        }
    }
    Ok(if length == 0 { None } else { Some((source.take(length, String::new)?, at)) })
}

/// The base64 of an element as numbers.
fn inline_base64<R: Read>(
    source: &mut Source<R>,
    tag: &Tag,
    mut block: Bytes,
) -> Result<FieldValues<'static>, ReadError> {
    let mut decoder = Decoder::default();
    if !tag.empty {
        loop {
            loop {
                let from = source.offset();
                let ahead = source.fill(1)?;
                let mut taken = 0;
                for &character in ahead.iter().take_while(|byte| **byte != b'<') {
                    taken += 1;
                    if !character.is_ascii_whitespace() {
                        decode(&mut decoder, &mut block, character, Place::Byte(from + taken as u64 - 1))?;
                    }
                }
                let more = taken > 0 && taken == ahead.len();
                source.consume(taken);
                if !more {
                    break;
                }
            }
            if !element_goes_on(source, tag)? {
                break;
            }
        }
    }
    if block.is_complete() && decoder.is_whole() {
        return Ok(block.into_collector().into_values());
    }
    let expected = format!("{} bytes more before the end of the array", block.wanted());
    Err(ReadError::Unexpected { at: source.byte(), expected, found: shown(b"") })
}

/// Passes over an element inside the one that `tag` opened, or the tag that closes it; whether it goes on.
fn element_goes_on<R: Read>(source: &mut Source<R>, tag: &Tag) -> Result<bool, ReadError> {
    let next = required_tag(source, &tag.name)?;
    if !next.closes {
        skip_element(source, &next)?;
        return Ok(true);
    }
    expect_closes(&next, tag).map(|()| false)
}

/// The next tag, which there must be inside an element of that name.
pub(super) fn required_tag<R: Read>(source: &mut Source<R>, inside: &str) -> Result<Tag, ReadError> {
    let expected = || format!("`</{inside}>`");
    xml::next_tag(source)?.ok_or_else(|| ReadError::Truncated { at: source.byte(), expected: expected() })
}

/// An error unless `next` closes the element that `tag` opened.
pub(super) fn expect_closes(next: &Tag, tag: &Tag) -> Result<(), ReadError> {
    if next.closes && next.name == tag.name {
        return Ok(());
    }
    Err(ReadError::Unexpected { at: next.at, expected: format!("`</{}>`", tag.name), found: next.shown() })
}

/// Passes over all of the element that `tag` opened.
pub(super) fn skip_element<R: Read>(source: &mut Source<R>, tag: &Tag) -> Result<(), ReadError> {
    let mut depth = u64::from(!tag.empty);
    while depth > 0 {
        loop {
            let ahead = source.fill(1)?;
            let text = ahead.iter().take_while(|byte| **byte != b'<').count();
            let more = text > 0 && text == ahead.len();
            source.consume(text);
            if !more {
                break;
            }
        }
        let next = required_tag(source, &tag.name)?;
        if next.closes {
            depth -= 1;
            if depth == 0 {
                expect_closes(&next, tag)?;
            }
        } else if !next.empty {
            depth += 1;
        }
    }
    Ok(())
}
