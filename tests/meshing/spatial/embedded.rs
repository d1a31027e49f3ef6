//! `EmbeddedMesh`: accepted shapes, refused shapes, and what the refusal lists.

use std::sync::atomic::AtomicBool;
use welter_meshing::shapes::{self, BoxPair, Sphere};
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::{EmbeddedError, EmbeddedMesh, TriId};
use welter_meshing::{Cancelled, Monitor};

#[test]
fn embedded_shapes_are_accepted() {
    for name in ["sphere", "torus", "box", "dumbbell", "nested-boxes"] {
        let mesh = shapes::by_name(name, Some(0.3)).unwrap();
        let embedded = EmbeddedMesh::new(mesh.clone()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(embedded.as_closed_oriented(), &mesh);
        assert_eq!(embedded.into_closed_oriented(), mesh);
    }
}

#[test]
fn shapes_that_intersect_are_refused_with_all_pairs() {
    for name in
        ["two-boxes", "coincident-boxes", "ring-overlap", "helix-overlap", "trefoil-overlap", "figure-eight"]
    {
        let mesh = shapes::by_name(name, Some(0.3)).unwrap();
        let pairs = self_intersections(&mesh, &Monitor::none()).unwrap();
        let Err(EmbeddedError::SelfIntersections(found)) = EmbeddedMesh::new(mesh) else { panic!("{name}") };
        assert_eq!(found.pairs, pairs, "{name}");
        assert!(!found.pairs.is_empty());
        let message = found.to_string();
        assert!(
            message.starts_with(&format!("{} pairs of intersecting triangles: ", pairs.len())),
            "{message}"
        );
    }
}

#[test]
fn touching_is_refused() {
    // Two unit boxes with one corner in common, at vertices of different index.
    let mesh = shapes::two_boxes(&BoxPair {
        first: [glam::DVec3::ZERO, glam::DVec3::ONE],
        second: [glam::DVec3::ONE, glam::DVec3::splat(2.0)],
        second_reversed: false,
        edge_length: 1.0,
    });
    let Err(EmbeddedError::SelfIntersections(found)) = EmbeddedMesh::new(mesh.unwrap()) else {
        panic!("they touch")
    };
    assert!(found.pairs.iter().all(|[i, j]| *i < TriId(12) && *j >= TriId(12)), "{found:?}");
}

#[test]
fn a_cancelled_proof_is_no_proof() {
    let stop = AtomicBool::new(true);
    let mesh = shapes::sphere(&Sphere { edge_length: 0.5, ..Sphere::default() }).unwrap();
    let found = EmbeddedMesh::check(&mesh, &Monitor::new(None, Some(&stop)));
    assert_eq!(found, Err(EmbeddedError::Cancelled(Cancelled)));
}
