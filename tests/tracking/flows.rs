//! The flows, against exact solutions and other methods.

mod advection;
mod dumbbell;
mod face_offsetting;
mod fields;
mod laws;
mod mean_curvature;
mod refused;
mod step_limit;

use glam::DVec3;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::flows::{Flow, Prediction};
use welter_tracking::surface::MovingSurface;

fn ball(radius: f64, edge_length: f64) -> MovingSurface {
    MovingSurface::new(&sphere(&Sphere { radius, edge_length, ..Sphere::default() }).unwrap()).unwrap()
}

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap()
}

/// Takes predicted positions as they are.
fn follow(surface: &mut MovingSurface, prediction: &Prediction) {
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    for vertex in vertices {
        surface.set_position(vertex, prediction.ends[vertex.index()]).unwrap();
    }
}

/// Steps of at most `dt` from one time to another; how many they were.
fn run(surface: &mut MovingSurface, flow: &dyn Flow, [from, to]: [f64; 2], dt: f64) -> usize {
    let (mut time, mut steps) = (from, 0);
    while time < to {
        let left = to - time;
        let prediction = flow.advance(surface, time, dt.min(left)).unwrap();
        follow(surface, &prediction);
        // The last step may be the sum of what is left, up to a rounding.
        time = if prediction.dt == left { to } else { time + prediction.dt };
        steps += 1;
    }
    steps
}

/// The slope of the logarithms of errors over those of sizes, between the first and the last.
fn order(sizes: &[f64], errors: &[f64]) -> f64 {
    let last = sizes.len() - 1;
    (errors[0] / errors[last]).ln() / (sizes[0] / sizes[last]).ln()
}
