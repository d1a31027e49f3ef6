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
//! One cosine a wave, of an angle that is counted in turns, so that whole turns are taken off without rounding: half a
//! microsecond for three octaves of 24.

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
    turns: Vec<Turns>,
}

/// A wave with its angles in turns.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turns {
    vector: DVec3,
    frequency: f64,
    phase: f64,
    amplitude: DVec3,
    /// Amplitude of the potential, perpendicular to the vector: `2 pi vector x potential` is the amplitude.
    potential: DVec3,
}

impl Turns {
    fn angle(&self, position: DVec3, time: f64) -> f64 {
        self.vector.dot(position) + (self.frequency * time + self.phase)
    }
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
        let (mut waves, mut turns) = (Vec::new(), Vec::new());
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
                let Wave { vector, frequency, phase, amplitude } = *wave;
                let unit_potential = amplitude.cross(vector) / (TAU * vector.length_squared());
                let turn = Turns {
                    vector: vector * (ratio / parameters.wavelength),
                    frequency: frequency * (ratio * gain / parameters.period),
                    phase,
                    amplitude: amplitude * speed,
                    potential: unit_potential * (speed * parameters.wavelength / ratio),
                };
                *wave = Wave {
                    vector: TAU * turn.vector,
                    frequency: TAU * turn.frequency,
                    phase: TAU * phase,
                    amplitude: turn.amplitude,
                };
                turns.push(turn);
            }
        }
        Ok(Self { waves, turns })
    }

    /// The waves, octave by octave.
    #[must_use]
    pub fn waves(&self) -> &[Wave] {
        &self.waves
    }

    /// The vector potential, a sum of `sin(k . x + w t + p)`, and the velocity, its curl: that of
    /// [`VelocityField::velocity`], bit for bit. The potential has no divergence either, so of all potentials of a wave it is
    /// the shortest.
    ///
    /// ```
    /// use glam::DVec3;
    /// use welter_tracking::flows::{VelocityField, fields::{CurlNoise, CurlNoiseParameters}};
    /// let noise = CurlNoise::new(&CurlNoiseParameters::default())?;
    /// let (_potential, curl) = noise.potential_and_velocity(DVec3::X, 0.5);
    /// assert_eq!(curl, noise.velocity(DVec3::X, 0.5));
    /// # Ok::<(), welter_tracking::flows::FlowError>(())
    /// ```
    #[must_use]
    pub fn potential_and_velocity(&self, position: DVec3, time: f64) -> (DVec3, DVec3) {
        let add = |(potential, velocity): (DVec3, DVec3), wave: &Turns| {
            let (sin, cos) = sincos_of_turns(wave.angle(position, time));
            (potential + sin * wave.potential, velocity + cos * wave.amplitude)
        };
        self.turns.iter().fold((DVec3::ZERO, DVec3::ZERO), add)
    }
}

/// A wave of a length of about 1, and a time of about as much, with its angles in turns, and the velocity of its unit
/// potential.
fn draw(mut random: Random, potential: Potential) -> (Wave, DVec3) {
    // From 2^(-1/2) to 2^(1/2).
    let length = libm::exp2(0.5 * random.signed());
    let (frequency, phase) = (random.signed(), random.unit());
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
        let add = |sum: DVec3, wave: &Turns| {
            sum + cos_of_rest(rest_of_turns(wave.angle(position, time))) * wave.amplitude
        };
        self.turns.iter().fold(DVec3::ZERO, add)
    }
}

/// Sine and cosine of `2 pi turns`, each within 2 u of one; NaN for what is not finite.
fn sincos_of_turns(turns: f64) -> (f64, f64) {
    let rest = rest_of_turns(turns);
    // A quarter of a turn back: from -3/4 to 1/4, brought to at most a half.
    let back = rest - 0.25;
    (cos_of_rest(if back < -0.5 { back + 1.0 } else { back }), cos_of_rest(rest))
}

/// What whole turns leave, at most half a turn; without rounding.
fn rest_of_turns(turns: f64) -> f64 {
    // Adding it rounds numbers up to half of it to whole ones.
    const WHOLE: f64 = 3.0 * (1_u64 << 51) as f64;
    let rest = turns - ((turns + WHOLE) - WHOLE);
    if rest.abs() > 0.5 { turns - libm::rint(turns) } else { rest }
}

/// `cos(2 pi rest)` within 2 u, for a rest of at most half a turn.
///
/// The cosine is the sine of the quarter turn less `|rest|`, by its power series up to the 23rd power, whose next term is
/// below 2^-60.
fn cos_of_rest(rest: f64) -> f64 {
    let quarter = 0.25 - rest.abs();
    let square = quarter * quarter;
    SINE_OF_TURNS.iter().rev().fold(0.0, |sum, &term| sum * square + term) * quarter
}

/// `(-1)^n (2 pi)^(2n + 1) / (2n + 1)!`.
const SINE_OF_TURNS: [f64; 12] = {
    let mut terms = [TAU; 12];
    let mut n = 1;
    while n < 12 {
        let k = 2.0 * n as f64;
        terms[n] = -terms[n - 1] * (TAU * TAU) / (k * (k + 1.0));
        n += 1;
    }
    terms
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_of_turns() {
        let mut worst: f64 = 0.0;
        for i in -4000..=4000 {
            let turns = f64::from(i) / 1234.0;
            let (sin, cos) = libm::sincos(TAU * turns.rem_euclid(1.0));
            let found = sincos_of_turns(turns);
            worst = worst.max((found.0 - sin).abs()).max((found.1 - cos).abs());
        }
        assert!(worst < 1e-15, "{worst:e}");
        for (turns, cosine) in [(0.0, 1.0), (0.25, 0.0), (0.5, -1.0), (0.75, 0.0), (1e15 + 0.5, -1.0)] {
            assert!((sincos_of_turns(turns).1 - cosine).abs() < 1e-15, "{turns}");
            assert!((sincos_of_turns(-turns).1 - cosine).abs() < 1e-15, "{turns}");
        }
        for large in [4e15, 1e16, 1e300] {
            let (sin, cos) = sincos_of_turns(large);
            assert!(sin.abs() <= 1.0 + 1e-15 && cos.abs() <= 1.0 + 1e-15, "{large}");
        }
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(sincos_of_turns(bad).0.is_nan() && sincos_of_turns(bad).1.is_nan());
        }
    }
}
