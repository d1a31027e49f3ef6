//! What a case does under changes of the operands: affine maps, exchange of operands, renumbering of vertices.

extern crate std;

use std::vec::Vec;

use super::Sequence;
use crate::intersection::*;
use crate::{Point, Sign};

type Map = fn([f64; 3]) -> [f64; 3];

const TINY: f64 = f64::from_bits(1);
/// 2^1020: integers up to 8 scale to finite numbers, their differences too.
const HUGE: f64 = f64::from_bits((1023 + 1020) << 52);

/// Maps that act exactly on small integers, with the sign of their determinant.
const AFFINE: [(Map, Sign); 8] = [
    (|[x, y, z]| [y, z, x], Sign::Positive),
    (|[x, y, z]| [y, x, z], Sign::Negative),
    (|[x, y, z]| [-x, -y, -z], Sign::Negative),
    (|p| p.map(|x| x * TINY), Sign::Positive),
    (|p| p.map(|x| x * HUGE), Sign::Positive),
    (|[x, y, z]| [x * TINY, y, z * HUGE], Sign::Positive),
    (|[x, y, z]| [(x + 2.0 * y - z) * TINY, (y + 3.0 * z) * TINY, (z - x) * TINY], Sign::Negative),
    (|[x, y, z]| [x + 2f64.powi(50), y - 2f64.powi(40), z * HUGE], Sign::Positive),
];

#[test]
fn affine_maps_keep_every_case_of_hulls() {
    let mut random = Sequence(11);
    for round in 0..700 {
        let mut points: [[f64; 3]; 6] = random.points(1 + round % 3);
        if round % 3 == 0 {
            points.iter_mut().for_each(|p| p[2] = p[0] - p[1]);
        }
        for (map, handedness) in AFFINE {
            let [a, b, c, d, e, f] = points;
            let [ma, mb, mc, md, me, mf] = points.map(map);
            assert_eq!(
                triangle_triangle([ma, mb, mc], [md, me, mf]),
                triangle_triangle([a, b, c], [d, e, f])
            );
            assert_eq!(
                triangles_intersect([ma, mb, mc], [md, me, mf]),
                triangle_triangle([a, b, c], [d, e, f]) != TriangleTriangle::Disjoint
            );
            assert_eq!(segment_triangle([ma, mb], [md, me, mf]), segment_triangle([a, b], [d, e, f]));
            assert_eq!(segment_segment_3d([ma, mb], [md, me]), segment_segment_3d([a, b], [d, e]));
            assert_eq!(point_in_triangle_3d(ma, [md, me, mf]), point_in_triangle_3d(a, [d, e, f]));
            assert_eq!(point_in_tetrahedron(ma, [mb, mc, md, me]), point_in_tetrahedron(a, [b, c, d, e]));
            let turned = |case| match case {
                RayTriangle::Crossing { at, direction } => {
                    RayTriangle::Crossing { at, direction: direction * handedness }
                }
                other => other,
            };
            assert_eq!(ray_triangle(ma, mb, [md, me, mf]), turned(ray_triangle(a, b, [d, e, f])));
        }
    }
}

/// The vector forms of a ray scale with the vector alone, and agree with a ray along an axis.
#[test]
fn ray_directions_scale_and_keep_extreme_exponents() {
    let mut random = Sequence(12);
    for round in 0..1200 {
        let [o, d, a, b, c]: [[f64; 3]; 5] = random.points(1 + round % 3);
        let case = ray_triangle_direction(o, d, [a, b, c]);
        for (map, _) in &AFFINE[3..6] {
            let t = [a, b, c].map(map);
            assert_eq!(ray_triangle_direction(map(o), map(d), t), case);
        }
        for scale in [TINY, HUGE] {
            assert_eq!(ray_triangle_direction(o, d.map(|x| x * scale), [a, b, c]), case);
        }
    }
}

