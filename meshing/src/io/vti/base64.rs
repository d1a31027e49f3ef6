//! Bytes as base64 (RFC 4648) on their way to a writer: [`Base64`].

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
        }
    }
}
