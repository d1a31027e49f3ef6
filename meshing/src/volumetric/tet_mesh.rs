//! [`TetMesh`]: tetrahedra that came from hexahedra.

use crate::DVec3;

/// Tetrahedra; they hang together where they have vertices in common, never by lying at the same place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    /// Where the vertices are.
    pub positions: Vec<DVec3>,
    /// The corners of each tetrahedron, of positive volume: `(b - a) x (c - a) . (d - a) > 0`.
    pub tetrahedra: Vec<[u32; 4]>,
    /// The hexahedron that holds the centre of each tetrahedron, or one of the two.
    pub hexahedra: Vec<u32>,
}
