//! Surfaces made of rings of vertices one ahead of the other: [`RingBuilder`].
//!
//! Each ring is listed counterclockwise about the direction in which the rings advance; consecutive rings, of any
//! two counts, are joined by a strip of triangles whose orientation is outward. Strips share the rings' vertices,
//! so the surface is closed once both ends are closed by an apex or the last ring is joined to the first.
//! Complexity: linear.

use crate::surface::TriangleSoup;
use glam::DVec3;
use std::ops::Range;

/// Builds a tube, ring after ring.
#[derive(Default)]
pub(crate) struct RingBuilder {
    soup: TriangleSoup,
    /// The vertices of the first and of the newest ring; an apex is a ring of one vertex.
    ends: Option<[Range<u32>; 2]>,
}

impl RingBuilder {
    /// Adds a ring ahead of the newest one (one vertex: an apex) and joins them.
    pub(crate) fn push(&mut self, ring: impl IntoIterator<Item = DVec3>) {
        let start = self.soup.positions.len() as u32;
        self.soup.positions.extend(ring);
        let ring = start..self.soup.positions.len() as u32;
        self.ends = Some(match self.ends.take() {
            None => [ring.clone(), ring],
            Some([first, newest]) => {
                self.join(&newest, &ring, 0);
                [first, ring]
            }
        });
    }

    /// Joins the newest ring to the first: vertex `i` of it to vertex `i + shift` of the first.
    pub(crate) fn close(&mut self, shift: u32) {
        if let Some([first, newest]) = self.ends.take() {
            self.join(&newest, &first, shift);
        }
    }

    /// The surface.
    pub(crate) fn finish(self) -> TriangleSoup {
        self.soup
    }

    /// A strip of triangles from ring `a` to ring `b` ahead of it: both are walked round at an even pace.
    fn join(&mut self, a: &Range<u32>, b: &Range<u32>, shift: u32) {
        let (p, q) = (a.end - a.start, b.end - b.start);
        let of_a = |i: u32| a.start + i % p;
        let of_b = |j: u32| b.start + (j + shift) % q;
        // An apex has no side of its own to advance along.
        let (a_steps, b_steps) = (if p == 1 { 0 } else { p }, if q == 1 { 0 } else { q });
        let (mut i, mut j) = (0, 0);
        while i < a_steps || j < b_steps {
            // Compare the middles of the next sides, (i + 1/2) / p and (j + 1/2) / q.
            let along_a = u64::from(2 * i + 1) * u64::from(q) <= u64::from(2 * j + 1) * u64::from(p);
            if i < a_steps && (along_a || j == b_steps) {
                self.soup.triangles.push([of_a(i), of_a(i + 1), of_b(j)]);
                i += 1;
            } else {
                self.soup.triangles.push([of_a(i), of_b(j + 1), of_b(j)]);
                j += 1;
            }
        }
    }
}
