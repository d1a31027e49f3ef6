//! [`Buckets`]: which triangles may be near a box, while triangles change.
//!
//! # What it promises
//! [`Buckets::all_near`] visits every triangle whose box meets the box asked for, some perhaps twice, as long
//! as every triangle's box has sides of at most
//! [`Buckets::reach`].
//!
//! # Method
//! Space is cut into cubes with sides of 5/4 of that length. A triangle is in the list of the cube that holds
//! the least corner of its box, so its box ends in the next cube at the latest: the cubes to look into are
//! those of the box asked for and those before. Cubes are named by a hash of their integer coordinates; cubes
//! with the same name share a list. Lists are doubly linked through arrays.
//!
//! Rounding: the number of a cube is the floor of a rounded quotient, which is monotone. A triangle that
//! meets the box asked for begins at most 4/5 of a side before that box does, up to some 2^-52 of the
//! quotients; these are at most 2^41 ([`MOST_REACHES`]), so the remaining fifth is far more than what
//! rounding can take away, and the floors differ by one at most.
//!
//! # Complexity
//! Constant for each insertion and removal; a query costs the triangles in the cubes it looks into.

use crate::DVec3;
use crate::spatial::Box3;
use crate::surface::TriId;

const END: u32 = u32::MAX;

/// Largest magnitude of a coordinate, in units of [`Buckets::reach`].
pub(super) const MOST_REACHES: f64 = (1_u64 << 40) as f64;

/// A triangle in its list; a cache line.
#[derive(Clone, Debug)]
struct Entry {
    around: Box3,
    next: u32,
    /// The triangle before in its list; without meaning for the first.
    previous: u32,
    /// The list; `END` if the triangle is in none.
    list: u32,
}

#[derive(Debug)]
pub(super) struct Buckets {
    reach: f64,
    side: f64,
    /// First triangle of each list; as many as a power of two.
    first: Vec<u32>,
    entries: Vec<Entry>,
}

impl Buckets {
    /// Empty lists for about so many triangles whose boxes have sides of at most `reach`, which is positive.
    pub(super) fn new(reach: f64, triangles: usize) -> Self {
        let lists = triangles.next_power_of_two().min(1 << 30);
        Self { reach, side: 1.25 * reach, first: vec![END; lists], entries: Vec::with_capacity(triangles) }
    }

    /// Longest side of a triangle's box.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Puts a triangle where its box is, from wherever it was.
    pub(super) fn place(&mut self, triangle: TriId, around: Box3) {
        let t = triangle.index();
        if t >= self.entries.len() {
            let nowhere = Entry { around: Box3::EMPTY, next: END, previous: END, list: END };
            self.entries.resize(t + 1, nowhere);
        }
        self.entries[t].around = around;
        let list = self.list_of(self.cube(around.min));
        if self.entries[t].list == list {
            return;
        }
        self.remove(triangle);
        let second = std::mem::replace(&mut self.first[list as usize], triangle.0);
        if second != END {
            self.entries[second as usize].previous = triangle.0;
        }
        self.entries[t].next = second;
        self.entries[t].list = list;
    }

    /// Takes a triangle out, if it is in a list.
    pub(super) fn remove(&mut self, triangle: TriId) {
        let Entry { next, previous, list, .. } = self.entries[triangle.index()];
        if list == END {
            return;
        }
        if self.first[list as usize] == triangle.0 {
            self.first[list as usize] = next;
        } else {
            self.entries[previous as usize].next = next;
        }
        if next != END {
            self.entries[next as usize].previous = previous;
        }
        self.entries[triangle.index()].list = END;
    }

    /// Visits every triangle whose box meets `around`, some perhaps twice, with its box, until one visit
    /// returns false; whether none did.
    pub(super) fn all_near(&self, around: &Box3, mut visit: impl FnMut(TriId, &Box3) -> bool) -> bool {
        let low = self.cube(around.min).map(|i| i - 1);
        let high = self.cube(around.max);
        for k in low[2]..=high[2] {
            for j in low[1]..=high[1] {
                let row = row_name(j, k);
                for i in low[0]..=high[0] {
                    let mut t = self.first[self.list_in(row, i) as usize];
                    while t != END {
                        let entry = &self.entries[t as usize];
                        if entry.around.meets(around) && !visit(TriId(t), &entry.around) {
                            return false;
                        }
                        t = entry.next;
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

    fn list_of(&self, [i, j, k]: [i64; 3]) -> u32 {
        self.list_in(row_name(j, k), i)
    }

    /// Cubes of a row along x have lists side by side: a query reads few cache lines.
    #[inline]
    fn list_in(&self, row: u64, i: i64) -> u32 {
        (row.wrapping_add(i as u64) & (self.first.len() as u64 - 1)) as u32
    }
}

/// A name for the row of cubes along x, of well mixed bits.
#[inline]
fn row_name(j: i64, k: i64) -> u64 {
    // Odd multipliers, from the digits of the golden ratio and of the square root of 2.
    const MIX: [u64; 2] = [0x9e37_79b9_7f4a_7c15, 0x6a09_e667_f3bc_c909];
    let mixed = (j as u64).wrapping_mul(MIX[0]).rotate_left(31) ^ k as u64;
    let mixed = mixed.wrapping_mul(MIX[1]);
    mixed ^ mixed >> 32
}
