//! What a flow primitive refuses: [`ProceduralError`].

use glam::DVec3;
use thiserror::Error;
use welter_tracking::flows::FlowError;

/// Why there is no such flow primitive.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ProceduralError {
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
    /// A vertex of a filament has a coordinate that is infinite or not a number.
    #[error("vertex {index} of the filament is at ({}, {}, {})", position.x, position.y, position.z)]
    Vertex {
        /// Which vertex; the first.
        index: usize,
        /// Where it is.
        position: DVec3,
    },
    /// A filament has too few vertices to be a line.
    #[error("the filament has {vertices} vertices, must have at least {least}")]
    Line {
        /// How many it has.
        vertices: usize,
        /// How many it must have.
        least: usize,
    },
    /// There are no keyframes.
    #[error("there are no keyframes")]
    NoKeyframes,
    /// The time of a keyframe is not finite, or not after the one before.
    #[error("keyframe {index} is at time {time}, must be finite and after the one before")]
    KeyTime {
        /// Which keyframe; the first.
        index: usize,
        /// Its time.
        time: f64,
    },
    /// The value of a keyframe is not finite.
    #[error("the value of keyframe {index} is not finite")]
    KeyValue {
        /// Which keyframe; the first.
        index: usize,
    },
    /// The distance to a solid has no gradient in closed form, only one by finite differences.
    #[error("the gradient of the distance to the solid is only known by finite differences")]
    NoExactGradient,
    /// The parameters of noise are out of range.
    #[error(transparent)]
    Noise(#[from] FlowError),
}

/// Lengths of primitives are from here on: their squares and fifth powers, and the ratios to other lengths, are numbers.
pub(super) const SHORTEST: f64 = 1.0 / LONGEST;
/// Lengths of primitives are up to here: 2^450.
pub(super) const LONGEST: f64 = f64::from_bits((1023 + 450) << 52);

impl ProceduralError {
    /// Refuses a parameter unless it is what it must be.
    pub(super) fn require(ok: bool, name: &'static str, value: f64, must: &'static str) -> Result<(), Self> {
        if ok { Ok(()) } else { Err(Self::Parameter { name, value, must }) }
    }

    /// Refuses a number that is infinite or none.
    pub(super) fn require_finite(name: &'static str, value: f64) -> Result<(), Self> {
        Self::require(value.is_finite(), name, value, "finite")
    }

    /// Refuses a vector with a component that is infinite or no number.
    pub(super) fn require_finite_vector(name: &'static str, vector: DVec3) -> Result<(), Self> {
        vector.to_array().into_iter().try_for_each(|component| Self::require_finite(name, component))
    }

    /// Refuses a vector that has no direction.
    pub(super) fn require_direction(name: &'static str, vector: DVec3) -> Result<(), Self> {
        Self::require_finite_vector(name, vector)?;
        let size = vector.abs().max_element();
        Self::require(size.is_normal(), name, size, "a vector with a component that is a normal number")
    }

    /// Refuses what is no length between 2^-450 and 2^450.
    pub(super) fn require_length(name: &'static str, value: f64) -> Result<(), Self> {
        Self::require((SHORTEST..=LONGEST).contains(&value), name, value, "a length from 2^-450 to 2^450")
    }

    /// Refuses a core that is none, or differs from the size of the primitive by more than a factor of 2^100.
    pub(super) fn require_core(core: f64, size: f64) -> Result<(), Self> {
        const FACTOR: f64 = (1_u128 << 100) as f64;
        let ok = core > 0.0 && core / size <= FACTOR && size / core <= FACTOR;
        Self::require(ok, "core", core, "above 0, and from 2^-100 to 2^100 times the size of the vortex")
    }
}
