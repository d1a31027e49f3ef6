//! The sphere, as a geodesic icosahedron: [`sphere`]; and two of them: [`two_spheres`].
//!
//! Method: each face of the icosahedron is divided into `n^2` triangles by a regular grid (any frequency `n`, not
//! only powers of two) and the grid points are moved out to the sphere. 20 n^2 triangles, 10 n^2 + 2 vertices, of
//! which 12 have five neighbours and the others six. Edge lengths differ by a factor of up to 1.8 at large `n`.

use super::error::{
    ShapeError, divisions, finish, require, require_coordinates, require_length, require_triangles,
};
use crate::surface::{ClosedOrientedMesh, TriangleSoup};
use glam::DVec3;

/// Parameters of [`sphere`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre. Default: the origin.
    pub center: DVec3,
    /// Radius, positive. Default: 1, so that volume and curvature are easy to compare with their exact values.
    pub radius: f64,
    /// Longest edge wanted, positive. Default: 0.05, which gives 14,580 triangles.
    pub edge_length: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { center: DVec3::ZERO, radius: 1.0, edge_length: 0.05 }
    }
}

/// The angle that an edge of the icosahedron spans at its centre: arccos(1 / sqrt 5).
const EDGE_ANGLE: f64 = 1.107_148_717_794_090_4;

/// A sphere: genus 0, no self-intersection.
///
/// ```
/// use welter_meshing::shapes::{Sphere, sphere};
/// let mesh = sphere(&Sphere { radius: 2.0, edge_length: 0.5, ..Sphere::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 4);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn sphere(parameters: &Sphere) -> Result<ClosedOrientedMesh, ShapeError> {
    let &Sphere { center, radius, edge_length } = parameters;
    require_coordinates("center", center)?;
    require_length("radius", radius)?;
    require_length("edge_length", edge_length)?;
    // Moving out stretches the edges at a face's middle to 1.176 times their share of the angle.
    let frequency = divisions(1.176 * EDGE_ANGLE * radius, edge_length, 1);
    require_triangles(edge_length, 20.0 * frequency * frequency)?;
    let mut soup = unit_sphere(frequency as u32);
    for position in &mut soup.positions {
        *position = center + radius * *position;
    }
    Ok(finish(soup))
}

/// Parameters of [`two_spheres`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoSpheres {
    /// Distance of the centres, which lie on the x axis, symmetric to the origin; greater than two radii. Default: 0.5, as in
    /// \[Brochu12\] 3.3.1.
    pub distance: f64,
    /// Radius of both, positive. Default: 0.2, as there.
    pub radius: f64,
    /// Longest edge wanted, positive. Default: 0.0165, which gives 10,240 triangles (there the mean is about 0.02).
    pub edge_length: f64,
}

impl Default for TwoSpheres {
    fn default() -> Self {
        Self { distance: 0.5, radius: 0.2, edge_length: 0.0165 }
    }
}

/// Two spheres apart from each other, which merge when they move along their normals \[Brochu12\].
///
/// ```
/// use welter_meshing::shapes::{TwoSpheres, two_spheres};
/// let mesh = two_spheres(&TwoSpheres { edge_length: 0.05, ..TwoSpheres::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 8);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn two_spheres(parameters: &TwoSpheres) -> Result<ClosedOrientedMesh, ShapeError> {
    let &TwoSpheres { distance, radius, edge_length } = parameters;
    require_length("distance", distance)?;
    require_length("radius", radius)?;
    require(2.0 * radius < distance, "radius", radius, "less than half of the distance of the centres")?;
    let ball = |x: f64| sphere(&Sphere { center: DVec3::new(x, 0.0, 0.0), radius, edge_length });
    let first = ball(-0.5 * distance)?;
    let triangles = 2 * first.triangles().len();
    require_triangles(edge_length, triangles as f64)?;
    let (mut soup, second) = (first.to_soup(), ball(0.5 * distance)?.to_soup());
    let before = soup.positions.len() as u32;
    soup.positions.extend(second.positions);
    soup.triangles.extend(second.triangles.iter().map(|t| t.map(|v| v + before)));
    Ok(finish(soup))
}

