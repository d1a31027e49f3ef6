//! Smoke as a surface: what a run keeps, releases and refuses.

mod ages;
mod budget;
mod conservation;
mod fog_layers;
mod laws;
mod releases;
mod unions;
mod walls;

use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, VortexRing, VortexRingParameters, Weighted, WeightedSum,
};
use welter_fluids::smoke::{
    Emission, EmittedShape, Joining, Schedule, SmokeParameters, SmokeSimulation, SmokeStep,
};
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::flows::VelocityField;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};

/// A number of an environment variable, for runs longer than those of every day.
fn setting(name: &str, default: u32) -> u32 {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} is {text:?}, no such number")),
        Err(_) => default,
    }
}

fn ball(center: DVec3, radius: f64, edge_length: f64) -> EmittedShape {
    EmittedShape::Closed(sphere(&Sphere { center, radius, edge_length }).unwrap())
}

/// A square in the plane of x and z, of side 1 and n times n cells.
fn sheet(n: u32) -> EmittedShape {
    let at = |k: u32| f64::from(k) / f64::from(n) - 0.5;
    let positions =
        (0..=n).flat_map(|j| (0..=n).map(move |i| DVec3::new(at(i), 0.0, at(j)))).collect::<Vec<_>>();
    let cell = |i: u32, j: u32| {
        let a = j * (n + 1) + i;
        [[a, a + n + 2, a + 1], [a, a + n + 1, a + n + 2]]
    };
    let triangles = (0..n).flat_map(|j| (0..n).flat_map(move |i| cell(i, j))).collect();
    EmittedShape::Open(TriMesh::new(TriangleSoup { positions, triangles, ..Default::default() }).unwrap())
}

fn once(shape: EmittedShape) -> Emission {
    Emission { shape, schedule: Schedule::default(), joining: Joining::Separate, path: None }
}

fn every(shape: EmittedShape, start: f64, interval: f64) -> Emission {
    Emission { schedule: Schedule { start, interval, count: None }, ..once(shape) }
}

/// A rising ring in noise, without divergence; all lengths times a factor.
fn rising(factor: f64) -> WeightedSum<AnyPotential<'static>> {
    stirred(factor, 2.0)
}

/// The same with a ring of another circulation, where lengths are one.
fn stirred(factor: f64, circulation: f64) -> WeightedSum<AnyPotential<'static>> {
    let ring = VortexRingParameters {
        center: factor * DVec3::new(0.0, 0.2, 0.0),
        axis: DVec3::Y,
        radius: 0.6 * factor,
        core: 0.3 * factor,
        circulation: circulation * factor * factor,
    };
    let noise = CurlNoiseParameters { seed: 7, wavelength: factor, speed: factor, ..Default::default() };
    WeightedSum::new(vec![
        Weighted {
            part: AnyPotential::new(VortexRing::new(&ring).unwrap()),
            amplitude: Amplitude::Constant(1.0),
        },
        Weighted {
            part: AnyPotential::new(CurlNoise::new(&noise).unwrap()),
            amplitude: Amplitude::Constant(0.3),
        },
    ])
}

fn run(emissions: Vec<Emission>, parameters: SmokeParameters) -> SmokeSimulation {
    SmokeSimulation::new(emissions, parameters, &Monitor::none()).unwrap()
}

fn step(smoke: &mut SmokeSimulation, flow: &impl VelocityField, end: f64) -> SmokeStep {
    smoke.step_to(flow, end, &Monitor::none()).unwrap()
}

/// The position and age of each vertex and all corners, in bits.
fn bits(smoke: &SmokeSimulation) -> (Vec<[u64; 4]>, Vec<[u32; 3]>) {
    let mesh = smoke.mesh();
    let vertex = |(p, age): (&DVec3, &f64)| [p.x, p.y, p.z, *age].map(f64::to_bits);
    let vertices = mesh.positions().iter().zip(smoke.ages()).map(vertex).collect();
    (vertices, mesh.triangles().iter().map(|corners| corners.map(|v| v.0)).collect())
}
