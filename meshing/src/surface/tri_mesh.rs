//! [`TriMesh`].

use super::{Group, TriId, VertexId};
use glam::DVec3;

/// Finite positions, indices in range, no repeated index in a triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    positions: Vec<DVec3>,
    triangles: Vec<[VertexId; 3]>,
    groups: Vec<Group>,
}

impl TriMesh {
    /// Vertex positions.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The corners of each triangle.
    #[must_use]
    pub fn triangles(&self) -> &[[VertexId; 3]] {
        &self.triangles
    }

    /// Named runs of triangles.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The positions of a triangle's corners.
    #[must_use]
    pub fn corners(&self, triangle: TriId) -> [DVec3; 3] {
        self.triangles[triangle.index()].map(|v| self.positions[v.index()])
    }
}
