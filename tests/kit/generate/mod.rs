//! Generators of hard input: coordinates ([`number`]) and configurations of points ([`Kind`],
//! [`graded`]) and their motions ([`Movement`]), systems of linear equations ([`system`]), volumetric meshes ([`volumes`]).

pub mod graded;
mod movement;
pub mod number;
mod points;
mod strategy;
mod systems;
pub mod volumes;

pub use movement::Movement;
pub use points::Kind;
pub use strategy::{points, seeded};
pub use systems::system;
