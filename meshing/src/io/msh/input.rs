//! The numbers of an MSH file, text or binary behind one face: [`Input`].

use std::io::Read;

use crate::io::error::{Place, ReadError, shown};
use crate::io::source::Source;
use crate::io::tokens;
use crate::io::words::Words;

/// A reader of lines and numbers.
pub(super) struct Input<R> {
    words: Words<R>,
    pub(super) binary: bool,
    big_endian: bool,
    /// Size of a count in binary: 4 or 8 bytes.
    size: usize,
    /// Where the number last read from binary begins.
    at: Place,
}

impl<R: Read> Input<R> {
    pub(super) fn new(source: Source<R>) -> Self {
        let words = Words::new(source, None);
        Self { words, binary: false, big_endian: false, size: 8, at: Place::Byte(0) }
    }

    /// Where the number last read stands.
    pub(super) fn place(&self) -> Place {
        if self.binary { self.at } else { self.words.place() }
    }

    /// Where the line or word of text last read stands.
    pub(super) fn line_place(&self) -> Place {
        self.words.place()
    }

    /// Text, also where numbers are binary.
    pub(super) fn words(&mut self) -> &mut Words<R> {
        &mut self.words
    }

    /// Changes to binary: the number 1 in four bytes tells the byte order.
    pub(super) fn begin_binary(&mut self, size: usize) -> Result<(), ReadError> {
        let at = self.words.source().byte();
        let one = self.words.source().take(4, || "the number 1, which tells the byte order".to_owned())?;
        self.big_endian = match one {
            [1, 0, 0, 0] => false,
            [0, 0, 0, 1] => true,
            _ => return Err(ReadError::unexpected(at, "the number 1 in four bytes", one)),
        };
        (self.binary, self.size, self.words.in_bytes) = (true, size, true);
        Ok(())
    }

    fn bytes<const N: usize>(&mut self, expected: impl FnOnce() -> String) -> Result<[u8; N], ReadError> {
        self.at = self.words.source().byte();
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.words.source().take(N, expected)?);
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// An integer of 32 bits.
    #[inline]
    pub(super) fn int(&mut self, expected: impl Fn() -> String) -> Result<i32, ReadError> {
        if self.binary {
            return self.bytes(expected).map(i32::from_le_bytes);
        }
        let number = self.words.integer(&expected)?;
        i32::try_from(number).map_err(|_| {
            let at = self.words.place();
            ReadError::Unexpected {
                at,
                expected: format!("{} of 32 bits", expected()),
                found: number.to_string(),
            }
        })
    }

    /// A count, or the number of a node or element.
    #[inline]
    pub(super) fn size(&mut self, expected: impl Fn() -> String) -> Result<u64, ReadError> {
        match (self.binary, self.size) {
            (false, _) => self.words.count(expected),
            (true, 4) => self.bytes(expected).map(|bytes| u32::from_le_bytes(bytes).into()),
            (true, _) => self.bytes(expected).map(u64::from_le_bytes),
        }
    }

    #[inline]
    pub(super) fn double(&mut self, expected: impl Fn() -> String) -> Result<f64, ReadError> {
        if self.binary { self.bytes(expected).map(f64::from_le_bytes) } else { self.words.float(expected) }
    }

    /// The end of a section.
    pub(super) fn end_section(&mut self, name: &str) -> Result<(), ReadError> {
        let end = format!("$End{name}");
        match self.words.filled_line()? {
            Some(line) if line == end.as_bytes() => Ok(()),
            Some(line) => {
                let found = shown(line);
                Err(ReadError::Unexpected { at: self.words.place(), expected: shown(end.as_bytes()), found })
            }
            None => Err(ReadError::Truncated { at: self.words.end(), expected: shown(end.as_bytes()) }),
        }
    }

    /// Passes over a section, of text or of binary data.
    pub(super) fn skip_section(&mut self, name: &str) -> Result<(), ReadError> {
        let end = format!("$End{name}");
        if self.binary {
            self.words.source().skip_past(end.as_bytes())?;
            return Ok(());
        }
        loop {
            match self.words.filled_line()? {
                Some(line) if line == end.as_bytes() => return Ok(()),
                Some(_) => {}
                None => {
                    return Err(ReadError::Truncated {
                        at: self.words.end(),
                        expected: shown(end.as_bytes()),
                    });
                }
            }
        }
    }

    /// A line that is one integer, also where numbers are binary.
    pub(super) fn text_count(&mut self, expected: impl Fn() -> String) -> Result<u64, ReadError> {
        let count = self.words.count(expected)?;
        if self.words.rest_of_line().is_empty() {
            return Ok(count);
        }
        let found = shown(self.words.rest_of_line());
        Err(ReadError::Unexpected {
            at: self.words.place(),
            expected: "the end of the line".to_owned(),
            found,
        })
    }

    /// A line as text.
    pub(super) fn text_line(&mut self, expected: impl FnOnce() -> String) -> Result<String, ReadError> {
        match self.words.filled_line()? {
            Some(line) => Ok(tokens::name(line)),
            None => Err(ReadError::Truncated { at: self.words.end(), expected: expected() }),
        }
    }
}
