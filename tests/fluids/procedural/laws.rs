//! What must not change velocities: the scale, the number of threads; and positions that are none.

use super::{mixture, points, potentials};
use glam::DVec3;
use welter_fluids::procedural::{
    BoundaryParameters, Bounded, DivergentSource, DivergentSourceParameters, Extent, Moving, Path,
    ScalarNoiseParameters, SourceNoise, VectorPotential,
};
use welter_meshing::field::{Cuboid, Torus};
use welter_meshing::shapes::{Sphere, sphere};
use welter_tracking::flows::{Advection, Flow, FlowError, VelocityField};
use welter_tracking::surface::MovingSurface;

fn source(factor: f64, extent: Extent) -> DivergentSource {
    let waves = ScalarNoiseParameters { wavelength: factor, ..Default::default() };
    let parameters = DivergentSourceParameters {
        center: factor * DVec3::new(0.2, -0.1, 0.3),
        radius: 0.7 * factor,
        expansion: 1.5,
        extent,
        noise: Some(SourceNoise { waves, ..Default::default() }),
    };
    DivergentSource::new(&parameters).unwrap()
}

fn bounded(factor: f64) -> Bounded<impl VectorPotential, Torus> {
    let torus = Torus { radius: 0.75 * factor, tube_radius: 0.25 * factor, ..Torus::default() };
    let path = Path::new(
        vec![(0.0, DVec3::ZERO), (1.0, factor * DVec3::new(0.5, 0.25, 0.0))],
        welter_fluids::procedural::Interpolation::Smooth,
    );
    let path = path.unwrap();
    let parameters = BoundaryParameters {
        ramp_width: 0.5 * factor,
        anchor: Some(factor * DVec3::new(0.1, 0.0, 0.0)),
        path: Some(path.clone()),
    };
    Bounded::new(Moving { part: mixture(factor), path }, torus, &parameters).unwrap()
}

#[test]
fn lengths_times_a_power_of_two_give_velocities_times_that_power() {
    let places = points(100, 1.5, 91);
    for k in [-440_i32, -200, -3, 1, 40, 200, 440] {
        let factor = 2f64.powi(k);
        let same = |name: &str, one: DVec3, other: DVec3| {
            assert_eq!(factor * one, other, "{name}, 2^{k}");
        };
        for ((name, one), (_, large)) in potentials(1.0).into_iter().zip(potentials(factor)) {
            for &p in &places {
                let (a, b) = (one.potential_and_curl(p, 0.4), large.potential_and_curl(factor * p, 0.4));
                same(name, a.curl, b.curl);
                same(name, factor * a.potential, b.potential);
            }
        }
        for extent in [Extent::Confined, Extent::Unbounded] {
            let (one, large) = (source(1.0, extent), source(factor, extent));
            for &p in &places {
                same("source", one.velocity(p, 0.4), large.velocity(factor * p, 0.4));
                assert_eq!(one.divergence(p, 0.4), large.divergence(factor * p, 0.4));
            }
        }
        // Distances to solids are lengths between 1e-75 and 1e75.
        if k.abs() <= 200 {
            let (one, large) = (bounded(1.0), bounded(factor));
            for &p in &places {
                same("bounded", one.velocity(p, 0.4), large.velocity(factor * p, 0.4));
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let shape = Sphere { radius: 0.5, edge_length: 0.05, ..Sphere::default() };
    let surface = MovingSurface::new(&sphere(&shape).unwrap()).unwrap();
    assert!(surface.positions().len() > 1000);
    let flow = Advection::new(bounded(1.0));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| flow.advance(&surface, 0.2, 0.1).unwrap())
    };
    let one = on(1);
    for threads in [2, 5] {
        assert!(on(threads) == one, "{threads} threads");
    }
}

/// Numbers at every finite position; none at others, which advection then refuses.
#[test]
fn hostile_positions() {
    let cuboid = Cuboid::default();
    let parameters = BoundaryParameters { ramp_width: 0.5, ..Default::default() };
    let around = Bounded::new(mixture(1.0), cuboid, &parameters).unwrap();
    let sources = [Extent::Confined, Extent::Unbounded].map(|extent| source(1.0, extent));
    let values = [0.0, -0.0, 5e-324, 1e-300, 1e-160, 0.5, 1.0, 1e8, 1e100, 1e150];
    for &x in &values {
        for &y in &values {
            for z in [0.0, -1.0, 1e-200, 1e120] {
                let p = DVec3::new(x, -y, z);
                for (name, flow) in potentials(1.0) {
                    assert!(flow.velocity(p, 0.0).is_finite(), "{name} {p}");
                }
                assert!(around.velocity(p, 0.0).is_finite(), "{p}");
                assert!(
                    sources
                        .iter()
                        .all(|s| s.velocity(p, 0.0).is_finite() && s.divergence(p, 0.0).is_finite())
                );
            }
        }
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for p in [DVec3::new(bad, 0.0, 0.0), DVec3::new(0.0, 1.0, bad), DVec3::splat(bad)] {
            for (name, flow) in potentials(1.0) {
                assert!(flow.velocity(p, 0.0).is_nan(), "{name} {p}");
            }
            assert!(around.velocity(p, 0.0).is_nan());
            assert!(sources.iter().all(|s| s.velocity(p, 0.0).is_nan() && s.divergence(p, 0.0).is_nan()));
        }
    }
}

/// A weight that overflows is refused by advection, with the vertex.
#[test]
fn velocities_that_are_no_numbers_are_refused_with_their_vertex() {
    let surface = MovingSurface::new(&sphere(&Sphere::default()).unwrap()).unwrap();
    let keys = welter_fluids::procedural::Amplitude::Constant(1e308);
    let parts = [1.0, 1.0].map(|_| welter_fluids::procedural::Weighted {
        part: |_: DVec3, _: f64| DVec3::splat(10.0),
        amplitude: keys.clone(),
    });
    let sum = welter_fluids::procedural::WeightedSum::new(parts.to_vec());
    let refused = Advection::new(sum).advance(&surface, 0.0, 1.0);
    assert!(matches!(refused, Err(FlowError::Velocity { .. })), "{refused:?}");
}
