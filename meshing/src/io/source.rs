//! Streaming input: [`Source`] gives lines of text or runs of bytes out of one bounded buffer and knows where it is.
//!
//! Promises: no byte is copied more than once or kept longer than the line or record it belongs to; the buffer is
//! [`CHUNK`] bytes and grows only for a longer line, up to [`MAX_LINE`]; an interrupted read is tried again.
//! Does not promise: decoding; lines are bytes, ended by `\n`, `\r\n` or `\r`.

use super::error::{Place, ReadError, SHOWN, shown};
use std::io::{ErrorKind, Read};

/// Size of the buffer: large enough that the cost of a read vanishes, small enough to stay in the second-level cache.
const CHUNK: usize = 256 * 1024;
/// Longest line. A polygon of a million corners fits; a gigabyte of binary data without a line end does not.
pub(super) const MAX_LINE: usize = 16 * 1024 * 1024;

/// A reader with a buffer, a byte offset and a line number.
pub(super) struct Source<R> {
    reader: R,
    buffer: Vec<u8>,
    /// The bytes not yet taken are `buffer[start..end]`.
    start: usize,
    end: usize,
    /// Offset in the file of `buffer[0]`.
    base: u64,
    at_end: bool,
    /// Number of lines taken.
    line: u64,
    /// Offset in the file of the line last taken.
    line_begin: u64,
    /// Lines end at `\r` alone: a `\n` after it belongs to what follows.
    cr_only: bool,
}

impl<R: Read> Source<R> {
    pub(super) fn new(reader: R) -> Self {
        Self {
            reader,
            buffer: vec![0; CHUNK],
            start: 0,
            end: 0,
            base: 0,
            at_end: false,
            line: 0,
            line_begin: 0,
            cr_only: false,
        }
    }

    /// Offset in the file of the next byte.
    pub(super) fn offset(&self) -> u64 {
        self.base + self.start as u64
    }

    /// The next byte as a place.
    pub(super) fn byte(&self) -> Place {
        Place::Byte(self.offset())
    }

    /// The line last taken, as a place; the first before any was taken.
    pub(super) fn line(&self) -> Place {
        Place::Line(self.line.max(1))
    }

    /// The first byte of the line last taken, as a place.
    pub(super) fn line_begin(&self) -> Place {
        Place::Byte(self.line_begin)
    }

    /// The line to be taken next, as a place.
    #[inline]
    pub(super) fn next_line_place(&self) -> Place {
        Place::Line(self.line + 1)
    }

    /// The bytes ahead: at least `n` unless the file ends before.
    #[inline]
    pub(super) fn fill(&mut self, n: usize) -> Result<&[u8], ReadError> {
        if self.end - self.start < n {
            self.read_more(n)?;
        }
        Ok(&self.buffer[self.start..self.end])
    }

