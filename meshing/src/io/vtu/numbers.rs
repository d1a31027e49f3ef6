//! The numbers of an array as they arrive, in text or in binary: [`Scalar`], [`Collector`], [`Block`].

use std::borrow::Cow;

use super::super::error::{Place, ReadError};
use super::super::{FieldValues, tokens};

/// A number type of VTK.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float32,
    Float64,
}

impl Scalar {
    /// The type of a name; none for what are no numbers: `String`, `Bit`.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::Int8,
            "UInt8" => Self::UInt8,
            "Int16" => Self::Int16,
            "UInt16" => Self::UInt16,
            "Int32" => Self::Int32,
            "UInt32" => Self::UInt32,
            "Int64" => Self::Int64,
            "UInt64" => Self::UInt64,
            "Float32" => Self::Float32,
            "Float64" => Self::Float64,
            _ => return None,
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Self::Int8 | Self::UInt8 => 1,
            Self::Int16 | Self::UInt16 => 2,
            Self::Int32 | Self::UInt32 | Self::Float32 => 4,
            Self::Int64 | Self::UInt64 | Self::Float64 => 8,
        }
    }
}

/// Numbers of one type, gathered in the smallest of our types that holds them all.
pub(super) struct Collector {
    scalar: Scalar,
    big_endian: bool,
    values: FieldValues<'static>,
    /// The bytes of a number not yet whole.
    begun: Vec<u8>,
}

impl Collector {
    pub(super) fn new(scalar: Scalar, big_endian: bool) -> Self {
        let values = match scalar {
            Scalar::Float32 | Scalar::Float64 => FieldValues::Float64(Cow::default()),
            Scalar::UInt8 => FieldValues::UInt8(Cow::default()),
            Scalar::Int8 | Scalar::Int16 | Scalar::UInt16 | Scalar::Int32 => {
                FieldValues::Int32(Cow::default())
            }
            Scalar::UInt32 | Scalar::Int64 | Scalar::UInt64 => FieldValues::Int64(Cow::default()),
        };
        Self { scalar, big_endian, values, begun: Vec::new() }
    }

    /// Bytes of a number.
    pub(super) fn size(&self) -> u64 {
        self.scalar.size() as u64
    }

    pub(super) fn big_endian(&self) -> bool {
        self.big_endian
    }

    /// How many whole numbers there are.
    pub(super) fn count(&self) -> u64 {
        self.values.len() as u64
    }

    pub(super) fn into_values(self) -> FieldValues<'static> {
        self.values
    }

    /// Appends the number that a word stands for; none if it stands for none of the type.
    pub(super) fn push_word(&mut self, word: &[u8]) -> Option<()> {
        match &mut self.values {
            FieldValues::Float64(values) => values.to_mut().push(tokens::float(word)?),
            FieldValues::Int32(values) => values.to_mut().push(tokens::integer(word)?.try_into().ok()?),
            FieldValues::Int64(values) => values.to_mut().push(tokens::integer(word)?),
            FieldValues::UInt8(values) => values.to_mut().push(tokens::integer(word)?.try_into().ok()?),
        }
        Some(())
    }

    /// Appends the numbers of bytes, of which the last may be incomplete; none if one is beyond 63 bits.
    pub(super) fn push_bytes(&mut self, mut bytes: &[u8]) -> Option<()> {
        let size = self.scalar.size();
        if !self.begun.is_empty() {
            let (head, rest) = bytes.split_at(bytes.len().min(size - self.begun.len()));
            self.begun.extend_from_slice(head);
            bytes = rest;
            if self.begun.len() < size {
                return Some(());
            }
            let number = std::mem::take(&mut self.begun);
            self.push_whole(&number)?;
        }
        let (whole, rest) = bytes.split_at(bytes.len() / size * size);
        self.begun.extend_from_slice(rest);
        self.push_whole(whole)
    }

    fn push_whole(&mut self, bytes: &[u8]) -> Option<()> {
        let big = self.big_endian;
        match (&mut self.values, self.scalar) {
            (FieldValues::Float64(v), Scalar::Float32) => {
                append(v, bytes, big, |b| Some(f64::from(f32::from_le_bytes(b))))
            }
            (FieldValues::Float64(v), _) => append(v, bytes, big, |b| Some(f64::from_le_bytes(b))),
            (FieldValues::UInt8(v), _) => append(v, bytes, big, |[b]| Some(b)),
            (FieldValues::Int32(v), Scalar::Int8) => {
                append(v, bytes, big, |b| Some(i8::from_le_bytes(b).into()))
            }
            (FieldValues::Int32(v), Scalar::Int16) => {
                append(v, bytes, big, |b| Some(i16::from_le_bytes(b).into()))
            }
            (FieldValues::Int32(v), Scalar::UInt16) => {
                append(v, bytes, big, |b| Some(u16::from_le_bytes(b).into()))
            }
            (FieldValues::Int32(v), _) => append(v, bytes, big, |b| Some(i32::from_le_bytes(b))),
            (FieldValues::Int64(v), Scalar::UInt32) => {
                append(v, bytes, big, |b| Some(u32::from_le_bytes(b).into()))
            }
            (FieldValues::Int64(v), Scalar::UInt64) => {
                append(v, bytes, big, |b| u64::from_le_bytes(b).try_into().ok())
            }
            (FieldValues::Int64(v), _) => append(v, bytes, big, |b| Some(i64::from_le_bytes(b))),
        }
    }
}

