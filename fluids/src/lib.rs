//! Fluids over tracked surfaces and grids: procedural flows, grid smoke, vortex sheets with a fast multipole method,
//! Voronoi liquid, and a B-spline cut-cell solver.
//!
//! # What it promises
//! * The same scene gives the same bits for any number of threads.
//!
//! # What it will promise
//! * Each solver states what it conserves (circulation, volume, momentum, energy) and reports it every step.
//! * Convergence orders are stated in the documentation and asserted by tests against analytic solutions.
//!
//! # What it holds today
//! * [`marker_particles`]: smoke as points, which smoke as a surface is measured against.
//! * [`procedural`]: flow without simulation, from formulas with exact curls.
//! * [`smoke`]: smoke as a surface that is released over time and carried by a flow.
//! * [`volume_rendering`]: the picture of uniform smoke inside a closed surface.

#![forbid(unsafe_code)]

pub mod marker_particles;
pub mod procedural;
pub mod smoke;
pub mod volume_rendering;
