//! Flow primitives, against quadrature, automatic differentiation and fluxes.

mod boundaries;
mod confinement;
mod divergence;
mod filaments;
mod laws;
mod noise;
mod orders;
mod refused;
mod rings;
mod sources;
mod times;
mod walls;

use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, LocalPotential, VectorPotential, VortexFilament, VortexFilamentParameters,
    VortexRing, VortexRingParameters, Weighted, WeightedSum, Wind, WindParameters,
};
use welter_kit::evolution::Dual;
use welter_kit::mesher::Random;
use welter_kit::procedural::LineVortex;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};

fn ring(parameters: VortexRingParameters) -> VortexRing {
    VortexRing::new(&parameters).unwrap()
}

/// All primitives with a potential, with lengths times a factor.
fn potentials(factor: f64) -> Vec<(&'static str, AnyPotential<'static>)> {
    let ring = VortexRingParameters {
        center: factor * DVec3::new(0.1, -0.2, 0.3),
        axis: DVec3::new(1.0, 2.0, -0.5),
        radius: 0.8 * factor,
        core: 0.3 * factor,
        circulation: 2.0 * factor * factor,
    };
    let line = [[0.5, -1.0, 0.2], [0.1, 0.3, -0.4], [-0.6, 0.4, 0.5], [0.2, 1.0, 0.7]];
    let filament = VortexFilamentParameters {
        vertices: line.map(|v| factor * DVec3::from_array(v)).to_vec(),
        closed: true,
        core: 0.25 * factor,
        circulation: -1.5 * factor * factor,
    };
    let open = VortexFilamentParameters { closed: false, ..filament.clone() };
    let noise = CurlNoiseParameters { seed: 4, wavelength: factor, speed: factor, ..Default::default() };
    let wind = WindParameters {
        velocity: factor * DVec3::new(0.3, -1.0, 0.5),
        origin: factor * DVec3::new(0.5, 0.25, 1.0),
    };
    vec![
        ("ring", AnyPotential::new(VortexRing::new(&ring).unwrap())),
        ("closed filament", AnyPotential::new(VortexFilament::new(&filament).unwrap())),
        ("open filament", AnyPotential::new(VortexFilament::new(&open).unwrap())),
        ("curl noise", AnyPotential::new(CurlNoise::new(&noise).unwrap())),
        ("wind", AnyPotential::new(Wind::new(&wind).unwrap())),
    ]
}

/// All of them at once, with weights that do not depend on the scale.
fn mixture(factor: f64) -> WeightedSum<AnyPotential<'static>> {
    let weights = [1.0, 0.5, -0.75, 0.25, 0.5];
    let parts = potentials(factor).into_iter().zip(weights);
    WeightedSum::new(
        parts.map(|((_, part), weight)| Weighted { part, amplitude: Amplitude::Constant(weight) }).collect(),
    )
}

/// Compares a vortex with its sum at a point: potential and velocity, the curl of the twin's potential with its velocity, and that
/// the twin has no divergence. All within `tolerance` of the sums of magnitudes.
fn compare(flow: &impl VectorPotential, twin: &LineVortex, point: DVec3, tolerance: f64) {
    let LocalPotential { potential, curl } = flow.potential_and_curl(point, 0.0);
    let x = Dual::coordinates(point);
    let expected = twin.potential(x);
    let [of_potential, of_velocity, of_slope] = twin.magnitudes(point).map(|sum| tolerance * sum);
    let values = DVec3::from_array(expected.map(|c| c.value));
    let gap = (potential - values).length();
    assert!(gap <= of_potential, "{point}: potential {potential}, not {values}: {gap:e} > {of_potential:e}");
    let by_curl = Dual::curl(expected);
    let (velocity, divergence) = Dual::divergence(twin.velocity(x));
    for expected in [by_curl, velocity] {
        let gap = (curl - expected).length();
        assert!(gap <= of_velocity, "{point}: velocity {curl}, not {expected}: {gap:e} > {of_velocity:e}");
    }
    assert!(divergence.abs() <= of_slope, "{point}: divergence {divergence:e} > {of_slope:e}");
}

/// Points of a cube around the origin.
fn points(count: usize, size: f64, seed: u64) -> Vec<DVec3> {
    let mut random = Random::new(seed);
    (0..count).map(|_| size * random.point()).collect()
}
