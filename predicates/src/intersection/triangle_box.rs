//! A triangle against a closed box given by its least and greatest corners.
//!
//! | case | the triangle |
//! | --- | --- |
//! | `Disjoint` | has no common point with the box (always so for the empty box, `min > max` on some axis) |
//! | `Touching(c)` | meets the boundary only; `c.a`, `c.b` are the smallest closed features that hold the common set |
//! | `Crossing` | has points strictly inside the box and points outside |
//! | `Inside` | lies in the closed box, with points strictly inside |
//! | `Degenerate { a, b }` | meets the box, and the triangle (`a`) or the box (`b`) is degenerate |
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
use super::segment_box::{BoxFeature, Side, contains, is_flat};
use super::{Contact, P2, P3, SegmentBox, SegmentFeature, SegmentTriangle, TriangleFeature};
use super::{segment_box, segment_triangle};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient2d, orient3d};

/// How a triangle and a box meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TriangleBox {
    /// No common point.
    Disjoint,
    /// They meet on the boundary of the box only. The common points all lie on these features (closed), and on
    /// no smaller ones.
    Touching(Contact<TriangleFeature, BoxFeature>),
    /// The triangle has points strictly inside the box, and others outside.
    Crossing,
    /// The triangle lies in the closed box and has points strictly inside.
    Inside,
    /// They meet, and at least one is degenerate.
    Degenerate {
        /// The triangle is collinear or a single point.
        a: bool,
        /// The box is flat: `min == max` on some axis.
        b: bool,
    },
}

/// How the triangle `t` meets the closed box from `min` to `max`.
///
/// ```
/// use welter_predicates::intersection::{TriangleBox, triangle_box};
/// let (min, max) = ([0.0; 3], [1.0; 3]);
/// let at = |x: f64| triangle_box([[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]], min, max);
/// assert_eq!(at(1.0), TriangleBox::Inside);
/// assert_eq!(at(2.0), TriangleBox::Crossing);
/// let TriangleBox::Touching(touch) = at(3.0) else { panic!() };
/// assert_eq!(touch.b.dimension(), 0);
/// assert_eq!(at(4.0), TriangleBox::Disjoint);
/// ```
pub fn triangle_box(t: [impl Point<3>; 3], min: impl Point<3>, max: impl Point<3>) -> TriangleBox {
    case(t.map(Point::coords), min.coords(), max.coords())
}

/// As [`triangle_box`], checked; arguments are counted `t[0]`, `t[1]`, `t[2]`, `min`, `max`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_triangle_box;
/// let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// assert_eq!(try_triangle_box(t, [0.0; 3], [1.0, 1.0, f64::NAN]).unwrap_err().argument, 4);
/// ```
pub fn try_triangle_box(
    t: [impl Point<3>; 3],
    min: impl Point<3>,
    max: impl Point<3>,
) -> Result<TriangleBox, NonFinite> {
    let (t, min, max) = (t.map(Point::coords), min.coords(), max.coords());
    check_finite(&[t[0], t[1], t[2], min, max])?;
    Ok(case(t, min, max))
}

/// True when the closed triangle meets the closed box from `min` to `max`: [`triangle_box`] is not `Disjoint`. The
/// fast form.
///
/// ```
/// use welter_predicates::intersection::triangle_intersects_box;
/// let (min, max) = ([0.0; 3], [1.0; 3]);
/// assert!(triangle_intersects_box([[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]], min, max));
/// assert!(!triangle_intersects_box([[3.5, 0.0, 0.0], [0.0, 3.5, 0.0], [0.0, 0.0, 3.5]], min, max));
/// ```
pub fn triangle_intersects_box(t: [impl Point<3>; 3], min: impl Point<3>, max: impl Point<3>) -> bool {
    meets(&t.map(Point::coords), &min.coords(), &max.coords())
}

