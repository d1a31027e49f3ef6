//! Integration tests of `welter_fluids`, against slow twins and exact solutions of the kit.

#![allow(clippy::unwrap_used, reason = "a panic is the report of a test")]
#![allow(clippy::print_stdout, reason = "a test tells its figures")]

mod marker_particles;
mod procedural;
mod smoke;
mod volume_rendering;
