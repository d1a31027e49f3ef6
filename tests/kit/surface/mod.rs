//! Surfaces of the tracker, slow and obvious: [`PlainSurface`], a list of triangles that is rebuilt by every operation.

mod meshes;
mod plain;
mod replay;
mod winding;

pub use meshes::{Named, closed_surfaces, non_manifold_surfaces, open_surfaces, tube_between};
pub use plain::PlainSurface;
pub use replay::Replay;
pub use winding::winding_number;
