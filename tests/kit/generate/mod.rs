//! Generators of hard input: coordinates ([`number`]) and configurations of points ([`Kind`],
//! [`graded`]) and their motions ([`Movement`]).

pub mod graded;
mod movement;
pub mod number;
mod points;
mod strategy;

pub use movement::Movement;
pub use points::Kind;
pub use strategy::{points, seeded};
