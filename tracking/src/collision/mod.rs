//! Collision, as numbers: when moving primitives first touch, how near they come, where, and along which
//! normal.
//!
//! | question | where |
//! | --- | --- |
//! | when do they first touch? | [`time_of_impact`] |
//! | when are they first within a distance? | [`minimum_separation`] |
//! | which of their points are closest, at rest? | [`closest_points`] |
//!
//! Each asked of a vertex and a face, of two edges, and of a vertex and a segment of the plane. Vertices move
//! on straight lines at constant speed from their place at time 0 to their place at time 1.
//!
//! # What it promises
//! * Never late: no contact, and no approach within the distance, happens before the time that is returned;
//!   none is missed. This is proven for every finite `f64`, for degenerate primitives and for motion in a
//!   plane or on a line.
//! * Whether there is a contact at all is exact: it is `welter_predicates::ccd`'s answer.
//! * Numbers come with bounds that hold, at every scale: all is computed in units of the largest coordinate
//!   difference.
//! * Multiplying all coordinates by a power of two that keeps them representable changes no bit of a time,
//!   weight or normal.
//! * No allocation, no panic, and a bounded number of steps.
//!
//! # What it does not promise
//! The same bits under renaming of vertices or axes: the brackets overlap, for they hold the same time.
//!
//! # Method
//! The difference of two primitives is a moving polygon (`pair`, `motion`) that is met by the origin when
//! they touch. Its closest point (`polygon`) gives directions along which it stays away for a while, proven
//! in rounded arithmetic (`support`, `advance`). What that leaves open between its last time and the contact
//! is asked of the exact predicates.

mod advance;
pub mod closest_points;
mod error;
pub mod minimum_separation;
mod motion;
mod pair;
mod polygon;
mod response;
mod support;
pub mod time_of_impact;

pub use closest_points::ClosestPoints;
pub use error::CollisionError;
pub use minimum_separation::{Approach, MinimumSeparationParameters};
pub(crate) use polygon::{length, unit};
pub use time_of_impact::{Impact, TimeOfImpactParameters};

use welter_predicates::Point;

fn coordinates<const D: usize, const P: usize>(points: [impl Point<D>; P]) -> [[f64; D]; P] {
    points.map(Point::coords)
}
