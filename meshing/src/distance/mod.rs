//! Distance fields: numbers at the nodes of a grid that tell how far a surface is, and on which side of it they are.
//!
//! | question | answer | kind |
//! | --- | --- | --- |
//! | how often does a surface wind around each node | [`grid_winding_numbers`] | exact |
//! | how far is each node from a closed surface, and on which side | [`signed_distance`] | the sign exact, the distance with a stated bound |
//! | how far is each node from a mesh | [`unsigned_distance`] | construction with a stated bound |
//! | how far is each node from the zero contour of a level set | [`redistance`] | converges with a stated order |
//! | what is a quantity known inside, continued outside | [`extrapolate`] | converges with a stated order |
//!
//! # What it promises
//! The same bits for any number of threads; no panic and no endless loop on any numbers, finite or not.
//!
//! # What it does not promise
//! Gradients of length one where nodes are at the same distance from several parts of a surface.

mod caps;
mod extrapolation;
mod field;
mod flat;
mod interface;
mod nearest;
mod parameters;
mod redistance;
mod search;
mod slabs;
mod winding;

pub use extrapolation::{
    Degree, ExtrapolationError, ExtrapolationParameters, ExtrapolationReport, extrapolate,
};
pub use field::{DistanceField, signed_distance, unsigned_distance};
pub use parameters::{DistanceError, DistanceParameters, InsideRule};
pub use redistance::{RedistanceError, RedistanceParameters, RedistanceReport, redistance};
pub use winding::{GridWindingNumbers, grid_winding_numbers};
