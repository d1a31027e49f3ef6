//! Smoke as marker particles: points that fill what is released and are carried by a flow.
//!
//! # What it computes
//! What [`smoke`](crate::smoke) does with surfaces, with points instead: each carries the same volume of smoke. It is the
//! method that smoke as a surface is measured against \[Brochu12, section 5.5\], with the same emissions, flows and times, and
//! [`render_particles`](crate::volume_rendering::render_particles) draws it in the same light.
//!
//! # What it holds
//! * [`fill`]: points that fill a closed surface evenly.
//! * [`MarkerSimulation`]: releases and carries them; [`MarkerParameters`] says how, [`MarkerStep`] what a step did, [`MarkerState`]
//!   where a run stands.
//!
//! # What it promises
//! The same bits for any number of threads, and for a run that is resumed from a state; more in each of them.
//!
//! # What it does not promise
//! A picture without grain: the density of points follows from where they happen to be. How much worse than that of a surface of
//! as many bytes it is, `cargo bench -p welter-benches --bench smoke_storage` tells.

mod error;
mod fill;
mod parameters;
mod simulation;
mod state;

pub use error::{MarkerError, Unfilled};
pub use fill::fill;
pub use parameters::MarkerParameters;
pub use simulation::{MarkerRelease, MarkerSimulation, MarkerStep};
pub use state::MarkerState;
