//! A segment against a triangle in space.
//!
//! | case | the segment |
//! | --- | --- |
//! | `Disjoint` | has no common point with the triangle |
//! | `Crossing(c)` | meets the plane in one point, which lies on `c.a` of the segment and `c.b` of the triangle |
//! | `CoplanarPoint(c)` | lies in the plane and touches the triangle at one point |
//! | `CoplanarSegment([c, d])` | lies in the plane and shares with the triangle the segment from `c` to `d`, in its own direction |
//! | `Degenerate { a, b }` | meets the triangle, and the segment (`a`) or the triangle (`b`) is degenerate |
//!
//! Method: the sides of the two ends to the plane, then the orientations of the segment to the three edges.

use super::hull::{Hull3, all_finite, boxes_disjoint};
use super::planar::{Carrier, project, proper_axis};
use super::plane;
use super::{Contact, P3, SegmentFeature, TriangleFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient3d};

/// How a segment and a triangle meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SegmentTriangle {
    /// No common point.
    Disjoint,
    /// The segment, not in the plane, meets the triangle at one point: properly if both features are `Interior`.
    Crossing(Contact<SegmentFeature, TriangleFeature>),
    /// The segment lies in the plane and meets the triangle at one point.
    CoplanarPoint(Contact<SegmentFeature, TriangleFeature>),
    /// The segment lies in the plane; the ends of the common segment, in the direction of the segment.
    CoplanarSegment([Contact<SegmentFeature, TriangleFeature>; 2]),
    /// They meet, and at least one is degenerate.
    Degenerate {
        /// The segment has length zero.
        a: bool,
        /// The triangle is collinear or a single point.
        b: bool,
    },
}

impl SegmentTriangle {
    /// True when the interiors cross at one point.
    #[must_use]
    pub fn is_proper(self) -> bool {
        self == Self::Crossing(Contact { a: SegmentFeature::Interior, b: TriangleFeature::Interior })
    }
}

/// How the segment `s` meets the triangle `t`.
///
/// ```
/// use welter_predicates::intersection::{SegmentFeature, SegmentTriangle, TriangleFeature, segment_triangle};
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(segment_triangle([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0]], t).is_proper());
/// let SegmentTriangle::Crossing(c) = segment_triangle([[2.0, 2.0, 0.0], [2.0, 2.0, 1.0]], t) else { panic!() };
/// assert_eq!((c.a, c.b), (SegmentFeature::Vertex(0), TriangleFeature::Edge(1)));
/// let flat = segment_triangle([[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0]], t);
/// let SegmentTriangle::CoplanarSegment([enter, end]) = flat else { panic!() };
/// assert_eq!((enter.a, enter.b), (SegmentFeature::Interior, TriangleFeature::Edge(2)));
/// assert_eq!((end.a, end.b), (SegmentFeature::Vertex(1), TriangleFeature::Interior));
/// ```
pub fn segment_triangle(s: [impl Point<3>; 2], t: [impl Point<3>; 3]) -> SegmentTriangle {
    case(s.map(Point::coords), t.map(Point::coords))
}

/// True when the closed segment and the closed triangle meet: [`segment_triangle`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::segment_intersects_triangle;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(segment_intersects_triangle([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0]], t));
/// assert!(!segment_intersects_triangle([[1.0, 1.0, 1e-300], [1.0, 1.0, 1.0]], t));
/// ```
pub fn segment_intersects_triangle(s: [impl Point<3>; 2], t: [impl Point<3>; 3]) -> bool {
    segment_triangle(s, t) != SegmentTriangle::Disjoint
}

/// As [`segment_triangle`], checked; arguments are counted `s[0]`, `s[1]`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_segment_triangle;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]];
/// assert_eq!(try_segment_triangle([[0.0; 3], [1.0; 3]], t).unwrap_err().argument, 4);
/// ```
pub fn try_segment_triangle(
    s: [impl Point<3>; 2],
    t: [impl Point<3>; 3],
) -> Result<SegmentTriangle, NonFinite> {
    let (s, t) = (s.map(Point::coords), t.map(Point::coords));
    check_finite(&[s[0], s[1], t[0], t[1], t[2]])?;
    Ok(case(s, t))
}

fn case(s: [P3; 2], t: [P3; 3]) -> SegmentTriangle {
    if boxes_disjoint(&s, &t) {
        return SegmentTriangle::Disjoint;
    }
    let sides = plane::sides(&t, &s);
    if sides[0] * sides[1] == Sign::Positive || !all_finite(&s) || !all_finite(&t) {
        return SegmentTriangle::Disjoint;
    }
    if sides == [Sign::Zero; 2] {
        // Coplanar, or the triangle has no plane.
        let hulls = [Hull3::of_segment(s), Hull3::of_triangle(t)];
        let (a, b) = (!hulls[0].is_segment(), !hulls[1].is_triangle());
        if a || b {
            let meets = hulls[0].meets(&hulls[1]);
            return if meets { SegmentTriangle::Degenerate { a, b } } else { SegmentTriangle::Disjoint };
        }
    }
    with_sides(s, t, sides)
}

/// The case of a proper segment and a proper triangle.
pub(super) fn proper_segment_triangle(s: [P3; 2], t: [P3; 3]) -> SegmentTriangle {
    with_sides(s, t, plane::sides(&t, &s))
}

/// The same, when `sides[i] = orient3d(t[0], t[1], t[2], s[i])` is known.
pub(super) fn with_sides(s: [P3; 2], t: [P3; 3], sides: [Sign; 2]) -> SegmentTriangle {
    if sides[0] * sides[1] == Sign::Positive {
        return SegmentTriangle::Disjoint;
    }
    if sides == [Sign::Zero; 2] {
        return coplanar(s, t);
    }
    match stab(|i| orient3d(s[0], s[1], t[i], t[(i + 1) % 3])) {
        Some((at, _)) => SegmentTriangle::Crossing(Contact::new(SegmentFeature::on_line(sides), at)),
        None => SegmentTriangle::Disjoint,
    }
}

/// Where a line that is not in the plane of a triangle stabs it, from its orientation to the three edges: inside
/// exactly when no two of them are opposite. The sign is that of those that are not zero.
#[inline]
pub(super) fn stab(edge: impl Fn(usize) -> Sign) -> Option<(TriangleFeature, Sign)> {
    let e0 = edge(0);
    let e1 = edge(1);
    if e0 * e1 == Sign::Negative {
        return None;
    }
    let e2 = edge(2);
    if e0 * e2 == Sign::Negative || e1 * e2 == Sign::Negative {
        return None;
    }
    let sign = if e0.is_zero() { if e1.is_zero() { e2 } else { e1 } } else { e0 };
    Some((TriangleFeature::on_edges([e0.is_zero(), e1.is_zero(), e2.is_zero()]), sign))
}

fn coplanar(s: [P3; 2], t: [P3; 3]) -> SegmentTriangle {
    let Some(axis) = proper_axis(t) else { return SegmentTriangle::Disjoint };
    let ends = Carrier::segment(s.map(|p| project(p, axis))).clip(t.map(|p| project(p, axis))).get();
    match ends.map(|end| end.map(|(a, b)| Contact::new(a, b))) {
        [Some(one), Some(two)] => SegmentTriangle::CoplanarSegment([one, two]),
        [Some(one), None] => SegmentTriangle::CoplanarPoint(one),
        _ => SegmentTriangle::Disjoint,
    }
}
