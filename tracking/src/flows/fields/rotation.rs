//! Rotation about an axis: [`Rotation`].

use glam::DVec3;

use crate::flows::{FlowError, VelocityField};

/// A rigid rotation, `v = w x (p - center)`.
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::flows::{VelocityField, fields::Rotation};
/// let field = Rotation { center: DVec3::X, angular_velocity: 2.0 * DVec3::Z };
/// assert_eq!(field.velocity(DVec3::new(2.0, 0.0, 5.0), 0.0), DVec3::new(0.0, 2.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// A point of the axis. Default: the origin.
    pub center: DVec3,
    /// Along the axis, radians per time; counterclockwise when seen against it. Default: one revolution about z in one
    /// unit of time.
    pub angular_velocity: DVec3,
}

impl Default for Rotation {
    fn default() -> Self {
        Self { center: DVec3::ZERO, angular_velocity: std::f64::consts::TAU * DVec3::Z }
    }
}

impl Rotation {
    /// Whether the parameters are in range: finite.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        FlowError::require_finite("center", self.center)?;
        FlowError::require_finite("angular_velocity", self.angular_velocity)
    }
}

impl VelocityField for Rotation {
    fn velocity(&self, position: DVec3, _time: f64) -> DVec3 {
        self.angular_velocity.cross(position - self.center)
    }
}
