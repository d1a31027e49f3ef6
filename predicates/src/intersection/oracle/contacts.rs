//! Cases of two hulls against the face pairs of the slow twin.

extern crate std;

use std::vec::Vec;

use super::{Generator, Sequence, face_pairs, point, rank};
use crate::intersection::*;

fn triangle_mask(feature: TriangleFeature) -> usize {
    match feature {
        TriangleFeature::Vertex(i) => 1 << i,
        TriangleFeature::Edge(i) => 1 << i | 1 << ((i + 1) % 3),
        TriangleFeature::Interior => 7,
    }
}

fn segment_mask(feature: SegmentFeature) -> usize {
    match feature {
        SegmentFeature::Vertex(i) => 1 << i,
        SegmentFeature::Interior => 3,
    }
}

fn single(pairs: &[(usize, usize, bool)]) -> Vec<(usize, usize)> {
    pairs.iter().filter(|pair| pair.2).map(|pair| (pair.0, pair.1)).collect()
}

fn sorted(mut pairs: Vec<(usize, usize)>) -> Vec<(usize, usize)> {
    pairs.sort_unstable();
    pairs
}

fn generators<const P: usize>(points: [[f64; 3]; P]) -> [Generator; P] {
    points.map(point)
}

#[test]
fn triangle_triangle_names_the_face_pairs_of_the_slow_twin() {
    let mut random = Sequence(1);
    for round in 0..3000 {
        let reach = 1 + round % 3;
        let mut a: [[f64; 3]; 3] = random.points(reach);
        let mut b: [[f64; 3]; 3] = random.points(reach);
        if round % 4 == 0 {
            a.iter_mut().chain(&mut b).for_each(|p| p[2] = 0.0);
        }
        if round % 5 == 0 {
            b[0] = a[1];
        }
        let pairs = face_pairs(&generators(a), &generators(b));
        let case = triangle_triangle(a, b);
        assert_eq!(triangles_intersect(a, b), !pairs.is_empty(), "{a:?} {b:?}");
        assert_eq!(case != TriangleTriangle::Disjoint, !pairs.is_empty(), "{a:?} {b:?} {case:?}");
        if pairs.is_empty() {
            continue;
        }
        let proper = [rank(&generators(a)) == 3, rank(&generators(b)) == 3];
        if proper != [true, true] {
            assert_eq!(case, TriangleTriangle::Degenerate { a: !proper[0], b: !proper[1] });
            continue;
        }
        let found = case.contacts().iter().map(|c| (triangle_mask(c.a), triangle_mask(c.b))).collect();
        assert_eq!(sorted(found), sorted(single(&pairs)), "{a:?} {b:?} {case:?}");
        let coplanar = rank(&generators([a[0], a[1], a[2], b[0], b[1], b[2]])) == 3;
        let named_coplanar = matches!(
            case,
            TriangleTriangle::CoplanarPoint(_)
                | TriangleTriangle::CoplanarSegment(_)
                | TriangleTriangle::CoplanarArea(_)
        );
        assert_eq!(named_coplanar, coplanar, "{a:?} {b:?} {case:?}");
    }
}

#[test]
fn segment_triangle_names_the_face_pairs_of_the_slow_twin() {
    let mut random = Sequence(2);
    for round in 0..3000 {
        let reach = 1 + round % 3;
        let mut s: [[f64; 3]; 2] = random.points(reach);
        let mut t: [[f64; 3]; 3] = random.points(reach);
        if round % 3 == 0 {
            s.iter_mut().chain(&mut t).for_each(|p| p[1] = 1.0);
        }
        let pairs = face_pairs(&generators(s), &generators(t));
        let case = segment_triangle(s, t);
        assert_eq!(segment_intersects_triangle(s, t), !pairs.is_empty(), "{s:?} {t:?} {case:?}");
        if pairs.is_empty() {
            continue;
        }
        let proper = [s[0] != s[1], rank(&generators(t)) == 3];
        let coplanar = rank(&generators([s[0], s[1], t[0], t[1], t[2]])) == 3;
        let ends: Vec<_> = match case {
            SegmentTriangle::Degenerate { a, b } => {
                assert_eq!([a, b], proper.map(|p| !p));
                continue;
            }
            SegmentTriangle::Crossing(c) if !coplanar => [c].into(),
            SegmentTriangle::CoplanarPoint(c) if coplanar => [c].into(),
            SegmentTriangle::CoplanarSegment(ends) if coplanar => ends.into(),
            _ => panic!("{s:?} {t:?} {case:?} is of the wrong kind"),
        };
        assert_eq!(proper, [true, true]);
        let found = ends.iter().map(|c| (segment_mask(c.a), triangle_mask(c.b))).collect();
        assert_eq!(sorted(found), sorted(single(&pairs)), "{s:?} {t:?} {case:?}");
    }
}

