//! Finds equal points: [`Weld`].
//!
//! Promises: points are one exactly when their coordinates compare equal (`-0 == 0`; NaN equals nothing), numbered in the
//! order of first appearance. The numbers do not depend on the hash, which is keyed afresh each time so that no file
//! can be made to collide on purpose.
//! Method: open addressing over the ids; expected O(1) a point; 8 to 16 bytes a point beside the points.

use glam::DVec3;
use std::hash::{BuildHasher, RandomState};

const EMPTY: u32 = u32::MAX;
/// Odd constant of 64 random bits (the golden ratio), used to spread the bits of a product.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// A table of distinct points.
pub(super) struct Weld {
    slots: Vec<u32>,
    filled: usize,
    keys: [u64; 4],
}

impl Weld {
    pub(super) fn new() -> Self {
        let state = RandomState::new();
        let keys = [0_u64, 1, 2, 3].map(|k| state.hash_one(k));
        Self { slots: vec![EMPTY; 1024], filled: 0, keys }
    }

    /// The id of the point among `points` that equals `point`, or `None`: then it is noted as the next, number
    /// `points.len()`, which the caller has to push.
    #[inline]
    pub(super) fn find(&mut self, point: DVec3, points: &[DVec3]) -> Option<u32> {
        if point.is_nan() {
            return None;
        }
        if 2 * (self.filled + 1) > self.slots.len() {
            self.grow(points);
        }
        let mut slot = self.slot(point);
        loop {
            match self.slots[slot] {
                EMPTY => break,
                id if points[id as usize] == point => return Some(id),
                _ => slot = (slot + 1) & (self.slots.len() - 1),
            }
        }
        self.slots[slot] = points.len() as u32;
        self.filled += 1;
        None
    }

    #[inline]
    fn slot(&self, point: DVec3) -> usize {
        // + 0.0 makes -0 and 0 the same bits
        let [x, y, z] = (point + DVec3::ZERO).to_array().map(f64::to_bits);
        let mixed = fold(x ^ self.keys[0], y ^ self.keys[1]) ^ fold(z ^ self.keys[2], self.keys[3]);
        (fold(mixed, SPREAD) as usize) & (self.slots.len() - 1)
    }

    #[cold]
    fn grow(&mut self, points: &[DVec3]) {
        self.slots = vec![EMPTY; 2 * self.slots.len()];
        for (id, point) in points.iter().enumerate().filter(|(_, p)| !p.is_nan()) {
            let mut slot = self.slot(*point);
            while self.slots[slot] != EMPTY {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = id as u32;
        }
    }
}

/// Both halves of the product, so that every bit of either factor counts.
#[inline]
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    (product as u64) ^ ((product >> 64) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_coordinates_are_one_point_and_nan_is_none() {
        let mut weld = Weld::new();
        let mut points = Vec::new();
        let mut id = |p: DVec3| {
            weld.find(p, &points).unwrap_or_else(|| {
                points.push(p);
                points.len() as u32 - 1
            })
        };
        assert_eq!(id(DVec3::ZERO), 0);
        assert_eq!(id(DVec3::new(-0.0, 0.0, -0.0)), 0);
        assert_eq!(id(DVec3::NAN), 1);
        assert_eq!(id(DVec3::NAN), 2);
        for k in 0..5000 {
            assert_eq!(id(DVec3::new(f64::from(k), 1.0, f64::from(k).exp2())), 3 + k as u32);
        }
        for k in 0..5000 {
            assert_eq!(id(DVec3::new(f64::from(k), 1.0, f64::from(k).exp2())), 3 + k as u32);
        }
    }
}
