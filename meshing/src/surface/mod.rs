//! Surfaces of triangles, as types that promise more and more.
//!
//! ```text
//! TriangleSoup         what a file holds: nothing is promised
//!   TriMesh            finite positions, indices in range, no repeated index in a triangle
//!     ClosedOrientedMesh   each directed edge has its reverse partner; may intersect itself
//!       EmbeddedMesh       proven free of self-intersection
//! ```
//! Each step upward is a checking constructor that returns every defect with its ids; each step downward is free.

mod closed_oriented;
mod duplicates;
pub(crate) mod edges;
mod embedded;
mod ids;
pub(crate) mod list;
pub mod measure;
mod soup;
pub(crate) mod topology;
mod tri_mesh;

pub use closed_oriented::{ClosedOrientedDefects, ClosedOrientedError, ClosedOrientedMesh, EdgeDefect};
pub use duplicates::{degenerate_triangles, duplicate_triangles, duplicate_vertices};
pub use embedded::{EmbeddedError, EmbeddedMesh, SelfIntersections};
pub use ids::{EdgeId, TriId, VertexId};
pub use soup::{Group, TriangleSoup};
pub use topology::{BoundaryLoop, Component, Topology};
pub use tri_mesh::{
    MAX_TRIANGLES, MAX_VERTICES, NonFiniteVertex, TriMesh, TriMeshDefects, TriMeshError, TriangleIndices,
};
