//! Surfaces with predicted ends.

use glam::DVec3;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::surface::MovingSurface;

/// A number in [-1, 1) without pattern.
fn noise(i: usize) -> f64 {
    let z = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (z >> 11) as f64 / 2f64.powi(52) - 1.0
}

fn noise3(i: usize) -> DVec3 {
    DVec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2))
}

/// A sphere with about so many triangles, its edge length, and ends up to a tenth of that away along each axis.
pub(crate) fn sphere_in_motion(target: f64) -> (MovingSurface, f64, Vec<DVec3>) {
    // An equilateral triangle of edge length L has area sqrt(3) / 4 L^2; the unit sphere has 4 pi.
    let edge_length = (16.0 * std::f64::consts::PI / (3.0_f64.sqrt() * target)).sqrt();
    let mesh = sphere(&Sphere { edge_length, ..Sphere::default() }).expect("a sphere").into_mesh();
    let ends = mesh.positions().iter().enumerate().map(|(i, &p)| p + 0.1 * edge_length * noise3(i)).collect();
    (MovingSurface::new(&mesh).expect("admissible"), edge_length, ends)
}

/// Sheets in contact.
pub(crate) struct Contacts {
    pub(crate) name: &'static str,
    pub(crate) surface: MovingSurface,
    pub(crate) ends: Vec<DVec3>,
    pub(crate) length: f64,
}

/// Sheets of square cells of size 1 with two triangles each, somewhat uneven, one above the other.
fn stack(layers: usize, cells: usize, gap: f64) -> (TriMesh, Vec<usize>) {
    let (mut soup, mut layer_of) = (TriangleSoup::default(), Vec::new());
    for layer in 0..layers {
        let first = soup.positions.len();
        for y in 0..=cells {
            for x in 0..=cells {
                let at = DVec3::new(
                    x as f64 + 0.31 * layer as f64,
                    y as f64 + 0.17 * layer as f64,
                    gap * layer as f64,
                );
                soup.positions.push(at + DVec3::new(0.1, 0.1, 0.2 * gap) * noise3(soup.positions.len()));
                layer_of.push(layer);
            }
        }
        let id = |x: usize, y: usize| (first + y * (cells + 1) + x) as u32;
        for (x, y) in (0..cells).flat_map(|y| (0..cells).map(move |x| (x, y))) {
            let [a, b, c, d] = [id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)];
            soup.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (TriMesh::new(soup).expect("a stack"), layer_of)
}

fn scene(
    name: &'static str,
    layers: usize,
    cells: usize,
    gap: f64,
    motion: impl Fn(usize, usize) -> DVec3,
) -> Contacts {
    let (mesh, layer_of) = stack(layers, cells, gap);
    let ends = mesh.positions().iter().enumerate().map(|(i, &p)| p + motion(layer_of[i], i)).collect();
    Contacts { name, surface: MovingSurface::new(&mesh).expect("admissible"), ends, length: 1.2 }
}

pub(crate) fn contacts() -> Vec<Contacts> {
    let mut all = Vec::new();
    for cells in [24, 50] {
        all.push(scene("stacked sheets", 5, cells, 0.05, |layer, i| {
            DVec3::new(0.0, 0.0, -0.04 * layer as f64) + 0.02 * noise3(7 * i)
        }));
        all.push(scene("sliding sheets", 5, cells, 0.05, |layer, i| {
            let side = if layer.is_multiple_of(2) { 0.5 } else { -0.5 };
            DVec3::new(side, 0.3 * side, -0.06 * layer as f64) + 0.02 * noise3(7 * i)
        }));
    }
    all
}
