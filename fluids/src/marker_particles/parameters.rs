//! What is asked of a run of particles: [`MarkerParameters`].

use welter_meshing::surface::measure::signed_volume;
use welter_tracking::flows::Scheme;

use super::MarkerError;
use crate::smoke::Emission;

/// How particles are released and carried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerParameters {
    /// The time at the beginning, finite. No emission may begin before.
    pub start: f64,
    /// How particles follow velocities.
    pub scheme: Scheme,
    /// The volume of smoke that each particle carries, above 0 and finite. It depends on the size of what is released, so there is
    /// no default; [`MarkerParameters::within`] derives it from a number of particles.
    pub particle_volume: f64,
    /// The most particles, at least 1. A release that would make more is an error: with a part of it the shares would no longer
    /// be equal.
    pub most_particles: usize,
}

impl MarkerParameters {
    /// Particles of a volume, from time 0 on, by the method of Runge and Kutta, at most 10 million of them: 320 megabytes.
    #[must_use]
    pub fn of_volume(particle_volume: f64) -> Self {
        Self { start: 0.0, scheme: Scheme::default(), particle_volume, most_particles: 10_000_000 }
    }

    /// Particles such that everything that is released until a time, that time included, is of so many; with several emissions, up
    /// to half a particle more or less for each of them.
    ///
    /// ```
    /// use welter_fluids::marker_particles::MarkerParameters;
    /// use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule};
    /// use welter_meshing::shapes::{Sphere, sphere};
    /// let puff = sphere(&Sphere { radius: 0.25, edge_length: 0.1, ..Sphere::default() })?;
    /// let emission = Emission {
    ///     shape: EmittedShape::Closed(puff),
    ///     schedule: Schedule { start: 0.0, interval: 0.5, count: None },
    ///     joining: Joining::Separate,
    ///     path: None,
    /// };
    /// let one = MarkerParameters::within(std::slice::from_ref(&emission), 1000, 0.0)?;
    /// let two = MarkerParameters::within(std::slice::from_ref(&emission), 1000, 0.7)?;
    /// assert_eq!(two.particle_volume, 2.0 * one.particle_volume);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MarkerError`]: nothing is released until then, or volumes are beyond the range of numbers.
    pub fn within(emissions: &[Emission], particles: usize, until: f64) -> Result<Self, MarkerError> {
        MarkerError::require(particles > 0, "the number of particles", particles as f64, "at least 1")?;
        let mut volume = 0.0;
        for (emission, it) in emissions.iter().enumerate() {
            it.validate().map_err(|error| MarkerError::Emission { emission, error })?;
            let releases = it.schedule.within(f64::NEG_INFINITY, until.next_up()).size_hint().0;
            volume += releases as f64 * signed_volume(it.shape.mesh());
        }
        let share = volume / particles as f64;
        let ok = share > 0.0 && share.is_finite();
        MarkerError::require(ok, "the volume released", volume, "above 0 and finite, also divided")?;
        Ok(Self { most_particles: particles.saturating_add(emissions.len()), ..Self::of_volume(share) })
    }

    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`MarkerError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), MarkerError> {
        MarkerError::require(self.start.is_finite(), "start", self.start, "finite")?;
        let volume = self.particle_volume;
        let ok = volume > 0.0 && volume.is_finite();
        MarkerError::require(ok, "particle_volume", volume, "above 0 and finite")?;
        let most = self.most_particles;
        MarkerError::require(most > 0, "most_particles", most as f64, "at least 1")
    }
}
