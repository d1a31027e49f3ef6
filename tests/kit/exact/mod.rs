//! Exact oracles on unbounded integers.

mod clip;
pub mod collision;
mod determinant;
mod lift;
pub mod linear;
mod meeting;
mod moved;
pub mod moving;
mod orient;
mod patch;
pub mod rational;
mod rounding;
mod self_intersection;
mod spacetime;
mod surd;

pub use clip::clip_to_box;
pub use determinant::determinant;
pub use lift::lift;
pub use meeting::{Corner, Meeting, meeting, meeting_of_integers, meeting_of_ray, meeting_of_ray_through};
pub use moved::{MovedLine, moved_box_meets, moved_orient};
pub use orient::{in_sphere, in_sphere_value, orient, orient_value};
pub use patch::{infinitesimal, ray_bilinear_patch};
pub use rounding::nearest_f64;
pub use self_intersection::{intersects_itself, self_intersections};
pub use spacetime::swept_meet;
