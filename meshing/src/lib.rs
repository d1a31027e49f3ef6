//! Surfaces, their files, spatial queries and volumetric meshes.

#![forbid(unsafe_code)]

pub mod io;
mod monitor;
pub mod shapes;
pub mod spatial;
pub mod surface;

pub use glam::{DVec2, DVec3};
pub use monitor::{Cancelled, Monitor, Progress, Stage};
