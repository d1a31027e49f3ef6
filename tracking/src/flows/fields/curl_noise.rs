//! Smooth random velocities without divergence: [`CurlNoise`].
//!
//! # What it computes
//! The curl of a random vector potential \[Bridson07\], here a sum of plane waves, as in the turbulence of \[Kraichnan70\]:
//! ```text
//!   psi(x, t) = sum over waves  a sin(k . x + w t + p),      v = curl psi = sum  (k x a) cos(k . x + w t + p)
//! ```
//! with wave vectors `k` that are random in direction, and in length within a band of one octave; random phases `p`,
//! frequencies `w` and polarizations `a`.
//!
//! # What it promises
//! * No divergence: that of a wave is `-k . (k x a) sin(...)`, zero up to the roundings of one product, at every
//!   point. There are no finite differences.
//! * All derivatives in space and time are continuous and bounded; no wavelength outside of the octaves.
//! * Mean zero over space, and a mean square of `speed^2` (summed over the components).
//! * The same bits on every machine.
//!
//! # What it does not promise
//! To be periodic, or Gaussian: the number of waves an octave tells how near it comes to that.
//!
//! # Complexity
//! One cosine a wave: about a microsecond for three octaves of 24.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::flows::random::Random;
use crate::flows::{FlowError, VelocityField};

/// In which directions the potential points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Potential {
    /// Everywhere: velocities in space.
    #[default]
    Spatial,
    /// `(0, 0, psi(x, y, t))`: velocities in the plane of x and y that do not depend on z, as for the figures of
    /// \[Brochu12, section 3.3.3\].
    Planar,
}

/// What [`CurlNoise`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurlNoiseParameters {
    /// Which of the fields. Default: 0.
    pub seed: u64,
    /// The wavelength in the middle of the coarsest octave, above 0. Default: 1.
    pub wavelength: f64,
    /// The root of the mean square of the velocity, all octaves together, not below 0. Default: 1.
    pub speed: f64,
    /// The shortest time after which a wave of the coarsest octave returns, above 0; infinite for a field that does
    /// not change. Finer octaves change faster, by their turnover time wavelength / speed. Default: 1.
    pub period: f64,
    /// How many octaves there are, each of half the wavelength of the one before; 1 to 16. Default: 3.
    pub octaves: u32,
    /// The speed of an octave relative to the one before, not below 0. Default: 2^(-1/3), that of Kolmogorov's spectrum.
    pub gain: f64,
    /// How many waves each octave has, 1 to 4096. Default: 24.
    pub waves: u32,
    /// Where the potential points. Default: everywhere.
    pub potential: Potential,
}

impl Default for CurlNoiseParameters {
    fn default() -> Self {
        Self {
            seed: 0,
            wavelength: 1.0,
            speed: 1.0,
            period: 1.0,
            octaves: 3,
            gain: 0.793_700_525_984_099_7,
            waves: 24,
            potential: Potential::Spatial,
        }
    }
}

impl CurlNoiseParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        let require = FlowError::require;
        let &Self { wavelength, speed, period, octaves, gain, waves, .. } = self;
        require(wavelength.is_normal() && wavelength > 0.0, "wavelength", wavelength, "finite and above 0")?;
        require(speed.is_finite() && speed >= 0.0, "speed", speed, "finite and not below 0")?;
        require(period > 0.0, "period", period, "above 0")?;
        require((1..=16).contains(&octaves), "octaves", octaves.into(), "1 to 16")?;
        require(gain.is_finite() && gain >= 0.0, "gain", gain, "finite and not below 0")?;
        require((1..=4096).contains(&waves), "waves", waves.into(), "1 to 4096")
    }
}

/// `amplitude cos(vector . x + frequency t + phase)`, a velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Radians per length, in the direction in which the wave runs.
    pub vector: DVec3,
    /// Radians per time.
    pub frequency: f64,
    /// In [0, 2 pi).
    pub phase: f64,
    /// Perpendicular to the vector up to rounding.
    pub amplitude: DVec3,
}

/// A sum of random waves.
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::flows::{VelocityField, fields::{CurlNoise, CurlNoiseParameters, Potential}};
///
/// let planar = CurlNoiseParameters { seed: 3, potential: Potential::Planar, ..Default::default() };
/// let noise = CurlNoise::new(&planar)?;
/// let v = noise.velocity(DVec3::new(0.1, 0.2, 0.3), 0.5);
/// assert!(v.length() > 0.0 && v.z == 0.0);
/// assert_eq!(v, noise.velocity(DVec3::new(0.1, 0.2, 7.0), 0.5));
/// # Ok::<(), welter_tracking::flows::FlowError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CurlNoise {
    waves: Vec<Wave>,
}

impl CurlNoise {
    /// Draws the waves.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for a parameter out of range.
    pub fn new(parameters: &CurlNoiseParameters) -> Result<Self, FlowError> {
        parameters.validate()?;
        // Mean squares of the octaves, relative to the first.
        let squares =
            (0..parameters.octaves).map(|octave| libm::pow(parameters.gain, 2.0 * f64::from(octave)));
        let coarsest = parameters.speed / squares.sum::<f64>().sqrt();
        let mut waves = Vec::new();
        for octave in 0..parameters.octaves {
            let gain = libm::pow(parameters.gain, f64::from(octave));
            let ratio = libm::scalbn(1.0, octave as i32);
            let first = waves.len();
            let mut square = 0.0;
            for wave in 0..parameters.waves {
                let random = Random::of(&[parameters.seed, octave.into(), wave.into()]);
                let (wave, velocity) = draw(random, parameters.potential);
                square += 0.5 * velocity.length_squared();
                waves.push(Wave { amplitude: velocity, ..wave });
            }
            let speed = if square > 0.0 { gain * coarsest / square.sqrt() } else { 0.0 };
            for wave in &mut waves[first..] {
                wave.vector *= ratio * (TAU / parameters.wavelength);
                wave.frequency *= ratio * gain * (TAU / parameters.period);
                wave.amplitude *= speed;
            }
        }
        Ok(Self { waves })
    }

    /// The waves, octave by octave.
    #[must_use]
    pub fn waves(&self) -> &[Wave] {
        &self.waves
    }
}

/// A wave of a wavelength of about 2 pi, and a time of about as much, and the velocity of its unit potential.
fn draw(mut random: Random, potential: Potential) -> (Wave, DVec3) {
    // From 2^(-1/2) to 2^(1/2).
    let length = libm::exp2(0.5 * random.signed());
    let (frequency, phase) = (random.signed(), TAU * random.unit());
    let vector = match potential {
        Potential::Spatial => length * random.direction(),
        Potential::Planar => {
            let (sin, cos) = libm::sincos(TAU * random.unit());
            length * DVec3::new(cos, sin, 0.0)
        }
    };
    let polarization = match potential {
        Potential::Spatial => random.direction(),
        Potential::Planar => DVec3::Z,
    };
    (Wave { vector, frequency, phase, amplitude: DVec3::ZERO }, vector.cross(polarization))
}

impl VelocityField for CurlNoise {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        let add = |sum: DVec3, wave: &Wave| {
            let angle = wave.vector.dot(position) + (wave.frequency * time + wave.phase);
            sum + libm::cos(angle) * wave.amplitude
        };
        self.waves.iter().fold(DVec3::ZERO, add)
    }
}
