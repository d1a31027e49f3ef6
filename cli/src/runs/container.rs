//! Files of a run that are read back: [`Container`], named sections with checksums.
//!
//! Promises: a file that is cut, changed in any bit (to the strength of CRC-32 \[Peterson61\]), of another kind or of another version is told
//! from a whole one; no file panics or makes the reader take memory beyond its own size.
//!
//! Format, all numbers little-endian: the eight bytes `WELTER\r\n`, version (u32), number of sections (u32); then each section: length of its
//! name (u32), length of its content (u64), name, content; at the end CRC-32 of everything before.

use std::fmt;

const MAGIC: &[u8; 8] = b"WELTER\r\n";

/// Raised when the meaning of a section changes.
const VERSION: u32 = 1;

/// Named sections in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Container(Vec<(String, Vec<u8>)>);

/// Why bytes are no container.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NoContainer {
    /// It begins differently.
    Foreign,
    /// Made by another version of the format.
    Version(u32),
    /// Something is missing or changed.
    Damaged(&'static str),
}

impl fmt::Display for NoContainer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => f.write_str("this is no file of a run"),
            Self::Version(version) => write!(f, "version {version} of the format, version {VERSION} is read"),
            Self::Damaged(what) => write!(f, "damaged: {what}"),
        }
    }
}

impl Container {
    pub(crate) fn with(mut self, name: &str, content: impl Into<Vec<u8>>) -> Self {
        self.0.push((name.to_owned(), content.into()));
        self
    }

    /// The content of the first section of a name.
    pub(crate) fn section(&self, name: &str) -> Option<&[u8]> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, content)| content.as_slice())
    }

    /// The same as text.
    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        self.section(name).and_then(|bytes| std::str::from_utf8(bytes).ok())
    }

    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let size: usize = self.0.iter().map(|(name, content)| 12 + name.len() + content.len()).sum();
        let mut bytes = Vec::with_capacity(20 + size);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(self.0.len() as u32).to_le_bytes());
        for (name, content) in &self.0 {
            bytes.extend_from_slice(&(name.len() as u32).to_le_bytes());
            bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
            bytes.extend_from_slice(name.as_bytes());
            bytes.extend_from_slice(content);
        }
        let sum = crc32fast::hash(&bytes);
        bytes.extend_from_slice(&sum.to_le_bytes());
        bytes
    }

    pub(crate) fn of_bytes(bytes: &[u8]) -> Result<Self, NoContainer> {
        let short = NoContainer::Damaged("the file ends too early");
        if !bytes.starts_with(MAGIC) {
            return Err(if MAGIC.starts_with(bytes) { short } else { NoContainer::Foreign });
        }
        let word = |at: usize| -> Option<u32> {
            bytes.get(at..at + 4).map(|word| u32::from_le_bytes(word.try_into().expect("4 bytes")))
        };
        let (Some(version), Some(count)) = (word(8), word(12)) else { return Err(short) };
        if version != VERSION {
            return Err(NoContainer::Version(version));
        }
        let Some((content, sum)) = bytes.split_last_chunk::<4>().filter(|(content, _)| content.len() >= 16)
        else {
            return Err(short);
        };
        if crc32fast::hash(content) != u32::from_le_bytes(*sum) {
            return Err(NoContainer::Damaged("the checksum is another one"));
        }
        // What follows can be wrong only if it was written so.
        let wrong = NoContainer::Damaged("its sections do not fit into it");
        let mut rest = &content[16..];
        let mut take = |count: u64| {
            let (taken, left) = rest.split_at_checked(usize::try_from(count).ok()?)?;
            rest = left;
            Some(taken)
        };
        let mut container = Self::default();
        for _ in 0..count {
            let section = (|| {
                let lengths = take(12)?;
                let name = u32::from_le_bytes(lengths[..4].try_into().ok()?);
                let length = u64::from_le_bytes(lengths[4..].try_into().ok()?);
                let name = String::from_utf8(take(name.into())?.to_vec()).ok()?;
                Some((name, take(length)?.to_vec()))
            })();
            container.0.push(section.ok_or_else(|| wrong.clone())?);
        }
        if rest.is_empty() { Ok(container) } else { Err(wrong) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn container() -> Container {
        Container::default().with("about", "{}").with("state", vec![0, 255, 13, 10]).with("empty", "")
    }

    #[test]
    fn sections_come_back() {
        let read = Container::of_bytes(&container().to_bytes()).unwrap();
        assert_eq!(read, container());
        assert_eq!((read.text("about"), read.section("state")), (Some("{}"), Some(&[0, 255, 13, 10][..])));
        assert_eq!((read.section("other"), read.text("state")), (None, None));
        assert_eq!(Container::of_bytes(&Container::default().to_bytes()), Ok(Container::default()));
    }

    #[test]
    fn every_change_and_every_cut_is_noticed() {
        let bytes = container().to_bytes();
        for at in 0..bytes.len() {
            assert!(Container::of_bytes(&bytes[..at]).is_err(), "cut at {at}");
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[at] ^= 1 << bit;
                assert!(Container::of_bytes(&changed).is_err(), "bit {bit} of byte {at}");
            }
        }
        assert_eq!(Container::of_bytes(b"ply\n"), Err(NoContainer::Foreign));
        let mut newer = bytes;
        newer[8] = 2;
        assert_eq!(Container::of_bytes(&newer), Err(NoContainer::Version(2)));
    }

    #[test]
    fn wrong_lengths_under_a_right_checksum_are_refused() {
        let bytes = container().to_bytes();
        for at in 12..bytes.len() - 4 {
            let mut changed = bytes[..bytes.len() - 4].to_vec();
            changed[at] = 0xff;
            let sum = crc32fast::hash(&changed);
            changed.extend_from_slice(&sum.to_le_bytes());
            // Names and contents may be anything; counts and lengths may not.
            let _ = Container::of_bytes(&changed);
        }
        let mut many = bytes[..bytes.len() - 4].to_vec();
        many[12..16].fill(0xff);
        let sum = crc32fast::hash(&many);
        many.extend_from_slice(&sum.to_le_bytes());
        assert!(matches!(Container::of_bytes(&many), Err(NoContainer::Damaged(_))));
    }
}
