//! Segment against segment, in the plane and in space, and segment against triangle.

use super::{Case, expected, on_every_kind, reported};
use proptest::prelude::*;
use rug::Integer;
use welter_kit::exact::{Meeting, lift, meeting};
use welter_predicates::intersection::{
    Contact, SegmentFeature, SegmentSegment, SegmentTriangle, segment_intersects_triangle,
    segment_segment_2d, segment_segment_3d, segment_triangle, segments_intersect_2d, segments_intersect_3d,
};

fn case_of(found: SegmentSegment, coplanar: bool) -> (Case, &'static str) {
    match found {
        SegmentSegment::Disjoint => (Case::Disjoint, "disjoint"),
        SegmentSegment::Degenerate { a, b } => (Case::Degenerate(a, b), "degenerate"),
        SegmentSegment::Point(contact) => {
            (reported(&[contact], coplanar), if found.is_proper() { "proper" } else { "touching" })
        }
        SegmentSegment::Overlap(ends) => (reported(&ends, coplanar), "overlap"),
    }
}

/// True if the corner with the first contact's faces comes strictly before the other along the segment `s`.
pub(super) fn in_order<const D: usize, B: super::Face>(
    found: &Meeting,
    ends: &[Contact<SegmentFeature, B>; 2],
    s: [[f64; D]; 2],
) -> bool {
    let s = lift(&s);
    // Position along s, as numerator and positive denominator.
    let position = |end: &Contact<SegmentFeature, B>| {
        use super::Face;
        let corner = found.corners.iter().find(|c| (c.face_a, c.face_b) == (end.a.bits(), end.b.bits()));
        let point = &corner.expect("the corners are the same").point;
        let along = (0..D).map(|i| Integer::from(&s[1][i] - &s[0][i]) * &point[i]);
        (along.fold(Integer::new(), |sum, term| sum + term), point[D].clone())
    };
    let ((n0, d0), (n1, d1)) = (position(&ends[0]), position(&ends[1]));
    n0 * d1 < n1 * d0
}

const SEGMENT_CASES: [&str; 5] = ["disjoint", "degenerate", "proper", "touching", "overlap"];

#[test]
fn segments_of_the_plane() {
    on_every_kind::<2, 4>(1500, &SEGMENT_CASES, |[a0, a1, b0, b1]| {
        let (a, b) = ([a0, a1], [b0, b1]);
        let (answer, found) = (segment_segment_2d(a, b), meeting(&a, &b));
        let (case, name) = case_of(answer, true);
        prop_assert_eq!(case, expected(&found, &a, &b));
        prop_assert_eq!(segments_intersect_2d(a, b), !found.is_empty());
        if let SegmentSegment::Overlap(ends) = answer {
            prop_assert!(in_order(&found, &ends, a));
        }
        Ok(name)
    });
}

#[test]
fn segments_of_space() {
    on_every_kind::<3, 4>(1500, &SEGMENT_CASES, |[a0, a1, b0, b1]| {
        let (a, b) = ([a0, a1], [b0, b1]);
        let (answer, found) = (segment_segment_3d(a, b), meeting(&a, &b));
        let (case, name) = case_of(answer, true);
        prop_assert_eq!(case, expected(&found, &a, &b));
        prop_assert_eq!(segments_intersect_3d(a, b), !found.is_empty());
        if let SegmentSegment::Overlap(ends) = answer {
            prop_assert!(in_order(&found, &ends, a));
        }
        Ok(name)
    });
}

#[test]
fn segment_and_triangle() {
    let wanted = ["disjoint", "degenerate", "proper", "touching", "coplanar point", "coplanar segment"];
    on_every_kind::<3, 5>(1500, &wanted, |[s0, s1, t0, t1, t2]| {
        let (s, t) = ([s0, s1], [t0, t1, t2]);
        let (answer, found) = (segment_triangle(s, t), meeting(&s, &t));
        let (case, name) = match answer {
            SegmentTriangle::Disjoint => (Case::Disjoint, "disjoint"),
            SegmentTriangle::Degenerate { a, b } => (Case::Degenerate(a, b), "degenerate"),
            SegmentTriangle::Crossing(contact) if answer.is_proper() => {
                (reported(&[contact], false), "proper")
            }
            SegmentTriangle::Crossing(contact) => (reported(&[contact], false), "touching"),
            SegmentTriangle::CoplanarPoint(contact) => (reported(&[contact], true), "coplanar point"),
            SegmentTriangle::CoplanarSegment(ends) => (reported(&ends, true), "coplanar segment"),
        };
        prop_assert_eq!(case, expected(&found, &s, &t));
        prop_assert_eq!(segment_intersects_triangle(s, t), !found.is_empty());
        if let SegmentTriangle::CoplanarSegment(ends) = answer {
            prop_assert!(in_order(&found, &ends, s));
        }
        Ok(name)
    });
}
