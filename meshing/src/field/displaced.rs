//! A surface made rough: [`Displaced`].

use glam::DVec3;

use crate::field::error::require;
use crate::field::{FieldError, FractalNoise, NOISE_BOUND, ScalarField};
use crate::shapes::MAX_LENGTH;
use crate::spatial::Box3;

/// A field plus noise: its surface moves outward where the noise is negative, by about the amplitude at most. No distance.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ball, Displaced, FractalNoise, ScalarField}};
/// let noise = FractalNoise { wavelength: 0.5, octaves: 3, ..FractalNoise::default() };
/// let rock = Displaced { field: Ball::default(), noise, amplitude: 0.2 };
/// assert!((rock.value(DVec3::X) - Ball::default().value(DVec3::X)).abs() < 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displaced<F> {
    /// What is displaced.
    pub field: F,
    /// By what.
    pub noise: FractalNoise,
    /// What the noise is multiplied by, at most 1e75 in magnitude.
    pub amplitude: f64,
}

impl<F> Displaced<F> {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        self.noise.validate()?;
        require(self.amplitude.abs() <= MAX_LENGTH, "amplitude", self.amplitude, "at most 1e75 in magnitude")
    }
}

impl<F: ScalarField> ScalarField for Displaced<F> {
    fn value(&self, point: DVec3) -> f64 {
        self.field.value(point) + self.amplitude * self.noise.value(point)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        self.field.gradient(point, step) + self.amplitude * self.noise.gradient(point, step)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        self.field.sublevel_bounds(level + NOISE_BOUND * self.amplitude.abs())
    }
}
