//! The deformation field of the Enright test: [`Enright`].

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::flows::{FlowError, VelocityField};

/// Eight vortices in a cube \[LeVeque96\] that draw a sphere to a thin sheet and back \[Enright02\]:
/// ```text
///   u =  2 sin^2(pi x) sin(2 pi y) sin(2 pi z)
///   v = -sin(2 pi x) sin^2(pi y) sin(2 pi z)        times size sin(2 pi t / period),
///   w = -sin(2 pi x) sin(2 pi y) sin^2(pi z)        with x, y, z in units of size
/// ```
/// At half the period the surface is farthest; after the whole period every point is back where it was.
///
/// The test of \[Brochu12, section 3.3.3\], with this modulation: a sphere of radius 0.15 around (0.35, 0.35, 0.35), steps
/// of 0.01. (\[Enright02\] has cos(pi t / period) instead, which makes the same path at other speeds.)
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::flows::{VelocityField, fields::Enright};
/// let v = Enright::default().velocity(DVec3::new(0.25, 0.125, 0.25), 0.75);
/// assert!((v.x - 0.5_f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enright {
    /// The time after which all is back, above 0. Default: 3.
    pub period: f64,
    /// The side of the cube of the vortices, which has a corner in the origin, above 0. Default: 1.
    pub size: f64,
}

impl Default for Enright {
    fn default() -> Self {
        Self { period: 3.0, size: 1.0 }
    }
}

impl Enright {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        let above_zero = |name, value: f64| {
            FlowError::require(value.is_finite() && value > 0.0, name, value, "finite and above 0")
        };
        above_zero("period", self.period)?;
        above_zero("size", self.size)
    }
}

impl VelocityField for Enright {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        let [(sx, cx), (sy, cy), (sz, cz)] = position.to_array().map(|c| libm::sincos(PI * (c / self.size)));
        // sin(2 a) = 2 sin a cos a.
        let (dx, dy, dz) = (2.0 * sx * cx, 2.0 * sy * cy, 2.0 * sz * cz);
        let speed = self.size * libm::sin(TAU * (time / self.period));
        speed * DVec3::new(2.0 * sx * sx * dy * dz, -dx * sy * sy * dz, -dx * dy * sz * sz)
    }
}
