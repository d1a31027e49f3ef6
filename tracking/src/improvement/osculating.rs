//! The smooth surface that the vertices are on, near one of them: a polynomial of two coordinates in a plane across the normal,
//! fitted to the neighbours and to theirs \[Cazals05\].
//!
//! The polynomial goes through the vertex itself. It is a cubic one: with terms up to the second degree alone, the error of a
//! place half an edge away would be of the third order in the edge length, and that of a thousand small moves along the surface,
//! which is what smoothing does over the time steps that mean curvature asks for, of the first. The plane need not be
//! tangent: there are linear terms. Residuals are weighted by the inverse square of the distance, so near neighbours
//! count more. Neighbours more than 45 degrees off the plane are of another patch and are left out. With
//! too few left, or where the equations are singular, a quadratic one is tried, and then there is no fit.

use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;
use glam::DVec3;
use welter_meshing::surface::VertexId;

const QUADRATIC: usize = 5;
const CUBIC: usize = 9;

/// How many neighbours there are at least more than coefficients.
const SPARE: usize = 2;

/// Pivots below this part of their diagonal elements are taken for zero.
const SINGULAR: f64 = 1e-6;

/// The height over the plane through the vertex, which is the origin.
pub(crate) struct Osculating {
    center: DVec3,
    scale: Scale,
    axes: [DVec3; 2],
    normal: DVec3,
    /// Of [`monomials`].
    coefficients: [f64; CUBIC],
}

fn monomials(u: f64, v: f64) -> [f64; CUBIC] {
    [u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v]
}

impl Osculating {
    pub(crate) fn fit(surface: &MovingSurface, center: VertexId, normal: DVec3) -> Option<Self> {
        if !normal.is_normalized() {
            return None;
        }
        let scale = Scale::of_star(surface, center);
        let axes = <[DVec3; 2]>::from(normal.any_orthonormal_pair());
        let origin = surface.position(center);
        let mut points: Vec<[f64; 3]> = Vec::new();
        for w in two_rings(surface, center) {
            let way = scale.difference(surface.position(w), origin);
            let [u, v] = axes.map(|axis| axis.dot(way));
            let height = normal.dot(way);
            if height * height <= u * u + v * v && u * u + v * v > 0.0 {
                points.push([u, v, height]);
            }
        }
        let coefficients = fitted::<CUBIC>(&points).or_else(|| {
            let quadratic = fitted::<QUADRATIC>(&points)?;
            Some(std::array::from_fn(|i| quadratic.get(i).copied().unwrap_or(0.0)))
        })?;
        Some(Self { center: origin, scale, axes, normal, coefficients })
    }

    /// The point of the surface over, or under, the one that is `way` from the vertex. None where that is more than 45 degrees
    /// off the plane.
    pub(crate) fn place(&self, way: DVec3) -> Option<DVec3> {
        let [u, v] = self.axes.map(|axis| axis.dot(self.scale.scaled(way)));
        let height: f64 = monomials(u, v).iter().zip(self.coefficients).map(|(m, c)| m * c).sum();
        let place =
            self.center + self.scale.restored(u * self.axes[0] + v * self.axes[1] + height * self.normal);
        (height * height <= u * u + v * v && place.is_finite()).then_some(place)
    }
}

/// The neighbours and theirs, each once, without the center.
fn two_rings(surface: &MovingSurface, center: VertexId) -> Vec<VertexId> {
    let mesh = surface.connectivity();
    let ring = |v| mesh.star(v).flat_map(move |h| [mesh.head(h), mesh.apex(h)]);
    let mut all: Vec<VertexId> = ring(center).collect();
    all.sort_unstable();
    all.dedup();
    let second: Vec<VertexId> = all.iter().flat_map(|&v| ring(v)).collect();
    all.extend(second);
    all.sort_unstable();
    all.dedup();
    all.retain(|&v| v != center);
    all
}

/// The first `N` coefficients by weighted least squares.
fn fitted<const N: usize>(points: &[[f64; 3]]) -> Option<[f64; N]> {
    if points.len() < N + SPARE {
        return None;
    }
    let (mut matrix, mut right) = ([[0.0; N]; N], [0.0; N]);
    for &[u, v, height] in points {
        let row = monomials(u, v);
        let weight = 1.0 / (u * u + v * v);
        for i in 0..N {
            right[i] += weight * row[i] * height;
            for j in 0..N {
                matrix[i][j] += weight * row[i] * row[j];
            }
        }
    }
    solved(matrix, right)
}

/// By elimination without a choice of pivots: the matrix is positive definite, if it is not singular.
fn solved<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> Option<[f64; N]> {
    let diagonal: [f64; N] = std::array::from_fn(|i| matrix[i][i]);
    for k in 0..N {
        let (row, pivot) = (matrix[k], matrix[k][k]);
        if pivot.is_nan() || pivot <= SINGULAR * diagonal[k] {
            return None;
        }
        for i in k + 1..N {
            let factor = matrix[i][k] / pivot;
            for (element, above) in matrix[i].iter_mut().zip(row).skip(k) {
                *element -= factor * above;
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..N).rev() {
        for j in k + 1..N {
            right[k] -= matrix[k][j] * right[j];
        }
        right[k] /= matrix[k][k];
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of two rings on a surface over a plane.
    fn points(radius: f64, height: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
        (0..18)
            .map(|k| {
                let ring = if k < 6 { 1.0 } else { 2.0 };
                let turn = f64::from(k) * std::f64::consts::TAU / (6.0 * ring) + 0.1 * f64::from(k % 5);
                let (u, v) = (radius * ring * turn.cos(), radius * ring * turn.sin());
                [u, v, height(u, v)]
            })
            .collect()
    }

    #[test]
    fn cubic_surfaces_are_found() {
        let truth = [0.3, -0.2, 0.5, -0.7, 0.25, 0.1, -0.3, 0.2, 0.4];
        let found: [f64; CUBIC] =
            fitted(&points(0.5, |u, v| monomials(u, v).iter().zip(truth).map(|(m, c)| m * c).sum())).unwrap();
        for (f, t) in found.iter().zip(truth) {
            assert!((f - t).abs() < 1e-12, "{f} {t}");
        }
    }

    #[test]
    fn the_error_beside_a_vertex_is_of_the_fourth_order() {
        let error = |radius: f64| {
            let sine =
                |u: f64, v: f64| (u + 0.3).sin() * (1.5 * v + 0.2).cos() - 0.3_f64.sin() * 0.2_f64.cos();
            let c: [f64; CUBIC] = fitted(&points(radius, sine)).unwrap();
            let (u, v) = (0.4 * radius, 0.3 * radius);
            (monomials(u, v).iter().zip(c).map(|(m, c)| m * c).sum::<f64>() - sine(u, v)).abs()
        };
        let order = (error(0.1) / error(0.05)).log2();
        assert!((3.8..5.2).contains(&order), "{order}");
    }

    #[test]
    fn a_line_of_points_and_few_points_give_no_fit() {
        let line: Vec<[f64; 3]> = (1..20).map(|k| [0.1 * f64::from(k), 0.2 * f64::from(k), 0.0]).collect();
        assert_eq!(fitted::<QUADRATIC>(&line), None);
        assert_eq!(fitted::<QUADRATIC>(&points(1.0, |_, _| 0.0)[..6]), None);
        assert_eq!(fitted::<CUBIC>(&points(1.0, |_, _| 0.0)[..10]), None);
    }
}
