//! Generators of hard input: coordinates ([`number`]) and configurations of points ([`Kind`]).

pub mod number;
mod points;
mod strategy;

pub use points::Kind;
pub use strategy::{points, seeded};
