//! Areas of closed curves that may intersect themselves, as quadrilaterals on the cells of a grid: the volumetric mesher in the plane,
//! \[Gagniere22\] 3.10.1.
//!
//! # Method
//! The plane becomes one layer of cells, and the curve an upright wall through it. Where the wall meets cells and cuts edges is told by
//! segments (`front`); all behind that is the volumetric mesher's. The lower side of the layer is the mesh.

mod area;
mod front;
mod hosts;
mod joined;
mod polylines;
mod quad_mesh;
mod triangles;
mod turning;
mod verify;

pub use area::{AreaMesh, mesh_area};
pub use hosts::{AreaHost, AreaHosts};
pub use joined::JoinError;
pub use polylines::{ClosedPolylines, PolylineDefects};
pub use quad_mesh::{QuadMesh, QuadMeshError};
pub use triangles::AreaTriangles;
pub use verify::{AreaFinding, AreaVerification, verify_area};
