//! Momentum, energy, immovable vertices and friction.

use super::Body;
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::moving::{sheet, stack};
use welter_meshing::surface::{TriMesh, TriangleSoup, VertexId};
use welter_tracking::integration::{IntegrationParameters, Resolved};

/// The sum of masses times displacements, and twice the energy.
fn momentum(body: &Body, ends: &[DVec3]) -> (DVec3, f64) {
    let masses = body.surface.masses();
    let moved = |i: usize| ends[i] - body.surface.positions()[i];
    let sum = (0..ends.len()).map(|i| masses[i] * moved(i)).sum();
    (sum, (0..ends.len()).map(|i| masses[i] * moved(i).length_squared()).sum())
}

/// Sheets that fall on each other.
fn falling(random: &mut Random, by: f64) -> (Body, Vec<DVec3>) {
    let body = Body::new(&stack(4, 6, 6.0, 0.1));
    let ends =
        body.surface.positions().iter().map(|&p| p - DVec3::Z * by * p.z + 0.05 * random.point()).collect();
    (body, ends)
}

fn only(change: impl Fn(&mut IntegrationParameters)) -> IntegrationParameters {
    let mut parameters = super::no_stages();
    change(&mut parameters);
    parameters
}

#[test]
fn every_stage_keeps_momentum_and_none_adds_energy() {
    let mut random = Random::new(31);
    let mut used = [0; 4];
    for round in 0..6 {
        for (stage, parameters) in [
            only(|p| (p.proximity_rel, p.sweeps) = (0.2, 3)),
            only(|p| p.sweeps = 40),
            only(|p| p.zone_rounds = 40),
            only(|p| p.rigid_rounds = 40),
        ]
        .into_iter()
        .enumerate()
        {
            let (mut body, ends) = falling(&mut random, [0.5, 0.9, 1.1][round % 3]);
            if round > 2 {
                for v in 0..ends.len() {
                    body.surface.set_mass(VertexId(v as u32), random.between(0.5, 4.0)).unwrap();
                }
            }
            let resolved = body.resolve(ends.clone(), &parameters).unwrap();
            let report = resolved.report;
            if report.resting_vertices > 0 || report.shortenings > 0 || report.resting_zones > 0 {
                continue; // Safety came first.
            }
            used[stage] +=
                [report.repulsions, report.impulses, report.impact_zones, report.rigid_zones][stage];
            let ((before, energy), (after, left)) = (momentum(&body, &ends), momentum(&body, &resolved.ends));
            let size: f64 = energy.sqrt() * (ends.len() as f64).sqrt();
            assert!((after - before).length() < 1e-12 * size, "{stage}: {before} {after}");
            // Repulsion may add some.
            assert!(stage == 0 || left <= energy * (1.0 + 1e-12), "{stage}: {energy} {left}");
        }
    }
    println!("{used:?}");
    assert!(used.iter().all(|&used| used > 0), "{used:?}");
}

#[test]
fn angular_momentum_of_a_rigid_zone_is_kept() {
    // Two triangles turn into each other; the zone holds all six vertices in the end.
    let positions = vec![
        DVec3::new(-1.0, -1.0, 0.0),
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(0.0, 1.0, 0.0),
        DVec3::new(-0.5, -0.6, 0.1),
        DVec3::new(0.5, -0.7, 0.12),
        DVec3::new(0.0, 0.3, 0.15),
    ];
    let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2], [3, 4, 5]], ..TriangleSoup::default() };
    let mut body = Body::new(&TriMesh::new(soup).unwrap());
    let p = body.surface.positions();
    let moved = |i: usize| DVec3::Z * if i < 3 { 0.1 * p[i].y } else { -0.2 - 0.3 * (p[i].x + 0.6) };
    let ends: Vec<DVec3> = (0..6).map(|i| p[i] + moved(i)).collect();
    let resolved = body.resolve(ends.clone(), &only(|p| p.rigid_rounds = 20)).unwrap();
    assert!(
        resolved.report.rigid_zones > 0 && resolved.report.resting_vertices == 0,
        "{:?}",
        resolved.report
    );
    let all = (0..6).all(|i| resolved.ends[i] != ends[i]);
    assert!(all, "a vertex is not in the zone");
    let p = body.surface.positions();
    for i in 0..6 {
        for j in 0..i {
            let change = resolved.ends[i].distance(resolved.ends[j]) - p[i].distance(p[j]);
            assert!(change.abs() < 1e-14, "{i} {j} {change}");
        }
    }
    let centre = p.iter().sum::<DVec3>() / 6.0;
    let angular = |ends: &[DVec3]| (0..6).map(|i| (p[i] - centre).cross(ends[i] - p[i])).sum::<DVec3>();
    let (before, after) = (angular(&ends), angular(&resolved.ends));
    // The same to the second order of the angle.
    assert!(before.length() > 0.05 && (after - before).length() < 0.05 * before.length(), "{before} {after}");
}

