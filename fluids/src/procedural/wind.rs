//! Uniform wind: [`Wind`].

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::{LocalPotential, ProceduralError, VectorPotential};

/// What a [`Wind`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindParameters {
    /// The velocity everywhere. Default: x.
    pub velocity: DVec3,
    /// Where the potential is zero. It does not matter for the wind alone. Around a solid ([`Bounded`](super::Bounded)) the flow is fastest
    /// where the potential is large, so the origin belongs into the middle of the solid. Default: the origin.
    pub origin: DVec3,
}

impl Default for WindParameters {
    fn default() -> Self {
        Self { velocity: DVec3::X, origin: DVec3::ZERO }
    }
}

impl WindParameters {
    /// Whether the parameters are in range: finite.
    ///
    /// # Errors
    /// [`ProceduralError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        ProceduralError::require_finite_vector("velocity", self.velocity)?;
        ProceduralError::require_finite_vector("origin", self.origin)
    }
}

/// The same velocity everywhere, the curl of `1/2 w x (x - origin)`, a potential that is perpendicular to the wind and grows away from the
/// line through the origin along it.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{Wind, WindParameters};
/// use welter_tracking::flows::VelocityField;
/// let wind = Wind::new(&WindParameters { velocity: 3.0 * DVec3::Z, ..Default::default() })?;
/// assert_eq!(wind.velocity(DVec3::ONE, 5.0), 3.0 * DVec3::Z);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    velocity: DVec3,
    origin: DVec3,
}

impl Wind {
    /// The wind of some parameters.
    ///
    /// # Errors
    /// As [`WindParameters::validate`].
    pub fn new(parameters: &WindParameters) -> Result<Self, ProceduralError> {
        parameters.validate()?;
        let &WindParameters { velocity, origin } = parameters;
        Ok(Self { velocity, origin })
    }
}

impl VectorPotential for Wind {
    fn potential_and_curl(&self, position: DVec3, _time: f64) -> LocalPotential {
        if !position.is_finite() {
            return LocalPotential::NAN;
        }
        let potential = self.velocity.cross(0.5 * (position - self.origin));
        LocalPotential { potential, curl: self.velocity }
    }
}

impl VelocityField for Wind {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.potential_and_curl(position, time).curl
    }
}
