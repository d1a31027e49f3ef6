//! What each stage is for: it resolves what the ones before leave, and does no more than it must.

use super::Body;
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::moving::{first_collision, stack};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::integration::{ElementPair, IntegrationParameters, Resolved};

/// A triangle at rest and a small one above it, `height` above, that is to go `down`.
fn vertex_above_triangle(height: f64) -> Body {
    let positions = vec![
        DVec3::new(-4.0, -4.0, 0.0),
        DVec3::new(4.0, -4.0, 0.0),
        DVec3::new(0.0, 4.0, 0.0),
        DVec3::new(0.0, 0.0, height),
        DVec3::new(0.25, 0.0, height + 1.0),
        DVec3::new(0.0, 0.25, height + 1.0),
    ];
    let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2], [3, 4, 5]], ..TriangleSoup::default() };
    let mut body = Body::new(&TriMesh::new(soup).unwrap());
    body.length = 1.0;
    body
}

fn down(body: &Body, by: f64) -> Vec<DVec3> {
    let p = body.surface.positions();
    (0..6).map(|i| if i < 3 { p[i] } else { p[i] - DVec3::Z * by }).collect()
}

#[test]
fn repulsion_sends_a_pair_as_far_apart_as_it_is_told() {
    let mut body = vertex_above_triangle(0.125);
    let parameters = IntegrationParameters { proximity_rel: 0.5, ..super::no_stages() };
    // Down by a bit, which repulsion turns round.
    let ends = down(&body, 0.0625);
    let resolved = body.step(ends, &parameters);
    assert_eq!((resolved.report.proximities, resolved.report.repulsions), (1, 1));
    assert_eq!(resolved.report.collisions, Some(0));
    let p = body.surface.positions();
    // Weights 1/4, 1/4, 1/2 of the corners: the vertex is above the middle of the triangle.
    let gap = p[3].z - (0.25 * p[0].z + 0.25 * p[1].z + 0.5 * p[2].z);
    assert!((gap - 0.5).abs() < 1e-15, "{gap}");
    // What is far enough apart is left alone.
    let mut body = vertex_above_triangle(0.5625);
    let ends = down(&body, 0.25);
    assert_eq!(body.step(ends.clone(), &parameters).ends, ends);
}

#[test]
fn an_impulse_takes_the_approach_away_and_nothing_else() {
    let mut body = vertex_above_triangle(0.125);
    let ends: Vec<DVec3> = down(&body, 0.5)
        .iter()
        .enumerate()
        .map(|(i, &p)| if i < 3 { p } else { p + DVec3::X * 0.125 })
        .collect();
    let resolved = body.step(ends.clone(), &IntegrationParameters { sweeps: 3, ..super::no_stages() });
    assert_eq!((resolved.report.collisions, resolved.report.impulses), (Some(1), 1), "{:?}", resolved.report);
    let p = body.surface.positions();
    assert!((0..6).all(|i| p[i].x == ends[i].x && p[i].y == ends[i].y));
    // The vertex meets the plane a quarter of the way down, above x = 1/32.
    let weights = [0.25 - 1.0 / 256.0, 0.25 + 1.0 / 256.0, 0.5];
    let below: f64 = (0..3).map(|i| weights[i] * p[i].z).sum();
    assert!((p[3].z - below - 0.125).abs() < 1e-11, "{}", p[3].z - below);
}

#[test]
fn zones_resolve_together_what_impulses_pass_on() {
    // Sheets one upon another: an impulse between two is a collision of the next two.
    let mut random = Random::new(41);
    let mut body = Body::new(&stack(6, 4, 4.0, 0.02));
    let ends: Vec<DVec3> =
        body.surface.positions().iter().map(|&p| p - DVec3::Z * 3.0 * p.z + 0.01 * random.point()).collect();
    let one_sweep =
        body.clone().step(ends.clone(), &IntegrationParameters { sweeps: 1, ..super::no_stages() });
    assert!(one_sweep.report.resting_vertices > 0, "one sweep was enough: {:?}", one_sweep.report);
    let zones = IntegrationParameters { zone_rounds: 30, ..super::no_stages() };
    let resolved = body.step(ends, &zones);
    println!("{:?}", resolved.report);
    assert!(
        resolved.report.impact_zones > 0 && resolved.report.largest_impact_zone > 1000,
        "{:?}",
        resolved.report
    );
    assert_eq!((resolved.report.resting_vertices, resolved.fraction), (0, 1.0), "{:?}", resolved.report);
}

