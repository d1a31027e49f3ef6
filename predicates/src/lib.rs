//! Exact geometric predicates: signs and yes/no answers that are right for every finite `f64`.

#![no_std]
#![forbid(unsafe_code)]

mod arithmetic;
mod finite;
pub mod intersection;
mod orient;
mod point;
mod sign;
pub mod sos;

pub use finite::NonFinite;
pub use orient::{incircle, insphere, orient2d, orient3d, orient4d};
pub use point::Point;
pub use sign::Sign;
