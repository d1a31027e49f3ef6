//! Points, segments and triangles against boxes and tetrahedra, by the slow twin.

extern crate std;

use std::vec::Vec;

use super::{Generator, Relation, Row, Sequence, face_pairs, point, rank, solve};
use crate::intersection::*;

const SIDES: [Side; 3] = [Side::Min, Side::Between, Side::Max];

/// Rows that put a combination of generators into the relative interior of a feature of the box.
fn inside_feature(hull: &[Generator], feature: [Side; 3], min: [f64; 3], max: [f64; 3]) -> Vec<Row> {
    let mut rows = Vec::new();
    for k in 0..3 {
        let above: Vec<i128> = hull.iter().map(|p| p[k] - min[k] as i128 * p[3]).collect();
        let below: Vec<i128> = hull.iter().map(|p| max[k] as i128 * p[3] - p[k]).collect();
        match feature[k] {
            Side::Min => rows.push((above, Relation::Zero)),
            Side::Max => rows.push((below, Relation::Zero)),
            Side::Between => {
                rows.push((above, Relation::Above));
                rows.push((below, Relation::Above));
            }
        }
    }
    rows
}

/// Every pair of a face of a hull, as a set of generators, and a feature of a proper box whose relative interiors
/// meet, with whether in one point only.
fn box_pairs(hull: &[Generator], min: [f64; 3], max: [f64; 3]) -> Vec<(usize, BoxFeature, bool)> {
    let mut pairs = Vec::new();
    for face in 1..1usize << hull.len() {
        for code in 0..27 {
            let feature = [SIDES[code % 3], SIDES[code / 3 % 3], SIDES[code / 9]];
            let mut rows = inside_feature(hull, feature, min, max);
            // The box's own inequalities bind as equations or not at all, but the hull's weights count.
            for v in 0..hull.len() {
                let mut row = std::vec![0; hull.len()];
                row[v] = 1;
                let kind = if face >> v & 1 == 1 { Relation::Above } else { Relation::Zero };
                rows.push((row, kind));
            }
            if let Some(dimension) = solve(rows) {
                pairs.push((face, BoxFeature(feature), dimension == 1));
            }
        }
    }
    pairs
}

/// Whether a hull meets a box, flat and empty ones included.
fn meets_box(hull: &[Generator], min: [f64; 3], max: [f64; 3]) -> bool {
    let n = hull.len();
    let mut rows: Vec<Row> = Vec::new();
    for k in 0..3 {
        rows.push((hull.iter().map(|p| p[k] - min[k] as i128 * p[3]).collect(), Relation::AtLeast));
        rows.push((hull.iter().map(|p| max[k] as i128 * p[3] - p[k]).collect(), Relation::AtLeast));
    }
    for v in 0..n {
        rows.push(((0..n).map(|w| i128::from(v == w)).collect(), Relation::AtLeast));
    }
    rows.push((std::vec![1; n], Relation::Above));
    (0..3).all(|k| min[k] <= max[k]) && solve(rows).is_some()
}

/// A box, one in four flat or empty.
fn random_box(random: &mut Sequence, reach: i64, round: i64) -> ([f64; 3], [f64; 3]) {
    let [mut min, mut max]: [[f64; 3]; 2] = random.points(reach);
    for k in 0..3 {
        if min[k] > max[k] && round % 8 != 0 {
            (min[k], max[k]) = (max[k], min[k]);
        }
        if min[k] == max[k] && round % 4 != 0 {
            max[k] += 1.0;
        }
    }
    (min, max)
}

#[test]
fn segment_box_names_the_face_pairs_of_the_slow_twin() {
    let mut random = Sequence(5);
    for round in 0..3000 {
        let reach = 1 + round % 3;
        let s: [[f64; 3]; 2] = random.points(reach + 1);
        let (min, max) = random_box(&mut random, reach, round);
        let hull = s.map(point);
        let case = segment_box(s, min, max);
        let meets = meets_box(&hull, min, max);
        assert_eq!(case != SegmentBox::Disjoint, meets, "{s:?} {min:?} {max:?} {case:?}");
        assert_eq!(segment_intersects_box(s, min, max), meets);
        assert_eq!(point_in_box(s[0], min, max) != PointBox::Disjoint, meets_box(&hull[..1], min, max));
        let ends: Vec<_> = match case {
            SegmentBox::Disjoint => continue,
            SegmentBox::Degenerate { a, b } => {
                assert_eq!((a, b), (s[0] == s[1], (0..3).any(|k| min[k] == max[k])));
                continue;
            }
            SegmentBox::Point(c) => [c].into(),
            SegmentBox::Overlap(ends) => ends.into(),
        };
        let mut found: Vec<_> = ends
            .iter()
            .map(|c| match c.a {
                SegmentFeature::Vertex(i) => (1 << i, c.b),
                SegmentFeature::Interior => (3, c.b),
            })
            .collect();
        found.sort();
        let mut wanted: Vec<_> =
            box_pairs(&hull, min, max).iter().filter(|p| p.2).map(|p| (p.0, p.1)).collect();
        wanted.sort();
        assert_eq!(found, wanted, "{s:?} {min:?} {max:?} {case:?}");
        for end in ends {
            if let SegmentFeature::Vertex(i) = end.a {
                assert_eq!(point_in_box(s[usize::from(i)], min, max), PointBox::On(end.b));
            }
        }
    }
}

