//! Point in triangle (plane and space) and in tetrahedron.

use super::{Case, Face, dimension, expected, on_every_kind};
use proptest::prelude::*;
use welter_kit::exact::meeting;
use welter_predicates::intersection::{
    PointTetrahedron, PointTriangle, TetrahedronFeature, point_in_tetrahedron, point_in_triangle_2d,
    point_in_triangle_3d, tetrahedron_contains, triangle_contains_2d, triangle_contains_3d,
};

impl Face for TetrahedronFeature {
    fn bits(self) -> u32 {
        match self {
            Self::Vertex(i) => 1 << i,
            Self::Edge(i, j) => 1 << i | 1 << j,
            Self::Face(i) => 0b1111 & !(1 << i),
            Self::Interior => 0b1111,
        }
    }
}

/// The case of a point on this face of the other operand, whose dimension says whether all is coplanar.
fn on(face: impl Face, coplanar: bool) -> Case {
    Case::Meeting { corners: vec![(1, face.bits())], coplanar }
}

fn case_of(found: PointTriangle) -> (Case, &'static str) {
    use welter_predicates::intersection::TriangleFeature::{Edge, Interior, Vertex};
    match found {
        PointTriangle::Disjoint => (Case::Disjoint, "disjoint"),
        PointTriangle::Degenerate => (Case::Degenerate(false, true), "degenerate"),
        PointTriangle::On(face) => {
            let name = match face {
                Vertex(_) => "vertex",
                Edge(_) => "edge",
                Interior => "interior",
            };
            (on(face, true), name)
        }
    }
}

const WANTED: [&str; 5] = ["disjoint", "degenerate", "vertex", "edge", "interior"];

#[test]
fn point_in_triangle_of_the_plane() {
    on_every_kind::<2, 4>(1500, &WANTED, |[t0, t1, t2, p]| {
        let t = [t0, t1, t2];
        let found = meeting(&[p], &t);
        let (case, name) = case_of(point_in_triangle_2d(p, t));
        prop_assert_eq!(case, expected(&found, &[p], &t));
        prop_assert_eq!(triangle_contains_2d(t, p), !found.is_empty());
        Ok(name)
    });
}

#[test]
fn point_in_triangle_of_space() {
    on_every_kind::<3, 4>(1500, &WANTED, |[t0, t1, t2, p]| {
        let t = [t0, t1, t2];
        let found = meeting(&[p], &t);
        let (case, name) = case_of(point_in_triangle_3d(p, t));
        prop_assert_eq!(case, expected(&found, &[p], &t));
        prop_assert_eq!(triangle_contains_3d(t, p), !found.is_empty());
        Ok(name)
    });
}

#[test]
fn point_in_a_tetrahedron() {
    let wanted = ["disjoint", "degenerate", "vertex", "edge", "face", "interior"];
    on_every_kind::<3, 5>(1500, &wanted, |[v0, v1, v2, v3, p]| {
        let v = [v0, v1, v2, v3];
        let found = meeting(&[p], &v);
        let (case, name) = match point_in_tetrahedron(p, v) {
            PointTetrahedron::Disjoint => (Case::Disjoint, "disjoint"),
            PointTetrahedron::Degenerate => (Case::Degenerate(false, true), "degenerate"),
            PointTetrahedron::On(face) => {
                let name = match face {
                    TetrahedronFeature::Vertex(_) => "vertex",
                    TetrahedronFeature::Edge(i, j) => {
                        prop_assert!(i < j);
                        "edge"
                    }
                    TetrahedronFeature::Face(_) => "face",
                    TetrahedronFeature::Interior => "interior",
                };
                (on(face, dimension(&v) <= 2), name)
            }
        };
        prop_assert_eq!(case, expected(&found, &[p], &v));
        prop_assert_eq!(tetrahedron_contains(v, p), !found.is_empty());
        Ok(name)
    });
}
