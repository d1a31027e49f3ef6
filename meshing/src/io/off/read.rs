//! Reads OFF, line by line.

use super::super::builder::Builder;
use super::super::error::{Place, ReadError};
use super::super::source::Source;
use super::super::tokens::{self, Tokens};
use super::super::{Limits, ReadReport};
use crate::surface::TriangleSoup;
use glam::DVec3;
use std::io::Read;

/// Numbers that may follow x y z: normal (3), colour (4) and texture coordinates (2).
const MOST_EXTRAS: usize = 9;

pub(in super::super) fn read(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, ReadReport), ReadError> {
    let mut source = Source::new(input);
    source.begin_text("OFF text")?;
    let mut reader =
        Reader { builder: Builder::new(limits), corners: Vec::new(), plain_faces: 0, colored: 0 };
    let (vertices, faces, at) = header(&mut source)?;
    reader.builder.declare(vertices, faces, at)?;
    for row in 1..=vertices {
        let expected = || format!("vertex {row} of the {vertices} declared");
        let line = required_line(&mut source, expected)?;
        reader.vertex(line.0, line.1, row)?;
    }
    for row in 1..=faces {
        let expected = || format!("face {row} of the {faces} declared");
        let line = required_line(&mut source, expected)?;
        reader.face(line.0, line.1, vertices)?;
    }
    if let Some((line, at)) = source.next_filled_line(Some(b'#'))? {
        let found = super::super::error::shown(line);
        let after = if faces > 0 { "face declared" } else { "vertex declared" };
        return Err(ReadError::TrailingData { at, after: after.to_owned(), found });
    }
    Ok(reader.finish(at))
}

/// The next line that holds data, without its comment.
fn required_line<R: Read>(
    source: &mut Source<R>,
    expected: impl FnOnce() -> String,
) -> Result<(&[u8], Place), ReadError> {
    let last = source.line();
    match source.next_filled_line(Some(b'#'))? {
        Some((line, at)) => {
            let end = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
            Ok((line[..end].trim_ascii_end(), at))
        }
        None => Err(ReadError::Truncated { at: last, expected: expected() }),
    }
}

/// The keyword and the counts of vertices and faces, with the place of the counts.
fn header(source: &mut Source<impl Read>) -> Result<(u64, u64, Place), ReadError> {
    let (line, at) = match required_line(source, String::new) {
        Err(ReadError::Truncated { .. }) => return Err(ReadError::Empty { expected: "OFF text".to_owned() }),
        line => line?,
    };
    let mut tokens = Tokens::new(line);
    let word = tokens.next().unwrap_or_default();
    let keyword_end = word.iter().position(u8::is_ascii_digit).filter(|k| *k > 0).unwrap_or(word.len());
    let (keyword, digits) = word.split_at(keyword_end);
    match keyword {
        b"OFF" | b"COFF" | b"NOFF" | b"CNOFF" | b"STOFF" | b"STCOFF" | b"STNOFF" | b"STCNOFF" => {}
        _ if keyword.ends_with(b"OFF") => {
            let what = format!("`{}`", tokens::name(word));
            return Err(ReadError::Unsupported { at, what });
        }
        _ => return Err(ReadError::unexpected(at, "`OFF`, the first word of an OFF file", word)),
    }
    if tokens.rest() == b"BINARY" {
        return Err(ReadError::Unsupported { at, what: "binary OFF".to_owned() });
    }
    let on_first = !digits.is_empty() || !tokens.rest().is_empty();
    if on_first {
        // some writers leave no space between the keyword and the first count
        let rest = if digits.is_empty() { tokens.rest() } else { &line[keyword_end..] };
        return counts(rest, at);
    }
    let (line, at) = required_line(source, || "the numbers of vertices and faces".to_owned())?;
    counts(line, at)
}

fn counts(line: &[u8], at: Place) -> Result<(u64, u64, Place), ReadError> {
    let mut tokens = Tokens::new(line);
    let mut count = |what: &str| {
        let token = tokens.next().unwrap_or_default();
        let count = std::str::from_utf8(token).ok().and_then(|t| t.parse::<u64>().ok());
        count.ok_or_else(|| ReadError::unexpected(at, what, token))
    };
    let (vertices, faces) = (count("the number of vertices")?, count("the number of faces")?);
    if !tokens.rest().is_empty() {
        let token = tokens.next().unwrap_or_default();
        if tokens::integer(token).is_none() {
            return Err(ReadError::unexpected(at, "the number of edges", token));
        }
        if !tokens.rest().is_empty() {
            return Err(ReadError::unexpected(at, "the end of the line", tokens.rest()));
        }
    }
    Ok((vertices, faces, at))
}

