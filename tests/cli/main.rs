//! Integration tests: the command `welter`, run as a user or a script runs it.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
#![allow(clippy::print_stdout, reason = "a test that cannot run here says so")]

mod bad_input;
mod ccd;
mod check;
mod codes;
mod convert;
mod demo;
mod doctor;
mod harness;
mod info;
mod interrupt;
mod isosurface;
mod mesh;
mod mesh_of_curves;
mod new;
mod outputs;
mod render;
mod report;
mod shape;
mod sim;
mod track;
mod track_runs;
mod usage;
mod view;
