//! Integration tests of `welter_tracking`, against the exact oracles of the kit.

#![allow(clippy::unwrap_used, reason = "a panic is the report of a test")]
#![allow(clippy::print_stdout, reason = "a test tells its figures")]

mod broad_phase;
mod collision;
mod flows;
pub(crate) mod improvement;
mod integration;
mod quadric;
mod surface;
mod tracker;