/// The reader's state beside the soup.
struct Reader {
    builder: Builder,
    corners: Vec<u32>,
    /// Faces without and with a colour.
    plain_faces: u64,
    colored: u64,
}

impl Reader {
    fn vertex(&mut self, line: &[u8], at: Place, row: u64) -> Result<(), ReadError> {
        let mut tokens = Tokens::new(line);
        let mut coordinate = |name: char| {
            let token = tokens.next().unwrap_or_default();
            tokens::float(token).ok_or_else(|| {
                ReadError::unexpected(at, format!("the {name} coordinate of vertex {row}"), token)
            })
        };
        let position = DVec3::new(coordinate('x')?, coordinate('y')?, coordinate('z')?);
        let mut extras = 0;
        for token in tokens {
            extras += 1;
            if extras > MOST_EXTRAS || tokens::float(token).is_none() {
                return Err(ReadError::unexpected(at, format!("the end of vertex {row}"), token));
            }
        }
        if extras > 0 {
            self.builder.ignore("vertex attributes", at);
        }
        self.builder.vertex(position, at)
    }

    fn face(&mut self, line: &[u8], at: Place, vertices: u64) -> Result<(), ReadError> {
        let mut tokens = Tokens::new(line);
        let token = tokens.next().unwrap_or_default();
        let count = tokens::integer(token)
            .filter(|count| *count >= 3)
            .ok_or_else(|| ReadError::unexpected(at, "a face's number of vertices (at least 3)", token))?;
        self.corners.clear();
        for _ in 0..count {
            let token = tokens.next().unwrap_or_default();
            let index = tokens::integer(token)
                .ok_or_else(|| ReadError::unexpected(at, format!("{count} vertex indices"), token))?;
            match u32::try_from(index) {
                Ok(id) if u64::from(id) < vertices => self.corners.push(id),
                _ => return Err(ReadError::IndexOutOfRange { at, index, vertices, base: 0, declared: true }),
            }
        }
        self.builder.polygon(&self.corners, at)?;
        match color(tokens, at)? {
            Some(color) => {
                self.colored += 1;
                if self.plain_faces == 0 {
                    self.builder.color(color);
                }
            }
            None => {
                self.plain_faces += 1;
                self.builder.soup.triangle_colors = Vec::new();
            }
        }
        Ok(())
    }

    fn finish(mut self, at: Place) -> (TriangleSoup, ReadReport) {
        if self.plain_faces > 0 && self.colored > 0 {
            self.builder.ignore("colours of some faces only", at);
        }
        self.builder.finish()
    }
}

/// Three or four numbers: integers from 0 to 255, or decimals from 0 to 1. None, or one index of a palette: no colour.
fn color(tokens: Tokens<'_>, at: Place) -> Result<Option<[u8; 3]>, ReadError> {
    let wrong =
        |found: &[u8]| ReadError::unexpected(at, "a face colour of 3 or 4 numbers, or nothing", found);
    let rest = tokens.rest();
    let mut numbers = [0.0; 4];
    let mut count = 0;
    for token in tokens {
        let number = tokens::float(token).ok_or_else(|| wrong(token))?;
        *numbers.get_mut(count).ok_or_else(|| wrong(token))? = number;
        count += 1;
    }
    match count {
        0 | 1 => Ok(None),
        3 | 4 => {
            let whole = Tokens::new(rest).all(|token| tokens::integer(token).is_some());
            let (most, scale) = if whole { (255.0, 1.0) } else { (1.0, 255.0) };
            if numbers.iter().any(|n| !(0.0..=most).contains(n)) {
                return Err(wrong(rest));
            }
            let [red, green, blue, _] = numbers.map(|n| (n * scale).round() as u8);
            Ok(Some([red, green, blue]))
        }
        _ => Err(wrong(rest)),
    }
}
