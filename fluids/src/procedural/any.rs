//! Flows whose types are known only when the program runs: [`AnyPotential`], [`AnyVelocity`].

use std::fmt;
use std::sync::Arc;

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::{LocalPotential, VectorPotential};

/// A potential of any type, shared. Copies share it.
///
/// ```
/// use welter_fluids::procedural::{AnyPotential, Wind, WindParameters};
/// use welter_tracking::flows::{VelocityField, fields::{CurlNoise, CurlNoiseParameters}};
/// let wind = AnyPotential::new(Wind::new(&WindParameters::default())?);
/// let noise = AnyPotential::new(CurlNoise::new(&CurlNoiseParameters::default())?);
/// assert_eq!([&wind, &noise].map(|flow| flow.velocity(glam::DVec3::ZERO, 0.0))[0], glam::DVec3::X);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone)]
pub struct AnyPotential<'a>(Arc<dyn VectorPotential + Send + 'a>);

impl<'a> AnyPotential<'a> {
    /// Shares a potential.
    pub fn new(potential: impl VectorPotential + Send + 'a) -> Self {
        Self(Arc::new(potential))
    }
}

impl fmt::Debug for AnyPotential<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnyPotential").finish_non_exhaustive()
    }
}

impl VectorPotential for AnyPotential<'_> {
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential {
        self.0.potential_and_curl(position, time)
    }
}

impl VelocityField for AnyPotential<'_> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.0.velocity(position, time)
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        self.0.confine(from, to, times)
    }
}

/// A velocity field of any type, shared. Copies share it.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{AnyVelocity, Wind, WindParameters};
/// use welter_tracking::flows::VelocityField;
/// let wind = AnyVelocity::new(Wind::new(&WindParameters::default())?);
/// let closure = AnyVelocity::new(|p: DVec3, _: f64| p);
/// assert_eq!([wind, closure].map(|flow| flow.velocity(DVec3::Y, 0.0)), [DVec3::X, DVec3::Y]);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone)]
pub struct AnyVelocity<'a>(Arc<dyn VelocityField + Send + 'a>);

impl<'a> AnyVelocity<'a> {
    /// Shares a velocity field.
    pub fn new(field: impl VelocityField + Send + 'a) -> Self {
        Self(Arc::new(field))
    }
}

impl fmt::Debug for AnyVelocity<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnyVelocity").finish_non_exhaustive()
    }
}

impl VelocityField for AnyVelocity<'_> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.0.velocity(position, time)
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        self.0.confine(from, to, times)
    }
}
