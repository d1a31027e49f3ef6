//! What the renderer refuses: [`RenderError`].

use glam::DVec3;
use thiserror::Error;
use welter_meshing::Cancelled;

/// Why there is no picture.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RenderError {
    /// A number is out of range.
    #[error("{name} is {value}, must be {must}")]
    Parameter {
        /// Which number.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be.
        must: &'static str,
    },
    /// The image has no pixel, or too many.
    #[error(
        "an image of {width} x {height} pixels; sides are from 1 to {} pixels, and there are at most {} pixels",
        super::MAX_SIDE,
        super::MAX_PIXELS
    )]
    ImageSize {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// There is not one age a vertex.
    #[error("{ages} ages for {vertices} vertices; there must be one a vertex, or none at all")]
    AgeCount {
        /// Vertices of the smoke's surface.
        vertices: usize,
        /// Ages given.
        ages: usize,
    },
    /// An age is not a number from 0 to the largest of single precision.
    #[error("the age of vertex {vertex} is {age}, must be from 0 to {}", f32::MAX)]
    Age {
        /// Which vertex; the first.
        vertex: usize,
        /// Its age.
        age: f64,
    },
    /// There is not one age a particle.
    #[error("{ages} ages for {particles} particles; there must be one a particle, or none at all")]
    ParticleAges {
        /// Particles.
        particles: usize,
        /// Ages given.
        ages: usize,
    },
    /// A particle is nowhere.
    #[error("particle {particle} is at ({}, {}, {}), must be somewhere", position.x, position.y, position.z)]
    Particle {
        /// Which particle; the first.
        particle: usize,
        /// Its position.
        position: DVec3,
    },
    /// The age of a particle is not a number from 0 to the largest of single precision.
    #[error("the age of particle {particle} is {age}, must be from 0 to {}", f32::MAX)]
    ParticleAge {
        /// Which particle; the first.
        particle: usize,
        /// Its age.
        age: f64,
    },
    /// A direction is zero, or the camera looks along its own upward direction, or the eye is at the target.
    #[error("{name} ({}, {}, {}) gives no direction", value.x, value.y, value.z)]
    Direction {
        /// Which vector.
        name: &'static str,
        /// Its value.
        value: DVec3,
    },
    /// The shadow texture would have too many voxels.
    #[error("a shadow texture of {} x {} x {} voxels; there are at most {}",
        size[0], size[1], size[2], super::MAX_VOXELS)]
    ShadowTexture {
        /// Voxels along its axes.
        size: [usize; 3],
    },
    /// Nobody waits for the picture any longer.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl RenderError {
    /// Refuses a number unless it is what it must be.
    pub(super) fn require(
        ok: bool,
        name: &'static str,
        value: f64,
        must: &'static str,
    ) -> Result<(), RenderError> {
        if ok { Ok(()) } else { Err(RenderError::Parameter { name, value, must }) }
    }

    /// Refuses a vector with a component that is not finite.
    pub(super) fn require_finite(name: &'static str, vector: DVec3) -> Result<(), RenderError> {
        let bad = vector.to_array().into_iter().find(|c| !c.is_finite());
        bad.map_or(Ok(()), |value| Err(RenderError::Parameter { name, value, must: "finite" }))
    }

    /// Refuses a color with a component out of range. Products of two fit into single precision.
    pub(super) fn require_color(name: &'static str, color: [f64; 3]) -> Result<(), RenderError> {
        const MOST: f64 = (1_u64 << 40) as f64;
        let bad = color.into_iter().find(|c| !(0.0..=MOST).contains(c));
        bad.map_or(Ok(()), |value| Err(RenderError::Parameter { name, value, must: "from 0 to 2^40" }))
    }
}
