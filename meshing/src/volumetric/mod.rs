//! Volumetric meshes whose overlapping sheets stay apart \[Gagniere22\]: hexahedra on the cells of a grid, several on the same
//! cell where a surface overlaps itself.

mod hex_mesh;
mod tet_mesh;

pub use hex_mesh::{HexMesh, HexMeshError, QUADRILATERALS};
pub use tet_mesh::TetMesh;
