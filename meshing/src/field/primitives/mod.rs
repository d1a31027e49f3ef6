//! Exact signed distances of simple bodies.

mod boxes;
mod cylinder;
mod ellipsoid;
mod half_space;
mod round;

pub use boxes::Cuboid;
pub use cylinder::Cylinder;
pub use ellipsoid::Ellipsoid;
pub use half_space::HalfSpace;
pub use round::{Ball, Capsule, Torus};
