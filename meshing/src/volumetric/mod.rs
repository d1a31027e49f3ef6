//! Volumetric meshes whose overlapping sheets stay apart \[Gagniere22\]: hexahedra on the cells of a grid, several on the same
//! cell where a surface overlaps itself.

mod assembly;
mod cells;
mod copies;
mod crossings;
mod error;
mod extension;
mod frame;
mod gluing;
mod hex_mesh;
mod hosts;
mod mesher;
mod outward;
mod pairing;
mod parameters;
mod pieces;
mod precursors;
mod rows;
mod sheets;
mod tet_mesh;
mod volume;
mod walls;

pub use error::{Place, VolumeError};
pub use hex_mesh::{HexMesh, HexMeshError, QUADRILATERALS};
pub use hosts::{Host, Hosts};
pub use outward::outward;
pub use parameters::{Resolution, VolumeParameters};
pub use tet_mesh::TetMesh;
pub use volume::{VolumeMesh, mesh_volume};
