//! Where the moved planes of the triangles around a vertex meet: [`VertexOffset`].

use glam::DVec3;
use welter_meshing::surface::VertexId;

use super::sector;
use crate::quadric::scale::Scale;
use crate::quadric::{SymmetricMatrix, VertexQuadric};
use crate::surface::MovingSurface;

/// The star of a vertex whose triangles move along their normals.
pub(super) struct VertexOffset<'s> {
    surface: &'s MovingSurface,
    speeds: &'s [f64],
    vertex: VertexId,
    scale: &'s Scale,
    /// The displacement in a unit of time that follows the planes best.
    velocity: DVec3,
}

impl<'s> VertexOffset<'s> {
    /// Solves for the displacement of a vertex in a unit of time; speeds are by triangle id.
    pub(super) fn new(
        surface: &'s MovingSurface,
        scale: &'s Scale,
        speeds: &'s [f64],
        vertex: VertexId,
        threshold: f64,
    ) -> Self {
        let mut offset = Self { surface, speeds, vertex, scale, velocity: DVec3::ZERO };
        let (mut normals, mut matrix, mut moved) = (DVec3::ZERO, SymmetricMatrix::ZERO, DVec3::ZERO);
        for (one, other, speed) in offset.sectors() {
            let doubled = one.cross(other);
            let area = doubled.length();
            if area > 0.0 {
                normals += doubled;
                matrix.add_square(doubled, area.recip());
                moved += speed * doubled;
            }
        }
        // The eigenvalues are those of the matrix over its trace.
        let trace = matrix.diagonal.element_sum();
        let quadric = VertexQuadric::of_sums(normals, matrix);
        for k in 0..quadric.rank(threshold) {
            let axis = quadric.eigenvectors[k];
            offset.velocity += axis.dot(moved / trace) / quadric.eigenvalues[k] * axis;
        }
        offset
    }

    /// The meeting point of the planes.
    pub(super) fn sharp(&self) -> DVec3 {
        self.velocity
    }

    /// The same direction, no farther than the front of the star.
    pub(super) fn with_entropy(&self) -> DVec3 {
        let Some(direction) = self.velocity.try_normalize() else { return self.velocity };
        let (mut forward, mut backward) = (false, false);
        let mut farthest: f64 = 0.0;
        for (one, other, speed) in self.sectors() {
            if one.cross(other) == DVec3::ZERO {
                continue;
            }
            forward |= speed > 0.0;
            backward |= speed < 0.0;
            farthest = farthest.max(speed.abs() / sector::distance(direction, one, other));
        }
        let beyond = self.velocity.length() > farthest;
        if beyond && !(forward && backward) { farthest * direction } else { self.velocity }
    }

    /// For each triangle at the vertex the edges out of it, in scaled units, and its speed.
    fn sectors(&self) -> impl Iterator<Item = (DVec3, DVec3, f64)> + '_ {
        let mesh = self.surface.connectivity();
        let center = self.surface.position(self.vertex);
        let edge = move |to: VertexId| self.scale.difference(self.surface.position(to), center);
        mesh.star(self.vertex)
            .map(move |h| (edge(mesh.head(h)), edge(mesh.apex(h)), self.speeds[h.triangle().index()]))
    }
}
