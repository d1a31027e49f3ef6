//! The gyroid, a triply periodic surface \[Schoen70\]: [`Gyroid`].
//!
//! # Method
//! `g(x, y, z) = sin x cos y + sin y cos z + sin z cos x`, zero near the minimal surface, with the three coordinates in units of
//! `period / 2 pi`. Each component of its gradient, such as `cos x cos y - sin z sin x`, is at most the length of `(cos y, sin z)`, and the
//! squares of these three lengths add up to 3. So `g / sqrt 3`, in units of length, changes by at most one per unit of length: it
//! is a bound of the distance.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::field::error::{require_length, require_length_or_zero};
use crate::field::{FieldError, ScalarField};

/// One of the two labyrinths of a gyroid, or a sheet of some thickness along it. Fills space: clip it by a body.
///
/// A sheet is at least as thick as it says, and where it is thin against the period at most 1.23 times: measured, the scaled function's
/// gradient has lengths from `sqrt(2/3)` to 1 on the surface. The sheet's gradient in its middle is that of the positive side.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ball, Gyroid, Intersection, AnyField, ScalarField}};
/// let sheet = Gyroid { period: 0.7, thickness: 0.1 };
/// let parts = vec![AnyField::new(sheet), AnyField::new(Ball::default())];
/// let ball = Intersection { parts, blend_width: 0.0 };
/// assert!(ball.value(DVec3::ZERO) < 0.0 && sheet.bounds().is_none() && ball.bounds().is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gyroid {
    /// Length after which it repeats along each axis, positive. Default: 1.
    pub period: f64,
    /// Least thickness of the sheet; 0 for the solid labyrinth where `g` is negative. Default: 0.
    pub thickness: f64,
}

impl Default for Gyroid {
    fn default() -> Self {
        Self { period: 1.0, thickness: 0.0 }
    }
}

impl Gyroid {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_length("period", self.period)?;
        require_length_or_zero("thickness", self.thickness)
    }

    fn sines(&self, point: DVec3) -> [(f64, f64); 3] {
        point.to_array().map(|c| libm::sincos(TAU * (c / self.period)))
    }

    /// The scaled function of one labyrinth.
    fn labyrinth(&self, point: DVec3) -> f64 {
        let [(sx, cx), (sy, cy), (sz, cz)] = self.sines(point);
        (sx * cy + sy * cz + sz * cx) * (self.period / (TAU * 3.0_f64.sqrt()))
    }
}

impl ScalarField for Gyroid {
    fn value(&self, point: DVec3) -> f64 {
        let value = self.labyrinth(point);
        if self.thickness == 0.0 { value } else { value.abs() - 0.5 * self.thickness }
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let [(sx, cx), (sy, cy), (sz, cz)] = self.sines(point);
        let gradient = DVec3::new(cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz) / 3.0_f64.sqrt();
        let other_side = self.thickness != 0.0 && self.labyrinth(point) < 0.0;
        if other_side { -gradient } else { gradient }
    }
}
