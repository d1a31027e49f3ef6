//! Whether two triangles of a mesh meet in more than what they share: the rule behind self-intersection.
//!
//! # What it promises
//! The exact answer for every finite input. Triangles are given by the names of their corners and share the corners of
//! equal name, whatever the names mean (`Sharing`). A degenerate triangle is the closed segment or point that its
//! corners span.
//!
//! # Method
//! By the number of shared corners.
//!
//! * **None**: any common point of the closed triangles counts, touching too.
//! * **One**, `v`, with opposite edges `A'` and `B'`. Suppose `p != v` is common. The ray from `v` through `p` leaves
//!   triangle `A` at a point of `A'` and triangle `B` at a point of `B'`, neither of them `v`; the nearer one lies in
//!   both triangles. So the triangles meet elsewhere iff `A'` meets `B` or `B'` meets `A` away from `v`. Where `v` is
//!   neither on `A'` nor on `B'` that is the closed test. Where `v` lies on `A'`, triangle `A` is a segment, the union
//!   of the segments from `v` to the ends of `A'`: it is replaced by these two, each with its end as opposite edge.
//! * **Two**, `u` and `v`, with apices `a` and `b`. If `u v a b` are not coplanar, the planes of the triangles meet in the
//!   line `uv`, which each triangle meets in the edge. If they are, the triangles meet in more iff both apices
//!   are strictly on the same side of `uv`. If `a` is on the line `uv`, so is its triangle; the other then has no more than the
//!   edge in common with it unless `b` is on the line too, beyond the same end. If `u` and `v` coincide, the triangles are
//!   the segments `ua` and `ub`.
//! * **Three**: always.
//!
//! # Complexity
//! Two orientations settle nearly all neighbours: the other corners of one lie strictly on one side of the other's plane.

use glam::DVec3;
use welter_predicates::intersection::{segment_intersects_triangle, triangles_intersect};
use welter_predicates::{Sign, orient2d, orient3d};

use super::Box3;
use crate::surface::VertexId;

/// Whether triangles `s` and `t` meet in more than the corners of equal name; `at` tells where a vertex is.
///
/// Exact for every finite position. Triangles with three common corners always meet in more. A degenerate triangle is
/// the closed segment or point that its corners span.
///
/// ```
/// use welter_meshing::{DVec3, spatial::meet_in_more, surface::VertexId};
/// let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
/// let at = |v: VertexId| positions[v.index()];
/// let [a, b, c, d] = [0, 1, 2, 3].map(VertexId);
/// assert!(!meet_in_more(at, [a, b, c], [b, a, d])); // two faces of a tetrahedron
/// assert!(meet_in_more(at, [a, b, c], [a, c, b]));
/// ```
#[inline]
pub fn meet_in_more(at: impl Fn(VertexId) -> DVec3, s: [VertexId; 3], t: [VertexId; 3]) -> bool {
    let at = &at;
    let common = |k: usize| t.iter().position(|&w| w == s[k]);
    match [common(0), common(1), common(2)] {
        [None, None, None] => meet(s.map(at), t.map(at)),
        _ if collapsed(s) || collapsed(t) => meet_in_more_collapsed(at, s, t),
        [Some(j), None, None] => meet_beyond_vertex(from(s.map(at), 0), from(t.map(at), j)),
        [None, Some(j), None] => meet_beyond_vertex(from(s.map(at), 1), from(t.map(at), j)),
        [None, None, Some(j)] => meet_beyond_vertex(from(s.map(at), 2), from(t.map(at), j)),
        [Some(j), Some(k), None] => meet_beyond_edge(at(s[0]), at(s[1]), at(s[2]), at(t[3 - j - k])),
        [None, Some(j), Some(k)] => meet_beyond_edge(at(s[1]), at(s[2]), at(s[0]), at(t[3 - j - k])),
        [Some(j), None, Some(k)] => meet_beyond_edge(at(s[2]), at(s[0]), at(s[1]), at(t[3 - j - k])),
        [Some(_), Some(_), Some(_)] => true,
    }
}

/// Whether two corners have the same name: possible only where names are positions.
#[inline]
fn collapsed([a, b, c]: [VertexId; 3]) -> bool {
    a == b || b == c || c == a
}

