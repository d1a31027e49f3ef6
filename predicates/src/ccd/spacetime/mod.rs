//! Collision of swept simplices: motion in which space-time is cut into flat pieces \[Brochu12\].
//!
//! # What it computes
//! Time is one more coordinate. A vertex sweeps a segment from `(x, 0)` to `(x*, 1)`; an edge sweeps two
//! triangles, a face three tetrahedra, with vertices in the order of their indices:
//!
//! ```text
//! edge   x1 x2 x2*         face   x1 x2 x3  x3*
//!        x1 x1* x2*               x1 x2 x2* x3*
//!                                 x1 x1* x2* x3*
//! ```
//!
//! Two primitives collide if their pieces meet: one vertex against a face in three tests of a segment and a
//! tetrahedron, two edges in four tests of triangles, in four dimensions; a vertex against a segment of the
//! plane in two tests in three dimensions.
//!
//! # Promises
//! * The answer is exact for every finite `f64` and every degenerate position; pieces are closed sets. Not
//!   finite: false.
//! * **Watertight.** The pieces of an edge are the same in all faces that share it, because vertices are
//!   ordered by index. Let a closed triangulated surface (every edge in an even number of triangles) move, and
//!   a vertex start strictly inside and end strictly outside, by crossing parity: then [`vertex_face`] is true
//!   for some face, and so is [`vertex_segment_2d`] for a closed polygon. The pieces make up a chain modulo two
//!   whose boundary lies at times 0 and 1; along a path that avoids it the parity of the section around the
//!   vertex does not change.
//! * The same answer under permutation and mirroring of axes, scaling by powers of two, and renaming of
//!   vertices if the indices keep their order. Reversal of time takes the pieces to those of the *reversed*
//!   order of indices: the answer is the same if time and the order of indices are both reversed, and need not
//!   be if only one is.
//!
//! # Non-promises
//! * Between times 0 and 1 edges have kinks and faces folds, so answers differ from those of [`crate::ccd`],
//!   where primitives stay straight. At times 0 and 1 the two motions agree.
//! * Equal indices of different vertices: these are taken in the order of the arguments, and neighbours may
//!   then disagree.
//!
//! # Method
//! *Culling* as in [`crate::ccd`]. A point of a piece at time t is `(1 - t) p + t q`, with `p` in the hull of
//! the primitive at time 0 and `q` in that at time 1: divide the weights of its corners at either time by their
//! sum. A direction that separates two primitives strictly, and in the same sense, at both ends therefore
//! separates all of their pieces.
//!
//! *Pieces* by signs of [`orient4d`](crate::orient4d) (`meeting`), degenerate ones by projection.
//! [`by_elimination`] asks the same of the linear solver; tests compare the two. Orientations are faster.
//!
//! # Cost
//! Constant: at most 18 orientations for a vertex and a face, 24 for two edges, unless pieces are degenerate.

pub mod by_elimination;
mod meeting;
mod pieces;

use super::settle::{all_finite, boxes_apart_in_plane, never};
use super::{EDGE_EDGE, VERTEX_FACE};
use crate::Point;
use crate::intersection::segment_intersects_triangle;

/// Whether the moving vertex touches the moving face, both cut into pieces of space-time.
///
/// `t0` and `t1` are the places of `v, f0, f1, f2` at the beginning and at the end of the step, `indices` the
/// numbers of these vertices in their mesh; that of `v` does not matter. False when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::spacetime::vertex_face;
/// let rest = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// let step = |z0, z1| {
///     let at = |z| [[0.0, 0.0, z], rest[0], rest[1], rest[2]];
///     vertex_face(at(z0), at(z1), [7, 2, 5, 3])
/// };
/// assert!(step(1.0, -1.0));
/// assert!(step(1.0, 0.0));
/// assert!(!step(1.0, 5e-324));
/// ```
#[must_use]
pub fn vertex_face(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], indices: [u32; 4]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    !never(&t0, &t1, &VERTEX_FACE)
        && all_finite(&t0, &t1)
        && pieces::vertex_face(&t0, &t1, indices).iter().any(|points| meeting::meet(points, 2))
}

/// Whether the moving edges touch, both cut into pieces of space-time.
///
/// `t0` and `t1` are the places of `ea0, ea1, eb0, eb1`, `indices` their numbers in the mesh. False when a
/// coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::spacetime::edge_edge;
/// let across = |z| [[-1.0, 0.0, z], [1.0, 0.0, z], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
/// assert!(edge_edge(across(1.0), across(-1.0), [0, 1, 2, 3]));
/// assert!(!edge_edge(across(2.0), across(1.0), [0, 1, 2, 3]));
/// ```
#[must_use]
pub fn edge_edge(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], indices: [u32; 4]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    !never(&t0, &t1, &EDGE_EDGE)
        && all_finite(&t0, &t1)
        && pieces::edge_edge(&t0, &t1, indices).iter().any(|points| meeting::meet(points, 3))
}

/// Whether the moving vertex of the plane touches the moving segment, both cut into pieces of space-time.
///
/// `t0` and `t1` are the places of `v, s0, s1`, `indices` their numbers; that of `v` does not matter. False
/// when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::spacetime::vertex_segment_2d;
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// assert!(vertex_segment_2d([[0.0, 1.0], s[0], s[1]], [[0.0, -1.0], s[0], s[1]], [0, 1, 2]));
/// assert!(!vertex_segment_2d([[2.0, 1.0], s[0], s[1]], [[2.0, -1.0], s[0], s[1]], [0, 1, 2]));
/// ```
#[must_use]
pub fn vertex_segment_2d(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3], indices: [u32; 3]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    !boxes_apart_in_plane(&t0, &t1)
        && all_finite(&t0, &t1)
        && pieces::vertex_segment(&t0, &t1, indices)
            .iter()
            .any(|&[v0, v1, a, b, c]| segment_intersects_triangle([v0, v1], [a, b, c]))
}
