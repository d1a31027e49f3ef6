//! A line of the moved grid against a triangle.

use super::node::{copied, rounded_sides, side_of_line, side_of_plane};
use super::{P2, P3};
use crate::finite::check_finite;
use crate::intersection::{all_finite, project};
use crate::{NonFinite, Point, Sign, orient2d};

/// Whether the moved line along `axis` crosses a closed triangle, and from which side: the sign of the component of
/// the normal `(b - a) x (c - a)` along the axis if it does, [`Sign::Zero`] if not.
///
/// A triangle that is seen edge-on along the axis is not crossed. The line never meets an edge or a vertex.
///
/// ```
/// use welter_predicates::{Sign, moved_grid::axis_line_crossing};
/// let square = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [1.0, 1.0, 5.0], [0.0, 1.0, 5.0]];
/// let halves = [[square[0], square[1], square[2]], [square[0], square[2], square[3]]];
/// // Through the diagonal that both share, along z; the line moves more in x than in y.
/// assert_eq!(halves.map(|t| axis_line_crossing(2, [0.5, 0.5], t)), [Sign::Positive, Sign::Zero]);
/// assert_eq!(halves.map(|t| axis_line_crossing(0, [0.5, 5.0], t)), [Sign::Zero; 2]);
/// ```
#[inline]
#[must_use]
pub fn axis_line_crossing(axis: usize, line: [f64; 2], triangle: [impl Point<3>; 3]) -> Sign {
    crossing(axis % 3, line, &triangle.map(Point::coords))
}

/// As [`axis_line_crossing`], checked; arguments are counted `triangle[0]`, `triangle[1]`, `triangle[2]`, `line`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_axis_line_crossing;
/// let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, f64::NAN]];
/// assert_eq!(try_axis_line_crossing(2, [0.5; 2], t).unwrap_err().argument, 2);
/// ```
#[inline]
pub fn try_axis_line_crossing(
    axis: usize,
    line: [f64; 2],
    triangle: [impl Point<3>; 3],
) -> Result<Sign, NonFinite> {
    let triangle = triangle.map(Point::coords);
    check_finite(&triangle)?;
    check_line(3, line)?;
    Ok(crossing(axis % 3, line, &triangle))
}

/// Whether the crossing of a moved line with a triangle comes before the moved node at `coordinate` on that line: whether it is at
/// a smaller coordinate along the axis. Never the same, since the node does not lie on the triangle.
///
/// The triangle is one that the line crosses; for others the answer is that of its plane, `false` if that is parallel to the axis.
///
/// ```
/// use welter_predicates::moved_grid::crossing_precedes;
/// let t = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]];
/// assert!(crossing_precedes(2, [0.25, 0.25], t, 6.0));
/// assert!(crossing_precedes(2, [0.25, 0.25], t, 5.0));
/// assert!(!crossing_precedes(2, [0.25, 0.25], t, 5.0f64.next_down()));
/// ```
#[inline]
#[must_use]
pub fn crossing_precedes(axis: usize, line: [f64; 2], triangle: [impl Point<3>; 3], coordinate: f64) -> bool {
    precedes(axis % 3, line, &triangle.map(Point::coords), coordinate)
}

/// As [`crossing_precedes`], checked; arguments are counted `triangle[0]`, `triangle[1]`, `triangle[2]`, `line`,
/// `coordinate`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_crossing_precedes;
/// let t = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]];
/// assert_eq!(try_crossing_precedes(2, [0.25, 0.25], t, f64::NAN).unwrap_err().argument, 4);
/// ```
#[inline]
pub fn try_crossing_precedes(
    axis: usize,
    line: [f64; 2],
    triangle: [impl Point<3>; 3],
    coordinate: f64,
) -> Result<bool, NonFinite> {
    let triangle = triangle.map(Point::coords);
    check_finite(&triangle)?;
    check_line(3, line)?;
    if !coordinate.is_finite() {
        return Err(NonFinite { argument: 4, coordinate: 0, value: coordinate });
    }
    Ok(precedes(axis % 3, line, &triangle, coordinate))
}

/// [`check_finite`] of a line that is a later argument.
#[inline]
pub(super) fn check_line(argument: usize, line: P2) -> Result<(), NonFinite> {
    check_finite(&[line]).map_err(|error| NonFinite { argument, ..error })
}

#[inline]
fn crossing(axis: usize, line: P2, corners: &[P3; 3]) -> Sign {
    let t = corners.map(|p| project(p, axis));
    for k in 0..2 {
        // After the move the line is beyond every corner that it was at.
        let [a, b, c] = t.map(|p| p[k]);
        let behind = (a > line[k]) & (b > line[k]) & (c > line[k]);
        let ahead = (a <= line[k]) & (b <= line[k]) & (c <= line[k]);
        if behind | ahead {
            return Sign::Zero;
        }
    }
    let edges = [[t[0], t[1], line], [t[1], t[2], line], [t[2], t[0], line]];
    match rounded_sides(&edges) {
        [_, true, true] => Sign::Zero,
        [true, positive, _] if all_finite(corners) => {
            if positive {
                Sign::Positive
            } else {
                Sign::Negative
            }
        }
        _ => crossing_exactly(axis, line, &copied(corners)),
    }
}

#[cold]
#[inline(never)]
fn crossing_exactly(axis: usize, line: P2, corners: &[P3; 3]) -> Sign {
    let t = corners.map(|p| project(p, axis));
    // On one side of all three edges, hence inside. If the projection is degenerate, they do not run round
    // anything: one of the signs is zero, or two are opposite.
    let side = side_of_line(axis, t[0], t[1], line);
    let inside = side == side_of_line(axis, t[1], t[2], line) && side == side_of_line(axis, t[2], t[0], line);
    if inside && all_finite(corners) { side } else { Sign::Zero }
}

#[inline]
fn precedes(axis: usize, line: P2, t: &[P3; 3], coordinate: f64) -> bool {
    let [a, b, c] = t.map(|p| project(p, axis));
    let mut node = [coordinate; 3];
    (node[(axis + 1) % 3], node[(axis + 2) % 3]) = (line[0], line[1]);
    // The determinant of the node is the normal along the axis times the way from the node to the crossing.
    side_of_plane(t, node) * orient2d(a, b, c) == Sign::Negative
}