/// [`meet_in_more`] where one triangle at least is collapsed and they share a corner.
fn meet_in_more_collapsed(at: &impl Fn(VertexId) -> DVec3, s: [VertexId; 3], t: [VertexId; 3]) -> bool {
    let within = |s: [VertexId; 3], t: [VertexId; 3]| s.iter().all(|v| t.contains(v));
    if (collapsed(s) && within(s, t)) || (collapsed(t) && within(t, s)) {
        return false; // One is the vertex or edge that they share.
    }
    // The collapsed one is a segment of which only one end is shared.
    let shared = |s: [VertexId; 3], t: [VertexId; 3]| s.iter().position(|v| t.contains(v));
    let (Some(i), Some(j)) = (shared(s, t), shared(t, s)) else { return false };
    meet_beyond_vertex(from(s.map(at), i), from(t.map(at), j))
}

/// The corners in cyclic order from corner `k`.
#[inline]
fn from(t: [DVec3; 3], k: usize) -> [DVec3; 3] {
    [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]
}

#[inline]
fn meet(s: [DVec3; 3], t: [DVec3; 3]) -> bool {
    Box3::of(s).meets(&Box3::of(t)) && triangles_intersect(s, t)
}

/// Whether triangles `s` and `t` with the common first corner meet elsewhere.
fn meet_beyond_vertex(s: [DVec3; 3], t: [DVec3; 3]) -> bool {
    if same_side(s, t[1], t[2]) || same_side(t, s[1], s[2]) {
        return false;
    }
    let parts_of_t = star_parts(t);
    star_parts(s).iter().flatten().any(|&s| {
        parts_of_t.iter().flatten().any(|&t| {
            segment_intersects_triangle([s[1], s[2]], t) || segment_intersects_triangle([t[1], t[2]], s)
        })
    })
}

/// Whether `p` and `q` lie strictly on the same side of the plane of a triangle.
#[inline]
fn same_side([a, b, c]: [DVec3; 3], p: DVec3, q: DVec3) -> bool {
    match orient3d(a, b, c, p) {
        Sign::Zero => false,
        side => orient3d(a, b, c, q) == side,
    }
}

/// A triangle as a union of at most two, none of which has the first corner, common to all, on its opposite edge.
fn star_parts(t: [DVec3; 3]) -> [Option<[DVec3; 3]>; 2] {
    let [v, a, b] = t;
    let on_opposite_edge = Box3::of([a, b]).contains(v) && open_axis(t).is_none();
    if on_opposite_edge { [a, b].map(|end| (end != v).then_some([v, end, end])) } else { [Some(t), None] }
}

/// Whether triangles `uva` and `uvb` meet beyond the edge `uv`.
fn meet_beyond_edge(u: DVec3, v: DVec3, a: DVec3, b: DVec3) -> bool {
    if !orient3d(u, v, a, b).is_zero() {
        return false;
    }
    if u == v {
        return share_direction(u, a, b);
    }
    match (open_axis([u, v, a]), open_axis([u, v, b])) {
        (Some((axis, side)), Some(_)) => {
            let [u, v, b] = [u, v, b].map(|p| seen_along(axis, p));
            orient2d(u, v, b) == side
        }
        (None, None) => {
            let edge = Box3::of([u, v]);
            let beyond_v = |p: DVec3| Box3::of([u, p]).contains(v);
            !edge.contains(a) && !edge.contains(b) && beyond_v(a) == beyond_v(b)
        }
        _ => false,
    }
}

/// Whether the segments `ua` and `ub` share more than `u`.
fn share_direction(u: DVec3, a: DVec3, b: DVec3) -> bool {
    let nested = Box3::of([u, a]).contains(b) || Box3::of([u, b]).contains(a);
    a != u && b != u && nested && open_axis([u, a, b]).is_none()
}

/// The axis along which a triangle does not look flat, and its orientation seen so; none if it is degenerate.
fn open_axis(t: [DVec3; 3]) -> Option<(usize, Sign)> {
    (0..3).find_map(|axis| {
        let [a, b, c] = t.map(|p| seen_along(axis, p));
        let sign = orient2d(a, b, c);
        (!sign.is_zero()).then_some((axis, sign))
    })
}

fn seen_along(axis: usize, p: DVec3) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}
