//! Linear shear: [`Shear`].

use glam::DVec3;

use crate::flows::{FlowError, VelocityField};

/// Planes that slide over each other, `v = (gradient . (p - center)) direction`.
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::flows::{VelocityField, fields::Shear};
/// let field = Shear::default();
/// assert_eq!(field.velocity(DVec3::new(1.0, 2.0, 3.0), 0.0), DVec3::new(2.0, 0.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// A point that rests. Default: the origin.
    pub center: DVec3,
    /// Where points move to; of any length, which multiplies the velocity. Default: x.
    pub direction: DVec3,
    /// How fast the velocity changes, in 1 / time, and which way. Default: y. The field is free of divergence if it is
    /// perpendicular to the direction.
    pub gradient: DVec3,
}

impl Default for Shear {
    fn default() -> Self {
        Self { center: DVec3::ZERO, direction: DVec3::X, gradient: DVec3::Y }
    }
}

impl Shear {
    /// Whether the parameters are in range: finite.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        FlowError::require_finite("center", self.center)?;
        FlowError::require_finite("direction", self.direction)?;
        FlowError::require_finite("gradient", self.gradient)
    }
}

impl VelocityField for Shear {
    fn velocity(&self, position: DVec3, _time: f64) -> DVec3 {
        self.gradient.dot(position - self.center) * self.direction
    }
}
