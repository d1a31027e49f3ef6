//! Surface types.

mod ids;
mod soup;
mod tri_mesh;

pub use ids::{EdgeId, TriId, VertexId};
pub use soup::{Group, TriangleSoup};
pub use tri_mesh::TriMesh;
