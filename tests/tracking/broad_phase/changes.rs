//! Thousands of random operations, followed one by one, against all pairs.

use super::twin::{Lists, check_single};
use crate::surface::random::{Trial, trial};
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::surface::{Named, closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::surface::VertexId;
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::surface::{EventKind, MovingSurface};

/// Ends that depend on positions alone, so that vertices which an operation leaves in place keep their ends.
fn ends(surface: &MovingSurface) -> Vec<DVec3> {
    surface.positions().iter().map(|&p| DVec3::new(p.y, p.x, 1.125 * p.z)).collect()
}

/// How many operations were followed.
fn run(mesh: &welter_meshing::surface::TriMesh, kinds: &[u64], moves: bool, place: &str, seed: u64) -> usize {
    let mut surface = MovingSurface::new(mesh).unwrap();
    let mut random = Random::new(seed);
    let mut followed = 0;
    let all = ends(&surface);
    let mut broad_phase =
        BroadPhase::new(&surface, if moves { Motion::To(&all) } else { Motion::Rest }).unwrap();
    for step in 0..700 {
        let kind = match surface.connectivity().triangle_count() {
            0 => break,
            1..=12 => 0,
            120.. => 2,
            _ => kinds[random.below(kinds.len() as u64) as usize],
        };
        if let Some(Trial { plan: Ok(plan), .. }) = trial(&surface, &mut random, kind) {
            surface.apply(plan);
            followed += 1;
        }
        let wandered = random.below(4) == 0;
        let vertex = VertexId(random.below(surface.connectivity().vertex_slots() as u64) as u32);
        if wandered {
            let by = [1e-3, 0.1, 10.0][random.below(3) as usize] * random.point();
            surface.set_position(vertex, 0.5 * surface.position(vertex) + by).unwrap();
        }
        if step % 200 == 199 {
            let _ = surface.compact();
        }
        // Several operations may be followed together.
        if random.below(4) == 0 && !wandered {
            continue;
        }
        let log = surface.take_log();
        let all = ends(&surface);
        let motion = if moves { Motion::To(&all) } else { Motion::Rest };
        let compacted = log.iter().any(|event| event.kind == EventKind::Compact);
        broad_phase.follow(&surface, motion, &log).unwrap();
        if wandered && !compacted {
            broad_phase.moved(&surface, motion, &[vertex]).unwrap();
        }
        if step % 50 == 49 {
            broad_phase.refresh(&surface, motion).unwrap();
        }
        let distance = [0.0, 0.05][random.below(2) as usize];
        let lists = Lists::of(&broad_phase, &surface, distance);
        assert_eq!(lists, Lists::twin(&surface, motion, distance), "{place}, seed {seed}, step {step}");
        check_single(&broad_phase, &surface, &mut random, distance, &lists);
    }
    followed
}

fn run_all(surfaces: Vec<Named>, kinds: &[u64]) {
    let mut followed = 0;
    for (name, mesh) in surfaces {
        followed += run(&mesh, kinds, false, name, 0) + run(&mesh, kinds, true, name, 1);
    }
    println!("{followed} operations");
    assert!(followed > 2000, "{followed}");
}

#[test]
fn changes_of_closed_surfaces_are_followed() {
    run_all(closed_surfaces(), &[0, 1, 1, 2, 2, 3, 4]);
}

#[test]
fn changes_of_surfaces_with_edges_of_many_triangles_are_followed() {
    run_all(non_manifold_surfaces(), &[0, 1, 1, 2, 2, 3, 4]);
}

#[test]
fn changes_of_open_surfaces_are_followed() {
    run_all(open_surfaces(), &[0, 1, 2, 2, 3, 4, 5, 6, 6]);
}
