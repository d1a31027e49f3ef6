//! Mean-curvature normals at the vertices: [`mean_curvature_normals`].
//!
//! Convention: `H n`, where `H = (k1 + k2) / 2` is the mean of the principal curvatures, positive where the
//! surface bends away from its outward normal `n` as a sphere does; on a sphere of radius `R` it is the
//! position over `R^2`. Unit: 1 / length. The Laplacian of the positions is `-2 H n`; the gradient of area is
//! `2 H n` times the vertex' area.
//!
//! Method: the cotangent formula [Meyer03, equations 8 and 9],
//! ```text
//!   H n (x_i) = 1 / (4 A_i) * sum over edges ij of (cot alpha_ij + cot beta_ij) (x_i - x_j)
//! ```
//! written as the gradient of the area of each triangle with respect to its corner `a`,
//! `1/2 (b - c) x m` with unit normal `m`, which is the same sum and stays bounded as the triangle degenerates.
//! `A_i` is the mixed Voronoi area of [Meyer03, figure 4]: the areas of all vertices add up to that of the surface.
//!
//! Error, in the root mean square over the area: of order 2 in the edge length where the surroundings of vertices are
//! nearly symmetric (measured on tori of revolution), about 1.75 on geodesic spheres. It need not converge at single
//! irregular vertices, as no formula on one ring of triangles does. Complexity: linear.

use super::extent::{self, Scale};
use crate::surface::TriMesh;
use glam::DVec3;

/// What [`mean_curvature_normals`] finds, indexed by [`VertexId`](crate::surface::VertexId).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeanCurvature {
    /// Mean curvature times unit outward normal, in 1 / length. Zero where a vertex has no area. On the
    /// boundary of a surface it also holds the pull of the boundary.
    pub normals: Vec<DVec3>,
    /// Mixed Voronoi area of each vertex, in length^2.
    pub areas: Vec<f64>,
}

/// Mean curvature times outward unit normal at each vertex of a surface whose triangles are counterclockwise seen
/// from outside (for the other orientation the result is the same: the product does not depend on it).
///
/// ```
/// use welter_meshing::{shapes, surface::measure::mean_curvature_normals};
/// let ball = shapes::sphere(&shapes::Sphere { radius: 2.0, edge_length: 0.1, ..Default::default() })?;
/// let curvature = mean_curvature_normals(&ball);
/// assert!((curvature.normals[100].length() - 0.5).abs() < 1e-3);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
///
/// Values beyond the range of `f64` (a surface smaller than 1e-308) are infinite.
#[must_use]
pub fn mean_curvature_normals(mesh: &TriMesh) -> MeanCurvature {
    let count = mesh.positions().len();
    let mut normals = vec![DVec3::ZERO; count];
    let mut areas = vec![0.0; count];
    let Some(bounds) = extent::bounding_box(mesh) else { return MeanCurvature { normals, areas } };
    let scale = Scale::of_box(bounds);
    for triangle in mesh.triangles() {
        let x = triangle.map(|v| mesh.positions()[v.index()]);
        // Side k is opposite to corner k.
        let sides = [0, 1, 2].map(|k| scale.vector(x[(k + 2) % 3], x[(k + 1) % 3]));
        let double = sides[0].cross(sides[1]);
        let double_area = double.length();
        if double_area == 0.0 {
            continue;
        }
        let unit_normal = double / double_area;
        let shares = mixed_areas(sides, double_area);
        for k in 0..3 {
            let v = triangle[k].index();
            // With x_b - x_c = -side.
            normals[v] += 0.5 * unit_normal.cross(sides[k]);
            areas[v] += shares[k];
        }
    }
    for (normal, area) in normals.iter_mut().zip(&mut areas) {
        if *area > 0.0 {
            let scaled = *normal / (2.0 * *area);
            *normal = DVec3::from_array(scaled.to_array().map(|c| libm::scalbn(c, -scale.exponent)));
            *area = libm::scalbn(*area, 2 * scale.exponent);
        } else {
            *normal = DVec3::ZERO;
        }
    }
    MeanCurvature { normals, areas }
}

/// How a triangle's area is shared among its corners [Meyer03, figure 4]: to the nearest corner if it is not
/// obtuse; else half to the obtuse corner and a quarter to each other.
fn mixed_areas(sides: [DVec3; 3], double_area: f64) -> [f64; 3] {
    // The cosine at corner k has the sign of - side (k + 1) . side (k + 2).
    let dots = [0, 1, 2].map(|k| -sides[(k + 1) % 3].dot(sides[(k + 2) % 3]));
    if let Some(obtuse) = (0..3).find(|&k| dots[k] < 0.0) {
        let mut shares = [double_area / 8.0; 3];
        shares[obtuse] = double_area / 4.0;
        return shares;
    }
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        // Side i is seen from corner i; cotangents are dots over the double area.
        (sides[i].length_squared() * dots[i] + sides[j].length_squared() * dots[j]) / (8.0 * double_area)
    })
}
