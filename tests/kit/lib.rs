//! What the tests, the fuzz targets and the benchmarks share: generators of hard input and exact oracles.
//!
//! The oracles are written from the mathematics, not from the code under test: they are slow, obvious, and of
//! another kind where that is possible (a determinant by Laplace expansion of unbounded integers; an intersection
//! by enumerating the vertices of the polytope of barycentric weights). They promise to be right for every finite
//! `f64` and promise nothing about speed. Everything is deterministic in the bytes it is given.

#![cfg(feature = "oracles")]
#![forbid(unsafe_code)]

pub mod entropy;
pub mod evolution;
pub mod exact;
pub mod fuzz;
pub mod generate;
pub mod marker_particles;
pub mod mesher;
pub mod moving;
pub mod procedural;
pub mod surface;
pub mod volume_rendering;
pub mod volumetric;

/// The code in the project's README is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
