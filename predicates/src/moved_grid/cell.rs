//! A moved box against a triangle or a segment.
//!
//! Separating axes, as in [`crate::intersection::triangle_box`], which hold over every ordered field, hence also with the
//! infinitesimals: the 3 axes of the box, the normal of the triangle, and the 9 cross products of an axis with an edge. No
//! support plane touches anything after the move, so that each test is a sign that is not zero. Where a triangle is
//! degenerate, the tests that have no direction left separate nothing, and the others are those of the segment or point that it is.

use super::node::{copied, rounded_sides, side_of_line, sides_of_plane};
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
        None => triangle_passes(&copied(&[*min, *max]), &copied(t)),
    }
}

#[inline]
fn meets_segment(min: &P3, max: &P3, s: &[P3; 2]) -> bool {
    match by_boxes(min, max, s) {
        Some(answer) => answer,
        None => segment_passes(&copied(&[*min, *max]), &copied(s)),
    }
}

/// No if the moved box and the box of the points are disjoint, yes if it contains one of the points, else nothing.
#[inline(always)]
fn by_boxes<const P: usize>(min: &P3, max: &P3, points: &[P3; P]) -> Option<bool> {
    let mut apart = false;
    for k in 0..3 {
        let (mut low, mut high) = (points[0][k], points[0][k]);
        for p in &points[1..] {
            low = if p[k] < low { p[k] } else { low };
            high = if p[k] > high { p[k] } else { high };
        }
        // After the move `min` is greater than it was, and `max` too.
        apart |= (high <= min[k]) | (low > max[k]) | (min[k] > max[k]);
    }
    if apart || !all_finite(points) || !all_finite(&[*min, *max]) {
        return Some(false);
    }
    let inside = |p: &P3| (0..3).fold(true, |inside, k| inside & (p[k] > min[k]) & (p[k] <= max[k]));
    points.iter().fold(false, |any, p| any | inside(p)).then_some(true)
}

/// Whether none of the directions of the triangle separates it from the box.
#[inline(never)]
fn triangle_passes([min, max]: &[P3; 2], t: &[P3; 3]) -> bool {
    // With differences to the first corner, as the sides have them.
    let normal: [Sign; 3] =
        core::array::from_fn(|k| orient2d(project(t[1], k), project(t[2], k), project(t[0], k)));
    let ends = [corner(normal, min, max), corner(normal.map(|s| -s), min, max)];
    // Negative where the normal points to. Collinear corners have no side.
    let [high, low] = sides_of_plane(t, &ends);
    if high == Sign::Positive || low == Sign::Negative {
        return false;
    }
    let mut certain = true;
    for (k, &orientation) in normal.iter().enumerate() {
        match rounded_sides(&outer_corners(k, orientation, min, max, t)) {
            [_, _, true] => return false,
            [all, ..] => certain &= all,
        }
    }
    certain || !edges_separate(&normal, min, max, t)
}

/// Whether one of the nine edge directions separates a triangle from a box.
#[cold]
#[inline(never)]
fn edges_separate(normal: &[Sign; 3], min: &P3, max: &P3, t: &[P3; 3]) -> bool {
    (0..3).any(|k| {
        let edges = outer_corners(k, normal[k], min, max, t);
        edges.iter().any(|&[u, v, p]| side_of_line(k, u, v, p) == Sign::Negative)
    })
}

/// The edges of a triangle in the projection along an axis, in the order that has the triangle on the left, each with the
/// corner of the box that is the furthest on that side. The edge separates them if this corner is on the right.
///
/// A triangle that is seen edge-on has edges that run both ways along one line, so that the left sides of
/// all are both sides of it.
#[inline(always)]
fn outer_corners(axis: usize, orientation: Sign, min: &P3, max: &P3, t: &[P3; 3]) -> [[P2; 3]; 3] {
    let [a, b, c] = t.map(|p| project(p, axis));
    let (b, c) = if orientation == Sign::Negative { (c, b) } else { (b, c) };
    let (min, max) = (project(*min, axis), project(*max, axis));
    [[a, b], [b, c], [c, a]].map(|[u, v]| [u, v, left_corner(u, v, min, max)])
}

/// Whether none of the directions of the segment separates it from the box.
#[inline(never)]
fn segment_passes([min, max]: &[P3; 2], s: &[P3; 2]) -> bool {
    (0..3).all(|k| {
        let [u, v] = s.map(|p| project(p, k));
        !line_separates(k, u, v, project(*min, k), project(*max, k))
    })
}

/// The corner of the box that is extreme in a direction with these signs.
#[inline(always)]
fn corner(direction: [Sign; 3], min: &P3, max: &P3) -> P3 {
    core::array::from_fn(|k| if direction[k] == Sign::Negative { min[k] } else { max[k] })
}

/// The corner of a rectangle that is the furthest to the left of a line. The left normal is `(u - v)[1], (v - u)[0]`.
#[inline(always)]
fn left_corner(u: P2, v: P2, min: P2, max: P2) -> P2 {
    [if u[1] < v[1] { min[0] } else { max[0] }, if v[0] < u[0] { min[1] } else { max[1] }]
}

/// Whether, in the projection along an axis, a line has the moved box on one side. One of no direction has not.
#[inline(always)]
fn line_separates(axis: usize, u: P2, v: P2, min: P2, max: P2) -> bool {
    side_of_line(axis, u, v, left_corner(u, v, min, max)) == Sign::Negative
        || side_of_line(axis, u, v, left_corner(v, u, min, max)) == Sign::Positive
}
