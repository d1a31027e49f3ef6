//! Reads STL, text or binary, told apart by content: a binary header may begin with `solid` as text does.

use super::super::builder::Builder;
use super::super::error::{Place, ReadError};
use super::super::source::Source;
use super::super::{Limits, ReadReport};
use super::read_ascii;
use super::weld::Weld;
use crate::surface::TriangleSoup;
use glam::DVec3;
use std::io::Read;

/// Bytes looked at to tell text from binary: the header and about eighty triangles.
const PROBE: usize = 4096;
/// A binary file: 80 bytes of anything, then the number of triangles.
const HEADER: usize = 84;
/// A binary triangle: normal, three corners, two attribute bytes.
const RECORD: usize = 50;

/// Triangles of corners, made to share vertices.
pub(super) struct Facets {
    pub(super) builder: Builder,
    weld: Weld,
}

impl Facets {
    #[inline]
    pub(super) fn facet(&mut self, corners: [DVec3; 3], at: Place) -> Result<(), ReadError> {
        let mut ids = [0; 3];
        for (id, corner) in ids.iter_mut().zip(corners) {
            *id = match self.weld.find(corner, &self.builder.soup.positions) {
                Some(id) => id,
                None => {
                    let next = self.builder.soup.positions.len() as u32;
                    self.builder.vertex(corner, at)?;
                    next
                }
            };
        }
        self.builder.triangle(ids, at)
    }
}

pub(in super::super) fn read(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, ReadReport), ReadError> {
    let mut source = Source::new(input);
    let mut facets = Facets { builder: Builder::new(limits), weld: Weld::new() };
    match probe(source.fill(PROBE)?)? {
        Encoding::Text => {
            source.begin_text("STL")?;
            read_ascii::read(&mut source, &mut facets)?;
        }
        Encoding::Binary => read_binary(&mut source, &mut facets)?,
    }
    Ok(facets.builder.finish())
}

enum Encoding {
    Text,
    Binary,
}

/// Text begins with `solid`, and has no control characters, or speaks of facets where a binary file has its triangles.
fn probe(head: &[u8]) -> Result<Encoding, ReadError> {
    const EXPECTED: &str = "STL (`solid` and text, or binary)";
    let encoding = |found| Err(ReadError::Encoding { found, expected: EXPECTED });
    match head {
        [] => return Err(ReadError::Empty { expected: EXPECTED.to_owned() }),
        [0xff, 0xfe, _, 0, _, 0, ..] | [0xfe, 0xff, 0, _, 0, _, ..] => return encoding("UTF-16 text"),
        [b's' | b'S', 0, b'o' | b'O', 0, ..] | [0, b's' | b'S', 0, b'o' | b'O', ..] => {
            return encoding("UTF-16 text");
        }
        [0x1f, 0x8b, 8, ..] => return encoding("gzip data"),
        [b'P', b'K', 3, 4, ..] => return encoding("a zip archive"),
        _ => {}
    }
    let lower = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start().to_ascii_lowercase();
    let plain = |b: &u8| b.is_ascii_whitespace() || *b == 0x0b || (*b >= 0x20 && *b != 0x7f);
    let text = head.iter().all(plain);
    if lower.starts_with(b"solid") {
        let body = lower.get(HEADER..).unwrap_or_default();
        let has = |word: &[u8]| body.windows(word.len()).any(|w| w == word);
        let facets = has(b"facet") || has(b"vertex") || has(b"endsolid");
        return Ok(if text || facets { Encoding::Text } else { Encoding::Binary });
    }
    if lower.is_empty() {
        return Err(ReadError::Empty { expected: EXPECTED.to_owned() });
    }
    if text {
        let word = lower.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        return Err(ReadError::unexpected(Place::Line(1), EXPECTED, word));
    }
    Ok(Encoding::Binary)
}

fn read_binary(source: &mut Source<impl Read>, facets: &mut Facets) -> Result<(), ReadError> {
    let header = source.take(HEADER, || "the 84 bytes of a binary STL header".to_owned())?;
    let count = u32::from_le_bytes(le(header, 80));
    facets.builder.declare(0, u64::from(count), Place::Byte(80))?;
    for k in 0..count {
        let at = source.byte();
        let record =
            source.take(RECORD, || format!("triangle {} of the {count} declared", u64::from(k) + 1))?;
        let number = |offset: usize| f64::from(f32::from_le_bytes(le(record, offset)));
        let corner = |k: usize| DVec3::new(number(12 * k), number(12 * k + 4), number(12 * k + 8));
        if record[48..] != [0, 0] {
            facets.builder.ignore("attribute bytes", at);
        }
        facets.facet([corner(1), corner(2), corner(3)], at)?;
    }
    source.expect_end(|| format!("of the {count} triangles declared"))
}

#[inline]
fn le(bytes: &[u8], offset: usize) -> [u8; 4] {
    let mut word = [0; 4];
    word.copy_from_slice(&bytes[offset..offset + 4]);
    word
}
