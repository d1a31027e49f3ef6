//! Pairs that are asked about within the search.

use super::twin::{Lists, loose};
use glam::DVec3;
use std::sync::Mutex;
use welter_kit::mesher::Random;
use welter_kit::surface::{closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::spatial::Box3;
use welter_meshing::surface::TriId;
use welter_tracking::broad_phase::{BroadPhase, BroadPhaseError, Motion};
use welter_tracking::surface::MovingSurface;

fn surfaces() -> Vec<MovingSurface> {
    let named = [closed_surfaces(), non_manifold_surfaces(), open_surfaces()].concat();
    let mut all: Vec<MovingSurface> =
        named.iter().map(|(_, mesh)| MovingSurface::new(mesh).unwrap()).collect();
    let mut random = Random::new(51);
    for size in [0.1, 0.5, 5.0] {
        let corners = (0..40).map(|_| {
            let place = random.point();
            std::array::from_fn(|_| place + size * random.point())
        });
        all.push(loose(corners.collect()));
    }
    all.push(loose(vec![[DVec3::ONE; 3]; 30]));
    all
}

#[test]
fn each_pair_is_asked_about_once_and_those_that_pass_are_listed() {
    let mut asked_of_all = 0;
    for surface in surfaces() {
        let (mesh, broad_phase) = (surface.connectivity(), BroadPhase::new(&surface, Motion::Rest).unwrap());
        for distance in [0.0, 0.3] {
            let lists = Lists::of(&broad_phase, &surface, distance);
            let asked = Mutex::new(Vec::new());
            let passed = broad_phase.vertex_triangle_pairs_that(mesh, distance, |v, t| {
                asked.lock().unwrap().push((v, t));
                (v.0 + t.0).is_multiple_of(3)
            });
            let mut asked = asked.into_inner().unwrap();
            asked.sort_unstable();
            assert_eq!(asked, lists.vertex_triangle);
            let expected =
                lists.vertex_triangle.iter().copied().filter(|(v, t)| (v.0 + t.0).is_multiple_of(3));
            assert_eq!(passed.unwrap(), expected.collect::<Vec<_>>());
            asked_of_all += asked.len();

            let asked = Mutex::new(Vec::new());
            let passed = broad_phase.edge_edge_pairs_that(mesh, distance, |a, b| {
                asked.lock().unwrap().push([a.min(b), a.max(b)]);
                (a.0 + b.0).is_multiple_of(3)
            });
            let mut asked = asked.into_inner().unwrap();
            asked.sort_unstable();
            assert_eq!(asked, lists.edge_edge);
            let expected = lists.edge_edge.iter().copied().filter(|[a, b]| (a.0 + b.0).is_multiple_of(3));
            assert_eq!(passed.unwrap(), expected.collect::<Vec<_>>());
            asked_of_all += asked.len();
        }
    }
    assert!(asked_of_all > 10_000, "{asked_of_all}");
}

#[test]
fn pairs_of_triangles_are_those_of_all_whose_boxes_are_near() {
    let mut found = 0;
    for surface in surfaces() {
        let mesh = surface.connectivity();
        let triangles: Vec<TriId> = mesh.triangles().collect();
        let places: Vec<DVec3> =
            surface.positions().iter().map(|&p| DVec3::new(p.y, -p.z, 0.5 * p.x)).collect();
        for motion in [Motion::Rest, Motion::At(&places)] {
            let broad_phase = BroadPhase::new(&surface, motion).unwrap();
            let at = if matches!(motion, Motion::Rest) { surface.positions() } else { &places };
            let bounds = |t: TriId| Box3::of(mesh.corners(t).map(|v| at[v.index()]));
            let mut expected = Vec::new();
            for (i, &s) in triangles.iter().enumerate() {
                let near = triangles[i + 1..].iter().filter(|&&t| bounds(s).meets(&bounds(t)));
                expected.extend(near.map(|&t| [s, t]));
            }
            assert_eq!(broad_phase.triangle_pairs_that(0.0, |_, _| true).unwrap(), expected);
            let some = broad_phase.triangle_pairs_that(0.0, |s, t| (s.0 ^ t.0) & 1 == 0).unwrap();
            expected.retain(|[s, t]| (s.0 ^ t.0) & 1 == 0);
            assert_eq!(some, expected);
            found += some.len();
        }
    }
    assert!(found > 1000, "{found}");
}

#[test]
fn places_that_are_not_finite_are_refused() {
    let surface = loose(vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]);
    let places = [DVec3::ZERO, DVec3::NAN, DVec3::Y];
    let refused = BroadPhase::new(&surface, Motion::At(&places));
    assert!(matches!(refused, Err(BroadPhaseError::End { .. })));
    let refused = BroadPhase::new(&surface, Motion::At(&places[1..]));
    assert!(matches!(refused, Err(BroadPhaseError::Ends { ends: 2, vertices: 3 })));
    let rest = BroadPhase::new(&surface, Motion::Rest).unwrap();
    assert!(matches!(rest.triangle_pairs_that(-1.0, |_, _| true), Err(BroadPhaseError::Distance { .. })));
}
