//! How far a surface is from a known one: [`errors`].

use glam::DVec3;
use welter_meshing::surface::TriMesh;

/// Distances of a surface from a known one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceErrors {
    /// The largest distance of a vertex.
    pub linf: f64,
    /// The mean distance of vertices, each weighted with a third of the area of its triangles.
    pub l1: f64,
    /// The mean of the signed distances, weighted alike: above 0 where the surface is too large.
    pub bias: f64,
}

/// The errors at the vertices of a surface, by the signed distance from the known one.
pub fn errors(mesh: &TriMesh, signed_distance: impl Fn(DVec3) -> f64) -> SurfaceErrors {
    let distances: Vec<f64> = mesh.positions().iter().map(|&p| signed_distance(p)).collect();
    let (mut linf, mut l1, mut bias, mut total): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|v| mesh.positions()[v.index()]);
        let third = (b - a).cross(c - a).length() / 6.0;
        for v in triangle {
            let distance = distances[v.index()];
            linf = linf.max(distance.abs());
            l1 += third * distance.abs();
            bias += third * distance;
            total += third;
        }
    }
    SurfaceErrors { linf, l1: l1 / total, bias: bias / total }
}

/// The Hausdorff distance between a surface around a point, all triangles included, and a sphere around that point.
///
/// No point of the sphere is farther from the surface than the surface is, at its farthest, from the sphere: the ray
/// through it meets the surface.
#[must_use]
pub fn hausdorff_to_sphere(mesh: &TriMesh, center: DVec3, radius: f64) -> f64 {
    let mut farthest: f64 = 0.0;
    for triangle in mesh.triangles() {
        let corners = triangle.map(|v| mesh.positions()[v.index()] - center);
        for corner in corners {
            farthest = farthest.max((corner.length() - radius).abs());
        }
        farthest = farthest.max((nearest_to_origin(corners) - radius).abs());
    }
    farthest
}

/// The distance of the origin from a triangle.
fn nearest_to_origin(corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let inside = (0..3).all(|k| corners[k].cross(corners[(k + 1) % 3]).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO {
        return normal.dot(a).abs() / normal.length();
    }
    let to_side = |k: usize| {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let along = to - from;
        let t = (-from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (from + t * along).length()
    };
    to_side(0).min(to_side(1)).min(to_side(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_of_triangles() {
        let at = |z: f64| [DVec3::new(-1.0, -1.0, z), DVec3::new(3.0, -1.0, z), DVec3::new(-1.0, 3.0, z)];
        assert_eq!(nearest_to_origin(at(2.0)), 2.0);
        assert_eq!(nearest_to_origin(at(0.0)), 0.0);
        assert_eq!(nearest_to_origin(at(0.0).map(|p| p + DVec3::splat(3.0) * DVec3::X)), 2.0);
        assert_eq!(nearest_to_origin(at(0.0).map(|p| p + DVec3::new(4.0, 4.0, 0.0))), 18f64.sqrt());
    }
}
