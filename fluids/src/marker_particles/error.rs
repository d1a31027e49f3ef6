//! Why there is no run of particles, or no step of it: [`MarkerError`].

use glam::DVec3;
use thiserror::Error;
use welter_meshing::Cancelled;

use crate::smoke::EmissionError;

/// Why a closed surface was not filled.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Unfilled {
    /// Too few of the points tried in the box of the surface are inside.
    #[error("of {tried} points in the box around the surface {inside} are inside, {wanted} are wanted")]
    Thin {
        /// How many points are wanted.
        wanted: usize,
        /// How many were found.
        inside: usize,
        /// How many were tried.
        tried: u64,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Why there is no run, or no step of it.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum MarkerError {
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
    /// An emission is none.
    #[error("emission {emission}: {error}")]
    Emission {
        /// Which emission, from 0.
        emission: usize,
        /// Why.
        error: EmissionError,
    },
    /// An open shape has no inside to be filled.
    #[error("the shape of emission {emission} is open: it has no inside to be filled")]
    Open {
        /// Which emission, from 0.
        emission: usize,
    },
    /// An emission begins before the run does.
    #[error("emission {emission} begins at {begins}, before the run at {start}")]
    BeginsBefore {
        /// Which emission, from 0.
        emission: usize,
        /// When it begins.
        begins: f64,
        /// When the run does.
        start: f64,
    },
    /// The volume of a shape is beyond the range of numbers, or it is of no or too many particles.
    #[error(
        "the shape of emission {emission} has a volume of {volume}, which is of {particles} particles a release"
    )]
    Volume {
        /// Which emission, from 0.
        emission: usize,
        /// Its volume, as far as there is a number for it.
        volume: f64,
        /// Of how many particles it is.
        particles: f64,
    },
    /// A release would make more particles than there may be.
    #[error("a release of emission {emission} would make {particles} particles, there may be {most}")]
    TooMany {
        /// Which emission, from 0.
        emission: usize,
        /// How many there would be.
        particles: u64,
        /// How many there may be.
        most: usize,
    },
    /// A shape was not filled.
    #[error("the shape of emission {emission}: {error}")]
    Unfilled {
        /// Which emission, from 0.
        emission: usize,
        /// Why.
        error: Unfilled,
    },
    /// A displaced particle is beyond the range of numbers.
    #[error("a release of emission {emission} at time {time} leaves the range of numbers")]
    Displaced {
        /// Which emission, from 0.
        emission: usize,
        /// When.
        time: f64,
    },
    /// A step does not lead to a later time.
    #[error("a step from time {time} to {end} is none")]
    Step {
        /// When it would begin.
        time: f64,
        /// When it would end.
        end: f64,
    },
    /// The flow has no velocity where a particle is.
    #[error("the velocity of particle {particle} at ({}, {}, {}) and time {time} is ({}, {}, {})",
        position.x, position.y, position.z, velocity.x, velocity.y, velocity.z)]
    Velocity {
        /// Which particle; the first.
        particle: usize,
        /// Where.
        position: DVec3,
        /// When.
        time: f64,
        /// What the flow gave.
        velocity: DVec3,
    },
    /// A particle would end beyond the range of numbers.
    #[error("particle {particle} would move from ({}, {}, {}) to ({}, {}, {})",
        start.x, start.y, start.z, end.x, end.y, end.z)]
    End {
        /// Which particle; the first.
        particle: usize,
        /// Where it is.
        start: DVec3,
        /// Where it would be.
        end: DVec3,
    },
    /// A state has not one age for each particle.
    #[error("the state has {ages} ages for {particles} particles")]
    StateAges {
        /// How many ages.
        ages: usize,
        /// How many particles.
        particles: usize,
    },
    /// A particle of a state has a position or an age that is not finite.
    #[error("particle {particle} of the state has a position or an age that is not finite")]
    StateParticle {
        /// Which particle; the first.
        particle: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl MarkerError {
    /// Refuses a parameter unless it is what it must be.
    pub(super) fn require(
        ok: bool,
        name: &'static str,
        value: f64,
        must: &'static str,
    ) -> Result<(), MarkerError> {
        if ok { Ok(()) } else { Err(MarkerError::Parameter { name, value, must }) }
    }

    /// What became of filling the shape of an emission.
    pub(super) fn of_filling(emission: usize, error: Unfilled) -> Self {
        match error {
            Unfilled::Cancelled(cancelled) => cancelled.into(),
            error => Self::Unfilled { emission, error },
        }
    }
}
