//! The queries in space: [`vertex_face`] and [`edge_edge`].

use super::super::corners::Corners;
use super::super::settle::{all_finite, culled};
use super::super::{EDGE_EDGE, VERTEX_FACE};
use super::RootParity;
use super::integers::Given;
use super::rounded::parity_of_step;
use super::surface::{Face, Parity};
use crate::Point;

/// The boundary of the prism over the triangle of corners 0, 1, 2 at the beginning and 3, 4, 5 at the end of
/// the step.
pub(super) const PRISM: [Face; 5] = [
    Face::Patch([0, 1, 3, 4]),
    Face::Patch([1, 2, 4, 5]),
    Face::Patch([2, 0, 5, 3]),
    Face::Triangle([0, 1, 2]),
    Face::Triangle([3, 4, 5]),
];

/// The boundary of the cube over the parallelogram of corners 0, 1, 2, 3 at the beginning and 4, 5, 6, 7 at
/// the end.
pub(super) const CUBE: [Face; 6] = [
    Face::Patch([0, 1, 4, 5]),
    Face::Patch([1, 2, 5, 6]),
    Face::Patch([2, 3, 6, 7]),
    Face::Patch([3, 0, 7, 4]),
    Face::Patch([0, 1, 3, 2]),
    Face::Patch([4, 5, 7, 6]),
];

/// The parity of the contacts of a moving vertex and a moving triangle.
///
/// `t0` and `t1` are the places of `v, f0, f1, f2` at the beginning and at the end of the step. `Even` when a
/// coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::parity::{RootParity, vertex_face};
/// let rest = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// let at = |z| [[0.0, 0.0, z], rest[0], rest[1], rest[2]];
/// let step = |z0, z1| vertex_face(at(z0), at(z1));
/// assert_eq!(step(1.0, -1.0), RootParity::Odd);
/// assert_eq!(step(1.0, 0.0), RootParity::OnBoundary);
/// assert_eq!(step(1.0, 5e-324), RootParity::Even);
/// ```
#[must_use]
pub fn vertex_face(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> RootParity {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    let [a, b, c] = VERTEX_FACE;
    RootParity::of(parity(&t0, &t1, &VERTEX_FACE, &PRISM, || [a, b, c, later(a), later(b), later(c)]))
}

/// The parity of the contacts of two moving edges.
///
/// `t0` and `t1` are the places of `ea0, ea1, eb0, eb1` at the beginning and at the end of the step. `Even`
/// when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::{self, parity};
/// // The edges pass through each other, and back.
/// let t0 = [[-4.0, 0.0, -4.0], [4.0, 0.0, 4.0], [-1.0, -1.0, -0.25], [-1.0, 1.0, -0.25]];
/// let t1 = [[-4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [1.0, -1.0, -0.25], [1.0, 1.0, -0.25]];
/// assert_eq!(parity::edge_edge(t0, t1), parity::RootParity::Even);
/// assert!(ccd::edge_edge(t0, t1));
/// ```
#[must_use]
pub fn edge_edge(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> RootParity {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    let [a, b, c, d] = EDGE_EDGE;
    let corners = || [a, b, c, d, later(a), later(b), later(c), later(d)];
    RootParity::of(parity(&t0, &t1, &EDGE_EDGE, &CUBE, corners))
}

/// The same corner at the end of the step, of the points at its beginning and its end together.
pub(super) fn later((i, j): (usize, usize)) -> (usize, usize) {
    (i + 4, j + 4)
}

/// The parity of the crossings with the image of the domain's boundary. `both` has the corners at the
/// beginning and the end of the step.
#[inline(always)]
fn parity<const K: usize, const C: usize>(
    t0: &[[f64; 3]; 4],
    t1: &[[f64; 3]; 4],
    corners: &[(usize, usize); K],
    faces: &[Face],
    both: impl FnOnce() -> [(usize, usize); C],
) -> Parity {
    if culled(t0, t1, corners).is_some() {
        return Parity::Even;
    }
    let image = Corners::new([t0, t1], corners, None);
    if image.separated_otherwise() {
        return Parity::Even;
    }
    parity_of_step(&image, faces).unwrap_or_else(|| {
        if !all_finite(t0, t1) {
            return Parity::Even;
        }
        let points: [[[f64; 3]; 4]; 2] = [*t0, *t1];
        Given::new(points.as_flattened(), both(), None).parity(faces)
    })
}
