//! A triangle against a closed box given by its least and greatest corners.
//!
//! Method: separating axes. A triangle and a box are disjoint exactly when one of 13 directions separates them:
//! the 3 axes of the box, the normal of the triangle, and the 9 cross products of an axis with an edge. Each is
//! decided exactly: the first by comparisons, the second by `orient3d` of the triangle with the two corners of
//! the box that are extreme along the normal, the last as `orient2d` of the edge with an extreme corner in the
//! projection along the axis. Which corner is extreme follows from signs, since the components of the normal are
//! the `orient2d` of the projected triangle. Degenerate operands are limits of proper ones, so the same 13
//! decide for them too.

use super::hull::all_finite;
use super::planar::project;
use super::{P2, P3};
use crate::{Point, Sign, orient2d, orient3d};

/// True when the closed triangle meets the closed box from `min` to `max`.
///
/// ```
/// use welter_predicates::intersection::triangle_intersects_box;
/// let (min, max) = ([0.0; 3], [1.0; 3]);
/// assert!(triangle_intersects_box([[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]], min, max));
/// assert!(!triangle_intersects_box([[3.5, 0.0, 0.0], [0.0, 3.5, 0.0], [0.0, 0.0, 3.5]], min, max));
/// ```
pub fn triangle_intersects_box(t: [impl Point<3>; 3], min: impl Point<3>, max: impl Point<3>) -> bool {
    let (t, min, max) = (t.map(Point::coords), min.coords(), max.coords());
    if !all_finite(&t) || !all_finite(&[min, max]) || (0..3).any(|k| min[k] > max[k]) {
        return false;
    }
    for k in 0..3 {
        if t.iter().all(|p| p[k] < min[k]) || t.iter().all(|p| p[k] > max[k]) {
            return false;
        }
    }
    if t.iter().any(|p| (0..3).all(|k| min[k] <= p[k] && p[k] <= max[k])) {
        return true;
    }
    let normal: [Sign; 3] = core::array::from_fn(|k| {
        let [a, b, c] = t.map(|p| project(p, k));
        orient2d(a, b, c)
    });
    !plane_separates(&t, &normal, &min, &max) && !(0..3).any(|k| edge_separates(&t, normal[k], &min, &max, k))
}

/// The corner of the box that is extreme in a direction with these signs.
fn corner<const N: usize>(direction: [Sign; N], min: &[f64; N], max: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|k| if direction[k] == Sign::Negative { min[k] } else { max[k] })
}

fn plane_separates(t: &[P3; 3], normal: &[Sign; 3], min: &P3, max: &P3) -> bool {
    let high = orient3d(t[0], t[1], t[2], corner(*normal, min, max));
    !high.is_zero() && high == orient3d(t[0], t[1], t[2], corner(normal.map(|s| -s), min, max))
}

/// True when, in the projection along `axis`, the line of an edge has the box strictly on one side and the
/// triangle on the other.
fn edge_separates(t: &[P3; 3], orientation: Sign, min: &P3, max: &P3, axis: usize) -> bool {
    let t: [P2; 3] = t.map(|p| project(p, axis));
    let (min, max) = (project(*min, axis), project(*max, axis));
    (0..3).any(|i| {
        let (u, v) = (t[i], t[(i + 1) % 3]);
        // The left normal of the edge.
        let left = [Sign::of_difference(u[1], v[1]), Sign::of_difference(v[0], u[0])];
        // The triangle lies on the left unless the orientation is negative, on the right unless it is positive.
        (orientation != Sign::Negative && orient2d(u, v, corner(left, &min, &max)) == Sign::Negative)
            || (orientation != Sign::Positive
                && orient2d(u, v, corner(left.map(|s| -s), &min, &max)) == Sign::Positive)
    })
}
