//! Words, numbers and names out of the bytes of a line.
//!
//! Promises: a decimal number becomes the nearest f64 (ties to even) whatever its length and exponent, by the standard
//! library's parser; `inf`, `nan` and the spellings that C runtimes print are read as such.

/// The words of a line: runs of bytes between ASCII white space.
#[derive(Clone)]
pub(super) struct Tokens<'a>(&'a [u8]);

impl<'a> Tokens<'a> {
    pub(super) fn new(line: &'a [u8]) -> Self {
        Self(line)
    }

    /// What is left of the line, without white space at its ends.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.0.trim_ascii()
    }

    /// Number of bytes not yet taken.
    pub(super) fn left(&self) -> usize {
        self.0.len()
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let Some(from) = self.0.iter().position(|b| !b.is_ascii_whitespace()) else {
            self.0 = &[];
            return None;
        };
        let word = &self.0[from..];
        let to = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.0 = &word[to..];
        Some(&word[..to])
    }
}

/// The f64 nearest to a decimal number; infinities and NaN in any usual spelling.
#[inline]
pub(super) fn float(token: &[u8]) -> Option<f64> {
    std::str::from_utf8(token).ok().and_then(|t| t.parse().ok()).or_else(|| not_finite(token))
}

/// Infinity and NaN as printed by C runtimes: `1.#INF`, `-1.#IND00`, `nan(snan)`, `-nan(0x8000)`.
#[cold]
fn not_finite(token: &[u8]) -> Option<f64> {
    let lower = token.to_ascii_lowercase();
    let (sign, word) = match lower.split_first() {
        Some((b'-', word)) => (-1.0, word),
        Some((b'+', word)) => (1.0, word),
        _ => (1.0, &lower[..]),
    };
    let tail = |prefix: &[u8]| word.strip_prefix(prefix);
    let zeros = |t: &[u8]| t.iter().all(|b| *b == b'0');
    if tail(b"1.#inf").is_some_and(zeros) {
        return Some(sign * f64::INFINITY);
    }
    let printed = tail(b"nan(").is_some_and(|t| t.ends_with(b")"))
        || [&b"1.#ind"[..], b"1.#qnan", b"1.#snan"].iter().any(|p| tail(p).is_some_and(zeros));
    printed.then_some(sign * f64::NAN)
}

/// A decimal integer with an optional sign.
#[inline]
pub(super) fn integer(token: &[u8]) -> Option<i64> {
    let (negative, digits) = match token.split_first()? {
        (b'-', digits) => (true, digits),
        (b'+', digits) => (false, digits),
        _ => (false, token),
    };
    if digits.is_empty() || digits.len() > 18 {
        return std::str::from_utf8(token).ok()?.parse().ok();
    }
    let mut value = 0_i64;
    for byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value = 10 * value + i64::from(digit);
    }
    Some(if negative { -value } else { value })
}

/// A name as text: UTF-8, else Latin-1, in which older programs write.
pub(super) fn name(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}
