//! Sources of volume: [`DivergentSource`].
//!
//! # What it computes
//! Flow out of a ball, times noise, as \[Brochu12, section 5.4.2\] disperses smoke:
//! ```text
//!   v(x, t) = expansion  n(x, t)  f(d / radius)  (x - center),        d = |x - center|
//!   div v   = expansion (n (3 f + s f') + grad n . (x - center) f),   s = d / radius
//! ```
//! with `n = 1`, or noise around a mean, and for `f`, by [`Extent`]:
//! ```text
//!   Confined:   f = 1/3 (1 - s^2)^5 for s < 1, and 0 beyond
//!   Unbounded:  3 f + s f' = (1 - s^2)^4 for s < 1, and 0 beyond: there f = 128/3465 / s^3, the flow of a point source
//! ```
//!
//! # What it promises
//! * [`DivergentSource::divergence`] is the divergence of the velocity, within roundings; at the centre it is
//!   `expansion n`.
//! * Velocities have four continuous derivatives, also at the centre and at the radius. (The velocity that \[Brochu12\] prints,
//!   `max(0, r - d) n (x - c) / d`, has no limit at the centre and a kink at the radius.)
//! * Without noise as much goes out of every closed surface as the divergence within it says: around an unbounded source [`DivergentSource::outflow`],
//!   around one that is confined nothing, since what spreads in the middle gathers at the rim.
//! * All lengths times a power of two give velocities times that power, bit for bit, as long as nothing leaves the range of normal
//!   numbers.
//!
//! # What it does not promise
//! That noise keeps to the radius: outside of it an unbounded source with noise still has the divergence of the noise,
//! `grad n . v / n`.
//!
//! # Complexity
//! A polynomial, and the waves of the noise.

use std::f64::consts::PI;

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::scale::{Frame, Place};
use super::{ProceduralError, ScalarNoise, ScalarNoiseParameters};

/// How far the flow of a source reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extent {
    /// To its radius, as in \[Brochu12\].
    #[default]
    Confined,
    /// To infinity, falling with the square of the distance: what has been given out must go somewhere.
    Unbounded,
}

/// Noise that multiplies the velocity of a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceNoise {
    /// Its mean. Default: 1; 0 for noise alone.
    pub mean: f64,
    /// The root of the mean square of its deviation from the mean. Default: 1/2.
    pub variation: f64,
    /// Its waves.
    pub waves: ScalarNoiseParameters,
}

impl Default for SourceNoise {
    fn default() -> Self {
        Self { mean: 1.0, variation: 0.5, waves: ScalarNoiseParameters::default() }
    }
}

/// What a [`DivergentSource`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DivergentSourceParameters {
    /// The centre. Default: the origin.
    pub center: DVec3,
    /// The radius of the ball in which volume comes into being, a length from 2^-450 to 2^450. Default: 1.
    pub radius: f64,
    /// The divergence at the centre where the noise is one, in 1 / time; below 0 for a sink. Default: 1.
    pub expansion: f64,
    /// How far the flow reaches. Default: to the radius.
    pub extent: Extent,
    /// Noise that multiplies the velocity. Default: none.
    pub noise: Option<SourceNoise>,
}

impl Default for DivergentSourceParameters {
    fn default() -> Self {
        Self { center: DVec3::ZERO, radius: 1.0, expansion: 1.0, extent: Extent::default(), noise: None }
    }
}

impl DivergentSourceParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ProceduralError`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        ProceduralError::require_finite_vector("center", self.center)?;
        ProceduralError::require_length("radius", self.radius)?;
        ProceduralError::require_finite("expansion", self.expansion)?;
        let Some(SourceNoise { mean, variation, waves }) = self.noise else { return Ok(()) };
        ProceduralError::require_finite("mean", mean)?;
        ProceduralError::require_finite("variation", variation)?;
        waves.validate()
    }
}

/// A source of volume, or a sink.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{DivergentSource, DivergentSourceParameters, Extent};
/// use welter_tracking::flows::VelocityField;
/// let source = DivergentSource::new(&DivergentSourceParameters { extent: Extent::Unbounded, ..Default::default() })?;
/// // Outside: outflow / (4 pi d^2).
/// let v = source.velocity(DVec3::new(0.0, 2.0, 0.0), 0.0);
/// assert!((v.y - source.outflow() / (16.0 * std::f64::consts::PI)).abs() < 1e-15);
/// assert_eq!((source.divergence(DVec3::ZERO, 0.0), source.divergence(2.0 * DVec3::Y, 0.0)), (1.0, 0.0));
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DivergentSource {
    frame: Frame,
    parameters: DivergentSourceParameters,
    /// In units.
    radius: f64,
    noise: Option<ScalarNoise>,
}

/// The flux of an unbounded source over that of the same expansion everywhere in the ball, a third of that over `s^3`: the integral of
/// `(1 - s^2)^4 s^2`.
const TOTAL: f64 = 128.0 / 3465.0;

/// The radial part of a velocity.
#[derive(Clone, Copy)]
struct Radial {
    /// `f`.
    factor: f64,
    /// `3 f + s f'`.
    divergence: f64,
}

