//! A moved box against a triangle or a segment.
//!
//! Separating axes, as in [`crate::intersection::triangle_box`], which hold over every ordered field, hence also with the
//! infinitesimals: the 3 axes of the box, the normal of the triangle, and the 9 cross products of an axis with an edge. No
//! support plane touches anything after the move, so that each test is a sign that is not zero. Where a triangle is
//! degenerate, the tests that have no direction left separate nothing, and the others are those of the segment or point that it is.

use super::node::{side_of_line, side_of_plane};
use super::{P2, P3};
use crate::finite::check_finite;
use crate::intersection::{all_finite, project};
use crate::{NonFinite, Point, Sign, orient2d};

/// Whether the closed box from `min` to `max`, moved as a whole, meets a closed triangle.
///
/// A degenerate triangle is the segment or the point that it is. A box with `min > max` on some axis is empty.
///
/// ```
/// use welter_predicates::moved_grid::moved_box_meets_triangle;
/// // In the plane between two boxes: the move takes them up, so that the lower one holds it.
/// let t = [[0.25, 0.25, 1.0], [0.75, 0.25, 1.0], [0.25, 0.75, 1.0]];
/// assert!(moved_box_meets_triangle([0.0; 3], [1.0; 3], t));
/// assert!(!moved_box_meets_triangle([0.0, 0.0, 1.0], [1.0, 1.0, 2.0], t));
/// ```
#[inline]
#[must_use]
pub fn moved_box_meets_triangle(
    min: impl Point<3>,
    max: impl Point<3>,
    triangle: [impl Point<3>; 3],
) -> bool {
    meets_triangle(&min.coords(), &max.coords(), &triangle.map(Point::coords))
}

/// As [`moved_box_meets_triangle`], checked; arguments are counted `min`, `max`, `triangle[0]`, `triangle[1]`,
/// `triangle[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_moved_box_meets_triangle;
/// let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, f64::NAN]];
/// assert_eq!(try_moved_box_meets_triangle([0.0; 3], [1.0; 3], t).unwrap_err().argument, 4);
/// ```
#[inline]
pub fn try_moved_box_meets_triangle(
    min: impl Point<3>,
    max: impl Point<3>,
    triangle: [impl Point<3>; 3],
) -> Result<bool, NonFinite> {
    let (min, max, [a, b, c]) = (min.coords(), max.coords(), triangle.map(Point::coords));
    check_finite(&[min, max, a, b, c])?;
    Ok(meets_triangle(&min, &max, &[a, b, c]))
}

/// Whether the closed box from `min` to `max`, moved as a whole, meets a closed segment.
///
/// A segment of length zero is a point. A box with `min > max` on some axis is empty.
///
/// ```
/// use welter_predicates::moved_grid::moved_box_meets_segment;
/// // From corner to corner along an edge of the box: x moves away from it, y and z too.
/// let along = |y: f64, z: f64| moved_box_meets_segment([0.0; 3], [1.0; 3], [[0.0, y, z], [1.0, y, z]]);
/// assert_eq!([along(0.0, 0.0), along(0.0, 1.0), along(1.0, 0.0), along(1.0, 1.0)], [false, false, false, true]);
/// ```
#[inline]
#[must_use]
pub fn moved_box_meets_segment(min: impl Point<3>, max: impl Point<3>, segment: [impl Point<3>; 2]) -> bool {
    meets_segment(&min.coords(), &max.coords(), &segment.map(Point::coords))
}

/// As [`moved_box_meets_segment`], checked; arguments are counted `min`, `max`, `segment[0]`, `segment[1]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_moved_box_meets_segment;
/// let segment = [[0.0; 3], [1.0, f64::NEG_INFINITY, 0.0]];
/// assert_eq!(try_moved_box_meets_segment([0.0; 3], [1.0; 3], segment).unwrap_err().argument, 3);
/// ```
#[inline]
pub fn try_moved_box_meets_segment(
    min: impl Point<3>,
    max: impl Point<3>,
    segment: [impl Point<3>; 2],
) -> Result<bool, NonFinite> {
    let (min, max, [p, q]) = (min.coords(), max.coords(), segment.map(Point::coords));
    check_finite(&[min, max, p, q])?;
    Ok(meets_segment(&min, &max, &[p, q]))
}

