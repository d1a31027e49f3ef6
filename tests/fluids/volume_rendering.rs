//! The volume renderer against closed forms, a ray tracer that is slow and obvious, and its own symmetries.

mod closed_forms;
mod degenerate;
mod laws;
mod twin;
mod voxels;

use glam::DVec3;
use welter_fluids::volume_rendering::{
    Camera, Image, Light, Medium, Picture, RenderParameters, RenderReport, Scene, render,
};
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

/// White smoke alone, lit and seen from directions that no shape has as an axis.
fn scene(smoke: &ClosedOrientedMesh, extinction: f64) -> Scene<'_> {
    Scene {
        smoke,
        ages: &[],
        solids: &[],
        camera: Camera::toward(DVec3::new(1.3, 1.1, 4.2), DVec3::new(0.03, 0.02, 0.01)),
        light: Light { direction: DVec3::new(0.9, -1.2, -0.7), ..Light::default() },
        medium: Medium::white(extinction),
        background: [0.2, 0.3, 0.5],
    }
}

fn parameters(width: u32, height: u32, shadow_resolution: u32) -> RenderParameters {
    RenderParameters { width, height, shadow_resolution, ..RenderParameters::default() }
}

fn drawn(scene: &Scene<'_>, parameters: &RenderParameters) -> (Picture, RenderReport) {
    render(scene, parameters, &Monitor::none()).unwrap()
}

fn ball(center: DVec3, radius: f64, edge_length: f64) -> ClosedOrientedMesh {
    sphere(&Sphere { center, radius, edge_length }).unwrap()
}

/// Several surfaces as one.
fn together(parts: Vec<ClosedOrientedMesh>) -> ClosedOrientedMesh {
    let mut all = TriangleSoup::default();
    for part in parts {
        let base = all.positions.len() as u32;
        let soup = part.into_mesh().into_soup();
        all.positions.extend(soup.positions);
        all.triangles.extend(soup.triangles.iter().map(|t| t.map(|v| v + base)));
    }
    ClosedOrientedMesh::new(TriMesh::new(all).unwrap()).unwrap()
}

/// The surface with each position changed.
fn moved(mesh: &ClosedOrientedMesh, to: impl Fn(DVec3) -> DVec3) -> ClosedOrientedMesh {
    let mut soup = mesh.to_soup();
    soup.positions.iter_mut().for_each(|p| *p = to(*p));
    ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
}

/// The largest difference of two planes, in parts of the largest value of the first.
fn difference(a: &Image<f32>, b: &Image<f32>) -> f64 {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()));
    let most = a.pixels().iter().fold(0.0_f32, |most, &p| most.max(p));
    let worst = a.pixels().iter().zip(b.pixels()).fold(0.0_f32, |worst, (p, q)| worst.max((p - q).abs()));
    f64::from(worst) / f64::from(most)
}
