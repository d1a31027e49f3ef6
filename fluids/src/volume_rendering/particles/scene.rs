//! What is looked at, with particles for the smoke: [`ParticleScene`].

use glam::DVec3;

use super::super::{Camera, Light, Medium, RenderError};

/// Particles of smoke, a light, a camera.
#[derive(Clone, Copy, Debug)]
pub struct ParticleScene<'a> {
    /// Where the particles are.
    pub positions: &'a [DVec3],
    /// Time since emission, one number a particle, from 0 to the largest of single precision; or empty, which means 0 everywhere.
    pub ages: &'a [f64],
    /// The volume of smoke of each particle, above 0 and finite.
    pub particle_volume: f64,
    /// Radius of a particle in units of the cube root of its volume, from 1/4 to 64. At 2, 4/3 pi 2^3 = 33 balls overlap in the mean
    /// at each point inside. What comes nearest to the smoke depends on how the flow has spread the particles: less radius is more
    /// grain, more radius a wider border. The benchmark `smoke_storage` finds 1.4 to 2.8 the best.
    pub radius_rel: f64,
    /// From where it is seen.
    pub camera: Camera,
    /// What it is lit by.
    pub light: Light,
    /// What the smoke is like. Its interior rule is not looked at: particles have no inside.
    pub medium: Medium,
    /// Radiance seen where nothing is (red, green, blue), each from 0 to 2^40.
    pub background: [f64; 3],
}

impl ParticleScene<'_> {
    /// Whether all of the scene is in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first fault.
    pub fn validate(&self) -> Result<(), RenderError> {
        let (particles, ages) = (self.positions.len(), self.ages.len());
        if ages != 0 && ages != particles {
            return Err(RenderError::ParticleAges { particles, ages });
        }
        if let Some(particle) = self.positions.iter().position(|p| !p.is_finite()) {
            return Err(RenderError::Particle { particle, position: self.positions[particle] });
        }
        if let Some(particle) = self.ages.iter().position(|age| !(0.0..=f64::from(f32::MAX)).contains(age)) {
            return Err(RenderError::ParticleAge { particle, age: self.ages[particle] });
        }
        if particles > u32::MAX as usize {
            let must = "below 2^32";
            return Err(RenderError::Parameter { name: "particles", value: particles as f64, must });
        }
        let (volume, radius) = (self.particle_volume, self.radius_rel);
        let fits = volume > 0.0 && volume.is_finite();
        RenderError::require(fits, "particle_volume", volume, "above 0 and finite")?;
        let fits = (0.25..=64.0).contains(&radius);
        RenderError::require(fits, "radius_rel", radius, "from 1/4 to 64")?;
        RenderError::require_color("background", self.background)?;
        self.camera.validate()?;
        self.light.validate()?;
        self.medium.validate()
    }

    /// Radius of a particle.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius_rel * libm::cbrt(self.particle_volume)
    }
}
