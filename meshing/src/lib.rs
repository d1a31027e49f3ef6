//! Surfaces, their files, spatial queries and volumetric meshes.

#![forbid(unsafe_code)]

pub mod io;
pub mod shapes;
pub mod spatial;
pub mod surface;

pub use glam::DVec3;
