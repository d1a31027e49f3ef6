//! Why a tracker refuses a surface or a step: [`TrackerError`].

use crate::broad_phase::BroadPhaseError;
use crate::flows::FlowError;
use crate::improvement::ParameterError;
use crate::integration::IntegrationError;
use crate::surface::{AppendError, UnionError, VertexValueError};
use thiserror::Error;
use welter_meshing::Cancelled;

/// Why there is no tracker, or a step was not made; the surface is as it was before the step then.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TrackerError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// What is to be added is no surface.
    #[error(transparent)]
    Append(#[from] AppendError),
    /// What is to be united with the surface is not.
    #[error(transparent)]
    Union(#[from] UnionError),
    /// The flow predicts nothing.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// The flow gives a position that is none.
    #[error(transparent)]
    Position(#[from] VertexValueError),
    /// The flow made the step longer than asked for, or took no time.
    #[error("the flow made a step of {dt} where at most {asked} was asked for")]
    Step {
        /// The step that it made.
        dt: f64,
        /// The longest it should have made.
        asked: f64,
    },
    /// Positions cannot be accepted, or the surface intersects itself from the start.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The broad phase refuses positions.
    #[error(transparent)]
    BroadPhase(#[from] BroadPhaseError),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
