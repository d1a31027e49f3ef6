//! The numbers of an array as bytes on their way in, plain or in blocks compressed by zlib: [`Bytes`].
//!
//! A compressed array begins with a header: how many blocks there are, how many bytes a block has, how many the last has where it has
//! fewer (else 0), and how many each has compressed. Blocks are inflated piece by piece as they arrive, so no memory depends on what the
//! header says. Each has a checksum, which is checked.

use flate2::{Decompress, FlushDecompress, Status};

use super::numbers::{Block, Collector, check_length, number_of};
use crate::io::error::{Place, ReadError};

/// Bytes inflated at once.
const PIECE: usize = 1 << 15;

/// The bytes of an array, with what goes before them.
pub(super) enum Bytes {
    Plain(Block),
    Zlib(ZlibBlocks),
}

impl Bytes {
    /// How many bytes are wanted next at most.
    pub(super) fn wanted(&self) -> u64 {
        match self {
            Self::Plain(block) => block.wanted(),
            Self::Zlib(blocks) => blocks.wanted(),
        }
    }

    /// Whether all is there.
    pub(super) fn is_complete(&self) -> bool {
        match self {
            Self::Plain(block) => block.is_complete(),
            Self::Zlib(blocks) => blocks.is_complete(),
        }
    }

    /// Takes bytes that end at `at`.
    pub(super) fn push(&mut self, bytes: &[u8], at: Place) -> Result<(), ReadError> {
        match self {
            Self::Plain(block) => block.push(bytes, at),
            Self::Zlib(blocks) => blocks.push(bytes, at),
        }
    }

    pub(super) fn into_collector(self) -> Collector {
        match self {
            Self::Plain(block) => block.into_collector(),
            Self::Zlib(blocks) => blocks.collector,
        }
    }
}

/// An array in blocks compressed by zlib.
pub(super) struct ZlibBlocks {
    collector: Collector,
    /// Size of a number of the header: 4 or 8 bytes.
    width: usize,
    /// The header as far as it is there.
    header: Vec<u8>,
    /// Bytes of the header, as far as known: of its first three numbers, then of all.
    header_length: u64,
    /// How many blocks there are, bytes of each but the last, and of the last.
    sizes: [u64; 3],
    /// The block in work.
    block: u64,
    /// Compressed bytes of it still to come, and bytes that they are to become.
    left: [u64; 2],
    stream: Decompress,
    /// Whether the stream of the block is at its end.
    ended: bool,
    /// Number of numbers, where it is known beforehand.
    expected: Option<u64>,
}

impl ZlibBlocks {
    pub(super) fn new(collector: Collector, width: usize, expected: Option<u64>) -> Self {
        Self {
            collector,
            width,
            header: Vec::new(),
            header_length: 3 * width as u64,
            sizes: [0; 3],
            block: 0,
            left: [0; 2],
            stream: Decompress::new(true),
            ended: false,
            expected,
        }
    }

    /// Bytes of the header still to come.
    fn header_left(&self) -> u64 {
        self.header_length - self.header.len() as u64
    }

    fn wanted(&self) -> u64 {
        if self.header_left() > 0 { self.header_left() } else { self.left[0] }
    }

    fn is_complete(&self) -> bool {
        self.header_left() == 0 && self.block == self.sizes[0]
    }

    fn push(&mut self, mut bytes: &[u8], at: Place) -> Result<(), ReadError> {
        while !bytes.is_empty() {
            if self.is_complete() {
                return Err(ReadError::unexpected(at, "the end of the numbers of an array", b"more of them"));
            }
            let taken = self.wanted().min(bytes.len() as u64) as usize;
            let (piece, rest) = bytes.split_at(taken);
            if self.header_left() > 0 {
                self.header.extend_from_slice(piece);
                if self.header.len() == 3 * self.width {
                    self.read_sizes(at)?;
                }
                if self.header_left() == 0 {
                    self.begin_block(at)?;
                }
            } else {
                self.inflate(piece, at)?;
            }
            bytes = rest;
        }
        Ok(())
    }

    /// A number of the header.
    fn number(&self, place: u64) -> u64 {
        let begin = place as usize * self.width;
        number_of(&self.header[begin..begin + self.width], self.collector.big_endian())
    }

    /// The first three numbers, if they fit the array.
    fn read_sizes(&mut self, at: Place) -> Result<(), ReadError> {
        let [blocks, size, partial] = [0, 1, 2].map(|place| self.number(place));
        let last = if partial == 0 { size } else { partial };
        let fits = blocks == 0 || size > 0 && partial < size;
        let total = match blocks.checked_sub(1) {
            None => Some(0),
            Some(whole) => whole.checked_mul(size).and_then(|bytes| bytes.checked_add(last)),
        };
        let header = blocks.checked_add(3).and_then(|numbers| numbers.checked_mul(self.width as u64));
        let (true, Some(total), Some(header)) = (fits, total, header) else {
            let expected = "sizes of compressed blocks".to_owned();
            let found = format!("{blocks} blocks of {size} bytes, the last of {partial}");
            return Err(ReadError::Unexpected { at, expected, found });
        };
        check_length(total, self.collector.size(), self.expected, at)?;
        (self.sizes, self.header_length) = ([blocks, size, last], header);
        Ok(())
    }

    /// Makes ready for the block in work, if there is one more.
    fn begin_block(&mut self, at: Place) -> Result<(), ReadError> {
        let [blocks, size, last] = self.sizes;
        if self.block == blocks {
            return Ok(());
        }
        let compressed = self.number(3 + self.block);
        if compressed == 0 {
            return Err(ReadError::unexpected(at, "a compressed block", b"one of no bytes"));
        }
        self.left = [compressed, if self.block + 1 == blocks { last } else { size }];
        self.stream.reset(true);
        self.ended = false;
        Ok(())
    }

    /// Takes bytes of the block in work.
    fn inflate(&mut self, mut piece: &[u8], at: Place) -> Result<(), ReadError> {
        let broken = |found: &str| {
            let expected = "a block compressed by zlib".to_owned();
            ReadError::Unexpected { at, expected, found: found.to_owned() }
        };
        self.left[0] -= piece.len() as u64;
        let mut out = [0; PIECE];
        loop {
            let before = [self.stream.total_in(), self.stream.total_out()];
            let status = self.stream.decompress(piece, &mut out, FlushDecompress::None);
            let status = status.map_err(|_| broken("one that is damaged"))?;
            let used = (self.stream.total_in() - before[0]) as usize;
            let made = (self.stream.total_out() - before[1]) as usize;
            piece = &piece[used..];
            let left = self.left[1].checked_sub(made as u64);
            self.left[1] = left.ok_or_else(|| broken("one of more bytes than its header says"))?;
            let pushed = self.collector.push_bytes(&out[..made]);
            pushed
                .ok_or_else(|| ReadError::Unsupported { at, what: "an integer beyond 63 bits".to_owned() })?;
            self.ended = status == Status::StreamEnd;
            // What there was no room for is held back, also where bytes are still to be taken.
            if self.ended || used == 0 && made == 0 || piece.is_empty() && made < PIECE {
                break;
            }
        }
        if !piece.is_empty() {
            return Err(broken("one that ends before its size"));
        }
        if self.left[0] > 0 {
            return Ok(());
        }
        if !self.ended || self.left[1] > 0 {
            return Err(broken("one that goes on beyond its size, or is too short"));
        }
        self.block += 1;
        self.begin_block(at)
    }
}