#[test]
fn a_singular_zone_is_found_out_and_solved() {
    // A square on a square: eight vertices, and each of the four corners meets its like in several pairs.
    let square = |z: f64| [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[x, y]| DVec3::new(x, y, z));
    let positions = [square(0.0), square(0.25)].concat();
    let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let mesh = TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap();
    let mut body = Body::new(&mesh);
    let p = body.surface.positions();
    let ends: Vec<DVec3> = (0..8).map(|i| if i < 4 { p[i] } else { p[i] - DVec3::Z }).collect();
    let resolved = body.step(ends, &IntegrationParameters { zone_rounds: 5, ..super::no_stages() });
    println!("{:?}", resolved.report);
    assert!(resolved.report.singular_systems > 0, "{:?}", resolved.report);
    assert_eq!(
        (resolved.report.resting_vertices, resolved.report.rigid_zones),
        (0, 0),
        "{:?}",
        resolved.report
    );
    // Eight unit masses, half of which went down by one.
    for end in &resolved.ends {
        assert!((end.z - if end.z < -0.4 { -0.5 } else { -0.25 }).abs() < 1e-11, "{end}");
    }
}

#[test]
fn rigid_zones_resolve_what_is_left_without_zones() {
    let mut random = Random::new(42);
    let mut body = Body::new(&stack(3, 2, 2.0, 0.02));
    let ends: Vec<DVec3> =
        body.surface.positions().iter().map(|&p| p - DVec3::Z * 3.0 * p.z + 0.01 * random.point()).collect();
    let resolved = body.step(ends, &IntegrationParameters { rigid_rounds: 30, ..super::no_stages() });
    println!("{:?}", resolved.report);
    assert!(resolved.report.rigid_zones > 0, "{:?}", resolved.report);
    assert_eq!((resolved.report.resting_vertices, resolved.fraction), (0, 1.0), "{:?}", resolved.report);
}

#[test]
fn shorter_steps_go_as_far_as_they_can() {
    let mut body = vertex_above_triangle(0.25);
    let ends = down(&body, 1.0);
    // Contact at a quarter of the way: an eighth is free of it.
    let resolved = body.step(ends, &IntegrationParameters { most_halvings: 5, ..super::no_stages() });
    assert_eq!((resolved.fraction, resolved.report.shortenings), (0.125, 3));
    assert_eq!(body.surface.positions()[3].z, 0.125);
    assert_eq!(resolved.report.resting_vertices, 0);
}

#[test]
fn what_nothing_helps_stays_where_it_is_and_no_more() {
    let mut body = vertex_above_triangle(0.25);
    let mut ends = down(&body, 1.0);
    // Another corner of the small triangle, which does not collide.
    ends[4] = body.surface.positions()[4] + DVec3::X;
    let before = body.surface.clone();
    let Resolved { ends: resolved, report, .. } = body.step(ends.clone(), &super::no_stages());
    assert!(matches!(first_collision(&before, &ends), Some(ElementPair::VertexTriangle(..))));
    assert_eq!(report.resting_vertices, 4, "{report:?}");
    assert_eq!(resolved[3], before.positions()[3]);
    assert_eq!(resolved[4], ends[4]);
}

#[test]
fn a_crowded_step_is_cut_to_a_few_edge_lengths() {
    let mut random = Random::new(43);
    let mut body = Body::new(&stack(3, 6, 6.0, 0.1));
    let ends = body.surface.positions().iter().map(|&p| p + 5000.0 * random.point()).collect();
    let parameters =
        IntegrationParameters { most_collisions_per_vertex: 8, ..IntegrationParameters::default() };
    let resolved = body.step(ends, &parameters);
    println!("{:?} {}", resolved.report, resolved.fraction);
    assert_eq!(resolved.report.collisions, None);
    assert!(resolved.fraction <= 16.0 / 2500.0 && resolved.report.shortenings > 0);
}
