//! What a flow refuses: [`FlowError`].

use glam::DVec3;
use thiserror::Error;
use welter_meshing::surface::{TriId, VertexId};

/// Why a flow predicts nothing.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FlowError {
    /// A parameter is out of range.
    #[error("{name} is {value}, must be {must}")]
    Parameter {
        /// Which parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be.
        must: &'static str,
    },
    /// The time step is not a finite number above zero.
    #[error("the time step is {dt}, must be finite and above 0")]
    TimeStep {
        /// The time step asked for.
        dt: f64,
    },
    /// A velocity is infinite or not a number.
    #[error(
        "the velocity at ({}, {}, {}), time {time}, for vertex {}, is ({}, {}, {})",
        position.x, position.y, position.z, vertex.0, velocity.x, velocity.y, velocity.z
    )]
    Velocity {
        /// For which vertex it was asked; the first.
        vertex: VertexId,
        /// Where: at the vertex, or where a stage of the scheme looks ahead.
        position: DVec3,
        /// When.
        time: f64,
        /// The velocity.
        velocity: DVec3,
    },
    /// A speed along the normal is infinite or not a number.
    #[error(
        "the normal speed at ({}, {}, {}), time {time}, in the middle of triangle {}, is {speed}",
        position.x, position.y, position.z, triangle.0
    )]
    Speed {
        /// In the middle of which triangle; the first.
        triangle: TriId,
        /// Where.
        position: DVec3,
        /// When.
        time: f64,
        /// The speed.
        speed: f64,
    },
    /// A vertex would end beyond the range of numbers.
    #[error("vertex {} would move from ({}, {}, {}) to ({}, {}, {})",
        vertex.0, start.x, start.y, start.z, end.x, end.y, end.z)]
    End {
        /// Which vertex; the first.
        vertex: VertexId,
        /// Where it is.
        start: DVec3,
        /// Where it would be.
        end: DVec3,
    },
    /// The longest step that the flow allows is so short that time would not go on.
    #[error("a step of {dt} at time {time} may take {limit} at most, which is no time")]
    NoProgress {
        /// The time at the beginning.
        time: f64,
        /// The step asked for.
        dt: f64,
        /// The longest allowed.
        limit: f64,
    },
}

impl FlowError {
    /// Refuses a parameter unless it is what it must be.
    pub(crate) fn require(
        ok: bool,
        name: &'static str,
        value: f64,
        must: &'static str,
    ) -> Result<(), FlowError> {
        if ok { Ok(()) } else { Err(FlowError::Parameter { name, value, must }) }
    }

    /// Refuses a vector with a component that is not finite.
    pub(crate) fn require_finite(name: &'static str, vector: DVec3) -> Result<(), FlowError> {
        let bad = vector.to_array().into_iter().find(|c| !c.is_finite());
        bad.map_or(Ok(()), |value| Err(FlowError::Parameter { name, value, must: "finite" }))
    }
}
