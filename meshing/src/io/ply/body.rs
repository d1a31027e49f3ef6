//! The data of a PLY file, value by value: [`Body`], text or binary behind one face.

use super::super::error::{Place, ReadError, shown};
use super::super::source::Source;
use super::super::tokens::{self, Tokens};
use super::header::{Element, Encoding, Kind, Scalar};
use std::fmt;
use std::io::Read;

/// The value about to be read, for messages.
#[derive(Clone, Copy)]
pub(super) struct What<'a> {
    pub(super) element: &'a Element,
    pub(super) row: u64,
    /// Index of the property; past the last for the row itself.
    pub(super) property: usize,
}

impl fmt::Display for What<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(property) = self.element.properties.get(self.property) {
            write!(f, "`{}` of ", property.name)?;
        }
        write!(f, "{} {} of the {} declared", self.element.name, self.row + 1, self.element.rows)
    }
}

/// Reads values in the order of the header.
pub(super) struct Body<'s, R> {
    source: &'s mut Source<R>,
    encoding: Encoding,
    /// Text: the line in work and how much of it was taken.
    line: Vec<u8>,
    taken: usize,
    at: Place,
}

impl<'s, R: Read> Body<'s, R> {
    pub(super) fn new(source: &'s mut Source<R>, encoding: Encoding) -> Self {
        Self { source, encoding, line: Vec::new(), taken: 0, at: Place::Line(0) }
    }

    /// Where the value last read begins (binary) or stands (text).
    pub(super) fn place(&self) -> Place {
        self.at
    }

    /// Begins a row. In text each row is a line.
    #[inline]
    pub(super) fn begin_row(&mut self, what: What<'_>) -> Result<(), ReadError> {
        if self.encoding != Encoding::Ascii {
            self.at = self.source.byte();
            return Ok(());
        }
        self.line.clear();
        self.taken = 0;
        match self.source.next_filled_line(None)? {
            Some((line, at)) => {
                self.line.extend_from_slice(line);
                self.at = at;
            }
            None => {
                return Err(ReadError::Truncated { at: self.source.line(), expected: what.to_string() });
            }
        }
        Ok(())
    }

    /// Ends a row: in text nothing may be left on the line.
    #[inline]
    pub(super) fn end_row(&mut self, what: What<'_>) -> Result<(), ReadError> {
        if self.encoding == Encoding::Ascii && self.taken < self.line.len() {
            let rest = self.line[self.taken..].trim_ascii();
            if !rest.is_empty() {
                return Err(ReadError::Unexpected {
                    at: self.at,
                    expected: format!("the end of {}", What { property: usize::MAX, ..what }),
                    found: shown(rest),
                });
            }
        }
        Ok(())
    }

    /// The next word of the line; empty at its end.
    #[inline]
    fn word(&mut self) -> &[u8] {
        let mut tokens = Tokens::new(&self.line[self.taken..]);
        let word = tokens.next().unwrap_or_default();
        self.taken = self.line.len() - tokens.left();
        word
    }

    #[inline]
    fn binary<const N: usize>(&mut self, what: What<'_>) -> Result<[u8; N], ReadError> {
        self.at = self.source.byte();
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.source.take(N, || what.to_string())?);
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// A number as f64: the nearest one in text, converted exactly in binary.
    #[inline]
    pub(super) fn float(&mut self, scalar: Scalar, what: What<'_>) -> Result<f64, ReadError> {
        if self.encoding == Encoding::Ascii {
            let at = self.at;
            let word = self.word();
            return tokens::float(word).ok_or_else(|| ReadError::unexpected(at, what.to_string(), word));
        }
        Ok(match scalar {
            Scalar::F32 => f64::from(f32::from_le_bytes(self.binary(what)?)),
            Scalar::F64 => f64::from_le_bytes(self.binary(what)?),
            _ => self.integer(scalar, what)? as f64, // at most 32 bits: exact
        })
    }

    /// An integer of an integer type.
    #[inline]
    pub(super) fn integer(&mut self, scalar: Scalar, what: What<'_>) -> Result<i64, ReadError> {
        if self.encoding == Encoding::Ascii {
            let at = self.at;
            let word = self.word();
            return tokens::integer(word)
                .ok_or_else(|| ReadError::unexpected(at, format!("an integer, {what}"), word));
        }
        Ok(match scalar {
            Scalar::I8 => i64::from(i8::from_le_bytes(self.binary(what)?)),
            Scalar::U8 => i64::from(u8::from_le_bytes(self.binary(what)?)),
            Scalar::I16 => i64::from(i16::from_le_bytes(self.binary(what)?)),
            Scalar::U16 => i64::from(u16::from_le_bytes(self.binary(what)?)),
            Scalar::I32 => i64::from(i32::from_le_bytes(self.binary(what)?)),
            Scalar::U32 => i64::from(u32::from_le_bytes(self.binary(what)?)),
            Scalar::F32 | Scalar::F64 => unreachable!("the header check admits integer types only"),
        })
    }

    /// The length of a list, not negative.
    #[inline]
    pub(super) fn length(&mut self, scalar: Scalar, what: What<'_>) -> Result<u64, ReadError> {
        let length = self.integer(scalar, what)?;
        u64::try_from(length).map_err(|_| ReadError::Unexpected {
            at: self.at,
            expected: format!("the length of the list {what}"),
            found: length.to_string(),
        })
    }

    /// Passes over a value.
    pub(super) fn skip(&mut self, kind: Kind, what: What<'_>) -> Result<(), ReadError> {
        let (count, item) = match kind {
            Kind::Scalar(scalar) => (1, scalar),
            Kind::List { count, item } => (self.length(count, what)?, item),
        };
        if self.encoding != Encoding::Ascii {
            return self.source.skip(count * item.size() as u64, || what.to_string());
        }
        for _ in 0..count {
            if self.word().is_empty() {
                return Err(ReadError::unexpected(self.at, what.to_string(), b""));
            }
        }
        Ok(())
    }

    /// Passes over all rows of an element.
    pub(super) fn skip_element(&mut self, element: &Element) -> Result<(), ReadError> {
        if element.properties.is_empty() {
            return Ok(());
        }
        let mut what = What { element, row: 0, property: usize::MAX };
        if let (Some(stride), true) = (element.stride(), self.encoding != Encoding::Ascii) {
            let last = What { row: element.rows.saturating_sub(1), ..what };
            return self.source.skip(stride.saturating_mul(element.rows), || last.to_string());
        }
        for row in 0..element.rows {
            what.row = row;
            self.begin_row(what)?;
            for (property, p) in element.properties.iter().enumerate() {
                self.skip(p.kind, What { property, ..what })?;
            }
            self.end_row(what)?;
        }
        Ok(())
    }

    /// Nothing but white space may follow.
    pub(super) fn expect_end(&mut self, elements: &[Element]) -> Result<(), ReadError> {
        let after =
            || elements.last().map_or("line of the header".to_owned(), |e| format!("{} declared", e.name));
        if self.encoding != Encoding::Ascii {
            return self.source.expect_end(after);
        }
        match self.source.next_filled_line(None)? {
            None => Ok(()),
            Some((line, at)) => Err(ReadError::TrailingData { at, after: after(), found: shown(line) }),
        }
    }
}