impl DivergentSource {
    /// The source of some parameters.
    ///
    /// # Errors
    /// As [`DivergentSourceParameters::validate`].
    pub fn new(parameters: &DivergentSourceParameters) -> Result<Self, ProceduralError> {
        parameters.validate()?;
        let frame = Frame::new(parameters.center, parameters.radius);
        let noise = parameters.noise.map(|noise| ScalarNoise::new(&noise.waves)).transpose()?;
        Ok(Self { frame, parameters: *parameters, radius: frame.scaled(parameters.radius), noise })
    }

    /// The volume that comes out of the ball of an unbounded source per time, where the noise is one:
    /// `4 pi 128/3465 expansion radius^3`. Zero for one that is confined.
    #[must_use]
    pub fn outflow(&self) -> f64 {
        let &DivergentSourceParameters { radius, expansion, extent, .. } = &self.parameters;
        match extent {
            Extent::Confined => 0.0,
            Extent::Unbounded => 4.0 * PI * TOTAL * expansion * (radius * radius * radius),
        }
    }

    /// The divergence of the velocity, volume per volume and time.
    #[must_use]
    pub fn divergence(&self, position: DVec3, time: f64) -> f64 {
        let radial = match self.radial(position) {
            Ok(radial) => radial,
            Err(value) => return value,
        };
        let (value, gradient) = self.noise(position, time);
        let along = gradient.dot(position - self.parameters.center);
        self.parameters.expansion * (value * radial.divergence + along * radial.factor)
    }

    /// The noise and its gradient.
    fn noise(&self, position: DVec3, time: f64) -> (f64, DVec3) {
        match (&self.noise, &self.parameters.noise) {
            (Some(waves), Some(noise)) => {
                let (value, gradient) = waves.at(position, time);
                (noise.mean + noise.variation * value, noise.variation * gradient)
            }
            _ => (1.0, DVec3::ZERO),
        }
    }

    /// The radial part; without one, what each component is: zero where there is no flow, NaN at no position.
    fn radial(&self, position: DVec3) -> Result<Radial, f64> {
        let relative = match self.frame.place(position) {
            Place::Near(relative) => relative / self.radius,
            Place::Far => return Err(0.0),
            Place::Nowhere => return Err(f64::NAN),
        };
        let square = relative.length_squared();
        let inside = 1.0 - square;
        match self.parameters.extent {
            _ if square.is_infinite() => Err(0.0),
            Extent::Confined if inside <= 0.0 => Err(0.0),
            Extent::Confined => {
                let fourth = (inside * inside) * (inside * inside);
                let divergence = fourth * (inside - 10.0 / 3.0 * square);
                Ok(Radial { factor: fourth * inside / 3.0, divergence })
            }
            Extent::Unbounded if inside <= 0.0 => {
                Ok(Radial { factor: TOTAL / (square * square.sqrt()), divergence: 0.0 })
            }
            Extent::Unbounded => {
                // The integral of (1 - t^2)^4 t^2 from 0 to s, over s^3.
                let terms = [1.0 / 3.0, -4.0 / 5.0, 6.0 / 7.0, -4.0 / 9.0, 1.0 / 11.0];
                let factor = terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
                Ok(Radial { factor, divergence: (inside * inside) * (inside * inside) })
            }
        }
    }
}

impl VelocityField for DivergentSource {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        match self.radial(position) {
            Ok(Radial { factor, .. }) => {
                let (noise, _) = self.noise(position, time);
                (self.parameters.expansion * noise * factor) * (position - self.parameters.center)
            }
            Err(value) => DVec3::splat(value),
        }
    }
}
