//! Bytes as base64 (RFC 4648) on their way to a writer: [`Base64`]; and back: [`Decoder`].

use std::io::{self, Write};

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Takes bytes in pieces of any length and writes four characters for each three.
pub(super) struct Base64<'w, W> {
    output: &'w mut W,
    left: [u8; 3],
    count: usize,
}

impl<'w, W: Write> Base64<'w, W> {
    pub(super) fn new(output: &'w mut W) -> Self {
        Self { output, left: [0; 3], count: 0 }
    }

    pub(super) fn push(&mut self, bytes: &[u8]) -> io::Result<()> {
        for &byte in bytes {
            self.left[self.count] = byte;
            self.count += 1;
            if self.count == 3 {
                self.output.write_all(&characters(self.left))?;
                self.count = 0;
            }
        }
        Ok(())
    }

    /// Writes what is left, padded.
    pub(super) fn finish(self) -> io::Result<()> {
        if self.count == 0 {
            return Ok(());
        }
        let mut bytes = [0; 3];
        bytes[..self.count].copy_from_slice(&self.left[..self.count]);
        let mut text = characters(bytes);
        text[self.count + 1..].fill(b'=');
        self.output.write_all(&text)
    }
}

fn characters([a, b, c]: [u8; 3]) -> [u8; 4] {
    let bits = u32::from(a) << 16 | u32::from(b) << 8 | u32::from(c);
    [18, 12, 6, 0].map(|shift| ALPHABET[(bits >> shift & 63) as usize])
}

/// Takes characters and gives bytes. Padding ends a group, not the text: what follows is decoded on, as VTK encodes a length apart from
/// what it is the length of.
#[derive(Default)]
pub(in crate::io) struct Decoder {
    bits: u32,
    /// Characters of the group so far.
    count: usize,
    /// How many of them were padding.
    padding: usize,
}

impl Decoder {
    /// Appends the bytes that `character` completes; none if it is no character of base64 or stands where it cannot.
    pub(in crate::io) fn push(&mut self, character: u8, bytes: &mut Vec<u8>) -> Option<()> {
        let digit = match character {
            b'A'..=b'Z' => character - b'A',
            b'a'..=b'z' => character - b'a' + 26,
            b'0'..=b'9' => character - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' if self.count >= 2 => {
                self.padding += 1;
                0
            }
            _ => return None,
        };
        if self.padding > 0 && character != b'=' {
            return None;
        }
        self.bits = self.bits << 6 | u32::from(digit);
        self.count += 1;
        if self.count == 4 {
            bytes.extend_from_slice(&self.bits.to_be_bytes()[1..4 - self.padding]);
            *self = Self::default();
        }
        Some(())
    }

    /// Whether no group is open.
    pub(in crate::io) fn is_whole(&self) -> bool {
        self.count == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_examples_of_the_standard() {
        let examples = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
        ];
        for (bytes, text) in examples {
            for cut in 0..=bytes.len() {
                let mut written = Vec::new();
                let mut base64 = Base64::new(&mut written);
                base64.push(&bytes.as_bytes()[..cut]).unwrap();
                base64.push(&bytes.as_bytes()[cut..]).unwrap();
                base64.finish().unwrap();
                assert_eq!(String::from_utf8(written).unwrap(), text);
            }
            let (mut decoder, mut decoded) = (Decoder::default(), Vec::new());
            text.bytes().for_each(|character| decoder.push(character, &mut decoded).unwrap());
            assert!(decoder.is_whole());
            assert_eq!(decoded, bytes.as_bytes());
        }
    }

    #[test]
    fn what_is_no_base64_is_refused() {
        let accepted = |text: &str| {
            let (mut decoder, mut bytes) = (Decoder::default(), Vec::new());
            text.bytes().all(|character| decoder.push(character, &mut bytes).is_some())
        };
        assert!(accepted("Zg==Zg=="));
        for text in ["=", "Z=", "Zg=v", "Zm9v=", "Zm9v ", "Z<"] {
            assert!(!accepted(text), "{text}");
        }
    }
}
