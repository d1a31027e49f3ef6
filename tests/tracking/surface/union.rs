//! The union of a surface and a shape: against exact winding numbers, closed forms and the exact check of the kit.

mod laws;
mod named;
mod random;
mod refused;
mod values;

use glam::DVec3;
use welter_kit::exact::intersects_itself;
use welter_kit::mesher::Random;
use welter_kit::surface::winding_number;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Box_, Sphere, Torus, box_, sphere, torus};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use welter_tracking::surface::{MovingSurface, UnionError, UnionParameters, UnionReport};

fn ball(center: DVec3, radius: f64, edge_length: f64) -> ClosedOrientedMesh {
    sphere(&Sphere { center, radius, edge_length }).unwrap()
}

fn cuboid(min: [f64; 3], max: [f64; 3], edge_length: f64) -> ClosedOrientedMesh {
    box_(&Box_ { min: min.into(), max: max.into(), edge_length }).unwrap()
}

fn ring(edge_length: f64) -> ClosedOrientedMesh {
    torus(&Torus { edge_length, ..Torus::default() }).unwrap()
}

/// The same with other positions.
fn moved(mesh: &TriMesh, place: impl Fn(DVec3) -> DVec3) -> ClosedOrientedMesh {
    let mut soup = mesh.to_soup();
    soup.positions.iter_mut().for_each(|p| *p = place(*p));
    ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
}

/// Several meshes as one.
fn together(meshes: &[&TriMesh]) -> TriMesh {
    let mut soup = TriangleSoup::default();
    for mesh in meshes {
        let count = soup.positions.len() as u32;
        soup.positions.extend(mesh.positions());
        soup.triangles.extend(mesh.triangles().iter().map(|corners| corners.map(|v| v.0 + count)));
    }
    TriMesh::new(soup).unwrap()
}

fn unite(surface: &mut MovingSurface, shape: &ClosedOrientedMesh) -> Result<UnionReport, UnionError> {
    surface.unite(shape, &UnionParameters::default(), &Monitor::none())
}

/// Admissible, and free of self-intersection by the oracle.
fn check(surface: &MovingSurface) {
    assert_eq!(surface.check(), Ok(()));
    let mesh = surface.to_mesh();
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.to_array()).collect();
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|corners| corners.map(|v| v.0)).collect();
    assert!(!intersects_itself(&positions, &triangles));
}

/// The union winds as the larger of both sides about random points around them; how many points there were of which number.
fn check_windings(
    before: &TriMesh,
    shape: &TriMesh,
    after: &TriMesh,
    random: &mut Random,
    points: usize,
) -> [usize; 3] {
    let all = || before.positions().iter().chain(shape.positions());
    let min = all().copied().reduce(DVec3::min).unwrap();
    let max = all().copied().reduce(DVec3::max).unwrap();
    let mut counts = [0; 3];
    for _ in 0..points {
        let point = min + (max - min) * (0.5 + 0.51 * random.point());
        let [a, b, union] = [before, shape, after].map(|mesh| winding_number(mesh, point));
        assert_eq!(union, a.max(b), "{a} and {b} about {point}");
        counts[union.clamp(0, 2) as usize] += 1;
    }
    counts
}

/// Everything, in bits.
fn bits(surface: &MovingSurface) -> (Vec<[u64; 3]>, Vec<[u32; 3]>) {
    let mesh = surface.to_mesh();
    let positions = mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    (positions, mesh.triangles().iter().map(|corners| corners.map(|v| v.0)).collect())
}