#[test]
fn scaling_and_turning_keep_every_case_of_boxes() {
    let mut random = Sequence(13);
    for round in 0..700 {
        let [a, b, c, p, q]: [[f64; 3]; 5] = random.points(1 + round % 3);
        let min: [f64; 3] = core::array::from_fn(|k| p[k].min(q[k]));
        let max: [f64; 3] = core::array::from_fn(|k| p[k].max(q[k]));
        let segment = segment_box([a, b], min, max);
        let triangle = triangle_box([a, b, c], min, max);
        for (map, _) in &AFFINE[3..6] {
            let (low, high) = (map(min), map(max));
            assert_eq!(segment_box([map(a), map(b)], low, high), segment);
            assert_eq!(triangle_box([map(a), map(b), map(c)], low, high), triangle);
            assert_eq!(point_in_box(map(a), low, high), point_in_box(a, min, max));
        }
        let turn = |[x, y, z]: [f64; 3]| [y, z, x];
        let turned = triangle_box([a, b, c].map(turn), turn(min), turn(max));
        match (triangle, turned) {
            (TriangleBox::Touching(one), TriangleBox::Touching(two)) => {
                let [x, y, z] = one.b.0;
                assert_eq!((two.a, two.b), (one.a, BoxFeature([y, z, x])));
            }
            _ => assert_eq!(triangle, turned),
        }
        // Mirrored: least and greatest change places.
        let mirror = |p: [f64; 3]| p.map(|x| -x);
        let mirrored = segment_box([mirror(a), mirror(b)], mirror(max), mirror(min));
        let flip = |c: Contact<SegmentFeature, BoxFeature>| {
            let sides = c.b.0.map(|side| match side {
                Side::Min => Side::Max,
                Side::Between => Side::Between,
                Side::Max => Side::Min,
            });
            Contact { a: c.a, b: BoxFeature(sides) }
        };
        let expected = match segment {
            SegmentBox::Point(c) => SegmentBox::Point(flip(c)),
            SegmentBox::Overlap(ends) => SegmentBox::Overlap(ends.map(flip)),
            other => other,
        };
        assert_eq!(mirrored, expected);
    }
}

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// The feature of the original triangle that a feature of the renumbered one is.
fn original(feature: TriangleFeature, order: [usize; 3]) -> TriangleFeature {
    let vertex = |i: u8| TriangleFeature::Vertex(order[usize::from(i)] as u8);
    match feature {
        TriangleFeature::Vertex(i) => vertex(i),
        TriangleFeature::Edge(i) => vertex(i).join(vertex((i + 1) % 3)),
        TriangleFeature::Interior => TriangleFeature::Interior,
    }
}

fn sorted<T: Ord>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut items: Vec<T> = items.collect();
    items.sort();
    items
}

#[test]
fn renumbering_vertices_renumbers_features() {
    let mut random = Sequence(14);
    for round in 0..500 {
        let mut points: [[f64; 3]; 6] = random.points(1 + round % 3);
        if round % 2 == 0 {
            points.iter_mut().for_each(|p| p[1] = 0.0);
        }
        let [a, b] = [[points[0], points[1], points[2]], [points[3], points[4], points[5]]];
        let case = triangle_triangle(a, b);
        let contacts = sorted(case.contacts().iter().copied());
        let swapped = triangle_triangle(b, a);
        assert_eq!(sorted(swapped.contacts().iter().map(|c| c.swapped())), contacts);
        assert_eq!(triangles_intersect(b, a), case != TriangleTriangle::Disjoint);
        let stab = segment_triangle([a[0], a[1]], b);
        for order in ORDERS {
            let renumbered = triangle_triangle(order.map(|i| a[i]), b);
            assert_eq!(core::mem::discriminant(&renumbered), core::mem::discriminant(&case));
            let renamed = |c: &TriangleContact| Contact { a: original(c.a, order), b: c.b };
            assert_eq!(sorted(renumbered.contacts().iter().map(renamed)), contacts, "{a:?} {b:?} {order:?}");
            for other in ORDERS {
                assert_eq!(
                    triangles_intersect(order.map(|i| a[i]), other.map(|i| b[i])),
                    case != TriangleTriangle::Disjoint
                );
            }
            let renamed = |c: Contact<_, _>| Contact { a: c.a, b: original(c.b, order) };
            let expected = match segment_triangle([a[0], a[1]], order.map(|i| b[i])) {
                SegmentTriangle::Crossing(c) => SegmentTriangle::Crossing(renamed(c)),
                SegmentTriangle::CoplanarPoint(c) => SegmentTriangle::CoplanarPoint(renamed(c)),
                SegmentTriangle::CoplanarSegment(ends) => SegmentTriangle::CoplanarSegment(ends.map(renamed)),
                other => other,
            };
            assert_eq!(expected, stab, "the ends stay in the direction of the segment");
        }
    }
}

