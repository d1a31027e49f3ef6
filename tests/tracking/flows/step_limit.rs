//! No triangle turns over in a step of face offsetting.

use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::surface::{closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::surface::{TriMesh, VertexId};
use welter_tracking::flows::{FaceOffsetting, FaceOffsettingParameters, Front};
use welter_tracking::surface::MovingSurface;

fn normals(surface: &MovingSurface, positions: &[DVec3]) -> Vec<DVec3> {
    let mesh = surface.connectivity();
    mesh.triangles()
        .map(|t| {
            let [a, b, c] = mesh.corners(t).map(|v| positions[v.index()]);
            (b - a).cross(c - a)
        })
        .collect()
}

/// Surfaces of the kit with every vertex displaced at random, so that some triangles are slivers.
fn rough(mesh: &TriMesh, random: &mut Random, amount: f64) -> MovingSurface {
    let mut surface = MovingSurface::new(mesh).unwrap();
    let vertices: Vec<VertexId> = surface.connectivity().vertices().collect();
    for v in vertices {
        surface.set_position(v, surface.position(v) + amount * random.point()).unwrap();
    }
    surface
}

#[test]
fn triangles_keep_their_side_in_every_step() {
    let surfaces: Vec<_> =
        closed_surfaces().into_iter().chain(non_manifold_surfaces()).chain(open_surfaces()).collect();
    let mut random = Random::new(61);
    let (mut shortened, mut held, mut free) = (0, 0, 0);
    for round in 0..40 {
        for (name, mesh) in &surfaces {
            let amount = 0.3 * random.unit();
            let surface = rough(mesh, &mut random, amount);
            let parameters = FaceOffsettingParameters {
                area_kept: [0.0, 0.1, 0.5][round % 3],
                least_fraction: [0.0, 1.0 / 64.0, 1.0][round / 3 % 3],
                ..Default::default()
            };
            let front = if round % 2 == 0 { Front::Entropy } else { Front::Sharp };
            let speed = random.between(-1.0, 1.0);
            let flow = FaceOffsetting { speed, front, parameters };
            let found = flow.offsets(&surface, 0.0, 1.0).unwrap();
            let dt = found.prediction.dt;
            assert!(dt >= parameters.least_fraction && dt <= 1.0, "{name}: {dt}");
            assert_eq!(found.limiting.is_some(), dt < 1.0, "{name}");
            shortened += usize::from(dt < 1.0);
            held += usize::from(found.held > 0);
            free += usize::from(dt == 1.0 && found.held == 0);
            let before = normals(&surface, surface.positions());
            for fraction in [0.25, 0.5, 0.75, 1.0] {
                let pairs = surface.positions().iter().zip(&found.prediction.ends);
                let between: Vec<DVec3> = pairs.map(|(&a, &b)| a + fraction * (b - a)).collect();
                for (old, new) in before.iter().zip(normals(&surface, &between)) {
                    let kept = old.dot(new) / old.length_squared();
                    assert!(kept >= parameters.area_kept - 1e-6, "{name}, {round}: {kept} at {fraction}");
                }
            }
        }
    }
    println!("steps: {free} free, {shortened} shortened, {held} with vertices held back");
    assert!(shortened > 50 && held > 50 && free > 5);
}

/// A pyramid whose apex sinks by the speed over the cosine: it is flat, and stops there if nothing is kept.
#[test]
fn the_limit_is_the_time_at_which_a_triangle_vanishes() {
    // A cube inward: its side of 2 vanishes after 1, and triangles of the corner's faces with it.
    let cube = welter_meshing::shapes::box_(&welter_meshing::shapes::Box_ {
        edge_length: 3.0,
        ..Default::default()
    })
    .unwrap();
    let surface = MovingSurface::new(&cube).unwrap();
    assert_eq!(surface.connectivity().triangle_count(), 12);
    for (area_kept, expected) in [(0.0, 1.0), (0.25, 0.5), (0.0625, 0.75)] {
        let parameters = FaceOffsettingParameters { area_kept, least_fraction: 0.0, ..Default::default() };
        let flow = FaceOffsetting { speed: -1.0, front: Front::Entropy, parameters };
        let found = flow.offsets(&surface, 0.0, 7.0).unwrap();
        // The area falls with the square of the side.
        assert!((found.prediction.dt - expected).abs() < 1e-7, "{}", found.prediction.dt);
        assert!(found.limiting.is_some() && found.held == 0);
    }
}