#[test]
fn triangle_box_agrees_with_the_slow_twin() {
    let mut random = Sequence(6);
    let mut seen = [0; 5];
    for round in 0..5000 {
        let reach = 1 + round % 3;
        let t: [[f64; 3]; 3] = random.points(reach + 2);
        let (mut min, mut max) = random_box(&mut random, reach, round);
        if round % 5 == 1 {
            // Large boxes, that hold triangles.
            min = min.map(|x| x - 2.0);
            max = max.map(|x| x + 2.0);
        }
        let hull = t.map(point);
        let meets = meets_box(&hull, min, max);
        let case = triangle_box(t, min, max);
        assert_eq!(triangle_intersects_box(t, min, max), meets, "{t:?} {min:?} {max:?}");
        assert_eq!(case != TriangleBox::Disjoint, meets, "{t:?} {min:?} {max:?} {case:?}");
        let outside = t.iter().any(|p| (0..3).any(|k| p[k] < min[k] || p[k] > max[k]));
        let index = match case {
            TriangleBox::Disjoint => 0,
            TriangleBox::Degenerate { a, b } => {
                assert_eq!((a, b), (rank(&hull) < 3, (0..3).any(|k| min[k] == max[k])));
                1
            }
            TriangleBox::Touching(c) => {
                let pairs = box_pairs(&hull, min, max);
                let vertices = pairs.iter().fold(0, |set, pair| set | pair.0);
                let mask = match c.a {
                    TriangleFeature::Vertex(i) => 1 << i,
                    TriangleFeature::Edge(i) => 1 << i | 1 << ((i + 1) % 3),
                    TriangleFeature::Interior => 7,
                };
                assert_eq!(mask, vertices, "{t:?} {min:?} {max:?} {case:?}");
                let feature = pairs.iter().map(|pair| pair.1).reduce(BoxFeature::join);
                assert_eq!(Some(c.b), feature, "{t:?} {min:?} {max:?} {case:?}");
                assert!(c.b.dimension() < 3);
                2
            }
            TriangleBox::Crossing | TriangleBox::Inside => {
                let pairs = box_pairs(&hull, min, max);
                assert!(pairs.iter().any(|pair| pair.1.dimension() == 3), "{t:?} {min:?} {max:?} {case:?}");
                assert_eq!(case == TriangleBox::Inside, !outside);
                3 + usize::from(outside)
            }
        };
        seen[index] += 1;
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

#[test]
fn points_in_triangles_and_tetrahedra_agree_with_the_slow_twin() {
    let mut random = Sequence(7);
    for round in 0..3000 {
        let reach = 1 + round % 3;
        let [p]: [[f64; 3]; 1] = random.points(reach);
        let mut v: [[f64; 3]; 4] = random.points(reach);
        if round % 4 == 0 {
            v.iter_mut().for_each(|q| q[0] = p[0]);
        }
        let hull = v.map(point);
        let faces = |hull: &[Generator]| -> Vec<usize> {
            face_pairs(hull, &[point(p)]).iter().map(|pair| pair.0).collect()
        };
        let around = faces(&hull);
        let case = point_in_tetrahedron(p, v);
        assert_eq!(tetrahedron_contains(v, p), !around.is_empty());
        match case {
            PointTetrahedron::Disjoint => assert!(around.is_empty(), "{p:?} {v:?}"),
            PointTetrahedron::Degenerate => assert!(rank(&hull) < 4 && !around.is_empty(), "{p:?} {v:?}"),
            PointTetrahedron::On(feature) => {
                let mask = match feature {
                    TetrahedronFeature::Vertex(i) => 1 << i,
                    TetrahedronFeature::Edge(i, j) => 1 << i | 1 << j,
                    TetrahedronFeature::Face(i) => 15 - (1 << i),
                    TetrahedronFeature::Interior => 15,
                };
                assert_eq!(around, [mask], "{p:?} {v:?}");
            }
        }
        let t = [v[0], v[1], v[2]];
        let around = faces(&hull[..3]);
        let case = point_in_triangle_3d(p, t);
        assert_eq!(triangle_contains_3d(t, p), !around.is_empty());
        match case {
            PointTriangle::Disjoint => assert!(around.is_empty(), "{p:?} {t:?}"),
            PointTriangle::Degenerate => assert!(rank(&hull[..3]) < 3 && !around.is_empty(), "{p:?} {t:?}"),
            PointTriangle::On(feature) => {
                let mask = match feature {
                    TriangleFeature::Vertex(i) => 1 << i,
                    TriangleFeature::Edge(i) => 1 << i | 1 << ((i + 1) % 3),
                    TriangleFeature::Interior => 7,
                };
                assert_eq!(around, [mask], "{p:?} {t:?}");
            }
        }
        if round % 4 == 0 {
            let flat = |q: [f64; 3]| [q[1], q[2]];
            assert_eq!(point_in_triangle_2d(flat(p), t.map(flat)), case);
            assert_eq!(triangle_contains_2d(t.map(flat), flat(p)), case != PointTriangle::Disjoint);
        }
    }
}