fn meets(t: &[P3; 3], min: &P3, max: &P3) -> bool {
    for k in 0..3 {
        if t.iter().all(|p| p[k] < min[k]) || t.iter().all(|p| p[k] > max[k]) || min[k] > max[k] {
            return false;
        }
    }
    if !all_finite(t) || !all_finite(&[*min, *max]) {
        return false;
    }
    if t.iter().any(|p| contains(p, min, max)) {
        return true;
    }
    let normal: [Sign; 3] = core::array::from_fn(|k| {
        let [a, b, c] = t.map(|p| project(p, k));
        orient2d(a, b, c)
    });
    !plane_separates(t, &normal, min, max) && !(0..3).any(|k| edge_separates(t, normal[k], min, max, k))
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
        // The triangle lies on the left or on the right. If it is seen edge-on, its edges run both ways along one
        // line, so that testing the left of each tests both sides.
        if orientation == Sign::Negative {
            orient2d(u, v, corner(left.map(|s| -s), &min, &max)) == Sign::Positive
        } else {
            orient2d(u, v, corner(left, &min, &max)) == Sign::Negative
        }
    })
}

fn case(t: [P3; 3], min: P3, max: P3) -> TriangleBox {
    if !meets(&t, &min, &max) {
        return TriangleBox::Disjoint;
    }
    let (a, b) = (super::planar::proper_axis(t).is_none(), is_flat(&min, &max));
    if a || b {
        return TriangleBox::Degenerate { a, b };
    }
    // The common set is the hull of its extreme points, so that the join of their features is its feature.
    match extreme_points(t, min, max) {
        Some(touch) if touch.b.dimension() < 3 => TriangleBox::Touching(touch),
        _ if t.iter().all(|p| contains(p, &min, &max)) => TriangleBox::Inside,
        _ => TriangleBox::Crossing,
    }
}

/// The join of the features of the extreme common points: each is on an edge of the triangle or on one of the box.
fn extreme_points(t: [P3; 3], min: P3, max: P3) -> Option<Contact<TriangleFeature, BoxFeature>> {
    let mut joined: Option<Contact<TriangleFeature, BoxFeature>> = None;
    let mut add = |a: TriangleFeature, b: BoxFeature| {
        joined = Some(joined.map_or(Contact::new(a, b), |c| Contact::new(c.a.join(a), c.b.join(b))));
    };
    for i in 0..3 {
        match segment_box([t[i], t[(i + 1) % 3]], min, max) {
            SegmentBox::Point(c) => add(TriangleFeature::of_edge_point(i, c.a), c.b),
            SegmentBox::Overlap(ends) => {
                ends.iter().for_each(|c| add(TriangleFeature::of_edge_point(i, c.a), c.b));
            }
            SegmentBox::Disjoint | SegmentBox::Degenerate { .. } => {}
        }
    }
    for edge in 0..12 {
        // Along axis `edge / 4`, at one of the four corners of the other two.
        let side = |low: bool| if low { Side::Min } else { Side::Max };
        let mut sides = [Side::Between; 3];
        sides[(edge / 4 + 1) % 3] = side(edge % 2 == 0);
        sides[(edge / 4 + 2) % 3] = side(edge % 4 < 2);
        let end = |side: Side| -> (P3, BoxFeature) {
            let mut sides = sides;
            sides[edge / 4] = side;
            let p = core::array::from_fn(|k| if sides[k] == Side::Min { min[k] } else { max[k] });
            (p, BoxFeature(sides))
        };
        let (low, high) = (end(Side::Min), end(Side::Max));
        let mut take = |at: SegmentFeature, a: TriangleFeature| {
            add(
                a,
                match at {
                    SegmentFeature::Vertex(0) => low.1,
                    SegmentFeature::Vertex(_) => high.1,
                    SegmentFeature::Interior => BoxFeature(sides),
                },
            );
        };
        match segment_triangle([low.0, high.0], t) {
            SegmentTriangle::Crossing(c) | SegmentTriangle::CoplanarPoint(c) => take(c.a, c.b),
            SegmentTriangle::CoplanarSegment(ends) => ends.iter().for_each(|c| take(c.a, c.b)),
            SegmentTriangle::Disjoint | SegmentTriangle::Degenerate { .. } => {}
        }
    }
    joined
}
