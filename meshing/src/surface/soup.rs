//! What a file holds before anything is promised of it: [`TriangleSoup`].

use glam::DVec3;
use std::ops::Range;

/// A named run of triangles: an OBJ group or object, a PLY or STL solid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name as in the file.
    pub name: String,
    /// The triangles that belong to it.
    pub triangles: Range<u32>,
}

/// Triangles as a file gives them. Coordinates may be infinite or NaN, indices out of range: `TriMesh::new` checks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleSoup {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Named runs of triangles, ascending and disjoint; may be empty.
    pub groups: Vec<Group>,
    /// One colour (red, green, blue) a triangle, or empty.
    pub triangle_colors: Vec<[u8; 3]>,
}
