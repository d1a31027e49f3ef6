//! Spatial queries: bounding volume hierarchy, self-intersections, winding numbers.

mod box3;
mod bvh;
mod descent;
mod frame;
mod self_intersection;
mod tree;
mod triangle_pair;

pub use box3::Box3;
pub use bvh::{Bvh, RefitError};
pub use self_intersection::{Sharing, self_intersections};
pub use tree::BoxTree;