#[test]
fn reversing_a_segment_reverses_its_ends() {
    let reversed = |at| match at {
        SegmentFeature::Vertex(i) => SegmentFeature::Vertex(1 - i),
        SegmentFeature::Interior => SegmentFeature::Interior,
    };
    let mut random = Sequence(15);
    for round in 0..1200 {
        let [a, b, c, d]: [[f64; 2]; 4] = random.points(1 + round % 4);
        let case = segment_segment_2d([a, b], [c, d]);
        let first = |c: Contact<_, _>| Contact { a: reversed(c.a), b: c.b };
        let expected = match segment_segment_2d([b, a], [c, d]) {
            SegmentSegment::Point(c) => SegmentSegment::Point(first(c)),
            SegmentSegment::Overlap([one, two]) => SegmentSegment::Overlap([first(two), first(one)]),
            other => other,
        };
        assert_eq!(case, expected);
        let second = |c: Contact<_, _>| Contact { a: c.a, b: reversed(c.b) };
        let expected = match segment_segment_2d([a, b], [d, c]) {
            SegmentSegment::Point(c) => SegmentSegment::Point(second(c)),
            SegmentSegment::Overlap(ends) => SegmentSegment::Overlap(ends.map(second)),
            other => other,
        };
        assert_eq!(case, expected);
    }
}

/// Each function on operands of which one coordinate is not finite.
#[test]
fn non_finite_coordinates_are_disjoint_or_an_error() {
    let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let flat = |p: [f64; 3]| [p[0], p[1]];
    let far = [[0.25, 0.25, 0.0], [0.25, 0.25, 1.0], [0.0, 0.0, 1.0]];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..9 {
            let mut u = far;
            u[place / 3][place % 3] = bad;
            let expected = crate::NonFinite { argument: place / 3, coordinate: place % 3, value: bad };
            assert!(!triangles_intersect(u, t) && !triangles_intersect(t, u));
            assert_eq!(triangle_triangle(u, t), TriangleTriangle::Disjoint);
            assert_eq!(try_triangle_triangle(u, t), Err(expected));
            assert_eq!(triangle_box(u, [0.0; 3], [1.0; 3]), TriangleBox::Disjoint);
            assert!(!triangle_intersects_box(u, [0.0; 3], [1.0; 3]));
            assert_eq!(try_triangle_box(u, [0.0; 3], [1.0; 3]), Err(expected));
            let after = |shift| crate::NonFinite { argument: expected.argument + shift, ..expected };
            assert_eq!(ray_triangle([0.25, 0.25, -1.0], [0.25, 0.25, 0.0], u), RayTriangle::Disjoint);
            assert_eq!(ray_triangle_axis([0.25, 0.25, -1.0], 2, true, u), RayTriangle::Disjoint);
            assert_eq!(try_ray_triangle([0.25, 0.25, -1.0], t[0], u), Err(after(2)));
            assert_eq!(try_ray_triangle_direction([0.25, 0.25, -1.0], [0.0, 0.0, 1.0], u), Err(after(2)));
            assert_eq!(segment_triangle([t[0], t[1]], u), SegmentTriangle::Disjoint);
            assert_eq!(try_segment_triangle([t[0], t[1]], u), Err(after(2)));
            assert_eq!(point_in_triangle_3d(t[0], u), PointTriangle::Disjoint);
            assert_eq!(try_point_in_triangle_3d(t[0], u), Err(after(1)));
            assert_eq!(point_in_tetrahedron(t[0], [u[0], u[1], u[2], t[1]]), PointTetrahedron::Disjoint);
            assert_eq!(try_point_in_tetrahedron(t[0], [u[0], u[1], u[2], t[1]]), Err(after(1)));
            if place < 6 {
                let s = [u[0], u[1]];
                assert_eq!(segment_segment_3d(s, [t[0], t[1]]), SegmentSegment::Disjoint);
                assert_eq!(try_segment_segment_3d(s, [t[0], t[1]]), Err(expected));
                assert_eq!(segment_box(s, [0.0; 3], [1.0; 3]), SegmentBox::Disjoint);
                assert!(!segment_intersects_box(s, [0.0; 3], [1.0; 3]));
                assert_eq!(try_segment_box(s, [0.0; 3], [1.0; 3]), Err(expected));
                if place % 3 < 2 {
                    let s = s.map(flat);
                    assert_eq!(segment_segment_2d(s, [[0.0, 0.0], [1.0, 1.0]]), SegmentSegment::Disjoint);
                    assert_eq!(try_segment_segment_2d(s, [[0.0, 0.0], [1.0, 1.0]]), Err(expected));
                    assert_eq!(point_in_triangle_2d(s[place / 3], t.map(flat)), PointTriangle::Disjoint);
                    assert!(try_point_in_triangle_2d(s[place / 3], t.map(flat)).is_err());
                }
            }
            if place < 3 {
                assert_eq!(point_in_box(u[0], [0.0; 3], [1.0; 3]), PointBox::Disjoint);
                assert_eq!(try_point_in_box(u[0], [0.0; 3], [1.0; 3]), Err(expected));
            }
        }
    }
}