    #[cold]
    fn read_more(&mut self, n: usize) -> Result<(), ReadError> {
        while self.end - self.start < n && !self.at_end {
            if self.buffer.len() - self.start < n || self.end == self.buffer.len() {
                self.buffer.copy_within(self.start..self.end, 0);
                self.base += self.start as u64;
                self.end -= self.start;
                self.start = 0;
            }
            if self.buffer.len() < n {
                self.buffer.resize(n.max(2 * self.buffer.len()), 0);
            }
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(0) => self.at_end = true,
                Ok(read) => self.end += read,
                Err(e) if e.kind() == ErrorKind::Interrupted => {}
                Err(source) => {
                    return Err(ReadError::Io { offset: self.base + self.end as u64, source });
                }
            }
        }
        Ok(())
    }

    /// Takes `n` bytes that [`fill`](Self::fill) has shown.
    #[inline]
    pub(super) fn consume(&mut self, n: usize) {
        debug_assert!(n <= self.end - self.start);
        self.start += n;
    }

    /// Takes exactly `n` bytes, or says where the file ends and what is missing.
    #[inline]
    pub(super) fn take(&mut self, n: usize, expected: impl FnOnce() -> String) -> Result<&[u8], ReadError> {
        if self.end - self.start < n {
            self.read_more(n)?;
            if self.end - self.start < n {
                let at = Place::Byte(self.base + self.end as u64);
                return Err(ReadError::Truncated { at, expected: expected() });
            }
        }
        let from = self.start;
        self.start += n;
        Ok(&self.buffer[from..from + n])
    }

    /// Passes over `n` bytes in bounded memory.
    pub(super) fn skip(&mut self, mut n: u64, expected: impl Fn() -> String) -> Result<(), ReadError> {
        while n > 0 {
            let step = n.min(CHUNK as u64) as usize;
            self.take(step, &expected)?;
            n -= step as u64;
        }
        Ok(())
    }

    /// Passes over everything up to and with `end`, in bounded memory.
    pub(super) fn skip_past(&mut self, end: &[u8]) -> Result<(), ReadError> {
        loop {
            let ahead = self.fill(end.len())?;
            if let Some(at) = ahead.windows(end.len()).position(|window| window == end) {
                self.consume(at + end.len());
                return Ok(());
            }
            if ahead.len() < end.len() {
                let at = Place::Byte(self.base + self.end as u64);
                return Err(ReadError::Truncated { at, expected: shown(end) });
            }
            let passed = ahead.len() - end.len() + 1;
            self.consume(passed);
        }
    }

    /// The next line without its end, or `None` at the end of the file.
    #[inline]
    pub(super) fn next_line(&mut self) -> Result<Option<&[u8]>, ReadError> {
        Ok(self.next_span()?.map(|(from, to)| &self.buffer[from..to]))
    }

    /// The next line that holds more than white space and, where `comment` is given, does not begin with that byte;
    /// without the white space at its ends, and with its place.
    #[inline]
    pub(super) fn next_filled_line(
        &mut self,
        comment: Option<u8>,
    ) -> Result<Option<(&[u8], Place)>, ReadError> {
        while let Some((from, to)) = self.next_span()? {
            let first = self.buffer[from..to].iter().find(|b| !b.is_ascii_whitespace());
            if first.is_some() && first.copied() != comment {
                return Ok(Some((self.buffer[from..to].trim_ascii(), Place::Line(self.line))));
            }
        }
        Ok(None)
    }

    /// Takes the next line; where it stands in the buffer, without its end.
    #[inline]
    fn next_span(&mut self) -> Result<Option<(usize, usize)>, ReadError> {
        let mut scanned = 0;
        loop {
            let ahead = &self.buffer[self.start + scanned..self.end];
            if let Some(k) = ahead.iter().position(|&b| b == b'\n' || b == b'\r') {
                return self.take_line(scanned + k).map(Some);
            }
            scanned = self.end - self.start;
            if self.at_end {
                self.line_begin = self.base + self.start as u64;
                self.start = self.end;
                self.line += u64::from(scanned > 0);
                return Ok((scanned > 0).then_some((self.end - scanned, self.end)));
            }
            if scanned > MAX_LINE {
                return Err(ReadError::LineTooLong { at: Place::Line(self.line + 1), limit: MAX_LINE });
            }
            self.read_more(scanned + 1)?;
        }
    }

    /// Takes `length` bytes and the line end after them.
    #[inline]
    fn take_line(&mut self, length: usize) -> Result<(usize, usize), ReadError> {
        let mut taken = length + 1;
        if self.buffer[self.start + length] == b'\r' && !self.cr_only {
            let after = self.fill(taken + 1)?.get(taken).copied();
            if after == Some(b'\n') {
                taken += 1;
            } else if self.line == 0 && after.is_some() {
                self.cr_only = true; // the first line decides, so that a binary body may begin with `\n`
            }
        }
        let from = self.start;
        self.line_begin = self.base + from as u64;
        self.start += taken;
        self.line += 1;
        Ok((from, from + length))
    }

    /// Refuses what is not single-byte text or UTF-8, and passes over a UTF-8 byte order mark.
    pub(super) fn begin_text(&mut self, expected: &'static str) -> Result<(), ReadError> {
        let head = self.fill(4)?;
        let zero = |k: usize| head.get(k) == Some(&0);
        let found = match head {
            [] => return Err(ReadError::Empty { expected: expected.to_owned() }),
            [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => "UTF-32 text",
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "UTF-16 text",
            [a, ..] if *a != 0 && zero(1) && zero(2) && zero(3) => "UTF-32 text",
            [a, _, b, ..] if *a != 0 && *b != 0 && zero(1) && zero(3) => "UTF-16 text",
            [_, a, _, b, ..] if *a != 0 && *b != 0 && zero(0) && zero(2) => "UTF-16 text",
            [0x1f, 0x8b, ..] => "gzip data",
            [b'P', b'K', 3, 4, ..] => "a zip archive",
            [0xef, 0xbb, 0xbf, ..] => {
                self.consume(3);
                return Ok(());
            }
            _ => return Ok(()),
        };
        Err(ReadError::Encoding { found, expected })
    }

    /// An error unless only white space and zero bytes follow.
    pub(super) fn expect_end(&mut self, after: impl FnOnce() -> String) -> Result<(), ReadError> {
        loop {
            let ahead = self.fill(1)?;
            if ahead.is_empty() {
                return Ok(());
            }
            let blank = ahead.iter().take_while(|b| b.is_ascii_whitespace() || **b == 0).count();
            let surplus = blank < ahead.len();
            self.consume(blank);
            if surplus {
                let at = self.byte();
                let found = shown(self.fill(SHOWN + 1)?);
                return Err(ReadError::TrailingData { at, after: after(), found });
            }
        }
    }
}
