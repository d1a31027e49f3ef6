//! Exact geometric predicates: signs and yes/no answers that are right for every finite `f64`.

#![no_std]
#![forbid(unsafe_code)]

mod arithmetic;
pub mod ccd;
mod filter;
mod finite;
mod incircle;
mod insphere;
pub mod intersection;
mod orient2d;
mod orient3d;
mod orient4d;
mod point;
mod polynomial;
mod sign;
pub mod sos;
mod stage;
pub mod staged;
pub mod stats;

pub use finite::NonFinite;
pub use incircle::{incircle, incircle_value, try_incircle};
pub use insphere::{insphere, insphere_value, try_insphere};
pub use orient2d::{orient2d, orient2d_value, try_orient2d};
pub use orient3d::{orient3d, orient3d_value, try_orient3d};
pub use orient4d::{orient4d, orient4d_value, try_orient4d};
pub use point::Point;
pub use sign::Sign;
pub use stage::Stage;
