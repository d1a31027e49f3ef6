//! The query in the plane: [`vertex_segment_2d`].
//!
//! The domain is the square of `(t, u)`, its boundary's image the quadrilateral of the corners `s0 - v`,
//! `s1 - v` at the beginning and `s1 - v`, `s0 - v` at the end of the step. The ray has the direction
//! `(1, e)` with an infinitesimal `e > 0`: the side `det(R, p)` of a corner is the sign of `p_y`, or of
//! `-p_x` where that is zero, or zero if `p` is the origin. An edge between corners of one side meets neither
//! the ray nor the origin; one from `p` to `q` on opposite sides meets the line of the ray once, ahead if
//! `det(p, q)` has the side of `q`, at the origin if it is zero.

use super::super::settle::{all_finite, boxes_apart_in_plane};
use super::RootParity;
use crate::arithmetic::fixed_point::{self, Integers};
use crate::arithmetic::lattice::Extent;
use crate::arithmetic::scaled::Exact;
use crate::arithmetic::small::{self, Small};
use crate::polynomial::{Additive, Ring, Rounded, orient2d};
use crate::{Point, Sign, filter};

/// The parity of the contacts of a moving vertex and a moving segment of the plane.
///
/// `t0` and `t1` are the places of `v, s0, s1` at the beginning and at the end of the step. `Even` when a
/// coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::parity::{RootParity, vertex_segment_2d};
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// let step = |from, to| vertex_segment_2d([from, s[0], s[1]], [to, s[0], s[1]]);
/// assert_eq!(step([0.0, 1.0], [0.0, -1.0]), RootParity::Odd);
/// assert_eq!(step([1.0, 1.0], [1.0, -1.0]), RootParity::OnBoundary);
/// assert_eq!(step([2.0, 1.0], [2.0, -1.0]), RootParity::Even);
/// ```
#[must_use]
pub fn vertex_segment_2d(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3]) -> RootParity {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    if boxes_apart_in_plane(&t0, &t1) || !all_finite(&t0, &t1) {
        return RootParity::Even;
    }
    let quadrilateral = [(t0[1], t0[0]), (t0[2], t0[0]), (t1[2], t1[0]), (t1[1], t1[0])];
    let sides = quadrilateral.map(side);
    let mut odd = false;
    for i in 0..4 {
        let j = (i + 1) % 4;
        if sides[i].is_zero() {
            return RootParity::OnBoundary;
        }
        if sides[i] != sides[j] {
            let volume = determinant(quadrilateral[i], quadrilateral[j]);
            if volume.is_zero() {
                return RootParity::OnBoundary;
            }
            odd ^= volume == sides[j];
        }
    }
    if odd { RootParity::Odd } else { RootParity::Even }
}

/// A corner as the difference of two points.
type Corner = ([f64; 2], [f64; 2]);

/// The sign of `det(R, p)`.
fn side((p, origin): Corner) -> Sign {
    let y = Sign::of_difference(p[1], origin[1]);
    if y.is_zero() { -Sign::of_difference(p[0], origin[0]) } else { y }
}

/// The sign of the determinant of two corners.
fn determinant((p, v): Corner, (q, w): Corner) -> Sign {
    let rows = [[p[0] - v[0], p[1] - v[1]], [q[0] - w[0], q[1] - w[1]]];
    let value = orient2d::<Rounded>(&rows);
    if value.abs() > filter::orient2d(&rows) {
        Sign::of_nonzero(value)
    } else {
        exactly(&[p, v, q, w, [0.0; 2]])
    }
}

/// The sign of the determinant of two corners that are differences of the first four points; the last is
/// zero.
#[cold]
fn exactly(points: &[[f64; 2]; 5]) -> Sign {
    fn of<K: Ring<Outcome: Exact>>([p, v, q, w]: &[[K::D1; 2]; 4]) -> Sign {
        let row = |a: &[K::D1; 2], b: &[K::D1; 2]| [a[0].minus(&b[0]), a[1].minus(&b[1])];
        orient2d::<K>(&[row(p, v), row(q, w)]).into().sign()
    }
    let few = Extent::of(points).filter(|extent| !extent.is_tiny());
    match few.and_then(|extent| small::rows(points, extent, 2)) {
        Some((_, points)) => of::<Small>(&points),
        None => of::<Integers>(&fixed_point::differences(points).1),
    }
}