fn append<T: Clone, const N: usize>(
    values: &mut Cow<'static, [T]>,
    bytes: &[u8],
    big_endian: bool,
    number: impl Fn([u8; N]) -> Option<T>,
) -> Option<()> {
    let values = values.to_mut();
    for &(mut one) in bytes.as_chunks::<N>().0 {
        if big_endian {
            one.reverse();
        }
        values.push(number(one)?);
    }
    Some(())
}

/// A binary block: its length in bytes, then its numbers.
pub(super) struct Block {
    collector: Collector,
    /// Size of the length: 4 or 8 bytes.
    header: usize,
    begun: Vec<u8>,
    /// Bytes of numbers still to come, once the length is known.
    left: Option<u64>,
    /// Number of numbers, where it is known beforehand.
    expected: Option<u64>,
}

impl Block {
    pub(super) fn new(collector: Collector, header: usize, expected: Option<u64>) -> Self {
        Self { collector, header, begun: Vec::new(), left: None, expected }
    }

    /// How many bytes are wanted next at most.
    pub(super) fn wanted(&self) -> u64 {
        self.left.unwrap_or((self.header - self.begun.len()) as u64)
    }

    /// Whether all is there.
    pub(super) fn is_complete(&self) -> bool {
        self.left == Some(0)
    }

    /// Takes bytes that end at `at`, not more than it wants.
    pub(super) fn push(&mut self, bytes: &[u8], at: Place) -> Result<(), ReadError> {
        let rest = match self.left {
            Some(_) => bytes,
            None => {
                let (head, rest) = bytes.split_at(bytes.len().min(self.header - self.begun.len()));
                self.begun.extend_from_slice(head);
                if self.begun.len() == self.header {
                    self.left = Some(self.length(at)?);
                }
                rest
            }
        };
        let Some(left) = self.left else { return Ok(()) };
        let Some(after) = left.checked_sub(rest.len() as u64) else {
            return Err(ReadError::unexpected(at, "the end of the numbers of an array", b"more of them"));
        };
        self.left = Some(after);
        self.collector
            .push_bytes(rest)
            .ok_or_else(|| ReadError::Unsupported { at, what: "an integer beyond 63 bits".to_owned() })
    }

    /// The length that the first bytes say, if it fits the array.
    fn length(&self, at: Place) -> Result<u64, ReadError> {
        let length = number_of(&self.begun, self.collector.big_endian);
        check_length(length, self.collector.size(), self.expected, at)?;
        Ok(length)
    }

    pub(super) fn into_collector(self) -> Collector {
        self.collector
    }
}

/// The number of up to eight bytes.
pub(super) fn number_of(bytes: &[u8], big_endian: bool) -> u64 {
    let mut all = [0; 8];
    let part = &mut all[..bytes.len()];
    part.copy_from_slice(bytes);
    if big_endian {
        part.reverse();
    }
    u64::from_le_bytes(all)
}

/// An error unless so many bytes are an array of numbers of a size.
pub(super) fn check_length(
    length: u64,
    size: u64,
    expected: Option<u64>,
    at: Place,
) -> Result<(), ReadError> {
    let fits = match expected {
        Some(count) => count.checked_mul(size) == Some(length),
        None => length.is_multiple_of(size),
    };
    if fits {
        return Ok(());
    }
    let expected = match expected {
        Some(count) => format!("{count} numbers of {size} bytes"),
        None => format!("numbers of {size} bytes"),
    };
    Err(ReadError::Unexpected { at, expected, found: format!("{length} bytes") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_whole_out_of_pieces_of_any_length() {
        for (scalar, big) in [(Scalar::Float64, false), (Scalar::Float32, true), (Scalar::UInt16, true)] {
            let bytes: Vec<u8> = (0..48).collect();
            let mut whole = Collector::new(scalar, big);
            whole.push_bytes(&bytes).unwrap();
            for step in 1..20 {
                let mut pieces = Collector::new(scalar, big);
                bytes.chunks(step).for_each(|piece| pieces.push_bytes(piece).unwrap());
                assert_eq!(pieces.count(), 48 / scalar.size() as u64);
                assert_eq!(pieces.into_values(), whole.values, "{scalar:?} {step}");
            }
        }
        let mut numbers = Collector::new(Scalar::UInt16, true);
        numbers.push_bytes(&[1, 2]).unwrap();
        assert_eq!(numbers.into_values(), FieldValues::from(vec![258_i32]));
        assert!(Collector::new(Scalar::UInt64, false).push_bytes(&[0xff; 8]).is_none());
        assert!(Collector::new(Scalar::UInt8, false).push_word(b"256").is_none());
        assert!(Collector::new(Scalar::Int64, false).push_word(b"1.5").is_none());
    }
}
