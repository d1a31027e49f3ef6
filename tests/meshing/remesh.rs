//! Tests of `welter_meshing::remesh`: the shape of triangles on smooth fields, second order of distance, topology and embedding whatever the field
//! does, the laws of scaling and of threads, and what is refused.

mod hostile;
mod laws;
mod shape;

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::field::ScalarField;
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{MarchingCubes, marching_cubes};
use welter_meshing::remesh::{Equilateral, RemeshReport, StartingMesh, equilateral, starting_mesh};
use welter_meshing::surface::{ClosedOrientedMesh, EmbeddedMesh, Topology, TriMesh};

type Field = fn(DVec3) -> f64;

fn ball(p: DVec3) -> f64 {
    p.length() - 0.9
}

fn torus(p: DVec3) -> f64 {
    (p.x.hypot(p.y) - 0.6).hypot(p.z) - 0.27
}

fn two_balls(p: DVec3) -> f64 {
    let at = |x: f64, r: f64| (p - DVec3::new(x, 0.1 * x, 0.03)).length() - r;
    at(-0.5, 0.35).min(at(0.4, 0.42))
}

/// The smooth union of three balls, without any symmetry.
fn blobs(p: DVec3) -> f64 {
    let balls = [[0.0, 0.0, 0.05, 0.45], [0.45, 0.13, 0.0, 0.33], [-0.4, 0.2, 0.17, 0.36]];
    let at = |[x, y, z, r]: [f64; 4]| (-8.0 * ((p - DVec3::new(x, y, z)).length() - r)).exp();
    -balls.map(at).iter().sum::<f64>().ln() / 8.0
}

/// A sheet around the gyroid within a ball, the corner between the two rounded.
fn gyroid(p: DVec3) -> f64 {
    let q = 3.5 * p;
    let value = q.x.sin() * q.y.cos() + q.y.sin() * q.z.cos() + q.z.sin() * q.x.cos();
    let (sheet, sphere) = (value.abs() / 5.0 - 0.13, p.length() - 0.9);
    let blend = (0.15 - (sheet - sphere).abs()).max(0.0) / 0.15;
    sheet.max(sphere) + 0.25 * 0.15 * blend * blend
}

/// Two balls and a bar between them, blended near the balls.
fn dumbbell(p: DVec3) -> f64 {
    let balls = DVec3::new(p.x.abs() - 0.5, p.y, p.z).length() - 0.38;
    let bar = (p - DVec3::new(p.x.clamp(-0.5, 0.5), 0.0, 0.0)).length() - 0.17;
    let blend = (0.1 - (balls - bar).abs()).max(0.0) / 0.1;
    balls.min(bar) - 0.25 * 0.1 * blend * blend
}

fn ellipsoid(p: DVec3) -> f64 {
    (p / DVec3::new(0.9, 0.6, 0.45)).length_squared() - 1.0
}

/// A grid over [-1, 1]^3 with so many cells.
fn grid(cells: u32) -> Grid3 {
    Grid3::covering([-1.0; 3], [1.0; 3], 2.0 / f64::from(cells), 1).unwrap()
}

fn cubes(grid: &Grid3, field: &impl ScalarField) -> EmbeddedMesh {
    let samples = Samples::of(grid, field, &Monitor::none()).unwrap();
    marching_cubes(&samples, &MarchingCubes::default(), &Monitor::none()).unwrap()
}

fn start(grid: &Grid3, field: &impl ScalarField) -> (EmbeddedMesh, RemeshReport) {
    starting_mesh(grid, field, &StartingMesh::default(), &Monitor::none()).unwrap()
}

fn remeshed(mesh: &EmbeddedMesh, field: &impl ScalarField, edge_length: f64) -> (EmbeddedMesh, RemeshReport) {
    let parameters = Equilateral { edge_length, ..Equilateral::default() };
    equilateral(mesh, field, &parameters, &Monitor::none()).unwrap()
}

/// Everything that is promised of a result, checked anew.
fn assert_kept(before: &TriMesh, after: &TriMesh) {
    ClosedOrientedMesh::check(after).unwrap();
    let closed = ClosedOrientedMesh::new(after.clone()).unwrap();
    EmbeddedMesh::check(&closed, &Monitor::none()).unwrap();
    let [old, new] = [before, after].map(Topology::of);
    let genera = |topology: &Topology| {
        let mut genera: Vec<Option<u64>> = topology.components().iter().map(|c| c.genus).collect();
        genera.sort_unstable();
        genera
    };
    assert_eq!(genera(&old), genera(&new));
    assert!(new.is_edge_manifold() && new.is_vertex_manifold() && new.unreferenced_vertices().is_empty());
}
