//! Exact oracles on unbounded integers and rationals.

mod determinant;
mod lift;
mod orient;

pub use determinant::determinant;
pub use lift::{lift, rational};
pub use orient::{in_sphere, orient};
