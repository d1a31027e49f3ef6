//! Spatial queries on triangles, exact where the answer is a yes or no or a list.
//!
//! | question | answer | kind |
//! | --- | --- | --- |
//! | which triangles of a mesh intersect each other | [`self_intersections`], [`Bvh::self_intersections`] | exact |
//! | is a mesh free of that | [`EmbeddedMesh`](crate::surface::EmbeddedMesh) | exact |
//! | how often does a surface wind around a point | [`winding_number`], [`WindingNumbers`] | exact |
//! | which triangles meet a ray, a box | [`Bvh::ray_hits`], [`Bvh::triangles_meeting`] | exact |
//! | which boxes of triangles meet each other, or a box | [`Bvh::self_pairs`], [`Bvh::pairs_with`], [`Bvh::boxes_meeting`] | exact about boxes |
//! | which point of a mesh is closest | [`Bvh::closest_point`] | construction with a stated bound |
//! | the same pairs for any boxes | [`BoxTree`] | exact about boxes |
//!
//! All of it holds for every finite `f64`, and is the same for any number of threads.

mod box3;
mod bvh;
mod chord;
pub(crate) mod closest;
mod descent;
pub(crate) mod frame;
mod ray;
mod self_intersection;
mod tree;
mod triangle_pair;
mod winding;

pub use box3::Box3;
pub use bvh::{Bvh, RefitError};
pub(crate) use chord::chord;
pub use closest::ClosestPoint;
pub use self_intersection::{Sharing, self_intersections};
pub use tree::BoxTree;
pub use triangle_pair::meet_in_more;
pub use winding::{Winding, WindingNumbers, winding_number};
