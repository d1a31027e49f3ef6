//! Two segments, in the plane and in space.
//!
//! | case | the segments |
//! | --- | --- |
//! | `Disjoint` | have no common point |
//! | `Point(c)` | have one; `c.a`, `c.b` both `Interior`: they cross properly, otherwise they touch |
//! | `Overlap([c, d])` | are collinear and share the segment from `c` to `d`, in the direction of the first |
//! | `Degenerate { a, b }` | meet, and the first (`a`) or the second (`b`) has length zero |

use super::hull::{Hull2, Hull3, all_finite, between, boxes_disjoint};
use super::planar::{project, proper_axis};
use super::{Contact, P2, P3, SegmentFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient2d, orient3d};

/// How two segments meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SegmentSegment {
    /// No common point.
    Disjoint,
    /// One common point.
    Point(Contact<SegmentFeature, SegmentFeature>),
    /// Collinear, with a common segment; its ends in the direction of the first operand.
    Overlap([Contact<SegmentFeature, SegmentFeature>; 2]),
    /// They meet, and at least one is a single point.
    Degenerate {
        /// The first segment has length zero.
        a: bool,
        /// The second segment has length zero.
        b: bool,
    },
}

impl SegmentSegment {
    /// True when the interiors cross at one point.
    #[must_use]
    pub fn is_proper(self) -> bool {
        self == Self::Point(Contact { a: SegmentFeature::Interior, b: SegmentFeature::Interior })
    }
}

/// How two segments of the plane meet.
///
/// ```
/// use welter_predicates::intersection::{SegmentFeature, SegmentSegment, segment_segment_2d};
/// let a = [[0.0, 0.0], [2.0, 2.0]];
/// assert!(segment_segment_2d(a, [[0.0, 2.0], [2.0, 0.0]]).is_proper());
/// let SegmentSegment::Point(touch) = segment_segment_2d(a, [[1.0, 1.0], [2.0, 0.0]]) else { panic!() };
/// assert_eq!((touch.a, touch.b), (SegmentFeature::Interior, SegmentFeature::Vertex(0)));
/// assert!(matches!(segment_segment_2d(a, [[1.0, 1.0], [3.0, 3.0]]), SegmentSegment::Overlap(_)));
/// assert_eq!(segment_segment_2d(a, [[3.0, 3.0], [4.0, 4.0]]), SegmentSegment::Disjoint);
/// assert_eq!(segment_segment_2d(a, [[1.0, 1.0]; 2]), SegmentSegment::Degenerate { a: false, b: true });
/// ```
pub fn segment_segment_2d(a: [impl Point<2>; 2], b: [impl Point<2>; 2]) -> SegmentSegment {
    case_2d(a.map(Point::coords), b.map(Point::coords))
}

/// True when two closed segments of the plane meet: [`segment_segment_2d`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::segments_intersect_2d;
/// assert!(segments_intersect_2d([[0.0, 0.0], [2.0, 2.0]], [[2.0, 2.0], [5.0, 0.0]]));
/// ```
pub fn segments_intersect_2d(a: [impl Point<2>; 2], b: [impl Point<2>; 2]) -> bool {
    segment_segment_2d(a, b) != SegmentSegment::Disjoint
}

/// As [`segment_segment_2d`], checked; arguments are counted `a[0]`, `a[1]`, `b[0]`, `b[1]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_segment_segment_2d;
/// let a = [[0.0, 0.0], [2.0, f64::NAN]];
/// assert_eq!(try_segment_segment_2d(a, [[0.0, 1.0], [1.0, 0.0]]).unwrap_err().coordinate, 1);
/// ```
pub fn try_segment_segment_2d(
    a: [impl Point<2>; 2],
    b: [impl Point<2>; 2],
) -> Result<SegmentSegment, NonFinite> {
    let (a, b) = (a.map(Point::coords), b.map(Point::coords));
    check_finite(&[a[0], a[1], b[0], b[1]])?;
    Ok(case_2d(a, b))
}

/// How two segments of space meet.
///
/// ```
/// use welter_predicates::intersection::{SegmentSegment, segment_segment_3d};
/// let a = [[0.0, 0.0, 1.0], [2.0, 2.0, 1.0]];
/// assert!(segment_segment_3d(a, [[0.0, 2.0, 1.0], [2.0, 0.0, 1.0]]).is_proper());
/// assert_eq!(segment_segment_3d(a, [[0.0, 2.0, 1.0], [2.0, 0.0, 2.0]]), SegmentSegment::Disjoint);
/// ```
pub fn segment_segment_3d(a: [impl Point<3>; 2], b: [impl Point<3>; 2]) -> SegmentSegment {
    case_3d(a.map(Point::coords), b.map(Point::coords))
}

/// True when two closed segments of space meet: [`segment_segment_3d`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::segments_intersect_3d;
/// assert!(segments_intersect_3d([[0.0; 3], [1.0; 3]], [[0.5, 0.5, 0.5], [5.0, 0.0, 0.0]]));
/// ```
pub fn segments_intersect_3d(a: [impl Point<3>; 2], b: [impl Point<3>; 2]) -> bool {
    segment_segment_3d(a, b) != SegmentSegment::Disjoint
}

