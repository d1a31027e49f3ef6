//! Distance fields: numbers at the nodes of a grid that tell how far a surface is, and on which side of it they are.

mod caps;
mod field;
mod flat;
mod nearest;
mod parameters;
mod search;
mod slabs;
mod winding;

pub use field::{DistanceField, signed_distance, unsigned_distance};
pub use parameters::{DistanceError, DistanceParameters, InsideRule};
pub use winding::{GridWindingNumbers, grid_winding_numbers};
