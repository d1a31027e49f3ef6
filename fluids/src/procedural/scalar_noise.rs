//! Smooth random numbers in space and time with their gradient: [`ScalarNoise`].
//!
//! # What it computes
//! `n(x, t) = sum over waves  c cos(k . x + w t + p)`: the waves of [`CurlNoise`] with the length of each velocity for an amplitude.
//!
//! # What it promises
//! * All derivatives are continuous and bounded; no wavelength outside of the octaves. Mean zero over space, mean square one.
//! * The gradient is that of the sum, within roundings.
//! * The same bits on every machine.

use glam::DVec3;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Potential};

use super::ProceduralError;

/// What [`ScalarNoise`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalarNoiseParameters {
    /// Which of the noises. Default: 0.
    pub seed: u64,
    /// The wavelength in the middle of the coarsest octave, above 0. Default: 1.
    pub wavelength: f64,
    /// The shortest time after which a wave of the coarsest octave returns, above 0; infinite for noise that does not change.
    /// Default: 1.
    pub period: f64,
    /// How many octaves there are, each of half the wavelength of the one before; 1 to 16. Default: 2.
    pub octaves: u32,
    /// The amplitude of an octave relative to the one before, not below 0. Default: 1/2.
    pub gain: f64,
    /// How many waves each octave has, 1 to 4096. Default: 24.
    pub waves: u32,
}

impl Default for ScalarNoiseParameters {
    fn default() -> Self {
        Self { seed: 0, wavelength: 1.0, period: 1.0, octaves: 2, gain: 0.5, waves: 24 }
    }
}

impl ScalarNoiseParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ProceduralError::Noise`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        Ok(self.of_curl().validate()?)
    }

    fn of_curl(&self) -> CurlNoiseParameters {
        let &Self { seed, wavelength, period, octaves, gain, waves } = self;
        CurlNoiseParameters {
            seed,
            wavelength,
            period,
            octaves,
            gain,
            waves,
            speed: 1.0,
            potential: Potential::Spatial,
        }
    }
}

/// A sum of random waves.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{ScalarNoise, ScalarNoiseParameters};
/// let noise = ScalarNoise::new(&ScalarNoiseParameters::default())?;
/// let (value, gradient) = noise.at(DVec3::X, 0.5);
/// let (next, _) = noise.at(DVec3::X + 1e-6 * DVec3::Y, 0.5);
/// assert!((next - value - 1e-6 * gradient.y).abs() < 1e-9);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarNoise {
    waves: Vec<ScalarWave>,
}

/// `amplitude cos(vector . x + frequency t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ScalarWave {
    vector: DVec3,
    frequency: f64,
    phase: f64,
    amplitude: f64,
}

impl ScalarNoise {
    /// Draws the waves.
    ///
    /// # Errors
    /// As [`ScalarNoiseParameters::validate`].
    pub fn new(parameters: &ScalarNoiseParameters) -> Result<Self, ProceduralError> {
        // The mean square of the velocity is half the sum of the squares of its amplitudes, as that of the number will be.
        let noise = CurlNoise::new(&parameters.of_curl())?;
        let waves = noise.waves().iter().map(|wave| ScalarWave {
            vector: wave.vector,
            frequency: wave.frequency,
            phase: wave.phase,
            amplitude: wave.amplitude.length(),
        });
        Ok(Self { waves: waves.collect() })
    }

    /// The value and its gradient at a position and a time.
    #[must_use]
    pub fn at(&self, position: DVec3, time: f64) -> (f64, DVec3) {
        self.waves.iter().fold((0.0, DVec3::ZERO), |(value, gradient), wave| {
            let angle = wave.vector.dot(position) + (wave.frequency * time + wave.phase);
            let (sin, cos) = libm::sincos(angle);
            (value + wave.amplitude * cos, gradient - wave.amplitude * sin * wave.vector)
        })
    }
}