/// The vertices of the icosahedron, on the unit sphere: the cyclic permutations of (0, +-1, +-golden ratio).
fn icosahedron() -> [DVec3; 12] {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut vertices = [DVec3::ZERO; 12];
    for axis in 0..3 {
        for (i, (s, t)) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].into_iter().enumerate() {
            let mut v = [0.0; 3];
            v[(axis + 1) % 3] = s;
            v[(axis + 2) % 3] = t * golden;
            vertices[4 * axis + i] = unit(DVec3::from_array(v));
        }
    }
    vertices
}

/// The faces of an icosahedron, counterclockwise seen from outside: the triples of mutually adjacent vertices.
fn faces(vertices: &[DVec3; 12]) -> Vec<[usize; 3]> {
    // Neighbours have dot product 1/sqrt 5 = 0.447, all other pairs at most -0.447.
    let adjacent = |i: usize, j: usize| vertices[i].dot(vertices[j]) > 0.0;
    let mut faces = Vec::with_capacity(20);
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if adjacent(i, j) && adjacent(j, k) && adjacent(k, i) {
                    let outward = vertices[i].dot(vertices[j].cross(vertices[k])) > 0.0;
                    faces.push(if outward { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    faces
}

fn unit_sphere(frequency: u32) -> TriangleSoup {
    let n = frequency as usize;
    let corners = icosahedron();
    let faces = faces(&corners);
    let mut positions = corners.to_vec();
    positions.reserve(10 * n * n);
    let mut triangles = Vec::with_capacity(20 * n * n);

    // The inner points of each edge of the icosahedron, from its smaller to its larger corner.
    let mut edge_start = [[0u32; 12]; 12];
    for i in 0..12 {
        for j in i + 1..12 {
            if corners[i].dot(corners[j]) > 0.0 {
                edge_start[i][j] = positions.len() as u32;
                for step in 1..n {
                    let (s, t) = ((n - step) as f64, step as f64);
                    positions.push(unit(s * corners[i] + t * corners[j]));
                }
            }
        }
    }
    let on_edge = |from: usize, to: usize, step: usize| -> u32 {
        let index = if from < to { step - 1 } else { n - step - 1 };
        edge_start[from.min(to)][from.max(to)] + index as u32
    };

    for [a, b, c] in faces {
        // Grid point (i, j) is (n - i - j) a + i b + j c over n.
        let inner_start = positions.len() as u32;
        let mut grid = Vec::with_capacity((n + 1) * (n + 2) / 2);
        let mut inner = inner_start;
        for j in 0..=n {
            for i in 0..=n - j {
                let k = n - i - j;
                grid.push(match (k, i, j) {
                    (_, 0, 0) => a as u32,
                    (0, _, 0) => b as u32,
                    (0, 0, _) => c as u32,
                    (_, _, 0) => on_edge(a, b, i),
                    (_, 0, _) => on_edge(a, c, j),
                    (0, _, _) => on_edge(b, c, j),
                    _ => {
                        let sum = k as f64 * corners[a] + i as f64 * corners[b] + j as f64 * corners[c];
                        positions.push(unit(sum));
                        inner += 1;
                        inner - 1
                    }
                });
            }
        }
        let row = |j: usize| j * (n + 1) - j * j.saturating_sub(1) / 2;
        for j in 0..n {
            let (low, high) = (row(j), row(j + 1));
            for i in 0..n - j {
                triangles.push([grid[low + i], grid[low + i + 1], grid[high + i]]);
                if i + 1 < n - j {
                    triangles.push([grid[low + i + 1], grid[high + i + 1], grid[high + i]]);
                }
            }
        }
    }
    TriangleSoup { positions, triangles, ..TriangleSoup::default() }
}

/// Division and square root are correctly rounded: the same bits everywhere.
fn unit(v: DVec3) -> DVec3 {
    v / v.length_squared().sqrt()
}
