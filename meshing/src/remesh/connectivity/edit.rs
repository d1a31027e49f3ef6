//! Splits, flips and collapses of edges.
//!
//! ```text
//!        c                  c                  c                      c
//!      / t \              / | \              /   \                  /   \
//!     a --> b    split   a--m--b     flip   a --+-- b    collapse     a       (b into a)
//!      \   /              \ | /              \  |  /                \   /
//!        d                  d                   d                     d
//! ```
//! The half-edge given runs from `a` to `b`, `c` is the apex of its triangle, `d` that of the neighbour.

use super::{Connectivity, HalfEdge, REMOVED};
use crate::surface::{TriId, VertexId};

impl Connectivity {
    /// Puts a new vertex on an edge: its two triangles become four. The triangles of the half-edge and its
    /// opposite keep the half-edge's tail.
    ///
    /// # Panics
    /// If the half-edge is not one of a triangle in use, or ids are used up.
    pub fn split(&mut self, half_edge: HalfEdge) -> VertexId {
        let (h, o) = (half_edge, self.opposite(half_edge));
        let (b, c, d) = (self.head(h), self.apex(h), self.apex(o));
        let m = VertexId::from_index(self.outgoing.len());
        let (beyond_h, beyond_o) = (self.opposite(h.next()), self.opposite(o.previous()));

        self.set_corner(h.next(), m);
        self.set_corner(o, m);
        let right = self.push([m, b, c]);
        let left = self.push([b, m, d]);
        let side = |t, k| HalfEdge::of(t, k);
        self.join(side(right, 0), side(left, 0));
        self.join(side(right, 1), beyond_h);
        self.join(side(right, 2), h.next());
        self.join(side(left, 1), o.previous());
        self.join(side(left, 2), beyond_o);
        self.outgoing.push(side(right, 0));
        self.outgoing[b.index()] = side(right, 1);
        m
    }

    /// Whether an edge can be flipped: its ends keep three edges at least, and the apexes are not joined yet.
    #[must_use]
    pub fn can_flip(&self, half_edge: HalfEdge) -> bool {
        let (h, o) = (half_edge, self.opposite(half_edge));
        let (c, d) = (self.apex(h), self.apex(o));
        let keeps = |v| self.around(v).nth(3).is_some();
        c != d && keeps(self.tail(h)) && keeps(self.head(h)) && !self.adjacent(c, d)
    }

    /// Replaces an edge by that between its apexes. Afterwards the half-edge's triangle is `d c a`, that of
    /// its opposite `c d b`.
    ///
    /// # Panics
    /// If the edge cannot be flipped ([`Connectivity::can_flip`]).
    pub fn flip(&mut self, half_edge: HalfEdge) {
        assert!(self.can_flip(half_edge), "who flips an edge asks before");
        let (h, o) = (half_edge, self.opposite(half_edge));
        let [a, b, c, d] = [self.tail(h), self.head(h), self.apex(h), self.apex(o)];
        let [bc, ca, ad, db] =
            [h.next(), h.previous(), o.next(), o.previous()].map(|side| self.opposite(side));
        let (s, t) = (h.triangle(), o.triangle());
        self.triangles[s.index()] = [d, c, a];
        self.triangles[t.index()] = [c, d, b];
        self.join(HalfEdge::of(s, 0), HalfEdge::of(t, 0));
        self.join(HalfEdge::of(s, 1), ca);
        self.join(HalfEdge::of(s, 2), ad);
        self.join(HalfEdge::of(t, 1), db);
        self.join(HalfEdge::of(t, 2), bc);
        self.outgoing[a.index()] = HalfEdge::of(s, 2);
        self.outgoing[b.index()] = HalfEdge::of(t, 2);
        self.outgoing[c.index()] = HalfEdge::of(s, 1);
        self.outgoing[d.index()] = HalfEdge::of(t, 1);
    }

    /// Whether an edge can be collapsed without a change of topology: its ends have no common neighbours but
    /// the two apexes, and their component is not a tetrahedron.
    #[must_use]
    pub fn can_collapse(&self, half_edge: HalfEdge) -> bool {
        let (h, o) = (half_edge, self.opposite(half_edge));
        let (a, b) = (self.tail(h), self.head(h));
        let (c, d) = (self.apex(h), self.apex(o));
        let wide = |v| self.around(v).nth(3).is_some();
        let common = |v: VertexId| v == c || v == d || v == a || !self.adjacent(v, a);
        c != d && (wide(a) || wide(b)) && self.neighbours(b).all(common)
    }

    /// Removes the two triangles of an edge and its head; the head's other triangles go to the tail.
    ///
    /// # Panics
    /// If the edge cannot be collapsed ([`Connectivity::can_collapse`]).
    pub fn collapse(&mut self, half_edge: HalfEdge) {
        assert!(self.can_collapse(half_edge), "who collapses an edge asks before");
        let (h, o) = (half_edge, self.opposite(half_edge));
        let [a, b, c, d] = [self.tail(h), self.head(h), self.apex(h), self.apex(o)];
        let [cb, ac, da, bd] =
            [h.next(), h.previous(), o.next(), o.previous()].map(|side| self.opposite(side));
        let mut spoke = self.outgoing[b.index()];
        let first = spoke;
        loop {
            self.set_corner(spoke, a);
            spoke = self.opposite(spoke.previous());
            if spoke == first {
                break;
            }
        }
        self.join(cb, ac);
        self.join(bd, da);
        self.outgoing[a.index()] = ac;
        self.outgoing[c.index()] = cb;
        self.outgoing[d.index()] = da;
        self.outgoing[b.index()] = HalfEdge::NONE;
        for removed in [h.triangle(), o.triangle()] {
            self.triangles[removed.index()] = [REMOVED; 3];
        }
    }

    fn set_corner(&mut self, half_edge: HalfEdge, tail: VertexId) {
        self.triangles[half_edge.triangle().index()][half_edge.side()] = tail;
    }

    fn join(&mut self, one: HalfEdge, other: HalfEdge) {
        self.opposite[one.0 as usize] = other;
        self.opposite[other.0 as usize] = one;
    }

    fn push(&mut self, corners: [VertexId; 3]) -> TriId {
        let id = TriId::from_index(self.triangles.len());
        self.triangles.push(corners);
        self.opposite.extend([HalfEdge::NONE; 3]);
        id
    }
}
