//! Inputs changed in a few places: [`mutated`].

use crate::entropy::{Entropy, stream};

/// Bytes that mean something to readers of text or of binary numbers.
const TELLING: &[u8] = b"\0\xff\x7f\x80\x01 \n\r\t-+.e019<>/&\"'$#:;=_%\\";
/// Words that readers look for, and numbers at the ends of types.
const WORDS: &[&str] = &[
    "nan",
    "inf",
    "-1",
    "0",
    "1e400",
    "4294967295",
    "4294967296",
    "-2147483649",
    "9223372036854775808",
    "\n",
    "<a/>",
    "</",
    "$End",
    "$Nodes\n1\n",
    "\"",
    "&#10;",
    "&lt;",
    "End",
    "# ",
];

/// An input after one to six changes that follow from a seed; `other` is where parts may come from.
pub(super) fn mutated(input: &[u8], other: &[u8], seed: u64) -> Vec<u8> {
    let bytes = stream(seed, 128);
    let mut entropy = Entropy::new(&bytes);
    let mut changed = input.to_vec();
    for _ in 0..=entropy.below(6) {
        let at = place(&mut entropy, changed.len() + 1);
        let length = 1 + place(&mut entropy, 24.min(changed.len() + 1));
        let end = (at + length).min(changed.len());
        match entropy.below(8) {
            0 | 1 if at < changed.len() => changed[at] = entropy.pick(TELLING),
            2 if at < changed.len() => changed[at] ^= 1 << entropy.below(8),
            3 => _ = changed.drain(at.min(end)..end),
            4 => changed.truncate(at),
            5 => {
                let copy = changed[at.min(end)..end].to_vec();
                let to = place(&mut entropy, changed.len() + 1);
                changed.splice(to..to, copy);
            }
            6 => {
                let from = place(&mut entropy, other.len() + 1);
                let part = &other[from..(from + length).min(other.len())];
                changed.splice(at..at, part.iter().copied());
            }
            _ => {
                let word = entropy.pick(WORDS);
                let end = if entropy.below(2) == 0 { at } else { end.max(at) };
                changed.splice(at..end, word.bytes());
            }
        }
    }
    changed
}

/// A number below `end`, which is not 0.
fn place(entropy: &mut Entropy<'_>, end: usize) -> usize {
    (entropy.word() % end as u64) as usize
}
