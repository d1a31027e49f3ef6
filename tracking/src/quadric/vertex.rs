//! The quadric of the triangles around a vertex: [`VertexQuadric`].

use glam::DVec3;
use welter_meshing::surface::VertexId;

use super::eigen::SymmetricMatrix;
use super::scale::Scale;
use crate::surface::MovingSurface;

/// How the triangles around a vertex face: the eigenvalues and eigenvectors of their quadric.
///
/// ```
/// use welter_meshing::shapes::{Box_, box_};
/// use welter_tracking::{quadric::VertexQuadric, surface::MovingSurface};
///
/// let cube = MovingSurface::new(&*box_(&Box_ { edge_length: 0.5, ..Box_::default() })?)?;
/// let corners = cube.positions().iter().filter(|p| p.abs() == glam::DVec3::ONE).count();
/// let ranks = cube.connectivity().vertices().map(|v| VertexQuadric::new(&cube, v).rank(0.03));
/// assert_eq!((corners, ranks.filter(|&rank| rank == 3).count()), (8, 8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexQuadric {
    /// Descending, with sum 1 (up to roundings); all zero if no triangle at the vertex has an area.
    pub eigenvalues: [f64; 3],
    /// Orthonormal, in the order of the eigenvalues, of either sign.
    pub eigenvectors: [DVec3; 3],
    /// The mean of the normals, by area.
    mean: DVec3,
}

impl VertexQuadric {
    /// The quadric of a vertex: that of a vertex without triangles, or with such of no area only, has rank 0.
    ///
    /// # Panics
    /// If the id was never given out.
    #[must_use]
    pub fn new(surface: &MovingSurface, vertex: VertexId) -> Self {
        let mesh = surface.connectivity();
        let scale = Scale::of_star(surface, vertex);
        let center = surface.position(vertex);
        let (mut sum, mut matrix) = (DVec3::ZERO, SymmetricMatrix::ZERO);
        for half_edge in mesh.star(vertex) {
            let one = scale.difference(surface.position(mesh.head(half_edge)), center);
            let other = scale.difference(surface.position(mesh.apex(half_edge)), center);
            let doubled = one.cross(other);
            let area = doubled.length();
            if area > 0.0 {
                sum += doubled;
                matrix.add_square(doubled, area.recip());
            }
        }
        Self::of_sums(sum, matrix)
    }

    /// From the sums of `area normal` and `area normal normal^T`, in any unit.
    pub(crate) fn of_sums(sum: DVec3, mut matrix: SymmetricMatrix) -> Self {
        let trace = matrix.diagonal.element_sum();
        if trace > 0.0 {
            matrix.diagonal /= trace;
            matrix.beside /= trace;
        }
        let found = matrix.eigen_scaled();
        Self { eigenvalues: found.values, eigenvectors: found.vectors, mean: sum }
    }

    /// How many eigenvalues are at least `threshold` times the largest: 1 where the surface is smooth, 2 on a ridge, 3 at
    /// a corner; 0 if no triangle has an area.
    ///
    /// Two planes of equal weight whose normals differ by the angle `a` have the ratio tan^2(a / 2).
    #[must_use]
    pub fn rank(&self, threshold: f64) -> usize {
        let above = |&&value: &&f64| value > 0.0 && value >= threshold * self.eigenvalues[0];
        self.eigenvalues.iter().take_while(above).count()
    }

    /// The unit vector along the mean of the normals by area; the first eigenvector where that mean vanishes.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.mean.try_normalize().unwrap_or(self.eigenvectors[0])
    }

    /// The part of a vector along the eigenvectors that count towards the rank: the primary space.
    #[must_use]
    pub fn primary_part(&self, vector: DVec3, threshold: f64) -> DVec3 {
        let primary = &self.eigenvectors[..self.rank(threshold)];
        primary.iter().fold(DVec3::ZERO, |sum, &e| sum + e.dot(vector) * e)
    }

    /// The part of a vector along the other eigenvectors, in which the triangles do not see a motion to first order:
    /// the null space.
    #[must_use]
    pub fn null_part(&self, vector: DVec3, threshold: f64) -> DVec3 {
        let null = &self.eigenvectors[self.rank(threshold)..];
        null.iter().fold(DVec3::ZERO, |sum, &e| sum + e.dot(vector) * e)
    }
}