#[test]
fn segment_segment_names_the_face_pairs_of_the_slow_twin() {
    let mut random = Sequence(3);
    for round in 0..4000 {
        let reach = 1 + round % 4;
        let mut a: [[f64; 3]; 2] = random.points(reach);
        let mut b: [[f64; 3]; 2] = random.points(reach);
        let planar = round % 2 == 0;
        if planar {
            a.iter_mut().chain(&mut b).for_each(|p| p[2] = 0.0);
        }
        let pairs = face_pairs(&generators(a), &generators(b));
        let case = segment_segment_3d(a, b);
        assert_eq!(segments_intersect_3d(a, b), !pairs.is_empty(), "{a:?} {b:?} {case:?}");
        if planar {
            let flat = |s: [[f64; 3]; 2]| s.map(|p| [p[0], p[1]]);
            assert_eq!(segment_segment_2d(flat(a), flat(b)), case);
        }
        let ends: Vec<_> = match case {
            SegmentSegment::Disjoint => continue,
            SegmentSegment::Degenerate { a: first, b: second } => {
                assert_eq!([first, second], [a[0] == a[1], b[0] == b[1]]);
                continue;
            }
            SegmentSegment::Point(c) => [c].into(),
            SegmentSegment::Overlap(ends) => ends.into(),
        };
        let found = ends.iter().map(|c| (segment_mask(c.a), segment_mask(c.b))).collect();
        assert_eq!(sorted(found), sorted(single(&pairs)), "{a:?} {b:?} {case:?}");
    }
}

#[test]
fn ray_triangle_names_the_face_pairs_of_the_slow_twin() {
    let mut random = Sequence(4);
    for round in 0..4000 {
        let reach = 1 + round % 3;
        let mut o: [f64; 3] = random.points::<3, 1>(reach)[0];
        let mut d: [f64; 3] = random.points::<3, 1>(reach)[0];
        let mut t: [[f64; 3]; 3] = random.points(reach);
        if round % 3 == 0 {
            t.iter_mut().for_each(|p| p[0] = 1.0);
            (o[0], d[0]) = (1.0, 0.0);
        }
        if round % 4 == 0 {
            d = core::array::from_fn(|k| if k == (round / 4) as usize % 3 { d[k] } else { 0.0 });
        }
        let direction: Generator = [d[0] as i128, d[1] as i128, d[2] as i128, 0];
        let pairs: Vec<_> = face_pairs(&[point(o), direction], &generators(t))
            .into_iter()
            .filter(|pair| pair.0 & 1 == 1)
            .collect();
        let case = ray_triangle_direction(o, d, t);
        let through: [f64; 3] = core::array::from_fn(|k| o[k] + d[k]);
        assert_eq!(ray_triangle(o, through, t), case, "{o:?} {d:?} {t:?}");
        if let [axis] = (0..3).filter(|&k| d[k] != 0.0).collect::<Vec<_>>()[..] {
            assert_eq!(ray_triangle_axis(o, axis, d[axis] > 0.0, t), case, "{o:?} {d:?} {t:?}");
        }
        assert_eq!(case != RayTriangle::Disjoint, !pairs.is_empty(), "{o:?} {d:?} {t:?} {case:?}");
        let proper = [d != [0.0; 3], rank(&generators(t)) == 3];
        let coplanar = rank(&[point(o), direction, point(t[0]), point(t[1]), point(t[2])]) == 3;
        let ends: Vec<_> = match case {
            RayTriangle::Disjoint => continue,
            RayTriangle::Degenerate { a, b } => {
                assert_eq!([a, b], proper.map(|p| !p));
                continue;
            }
            RayTriangle::Crossing { at, direction } if !coplanar => {
                let edge = |i: usize| -> [f64; 3] { core::array::from_fn(|k| t[i][k] - t[0][k]) };
                let (u, v) = (edge(1), edge(2));
                let n: [f64; 3] = core::array::from_fn(|k| {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    u[i] * v[j] - u[j] * v[i]
                });
                let slope = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
                assert_eq!(direction, crate::Sign::of(slope));
                [at].into()
            }
            RayTriangle::CoplanarPoint(c) if coplanar => [c].into(),
            RayTriangle::CoplanarSegment(ends) if coplanar => ends.into(),
            _ => panic!("{o:?} {d:?} {t:?} {case:?} is of the wrong kind"),
        };
        let mask = |a| if a == RayFeature::Origin { 1 } else { 3 };
        let found = ends.iter().map(|c| (mask(c.a), triangle_mask(c.b))).collect();
        assert_eq!(sorted(found), sorted(single(&pairs)), "{o:?} {d:?} {t:?} {case:?}");
    }
}