#[inline]
fn meets_triangle(min: &P3, max: &P3, t: &[P3; 3]) -> bool {
    match by_boxes(min, max, t) {
        Some(answer) => answer,
        None => triangle_passes(min, max, t),
    }
}

#[inline]
fn meets_segment(min: &P3, max: &P3, s: &[P3; 2]) -> bool {
    match by_boxes(min, max, s) {
        Some(answer) => answer,
        None => (0..3).all(|k| {
            let [u, v] = s.map(|p| project(p, k));
            !line_separates(k, u, v, project(*min, k), project(*max, k))
        }),
    }
}

/// No if the moved box and the box of the points are disjoint, yes if it contains one of the points, else nothing.
#[inline(always)]
fn by_boxes<const P: usize>(min: &P3, max: &P3, points: &[P3; P]) -> Option<bool> {
    let mut apart = false;
    let mut inside = [true; P];
    for k in 0..3 {
        let (mut above, mut below) = (true, true);
        for (p, inside) in points.iter().zip(&mut inside) {
            // After the move `min` is greater than itself, and `max` too.
            let (over_min, over_max) = (p[k] > min[k], p[k] > max[k]);
            below &= !over_min;
            above &= over_max;
            *inside &= over_min & !over_max;
        }
        apart |= above | below | (min[k] > max[k]);
    }
    if apart || !all_finite(points) || !all_finite(&[*min, *max]) {
        return Some(false);
    }
    inside.iter().any(|&inside| inside).then_some(true)
}

/// Whether none of the directions of the triangle separates it from the box.
#[inline(never)]
fn triangle_passes(min: &P3, max: &P3, t: &[P3; 3]) -> bool {
    let mut normal = [Sign::Zero; 3];
    for (k, along) in normal.iter_mut().enumerate() {
        let t = t.map(|p| project(p, k));
        *along = orient2d(t[0], t[1], t[2]);
        let (min, max) = (project(*min, k), project(*max, k));
        if (0..3).any(|i| edge_separates(k, *along, t[i], t[(i + 1) % 3], &min, &max)) {
            return false;
        }
    }
    // Negative where the normal points to. Collinear corners have no side.
    side_of_plane(t, corner(normal, min, max)) != Sign::Positive
        && side_of_plane(t, corner(normal.map(|s| -s), min, max)) != Sign::Negative
}

/// The corner of the box that is extreme in a direction with these signs.
#[inline(always)]
fn corner<const N: usize>(direction: [Sign; N], min: &[f64; N], max: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|k| if direction[k] == Sign::Negative { min[k] } else { max[k] })
}

/// Whether, in the projection along an axis, the line of an edge has the moved box on one side and the triangle, of this
/// orientation, on the other.
#[inline(always)]
fn edge_separates(axis: usize, orientation: Sign, u: P2, v: P2, min: &P2, max: &P2) -> bool {
    // The left normal of the edge.
    let left = [Sign::of_difference(u[1], v[1]), Sign::of_difference(v[0], u[0])];
    // The triangle lies on the left or on the right. If it is seen edge-on, its edges run both ways along one
    // line, so that testing the left of each tests both sides.
    if orientation == Sign::Negative {
        side_of_line(axis, u, v, corner(left.map(|s| -s), min, max)) == Sign::Positive
    } else {
        side_of_line(axis, u, v, corner(left, min, max)) == Sign::Negative
    }
}

/// Whether, in the projection along an axis, a line has the moved box on one side. One of no direction has not.
#[inline(always)]
fn line_separates(axis: usize, u: P2, v: P2, min: P2, max: P2) -> bool {
    let left = [Sign::of_difference(u[1], v[1]), Sign::of_difference(v[0], u[0])];
    side_of_line(axis, u, v, corner(left, &min, &max)) == Sign::Negative
        || side_of_line(axis, u, v, corner(left.map(|s| -s), &min, &max)) == Sign::Positive
}