/// Whatever the other coordinates are, one that is not finite makes the operands disjoint.
#[test]
fn no_case_comes_of_a_coordinate_that_is_not_finite() {
    let mut random = Sequence(16);
    for round in 0..20000 {
        let mut points: [[f64; 3]; 6] = random.points(1 + round % 2);
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.next() as usize % 3];
        let at = random.next() as usize;
        points[at % 3][at / 3 % 3] = bad;
        let [a, b, c, d, e, f] = points;
        assert!(!triangles_intersect([a, b, c], [d, e, f]), "{points:?}");
        assert!(!triangles_intersect([d, e, f], [a, b, c]), "{points:?}");
        assert_eq!(triangle_triangle([a, b, c], [d, e, f]), TriangleTriangle::Disjoint);
        assert!(!segment_intersects_triangle([d, e], [a, b, c]));
        assert!(!segments_intersect_3d([points[at % 3], d], [e, f]));
        assert!(!ray_intersects_triangle(points[at % 3], d, [d, e, f]));
        assert_eq!(ray_triangle_direction(d, points[at % 3], [d, e, f]), RayTriangle::Disjoint);
        assert_eq!(ray_triangle_axis(d, at % 3, at.is_multiple_of(2), [a, b, c]), RayTriangle::Disjoint);
        assert!(!triangle_intersects_box([a, b, c], [-2.0; 3], [2.0; 3]));
        assert!(!triangle_intersects_box([d, e, f], [-2.0; 3], points[at % 3]));
        assert!(!segment_intersects_box([points[at % 3], d], [-2.0; 3], [2.0; 3]));
        assert!(!triangle_contains_3d([a, b, c], d));
        assert!(!tetrahedron_contains([a, b, c, d], e));
    }
}

/// Single precision lifts: the same case as its double.
#[test]
fn single_precision_is_accepted() {
    let t = [[0.1f32, 0.2, 0.3], [1.1, 0.2, 0.3], [0.1, 1.2, 0.3]];
    let s = [[0.25f32, 0.35, -1.0], [0.25, 0.35, 1.0]];
    assert_eq!(segment_triangle(s, t), segment_triangle(s.map(Point::coords), t.map(Point::coords)));
    assert!(segment_triangle(s, t).is_proper());
}
