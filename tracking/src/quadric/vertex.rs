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

/// Up to this length, and from its reciprocal on, what is computed from edges is in the range of normal numbers and
/// so has the bits that it has in any other unit. What underflows even so is beyond the last bit of what it is added to.
const ORDINARY: f64 = (1_u128 << 100) as f64;

/// Sums over the triangles at a vertex.
struct Sums {
    /// Of the normals, by twice the area.
    normals: DVec3,
    /// Of the squares of the unit normals, by twice the area.
    matrix: SymmetricMatrix,
    /// The largest component of an edge out of the vertex.
    longest: f64,
}

impl Sums {
    /// Over triangles given by their two edges out of the vertex.
    #[inline]
    fn over(triangles: impl Iterator<Item = [DVec3; 2]>) -> Self {
        let mut sums = Self { normals: DVec3::ZERO, matrix: SymmetricMatrix::ZERO, longest: 0.0 };
        let mut longest = DVec3::ZERO;
        for [one, other] in triangles {
            longest = longest.max(one.abs()).max(other.abs());
            let doubled = one.cross(other);
            let area = doubled.length();
            if area > 0.0 {
                sums.normals += doubled;
                sums.matrix.add_square(doubled, area.recip());
            }
        }
        sums.longest = longest.max_element();
        sums
    }
}

impl VertexQuadric {
    /// The quadric of a vertex: that of a vertex without triangles, or with such of no area only, has rank 0.
    ///
    /// # Panics
    /// If the id was never given out.
    #[must_use]
    pub fn new(surface: &MovingSurface, vertex: VertexId) -> Self {
        let mesh = surface.connectivity();
        let center = surface.position(vertex);
        let edges = || mesh.star(vertex).map(|h| [mesh.head(h), mesh.apex(h)].map(|v| surface.position(v)));
        let whole = Sums::over(edges().map(|ends| ends.map(|end| end - center)));
        if whole.longest >= ORDINARY.recip() && whole.longest <= ORDINARY {
            return Self::of_sums(whole.normals, whole.matrix);
        }
        let scale = Scale::of_star(surface, vertex);
        let scaled = Sums::over(edges().map(|ends| ends.map(|end| scale.difference(end, center))));
        Self::of_sums(scaled.normals, scaled.matrix)
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
