//! Generators of hard input: coordinates ([`number`]) and configurations of points ([`Kind`],
//! [`graded`]).

pub mod graded;
pub mod number;
mod points;
mod strategy;

pub use points::Kind;
pub use strategy::{points, seeded};
