//! Surfaces, their files, spatial queries and volumetric meshes.
//!
//! # What it promises
//! * A type says what was proven of a surface: [`surface::TriMesh`] that it is finite with indices in range,
//!   [`surface::ClosedOrientedMesh`] that each directed edge has its reverse. Each is reached only through a check that
//!   returns every defect with its ids.
//! * Questions of yes or no about surfaces (which triangles intersect, is a point inside) are exact for every finite
//!   coordinate: they are answered by `welter_predicates`.
//! * The same input gives the same bits for any number of threads.
//! * No input makes it panic or take memory out of proportion: malformed files and meshes are typed errors.
//!
//! # What it does not promise
//! Numbers (areas, volumes, points) are rounded; where a bound is known it is stated. Nothing is repaired silently.

#![forbid(unsafe_code)]

pub mod cut_cells;
pub mod distance;
pub mod field;
pub mod grid;
pub mod io;
pub mod isosurface;
mod monitor;
pub mod quadrature;
pub mod remesh;
pub mod shapes;
pub mod spatial;
pub mod surface;
pub mod volumetric;

pub use glam::{DVec2, DVec3};
pub use monitor::{Cancelled, Monitor, Progress, Stage};
