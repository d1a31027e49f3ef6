//! Choices drawn from a finite run of bytes: [`Entropy`].
//!
//! A property test, a fuzzer and a test on stored bytes all feed the same generators through this type, so an input
//! that one of them found is a byte string that the others replay. When the bytes are used up every further choice is
//! the first one; a generator therefore always ends.

/// A reader of choices.
#[derive(Clone, Debug)]
pub struct Entropy<'a> {
    rest: &'a [u8],
}

impl<'a> Entropy<'a> {
    /// Choices from `bytes`, in order.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// What has not been drawn yet.
    #[must_use]
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next byte, or 0.
    pub fn byte(&mut self) -> u8 {
        match self.rest.split_first() {
            Some((&first, rest)) => {
                self.rest = rest;
                first
            }
            None => 0,
        }
    }

    /// The next eight bytes, lowest first.
    pub fn word(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// A number in `0..count`, from one byte.
    pub fn below(&mut self, count: u8) -> u8 {
        assert!(count > 0, "there is no number below zero");
        self.byte() % count
    }

    /// A number in `low..=high`, from two bytes.
    pub fn between(&mut self, low: i32, high: i32) -> i32 {
        let span = u32::try_from(high - low + 1).expect("low is not above high");
        let draw = u32::from(u16::from_le_bytes([self.byte(), self.byte()]));
        low + i32::try_from(draw % span).expect("below the span")
    }

    /// One of `choices`.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::from(self.byte()) % choices.len()]
    }
}

/// `count` bytes of the splitmix64 sequence that starts at `seed`: the same on every machine.
#[must_use]
pub fn stream(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed;
    let mut bytes = Vec::with_capacity(count + 7);
    while bytes.len() < count {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bytes.extend_from_slice(&(z ^ (z >> 31)).to_le_bytes());
    }
    bytes.truncate(count);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exhausted_bytes_give_the_first_choice() {
        let mut entropy = Entropy::new(&[7]);
        assert_eq!(entropy.byte(), 7);
        assert_eq!((entropy.word(), entropy.between(-3, 5), entropy.pick(&["a", "b"])), (0, -3, "a"));
    }

    #[test]
    fn the_stream_is_splitmix64() {
        // First output of splitmix64 from state 0, as its authors publish it.
        assert_eq!(stream(0, 8), 0xe220_a839_7b1d_cdaf_u64.to_le_bytes());
        assert_eq!(stream(1, 11)[..], stream(1, 64)[..11]);
    }
}