#[test]
fn immovable_vertices_go_where_they_are_told_and_nothing_goes_through_them() {
    let mut random = Random::new(32);
    for rise in [0.0, 0.2] {
        let mut body = Body::new(&stack(2, 6, 6.0, 0.1));
        let floor: Vec<usize> = (0..49).collect();
        for &v in &floor {
            body.surface.set_mass(VertexId(v as u32), f64::INFINITY).unwrap();
        }
        let end = |i: usize, p: DVec3| match i {
            0..49 => p + DVec3::Z * rise,
            _ => p + DVec3::new(0.05, 0.0, -0.4) + 0.02 * random.point(),
        };
        let ends: Vec<DVec3> = body
            .surface
            .positions()
            .iter()
            .enumerate()
            .map({
                let mut end = end;
                move |(i, &p)| end(i, p)
            })
            .collect();
        let resolved = body.step(ends.clone(), &IntegrationParameters::default());
        assert!(resolved.report.collisions > Some(50), "{:?}", resolved.report);
        assert_eq!((resolved.fraction, resolved.report.resting_vertices), (1.0, 0), "{:?}", resolved.report);
        for &v in &floor {
            assert_eq!(resolved.ends[v], ends[v]);
        }
        for end in &resolved.ends[49..] {
            assert!(end.z > rise, "{end}");
        }
        assert!(body.is_embedded());
    }
}

#[test]
fn a_surface_of_immovable_vertices_moves_as_far_as_it_can() {
    let mut body = Body::new(&stack(2, 3, 3.0, 0.1));
    let n = body.surface.positions().len();
    (0..n).for_each(|v| body.surface.set_mass(VertexId(v as u32), f64::INFINITY).unwrap());
    let p = body.surface.positions();
    let ends: Vec<DVec3> =
        (0..n).map(|i| p[i] - if i < n / 2 { DVec3::ZERO } else { DVec3::Z * 0.3 }).collect();
    let resolved = body.step(ends.clone(), &IntegrationParameters::default());
    // Half of it would touch, a quarter does not.
    assert_eq!((resolved.fraction, resolved.report.resting_vertices), (0.25, 0), "{:?}", resolved.report);
    let p = body.surface.positions();
    assert!(p[n / 2..].iter().all(|p| (p.z - 0.025).abs() < 1e-12));
}

/// A sheet above a large immovable triangle, pushed down and along; the mean motion of its vertices.
fn slide(friction: f64, down: f64, along: f64, repelled: bool) -> (DVec3, Resolved) {
    let board = sheet(2, 2.0);
    let mut soup = TriangleSoup {
        positions: vec![DVec3::new(-9.0, -9.0, 0.0), DVec3::new(15.0, -9.0, 0.0), DVec3::new(0.0, 15.0, 0.0)],
        triangles: vec![[0, 1, 2]],
        ..TriangleSoup::default()
    };
    let first = soup.positions.len();
    let place = DVec3::new(0.5, 0.5, 0.01);
    soup.positions.extend(board.positions().iter().map(|&p| p + place));
    soup.triangles.extend(board.triangles().iter().map(|t| t.map(|v| v.0 + first as u32)));
    let mut body = Body::new(&TriMesh::new(soup).unwrap());
    (0..first).for_each(|v| body.surface.set_mass(VertexId(v as u32), f64::INFINITY).unwrap());
    let push = DVec3::new(along, 0.0, -down);
    let p = body.surface.positions().to_vec();
    let ends = (0..p.len()).map(|i| if i < first { p[i] } else { p[i] + push }).collect();
    let proximity_rel = if repelled { 0.05 } else { 0.0 };
    let parameters = IntegrationParameters { friction, proximity_rel, ..IntegrationParameters::default() };
    let resolved = body.step(ends, &parameters);
    let count = (p.len() - first) as f64;
    let mean = (first..p.len()).map(|i| resolved.ends[i] - p[i]).sum::<DVec3>() / count;
    (mean, resolved)
}

#[test]
fn friction_slows_by_as_much_as_coulomb_says() {
    for repelled in [false, true] {
        for friction in [0.0, 0.25, 0.5] {
            let (down, along) = (0.2, 0.4);
            let (mean, resolved) = slide(friction, down, along, repelled);
            assert_eq!((resolved.report.shortenings, resolved.report.rigid_zones), (0, 0));
            // Only vertices of the sheet touch: each has its whole approach taken away.
            let slowed = along - mean.x;
            println!("{repelled} {friction}: {slowed} {}", mean.z);
            assert!((slowed - friction * down).abs() < 1e-9, "{repelled} {friction}: {slowed}");
            assert!(mean.y.abs() < 1e-12 && mean.z > -0.01);
        }
    }
}

#[test]
fn friction_stops_what_is_slow_and_never_turns_it_back() {
    for repelled in [false, true] {
        let (mean, _) = slide(0.8, 0.2, 0.1, repelled);
        assert!(mean.x.abs() < 1e-9, "{mean}");
    }
}
