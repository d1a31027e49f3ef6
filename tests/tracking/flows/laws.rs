//! What must not change predictions: the number of threads, the scale.

use super::ball;
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_meshing::surface::TriMesh;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};
use welter_tracking::flows::{
    Advection, FaceOffsetting, Flow, FlowError, Front, Jitter, MeanCurvature, Prediction, Scheme,
};
use welter_tracking::surface::MovingSurface;

fn rough_ball(edge_length: f64) -> MovingSurface {
    let mut surface = ball(1.0, edge_length);
    let mut random = Random::new(81);
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    for v in vertices {
        surface.set_position(v, surface.position(v) + 0.2 * edge_length * random.point()).unwrap();
    }
    surface
}

/// Flows whose lengths are multiplied by a factor.
fn flows(factor: f64) -> Vec<(&'static str, Box<dyn Flow + Sync>)> {
    let noise = CurlNoiseParameters { wavelength: factor, speed: factor, ..Default::default() };
    let noise = CurlNoise::new(&noise).unwrap();
    let sharp = FaceOffsetting { front: Front::Sharp, ..FaceOffsetting::new(-factor) };
    vec![
        ("Runge and Kutta", Box::new(Advection { field: noise.clone(), scheme: Scheme::Rk4 })),
        ("Euler", Box::new(Advection { field: noise, scheme: Scheme::Euler })),
        ("normal", Box::new(FaceOffsetting::new(0.5 * factor))),
        ("normal, sharp", Box::new(sharp)),
        ("jitter", Box::new(Jitter::default())),
        ("mean curvature", Box::new(MeanCurvature { speed: factor * factor, ..Default::default() })),
    ]
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let surface = rough_ball(0.05);
    assert!(surface.positions().len() > 4000);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        flows(1.0).into_iter().map(|(_, flow)| pool.install(|| advance(&*flow, &surface))).collect::<Vec<_>>()
    };
    let one = on(1);
    for threads in [2, 3, 8] {
        assert!(on(threads) == one, "{threads} threads");
    }
}

fn advance(flow: &dyn Flow, surface: &MovingSurface) -> Prediction {
    flow.advance(surface, 0.25, 0.5).unwrap()
}

#[test]
fn the_error_is_that_of_the_smallest_id_on_any_number_of_threads() {
    let surface = rough_ball(0.05);
    let field = |p: DVec3, _: f64| if p.x > 0.0 { DVec3::X / 0.0 } else { p };
    let first = surface.connectivity().vertices().find(|&v| surface.position(v).x > 0.0).unwrap();
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let found = pool.install(|| Advection { field, scheme: Scheme::Rk4 }.advance(&surface, 0.0, 1.0));
        let Err(FlowError::Velocity { vertex, position, time, .. }) = found else { panic!("{found:?}") };
        assert_eq!((vertex, position, time), (first, surface.position(first), 0.0));
    }
}

#[test]
fn lengths_times_a_power_of_two_give_positions_times_that_power() {
    let original = rough_ball(0.2).to_mesh();
    let predictions = |k: i32| {
        let factor = 2f64.powi(k);
        let mut soup = original.to_soup();
        soup.positions.iter_mut().for_each(|p| *p *= factor);
        let surface = MovingSurface::new(&TriMesh::new(soup).unwrap()).unwrap();
        flows(factor)
            .into_iter()
            // The speed of mean curvature is the square of a length, so it has half the range.
            .filter(|(name, _)| k.abs() < 500 || *name != "mean curvature")
            .map(|(name, flow)| (name, advance(&*flow, &surface)))
            .collect::<Vec<_>>()
    };
    let expected = predictions(0);
    for k in [-960_i32, -450, -100, -1, 1, 30, 450, 960] {
        for ((name, one), (other_name, other)) in
            expected.iter().filter(|(name, _)| k.abs() < 500 || *name != "mean curvature").zip(predictions(k))
        {
            assert_eq!(*name, other_name);
            assert_eq!(one.dt, other.dt, "{name}, 2^{k}");
            let scaled: Vec<DVec3> = one.ends.iter().map(|&p| 2f64.powi(k) * p).collect();
            assert!(scaled == other.ends, "{name}, 2^{k}");
        }
    }
}

/// Vertices of infinite mass, and free ids, stay.
#[test]
fn what_is_immovable_stays() {
    let mut surface = rough_ball(0.2);
    let edge = surface.connectivity().edges().next().unwrap();
    let [a, b] = surface.connectivity().ends(edge);
    let target = surface.position(a);
    let plan = surface.plan_collapse(edge, a, 0.0).map(|plan| surface.apply(plan));
    assert!(plan.is_ok() && !surface.connectivity().has_vertex(b), "{target}");
    let fixed: Vec<_> = surface.connectivity().vertices().step_by(3).collect();
    for &v in &fixed {
        surface.set_mass(v, f64::INFINITY).unwrap();
    }
    for (name, flow) in flows(1.0) {
        let ends = advance(&*flow, &surface).ends;
        assert_eq!(ends.len(), surface.connectivity().vertex_slots());
        assert_eq!(ends[b.index()], surface.positions()[b.index()], "{name}");
        let moved = |v: &&welter_meshing::surface::VertexId| ends[v.index()] != surface.position(**v);
        assert_eq!(fixed.iter().filter(moved).count(), 0, "{name}");
        let all: Vec<_> = surface.connectivity().vertices().collect();
        assert!(all.iter().filter(moved).count() > all.len() / 2, "{name}");
    }
}

/// Displacements fill the ball of half an edge length, differ between vertices, times and seeds, and have mean zero.
#[test]
fn jitter_is_random_and_repeatable() {
    let surface = ball(1.0, 0.05);
    let mesh = surface.connectivity();
    let lengths = mesh.edges().map(|e| {
        let [a, b] = mesh.ends(e).map(|v| surface.position(v));
        a.distance(b)
    });
    let mean = lengths.sum::<f64>() / mesh.edge_count() as f64;
    let displacements = |seed: u64, time: f64| {
        let ends = Jitter { amplitude_rel: 0.5, seed }.advance(&surface, time, 0.1).unwrap().ends;
        ends.iter().zip(surface.positions()).map(|(&q, &p)| (q - p) / (0.5 * mean)).collect::<Vec<DVec3>>()
    };
    let one = displacements(1, 0.0);
    let count = one.len() as f64;
    assert!(one.iter().all(|d| d.length() < 1.0 + 1e-12));
    // In a ball the mean square radius is 3/5; half of the points are within the cube root of a half.
    let square = one.iter().map(|d| d.length_squared()).sum::<f64>() / count;
    assert!((square - 0.6).abs() < 5.0 * (12.0 / 175.0 / count).sqrt(), "{square}");
    let inner = one.iter().filter(|d| d.length() < 0.5_f64.cbrt()).count() as f64 / count;
    assert!((inner - 0.5).abs() < 2.5 / count.sqrt(), "{inner}");
    let average = one.iter().sum::<DVec3>() / count;
    assert!(average.length() < 5.0 / count.sqrt(), "{average}");
    assert_eq!(displacements(1, 0.0), one);
    for other in [displacements(2, 0.0), displacements(1, 0.1)] {
        let correlation = one.iter().zip(&other).map(|(a, b)| a.dot(*b)).sum::<f64>() / count;
        assert!(correlation.abs() < 5.0 / count.sqrt(), "{correlation}");
    }
    assert_eq!(
        Jitter { amplitude_rel: 0.0, seed: 1 }.advance(&surface, 0.0, 0.1).unwrap().ends,
        surface.positions()
    );
}
