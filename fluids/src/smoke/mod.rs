//! Smoke as a surface: a mesh encloses uniform smoke, and a flow carries it \[Brochu12, chapter 5\].
//!
//! # What it holds
//! * [`Emission`]: surfaces that are released over time, as data; [`Schedule`]: at which times.
//! * [`FogLayer`]: closes sheets to layers, for the renderer.
//! * [`SmokeSimulation`]: releases and carries them; [`SmokeParameters`] says how, [`SmokeStep`] what a step did, [`SmokeState`] where
//!   a run stands.
//!
//! # What it promises
//! * An emission depends on its parameters and the index of the release alone, so a run that is resumed releases what one that was
//!   never stopped does, bit for bit.
//! * Every release falls into exactly one of the steps that a run takes, however they divide the time.
//! * What a run promises is in [`SmokeSimulation`].

mod carrier;
mod emission;
mod error;
mod fog_layer;
mod parameters;
mod report;
mod schedule;
mod simulation;
mod state;

pub(crate) use emission::next_release;
pub use emission::{Emission, EmissionError, EmittedShape, Joining};
pub use error::{SmokeError, SmokeParameterError};
pub use fog_layer::{ClosedSmoke, FogLayer, FogLayerError};
pub use parameters::{OverBudget, SmokeParameters};
pub use report::{Refusal, Released, SmokeStep};
pub use schedule::{Release, Schedule};
pub use simulation::SmokeSimulation;
pub use state::SmokeState;
