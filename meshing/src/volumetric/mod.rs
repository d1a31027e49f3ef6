//! Volumetric meshes whose overlapping sheets stay apart \[Gagniere22\]: hexahedra on the cells of a grid, several on the same
//! cell where a surface overlaps itself.

mod assembly;
mod cells;
mod characteristic;
mod coarsen;
mod coarsened;
mod complex;
mod continued;
mod copies;
mod crossings;
mod edges;
mod error;
mod extension;
mod faces;
mod frame;
mod gluing;
mod hex_mesh;
mod homology;
mod hosts;
mod mesher;
mod neighbours;
mod outward;
mod pairing;
mod parameters;
mod pieces;
pub mod plane;
mod precursors;
mod quality;
mod rows;
mod shared_union_find;
mod sheets;
mod sides;
mod tet_mesh;
mod tetrahedra;
mod verify;
mod volume;
mod walls;

pub use coarsen::{CoarsenError, Coarsening, TopologyChange, TopologyReport, coarsen, coarsen_checked};
pub use complex::{
    CellCounts, ComponentLabels, Components, TetError, TetMeshError, euler_characteristics,
    euler_characteristics_of_tetrahedra,
};
pub use error::{Place, VolumeError};
pub use hex_mesh::{HexMesh, HexMeshError, QUADRILATERALS};
pub use homology::{BettiError, BettiLimits, BettiNumbers, betti_numbers, betti_numbers_of_tetrahedra};
pub use hosts::{Host, Hosts};
pub use outward::outward;
pub use parameters::{Resolution, VolumeParameters};
pub use quality::{DIHEDRAL_BINS, RATIO_BINS, TetQuality, tetrahedra_quality};
pub use sides::{BoundarySide, boundary_sides};
pub use tet_mesh::TetMesh;
pub use tetrahedra::{Tetrahedra, TetrahedraError, TetrahedronPoint, tetrahedra};
pub use verify::{Finding, Findings, Verification, verify, verify_conversion};
pub use volume::{VolumeMesh, mesh_volume};
