//! [`Buckets`]: which triangles may be near a box, while triangles change.
//!
//! # What it promises
//! [`Buckets::for_each_near`] visits every triangle whose box meets the box asked for, as long as every triangle's box has sides of at most
//! [`Buckets::reach`]; it visits others too, and some twice.
//!
//! # Method
//! Space is cut into cubes with sides of 5/4 of that length. A triangle is in the list of the cube that holds the least corner of its box, so its box ends in
//! the next cube at the latest: the cubes to look into are those of the box asked for and those before. Cubes are named by a hash of their
//! integer coordinates; cubes with the same name share a list. Lists are doubly linked through arrays.
//!
//! Rounding: the number of a cube is the floor of a rounded quotient, which is monotone. A triangle that meets the box asked for begins at most
//! 4/5 of a side before that box does, up to some 2^-52 of the quotients; these are at most 2^41 ([`MOST_REACHES`]), so the remaining fifth is far more
//! than what rounding can take away, and the floors differ by one at most.
//!
//! # Complexity
//! Constant for each insertion and removal; a query costs the triangles in the cubes it looks into.

use crate::DVec3;
use crate::spatial::Box3;
use crate::surface::TriId;

const END: u32 = u32::MAX;

/// Largest magnitude of a coordinate, in units of [`Buckets::reach`].
pub(super) const MOST_REACHES: f64 = (1_u64 << 40) as f64;

#[derive(Debug)]
pub(super) struct Buckets {
    reach: f64,
    side: f64,
    /// First triangle of each list; as many as a power of two.
    first: Vec<u32>,
    next: Vec<u32>,
    /// The triangle before in its list; for the first of list `i`, `!i`.
    previous: Vec<u32>,
    /// The list of each triangle; `END` if it is in none.
    list: Vec<u32>,
}

impl Buckets {
    /// Empty lists for about so many triangles whose boxes have sides of at most `reach`, which is positive.
    pub(super) fn new(reach: f64, triangles: usize) -> Self {
        Self {
            reach,
            side: 1.25 * reach,
            first: vec![END; (2 * triangles).next_power_of_two().min(1 << 30)],
            next: Vec::new(),
            previous: Vec::new(),
            list: Vec::new(),
        }
    }

    /// Longest side of a triangle's box.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Puts a triangle where its box is, from wherever it was.
    pub(super) fn place(&mut self, triangle: TriId, around: &Box3) {
        let t = triangle.index();
        if t >= self.list.len() {
            for links in [&mut self.next, &mut self.previous, &mut self.list] {
                links.resize(t + 1, END);
            }
        }
        let list = self.list_of(self.cube(around.min));
        if self.list[t] == list {
            return;
        }
        self.remove(triangle);
        let second = self.first[list as usize];
        if second != END {
            self.previous[second as usize] = triangle.0;
        }
        self.next[t] = second;
        self.first[list as usize] = triangle.0;
        self.list[t] = list;
    }

    /// Takes a triangle out, if it is in a list.
    pub(super) fn remove(&mut self, triangle: TriId) {
        let t = triangle.index();
        let list = self.list[t];
        if list == END {
            return;
        }
        let next = self.next[t];
        if self.first[list as usize] == triangle.0 {
            self.first[list as usize] = next;
        } else {
            self.next[self.previous[t] as usize] = next;
        }
        if next != END {
            self.previous[next as usize] = self.previous[t];
        }
        self.list[t] = END;
    }

    /// Visits every triangle whose box meets `around`, and others, until one visit returns false; whether none did.
    pub(super) fn for_each_near(&self, around: &Box3, mut visit: impl FnMut(TriId) -> bool) -> bool {
        let low = self.cube(around.min).map(|i| i - 1);
        let high = self.cube(around.max);
        for k in low[2]..=high[2] {
            for j in low[1]..=high[1] {
                for i in low[0]..=high[0] {
                    let mut t = self.first[self.list_of([i, j, k]) as usize];
                    while t != END {
                        if !visit(TriId(t)) {
                            return false;
                        }
                        t = self.next[t as usize];
                    }
                }
            }
        }
        true
    }

    #[inline]
    fn cube(&self, point: DVec3) -> [i64; 3] {
        (point / self.side).to_array().map(|x| x.floor() as i64)
    }

    fn list_of(&self, cube: [i64; 3]) -> u32 {
        // Odd multipliers with well mixed bits, from the digits of the golden ratio and of square roots.
        const MIX: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0x6a09_e667_f3bc_c909, 0xbb67_ae85_84ca_a73b];
        let mixed = (0..3).fold(0_u64, |sum, i| (sum ^ cube[i] as u64).wrapping_mul(MIX[i]).rotate_left(31));
        ((mixed ^ mixed >> 32) & (self.first.len() as u64 - 1)) as u32
    }
}
