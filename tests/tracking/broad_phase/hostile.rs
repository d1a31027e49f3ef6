//! Surfaces that are hard for one structure or another: uneven, at one place, far away, at the ends of the range.

use super::twin::{Lists, check_single, loose, range};
use glam::DVec3;
use rug::Rational;
use welter_kit::mesher::Random;
use welter_kit::surface::{closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::spatial::Box3;
use welter_meshing::surface::VertexId;
use welter_tracking::broad_phase::{BroadPhase, BroadPhaseError, Motion};
use welter_tracking::surface::MovingSurface;

const TRIANGLES: usize = 60;

/// Corners of a triangle of a size around a place.
fn triangle(random: &mut Random, place: DVec3, size: f64) -> [DVec3; 3] {
    std::array::from_fn(|_| place + size * random.point())
}

/// Each kind with the size of its triangles, for distances and motions.
fn surfaces(random: &mut Random) -> Vec<(&'static str, f64, MovingSurface)> {
    let mut all = Vec::new();
    let mut add = |name, size: f64, random: &mut Random, make: &dyn Fn(&mut Random, usize) -> [DVec3; 3]| {
        all.push((name, size, loose((0..TRIANGLES).map(|i| make(random, i)).collect())));
    };
    add("even", 0.2, random, &|r, _| {
        let place = r.point();
        triangle(r, place, 0.2)
    });
    add("sizes from 1 to 2^-50", 0.1, random, &|r, _| {
        let size = 2f64.powi(-(r.below(51) as i32));
        let place = size * r.point();
        triangle(r, place, size)
    });
    add("one as large as all", 0.1, random, &|r, i| {
        let place = r.point();
        triangle(r, place, if i == 0 { 100.0 } else { 0.1 })
    });
    add("all at one place", 1.0, random, &|_, _| [DVec3::ONE; 3]);
    add("a million sizes from the origin", 1e-6, random, &|r, _| {
        let place = DVec3::ONE + 5e-6 * r.point();
        triangle(r, place, 1e-6)
    });
    add("one at the end of the range", 0.1, random, &|r, i| {
        let place = if i == 0 { DVec3::splat(1e308) } else { r.point() };
        triangle(r, place, 0.2)
    });
    add("all of the range", 1e306, random, &|r, _| {
        let size = 2f64.powi(r.below(2045) as i32 - 1022);
        let place = size * r.point();
        triangle(r, place, 0.5 * size)
    });
    add("the least numbers", 1e-323, random, &|r, _| {
        std::array::from_fn(|_| DVec3::from_array(std::array::from_fn(|_| f64::from_bits(r.below(40)))))
    });
    add("on a line", 2.0, random, &|r, i| {
        std::array::from_fn(|_| DVec3::new(i as f64 + r.below(3) as f64, 0.0, 0.0))
    });
    all
}

fn ends(surface: &MovingSurface, random: &mut Random, by: f64) -> Vec<DVec3> {
    surface.positions().iter().map(|&p| p + by * random.point()).collect()
}

#[test]
fn hard_surfaces_agree_with_all_pairs() {
    let (mut random, mut pairs) = (Random::new(3), 0);
    for _ in 0..6 {
        for (name, size, surface) in surfaces(&mut random) {
            let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
            for by in [0.0, 0.01 * size, size, 30.0 * size] {
                let ends = ends(&surface, &mut random, by);
                for motion in [Motion::To(&ends), Motion::At(&ends), Motion::Rest] {
                    broad_phase.refresh(&surface, motion).unwrap();
                    let distance = [0.0, 0.01 * size, size][random.below(3) as usize];
                    let lists = Lists::of(&broad_phase, &surface, distance);
                    assert_eq!(lists, Lists::twin(&surface, motion, distance), "{name}, {motion:?}");
                    check_single(&broad_phase, &surface, &mut random, distance, &lists);
                    pairs += lists.len();
                    let fresh = BroadPhase::new(&surface, motion).unwrap();
                    assert_eq!(Lists::of(&fresh, &surface, distance), lists, "{name}");
                }
            }
        }
    }
    assert!(pairs > 1_000_000, "{pairs}");
}

#[test]
fn connected_surfaces_agree_with_all_pairs() {
    let mut random = Random::new(4);
    for (name, mesh) in [closed_surfaces(), non_manifold_surfaces(), open_surfaces()].concat() {
        let surface = MovingSurface::new(&mesh).unwrap();
        let ends = ends(&surface, &mut random, 0.2);
        for (motion, distance) in [(Motion::Rest, 0.0), (Motion::Rest, 0.3), (Motion::To(&ends), 0.0)] {
            let broad_phase = BroadPhase::new(&surface, motion).unwrap();
            let lists = Lists::of(&broad_phase, &surface, distance);
            assert_eq!(lists, Lists::twin(&surface, motion, distance), "{name}, {distance}");
            check_single(&broad_phase, &surface, &mut random, distance, &lists);
        }
    }
}

#[test]
fn no_pair_within_the_exact_distance_is_missed_and_none_an_ulp_farther_is_found() {
    let mut random = Random::new(5);
    let mut close = 0;
    for round in 0..30 {
        // Gaps of few values, so that many are the distance itself or next to it.
        let distance = 1.0 + round as f64 * f64::EPSILON;
        let mut coordinate = || {
            let step = f64::from(random.below(3) as u32);
            step * distance + (random.below(9) as f64 - 4.0) * 0.25 * f64::EPSILON
        };
        let mut corner = || DVec3::new(coordinate(), coordinate(), coordinate());
        let surface = loose((0..12).map(|_| std::array::from_fn(|_| corner())).collect());
        let within = |distance: f64, strict: bool| {
            let distance = Rational::from_f64(distance).unwrap();
            Lists::by_all_pairs(&surface, |a, b| {
                (0..3).all(|axis| {
                    let of = |v: &[VertexId]| {
                        let (low, high) = range(&surface, Motion::Rest, v, axis);
                        (Rational::from_f64(low).unwrap(), Rational::from_f64(high).unwrap())
                    };
                    let ((a_low, a_high), (b_low, b_high)) = (of(a), of(b));
                    let gap = (a_low - b_high).max(b_low - a_high);
                    if strict { gap < distance } else { gap <= distance }
                })
            })
        };
        let found = Lists::of(&BroadPhase::new(&surface, Motion::Rest).unwrap(), &surface, distance);
        let (least, most) = (within(distance, false), within(distance.next_up(), true));
        assert!(least.vertex_triangle.iter().all(|pair| found.vertex_triangle.contains(pair)));
        assert!(least.edge_edge.iter().all(|pair| found.edge_edge.contains(pair)));
        assert!(least.edge_triangle.iter().all(|pair| found.edge_triangle.contains(pair)));
        assert!(found.vertex_triangle.iter().all(|pair| most.vertex_triangle.contains(pair)));
        assert!(found.edge_edge.iter().all(|pair| most.edge_edge.contains(pair)));
        assert!(found.edge_triangle.iter().all(|pair| most.edge_triangle.contains(pair)));
        close += usize::from(least != found);
    }
    assert!(close > 0, "rounding never mattered");
}

#[test]
fn many_elements_at_one_place_are_built_refreshed_and_changed() {
    let surface = loose(vec![[DVec3::ONE; 3]; 50_000]);
    let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
    broad_phase.refresh(&surface, Motion::Rest).unwrap();
    let all: Vec<VertexId> = surface.connectivity().vertices().collect();
    broad_phase.moved(&surface, Motion::Rest, &all).unwrap();
    assert_eq!(broad_phase.vertices_near(&Box3::of([DVec3::ZERO]), 1.0), Ok(all.clone()));
    assert_eq!(broad_phase.vertices_near(&Box3::of([DVec3::ZERO]), 1.0_f64.next_down()), Ok(Vec::new()));
    let everything = Box3 { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
    assert_eq!(broad_phase.vertices_near(&everything, 0.0), Ok(all));
    assert_eq!(broad_phase.triangles_near(&everything, 0.0).unwrap().len(), 50_000);
    assert_eq!(broad_phase.edges_near(&everything, 0.0).unwrap().len(), 150_000);
    assert_eq!(broad_phase.edges_near(&Box3::EMPTY, 1e300), Ok(Vec::new()));
}

#[test]
fn what_is_no_motion_and_no_distance_is_refused() {
    let surface = loose(vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]);
    let new = |ends: &[DVec3]| BroadPhase::new(&surface, Motion::To(ends)).unwrap_err();
    assert_eq!(new(&[DVec3::ZERO]), BroadPhaseError::Ends { ends: 1, vertices: 3 });
    let end = DVec3::new(0.0, f64::INFINITY, 0.0);
    assert_eq!(new(&[DVec3::ZERO, end, end]), BroadPhaseError::End { vertex: VertexId(1), end });
    assert!(matches!(new(&[DVec3::NAN; 3]), BroadPhaseError::End { vertex: VertexId(0), .. }));
    let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
    let error = BroadPhaseError::End { vertex: VertexId(1), end };
    let bad = [DVec3::ZERO, end, DVec3::ONE];
    assert_eq!(broad_phase.refresh(&surface, Motion::To(&bad)), Err(error));
    assert_eq!(broad_phase.moved(&surface, Motion::To(&bad), &[VertexId(0)]), Err(error));
    let mesh = surface.connectivity();
    for distance in [-1.0, f64::INFINITY, f64::NAN, -f64::MIN_POSITIVE] {
        let refused = |result: Option<BroadPhaseError>| {
            assert!(matches!(result, Some(BroadPhaseError::Distance { .. })), "{distance}: {result:?}");
        };
        refused(broad_phase.vertex_triangle_pairs(mesh, distance).err());
        refused(broad_phase.edge_edge_pairs(mesh, distance).err());
        refused(broad_phase.edge_triangle_pairs(mesh, distance).err());
        refused(broad_phase.triangles_near_vertex(mesh, VertexId(0), distance).err());
        refused(broad_phase.triangles_near(&Box3::EMPTY, distance).err());
    }
}

#[test]
fn a_refresh_without_the_changes_before_it_is_refused() {
    let (_, mesh) = closed_surfaces().pop().unwrap();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
    let everything = Box3 { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
    let before = broad_phase.edges_near(&everything, 0.0);
    let edge = surface.connectivity().edges().next().unwrap();
    let plan = surface.plan_split(edge, 0.5).unwrap();
    surface.apply(plan);
    let error = BroadPhaseError::NotFollowed { elements: "vertices" };
    assert_eq!(broad_phase.refresh(&surface, Motion::Rest), Err(error));
    assert_eq!(broad_phase.edges_near(&everything, 0.0), before);
    broad_phase.follow(&surface, Motion::Rest, surface.log()).unwrap();
    assert_eq!(broad_phase.refresh(&surface, Motion::Rest), Ok(()));
    assert_eq!(Lists::of(&broad_phase, &surface, 0.0), Lists::twin(&surface, Motion::Rest, 0.0));
}

#[test]
fn a_surface_without_triangles_has_no_pairs() {
    let surface = loose(Vec::new());
    let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
    broad_phase.refresh(&surface, Motion::To(&[])).unwrap();
    assert_eq!(Lists::of(&broad_phase, &surface, 1.0).len(), 0);
    assert_eq!(broad_phase.vertices_near(&Box3::of([DVec3::ZERO]), 1e300), Ok(Vec::new()));
}
