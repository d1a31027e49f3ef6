//! Integration tests of `welter_predicates`, against the exact oracles of the kit.

#![allow(clippy::unwrap_used, reason = "a panic is the report of a test")]
#![allow(clippy::print_stdout, reason = "a test says what it skipped")]

mod ccd;
mod ccd_adversarial;
mod ccd_batch;
mod ccd_oracle;
mod ccd_rates;
mod family;
mod intersection;
mod laws;
mod linear;
mod moved_grid;
mod oracle;
mod parity;
mod perturbation;
mod rates;
mod regressions;
mod sos;
mod spacetime;
mod values;
