//! Smoke as a surface: what comes into being, when and where.
//!
//! # What it holds
//! * [`Emission`]: surfaces that are released over time, as data; [`Schedule`]: at which times.
//!
//! # What it promises
//! * An emission depends on its parameters and the index of the release alone, so a run that is resumed releases what one that was
//!   never stopped does, bit for bit.
//! * Every release falls into exactly one of the steps that a run takes, however they divide the time.
//!
//! # What it does not promise
//! Anything about released surfaces afterwards: that they stay apart, or free of intersections.

mod emission;
mod schedule;

pub use emission::{Emission, EmissionError, EmittedShape, Joining};
pub use schedule::{Release, Schedule};
