//! Disjoint sets that several threads unite: [`SharedUnionFind`].
//!
//! Method: the parent of an element is never larger than it, and a root is linked below a smaller one by compare-and-swap, tried again
//! if another thread was first \[Anderson91\]; paths are halved as they are walked \[Tarjan75\]. So the root of a set is its smallest
//! member, whatever the order of the unions and whichever thread makes them.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

/// A partition of `0..n`. Orderings are relaxed: only the parents themselves are read, and any ancestor will do for one.
pub(super) struct SharedUnionFind {
    parent: Vec<AtomicU32>,
}

impl SharedUnionFind {
    /// Every element alone.
    pub(super) fn new(n: usize) -> Self {
        Self {
            parent: (0..n).into_par_iter().with_min_len(1 << 16).map(|i| AtomicU32::new(i as u32)).collect(),
        }
    }

    /// The smallest member of an element's set, of those united so far.
    pub(super) fn root(&self, mut x: u32) -> u32 {
        loop {
            let parent = self.parent[x as usize].load(Relaxed);
            if parent == x {
                return x;
            }
            let grandparent = self.parent[parent as usize].load(Relaxed);
            if grandparent == parent {
                return parent;
            }
            self.parent[x as usize].store(grandparent, Relaxed);
            x = grandparent;
        }
    }

    /// Whether an element is the smallest member of its set.
    pub(super) fn is_root(&self, x: u32) -> bool {
        self.parent[x as usize].load(Relaxed) == x
    }

    /// Makes one set of two.
    pub(super) fn unite(&self, mut a: u32, mut b: u32) {
        loop {
            (a, b) = (self.root(a), self.root(b));
            if a == b {
                return;
            }
            let (low, high) = (a.min(b), a.max(b));
            if self.parent[high as usize].compare_exchange(high, low, Relaxed, Relaxed).is_ok() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_smallest_members_whoever_unites() {
        // A cycle of multiples of 7 modulo 1000, in ten sets of equal remainder modulo 10 after the unions of i and i + 10.
        let sets = SharedUnionFind::new(1000);
        (0..990_u32).into_par_iter().for_each(|i| {
            let i = i * 7 % 990;
            sets.unite(i + 10, i);
        });
        assert!((0..1000).all(|i| sets.root(i) == i % 10));
    }
}