/// As [`segment_segment_3d`], checked; arguments are counted `a[0]`, `a[1]`, `b[0]`, `b[1]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_segment_segment_3d;
/// assert!(try_segment_segment_3d([[0.0; 3], [1.0; 3]], [[2.0; 3], [f64::INFINITY; 3]]).is_err());
/// ```
pub fn try_segment_segment_3d(
    a: [impl Point<3>; 2],
    b: [impl Point<3>; 2],
) -> Result<SegmentSegment, NonFinite> {
    let (a, b) = (a.map(Point::coords), b.map(Point::coords));
    check_finite(&[a[0], a[1], b[0], b[1]])?;
    Ok(case_3d(a, b))
}

fn case_2d(a: [P2; 2], b: [P2; 2]) -> SegmentSegment {
    if !all_finite(&[a[0], a[1], b[0], b[1]]) || boxes_disjoint(&a, &b) {
        return SegmentSegment::Disjoint;
    }
    let hulls = [Hull2::of_segment(a), Hull2::of_segment(b)];
    let proper = hulls.map(|hull| hull.is_segment());
    if proper == [true, true] {
        return proper_2d(a, b);
    }
    degenerate(hulls[0].meets(&hulls[1]), proper)
}

fn case_3d(a: [P3; 2], b: [P3; 2]) -> SegmentSegment {
    if !all_finite(&[a[0], a[1], b[0], b[1]]) || boxes_disjoint(&a, &b) {
        return SegmentSegment::Disjoint;
    }
    let hulls = [Hull3::of_segment(a), Hull3::of_segment(b)];
    let proper = hulls.map(|hull| hull.is_segment());
    if proper == [true, true] {
        return proper_3d(a, b);
    }
    degenerate(hulls[0].meets(&hulls[1]), proper)
}

fn degenerate(meets: bool, proper: [bool; 2]) -> SegmentSegment {
    if meets { SegmentSegment::Degenerate { a: !proper[0], b: !proper[1] } } else { SegmentSegment::Disjoint }
}

/// The case of two segments of nonzero length in the plane.
pub(super) fn proper_2d(a: [P2; 2], b: [P2; 2]) -> SegmentSegment {
    let of_b = b.map(|p| orient2d(a[0], a[1], p));
    if of_b[0] * of_b[1] == Sign::Positive {
        return SegmentSegment::Disjoint;
    }
    if of_b == [Sign::Zero; 2] {
        return collinear(a, b);
    }
    let of_a = a.map(|p| orient2d(b[0], b[1], p));
    if of_a[0] * of_a[1] == Sign::Positive {
        return SegmentSegment::Disjoint;
    }
    // The lines cross at one point, and each segment reaches the line of the other there.
    SegmentSegment::Point(Contact::new(SegmentFeature::on_line(of_a), SegmentFeature::on_line(of_b)))
}

/// The case of two segments of nonzero length in space.
pub(super) fn proper_3d(a: [P3; 2], b: [P3; 2]) -> SegmentSegment {
    if !orient3d(a[0], a[1], b[0], b[1]).is_zero() {
        return SegmentSegment::Disjoint;
    }
    // Along such an axis the common plane projects one to one.
    let axis = proper_axis([a[0], a[1], b[0]]).or_else(|| proper_axis([a[0], a[1], b[1]]));
    match axis {
        Some(axis) => proper_2d(a.map(|p| project(p, axis)), b.map(|p| project(p, axis))),
        None => collinear(a, b),
    }
}

/// The case of two segments of nonzero length on one line.
fn collinear<const N: usize>(a: [[f64; N]; 2], b: [[f64; N]; 2]) -> SegmentSegment {
    use SegmentFeature::{Interior, Vertex};
    let forward = a[0] < a[1];
    let mut ends = [None; 2];
    let mut count = 0;
    let mut push = |contact| {
        ends[count] = Some(contact);
        count += 1;
    };
    let find = |p: [f64; N], s: [[f64; N]; 2]| -> Option<SegmentFeature> {
        if p == s[0] {
            Some(Vertex(0))
        } else if p == s[1] {
            Some(Vertex(1))
        } else {
            between(p, s[0], s[1]).then_some(Interior)
        }
    };
    if let Some(at) = find(a[0], b) {
        push(Contact::new(Vertex(0), at));
    }
    let along = if (b[0] < b[1]) == forward { [0, 1] } else { [1, 0] };
    for i in along {
        if find(b[i], a) == Some(Interior) {
            push(Contact::new(Interior, Vertex(i as u8)));
        }
    }
    if let Some(at) = find(a[1], b) {
        push(Contact::new(Vertex(1), at));
    }
    match ends {
        [Some(one), Some(two)] => SegmentSegment::Overlap([one, two]),
        [Some(one), None] => SegmentSegment::Point(one),
        _ => SegmentSegment::Disjoint,
    }
}

impl SegmentFeature {
    /// The feature of a segment at which it meets a line or plane, from the sides of its ends, not both zero.
    pub(super) fn on_line(sides: [Sign; 2]) -> Self {
        if sides[0].is_zero() {
            Self::Vertex(0)
        } else if sides[1].is_zero() {
            Self::Vertex(1)
        } else {
            Self::Interior
        }
    }
}
