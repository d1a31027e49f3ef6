//! The generators as `proptest` strategies and as plain sequences.

use super::Kind;
use crate::entropy::{Entropy, stream};
use proptest::prelude::*;

/// Enough bytes that no generator of `count` coordinates runs dry.
const fn bytes_for(count: usize) -> usize {
    count * 24 + 64
}

/// Configurations of `N` points of a kind; a failing one shrinks by its bytes.
pub fn points<const D: usize, const N: usize>(kind: Kind) -> impl Strategy<Value = [[f64; D]; N]> {
    proptest::collection::vec(any::<u8>(), bytes_for(D * N))
        .prop_map(move |bytes| kind.draw(&mut Entropy::new(&bytes)))
}

/// The first `count` configurations of the fixed sequence that belongs to a kind.
pub fn seeded<const D: usize, const N: usize>(kind: Kind, count: u64) -> impl Iterator<Item = [[f64; D]; N]> {
    (0..count).map(move |seed| kind.draw(&mut Entropy::new(&stream(seed, bytes_for(D * N)))))
}
