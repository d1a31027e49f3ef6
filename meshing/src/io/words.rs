//! The words of a text file whose lines matter little: [`Words`]; also the lines and bytes of one that changes between text and binary.

use std::io::Read;

use super::error::{Place, ReadError, shown};
use super::source::Source;
use super::tokens::{self, Tokens};

/// A reader of words, over lines.
pub(super) struct Words<R> {
    source: Source<R>,
    /// What begins a comment, to the end of its line.
    comment: Option<u8>,
    /// The line in work and how much of it was taken.
    line: Vec<u8>,
    taken: usize,
    at: Place,
    /// Places are bytes: lines mean nothing to who looks into a file that is binary in part.
    pub(super) in_bytes: bool,
}

impl<R: Read> Words<R> {
    pub(super) fn new(source: Source<R>, comment: Option<u8>) -> Self {
        Self { source, comment, line: Vec::new(), taken: 0, at: Place::Line(1), in_bytes: false }
    }

    /// Where the file ended: its last line, or the byte after the last.
    pub(super) fn end(&self) -> Place {
        if self.in_bytes { self.source.byte() } else { self.source.line() }
    }

    /// Where the line of the word last taken stands.
    pub(super) fn place(&self) -> Place {
        self.at
    }

    /// The bytes behind the line in work.
    pub(super) fn source(&mut self) -> &mut Source<R> {
        &mut self.source
    }

    /// What is left of the line in work.
    pub(super) fn rest_of_line(&self) -> &[u8] {
        self.line[self.taken..].trim_ascii()
    }

    /// The next word; none at the end of the file.
    #[inline]
    pub(super) fn word(&mut self) -> Result<Option<&[u8]>, ReadError> {
        loop {
            let mut tokens = Tokens::new(&self.line[self.taken..]);
            if let Some(word) = tokens.next() {
                let (end, length) = (self.line.len() - tokens.left(), word.len());
                self.taken = end;
                return Ok(Some(&self.line[end - length..end]));
            }
            if !self.begin_line()? {
                return Ok(None);
            }
        }
    }

    /// Takes the next line that holds a word.
    fn begin_line(&mut self) -> Result<bool, ReadError> {
        self.line.clear();
        self.taken = 0;
        let Some((line, at)) = self.source.next_filled_line(self.comment)? else { return Ok(false) };
        let end = self.comment.and_then(|comment| line.iter().position(|&byte| byte == comment));
        self.line.extend_from_slice(&line[..end.unwrap_or(line.len())]);
        self.at = if self.in_bytes { self.source.line_begin() } else { at };
        Ok(true)
    }

    /// What is left of the line in work, taken.
    pub(super) fn take_rest(&mut self) -> &[u8] {
        let from = std::mem::replace(&mut self.taken, self.line.len());
        self.line[from..].trim_ascii()
    }

    /// The next line that holds a word, without the white space at its ends; none at the end of the file.
    pub(super) fn filled_line(&mut self) -> Result<Option<&[u8]>, ReadError> {
        if self.rest_of_line().is_empty() && !self.begin_line()? {
            return Ok(None);
        }
        let from = self.taken;
        self.taken = self.line.len();
        Ok(Some(self.line[from..].trim_ascii()))
    }

    /// The next word, which there must be.
    #[inline]
    pub(super) fn required(&mut self, expected: impl Fn() -> String) -> Result<&[u8], ReadError> {
        // Asked in two steps: the borrow of a word found would last over the error.
        let rest = &self.line[self.taken..];
        if rest.iter().all(u8::is_ascii_whitespace) && !self.begin_line()? {
            return Err(ReadError::Truncated { at: self.end(), expected: expected() });
        }
        Ok(self.word()?.unwrap_or_default())
    }

    /// Whether there is a next word, and it is such a one; it is not taken.
    pub(super) fn next_is(&mut self, wanted: impl Fn(&[u8]) -> bool) -> Result<bool, ReadError> {
        if self.rest_of_line().is_empty() && !self.begin_line()? {
            return Ok(false);
        }
        Ok(Tokens::new(&self.line[self.taken..]).next().is_some_and(wanted))
    }

    /// The next word as an integer.
    #[inline]
    pub(super) fn integer(&mut self, expected: impl Fn() -> String) -> Result<i64, ReadError> {
        let word = self.required(&expected)?;
        match tokens::integer(word) {
            Some(number) => Ok(number),
            None => {
                let found = shown(word);
                Err(ReadError::Unexpected { at: self.at, expected: expected(), found })
            }
        }
    }

    /// The next word as an integer that is not negative.
    #[inline]
    pub(super) fn count(&mut self, expected: impl Fn() -> String) -> Result<u64, ReadError> {
        let number = self.integer(&expected)?;
        let wrong =
            |_| ReadError::Unexpected { at: self.at, expected: expected(), found: number.to_string() };
        u64::try_from(number).map_err(wrong)
    }

    /// The next word as a number.
    #[inline]
    pub(super) fn float(&mut self, expected: impl Fn() -> String) -> Result<f64, ReadError> {
        let word = self.required(&expected)?;
        match tokens::float(word) {
            Some(number) => Ok(number),
            None => {
                let found = shown(word);
                Err(ReadError::Unexpected { at: self.at, expected: expected(), found })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_go_over_lines_and_stop_at_comments() {
        let text = "one 2 # three\n\n# four\n5.5\n rest of it \n";
        let mut words = Words::new(Source::new(text.as_bytes()), Some(b'#'));
        assert_eq!(words.word().unwrap(), Some(&b"one"[..]));
        assert_eq!(words.integer(String::new).unwrap(), 2);
        assert_eq!(words.float(String::new).unwrap(), 5.5);
        assert_eq!(words.place(), Place::Line(4));
        assert_eq!(words.filled_line().unwrap(), Some(&b"rest of it"[..]));
        assert_eq!(words.word().unwrap(), None);
        let error = words.count(|| "a count".to_owned()).unwrap_err();
        assert_eq!(error.to_string(), "line 5: the file ends here, expected a count");
    }

    #[test]
    fn wrong_words_are_named() {
        let mut words = Words::new(Source::new(&b"-1 x"[..]), None);
        let error = words.count(|| "a count".to_owned()).unwrap_err();
        assert_eq!(error.to_string(), "line 1: expected a count, found -1");
        let error = words.float(|| "a number".to_owned()).unwrap_err();
        assert_eq!(error.to_string(), "line 1: expected a number, found `x`");
    }
}
