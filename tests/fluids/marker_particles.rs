//! Marker particles: what a run keeps and refuses, and their pictures against a slow twin, closed forms and those of surfaces.

mod pictures;
mod refused;
mod runs;

use glam::DVec3;
use welter_fluids::marker_particles::{MarkerParameters, MarkerSimulation};
use welter_fluids::procedural::{
    Amplitude, AnyPotential, VortexRing, VortexRingParameters, Weighted, WeightedSum,
};
use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule};
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::ClosedOrientedMesh;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};

fn ball(center: DVec3, radius: f64, edge_length: f64) -> ClosedOrientedMesh {
    sphere(&Sphere { center, radius, edge_length }).unwrap()
}

fn every(shape: ClosedOrientedMesh, start: f64, interval: f64) -> Emission {
    Emission {
        shape: EmittedShape::Closed(shape),
        schedule: Schedule { start, interval, count: None },
        joining: Joining::Separate,
        path: None,
    }
}

/// Two emitters of different sizes, with all lengths times a factor.
fn emissions(factor: f64) -> Vec<Emission> {
    let low = ball(DVec3::ZERO, 0.35 * factor, 0.15 * factor);
    let high = ball(factor * DVec3::new(0.1, 1.0, 0.2), 0.25 * factor, 0.1 * factor);
    vec![every(low, 0.0, 0.15), every(high, 0.1, 0.2)]
}

/// A rising ring in noise, without divergence; all lengths times a factor.
fn rising(factor: f64) -> WeightedSum<AnyPotential<'static>> {
    let ring = VortexRingParameters {
        radius: factor,
        core: 0.3 * factor,
        circulation: 3.0 * factor * factor,
        ..VortexRingParameters::default()
    };
    let noise = CurlNoiseParameters {
        wavelength: factor,
        speed: 0.3 * factor,
        octaves: 2,
        waves: 8,
        ..CurlNoiseParameters::default()
    };
    let part = |part| Weighted { part, amplitude: Amplitude::Constant(1.0) };
    WeightedSum::new(vec![
        part(AnyPotential::new(VortexRing::new(&ring).unwrap())),
        part(AnyPotential::new(CurlNoise::new(&noise).unwrap())),
    ])
}

fn run(emissions: Vec<Emission>, parameters: MarkerParameters) -> MarkerSimulation {
    MarkerSimulation::new(emissions, parameters, &Monitor::none()).unwrap()
}

/// A run of some steps with particles in a number, and all lengths times a factor.
fn advanced(factor: f64, particles: usize, steps: u32) -> MarkerSimulation {
    let parameters = MarkerParameters::within(&emissions(factor), particles, 0.5).unwrap();
    let mut smoke = run(emissions(factor), parameters);
    for k in 1..=steps {
        let _ = smoke.step_to(&rising(factor), 0.05 * f64::from(k), &Monitor::none()).unwrap();
    }
    smoke
}

fn bits(smoke: &MarkerSimulation) -> Vec<u64> {
    let state = smoke.state();
    let numbers = state.positions.iter().flat_map(|p| p.to_array()).chain(state.ages.iter().copied());
    numbers.chain([state.time]).map(f64::to_bits).collect()
}
