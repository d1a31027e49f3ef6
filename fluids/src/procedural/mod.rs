//! Flow without simulation: velocities from formulas, added up.
//!
//! # What it computes
//! \[Brochu12, section 5.4.2\] makes the motion of smoke from a few kinds of flow, each with a weight:
//!
//! | primitive | flow | potential |
//! | --- | --- | --- |
//! | [`VortexRing`] | the ring of a puff of smoke, of any axis, with a core | closed form, by elliptic integrals |
//! | [`VortexFilament`] | around a polyline, with a core | closed form |
//! | [`Wind`] | the same everywhere | `1/2 w x (x - origin)` |
//! | [`CurlNoise`](welter_tracking::flows::fields::CurlNoise) | smooth random flow in space and time | sum of waves |
//! | [`DivergentSource`] | out of a ball, with noise | none; its divergence in closed form |
//!
//! What changes and joins them:
//!
//! | type | what it does |
//! | --- | --- |
//! | [`WeightedSum`] | the sum of parts, each times an [`Amplitude`]: a number, keyframes in time, pulses |
//! | [`Moving`] | carries a part along a [`Path`], given or that of a point in a flow |
//! | [`Bounded`] | makes potentials flow around a solid: `v = curl(R(distance) psi)` |
//! | [`AnyPotential`], [`AnyVelocity`] | parts whose types are known only when the program runs |
//!
//! All are [`VelocityField`]s, so [`Advection`](welter_tracking::flows::Advection) carries surfaces with them.
//!
//! ```
//! use glam::DVec3;
//! use welter_fluids::procedural::*;
//! use welter_meshing::field::Ball;
//! use welter_tracking::flows::{Advection, Flow, fields::{CurlNoise, CurlNoiseParameters}};
//! use welter_tracking::surface::MovingSurface;
//! use welter_meshing::shapes::{Sphere, sphere};
//!
//! let ring = VortexRing::new(&VortexRingParameters::default())?;
//! let noise = CurlNoise::new(&CurlNoiseParameters::default())?;
//! let swirl = WeightedSum::new(vec![
//!     Weighted { part: AnyPotential::new(ring), amplitude: Amplitude::Constant(1.0) },
//!     Weighted { part: AnyPotential::new(noise), amplitude: Amplitude::Constant(0.2) },
//! ]);
//! let ball = Ball { center: DVec3::new(0.0, 2.0, 0.0), radius: 0.5 };
//! let around = Bounded::new(swirl, ball, &BoundaryParameters { ramp_width: 0.5, ..Default::default() })?;
//! let spread = DivergentSource::new(&DivergentSourceParameters::default())?;
//! let flow = WeightedSum::new(vec![
//!     Weighted { part: AnyVelocity::new(around), amplitude: Amplitude::Constant(1.0) },
//!     Weighted { part: AnyVelocity::new(spread), amplitude: Amplitude::Constant(0.1) },
//! ]);
//! let smoke = MovingSurface::new(&*sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?)?;
//! assert!(Advection::new(flow).advance(&smoke, 0.0, 0.01).is_ok());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What it promises
//! * Curls are formulas: no finite differences anywhere. The velocity of everything with a potential is its curl within
//!   roundings, so it has no divergence; [`DivergentSource::divergence`] states what the sources have.
//! * Values depend on the position, the time and the parameters alone: the same bits on every machine and for any number of threads.
//! * Lengths are relative: with all lengths times a power of two (velocities and radii likewise; circulations and potentials times
//!   its square) velocities come out times that power, bit for bit, as long as nothing leaves the range of normal numbers.
//! * Nothing panics. A position that is infinite or not a number gives a velocity that is not a number, which
//!   [`Advection`](welter_tracking::flows::Advection) refuses with its place.
//!
//! # What it does not promise
//! A solution of the equations of fluids: vortices do not carry each other, and pressure is in none of this.
//!
//! # Complexity
//! Linear in the number of parts, for each position.

mod amplitude;
mod any;
mod bounded;
mod carried;
mod curl_noise;
mod elliptic;
mod error;
mod filament;
mod keyframes;
mod moving;
mod ramp;
mod ring;
mod scalar_noise;
mod scale;
mod source;
mod sum;
mod wall;
mod wind;

pub use amplitude::{Amplitude, Pulse};
pub use any::{AnyPotential, AnyVelocity};
pub use bounded::{BoundaryParameters, Bounded};
pub use error::ProceduralError;
pub use filament::{VortexFilament, VortexFilamentParameters};
pub use keyframes::{Interpolation, Keyed, Keyframes, Path};
pub use moving::Moving;
pub use ring::{VortexRing, VortexRingParameters};
pub use scalar_noise::{ScalarNoise, ScalarNoiseParameters};
pub use source::{DivergentSource, DivergentSourceParameters, Extent, SourceNoise};
pub use sum::{Weighted, WeightedSum};
pub use wind::{Wind, WindParameters};

use glam::DVec3;
use welter_tracking::flows::VelocityField;

/// A flow that is the curl of a vector potential, and so has no divergence.
///
/// Its [`VelocityField::velocity`] is the curl, so it can be followed as it is; with the potential it can be led around solids
/// ([`Bounded`]).
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{LocalPotential, VectorPotential};
/// use welter_tracking::flows::VelocityField;
///
/// /// Shear, `v = (y, 0, 0)`, the curl of `(0, 0, y^2 / 2)`.
/// struct Layers;
/// impl VectorPotential for Layers {
///     fn potential_and_curl(&self, p: DVec3, _time: f64) -> LocalPotential {
///         LocalPotential { potential: 0.5 * p.y * p.y * DVec3::Z, curl: p.y * DVec3::X }
///     }
/// }
/// impl VelocityField for Layers {
///     fn velocity(&self, p: DVec3, time: f64) -> DVec3 {
///         self.potential_and_curl(p, time).curl
///     }
/// }
/// assert_eq!(Layers.velocity(DVec3::ONE, 0.0), DVec3::X);
/// ```
pub trait VectorPotential: VelocityField {
    /// The potential and its curl, the velocity, at a position and a time.
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential;
}

/// A vector potential at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalPotential {
    /// The potential, in length^2 / time.
    pub potential: DVec3,
    /// Its curl, a velocity.
    pub curl: DVec3,
}

impl LocalPotential {
    /// No flow.
    pub const ZERO: Self = Self { potential: DVec3::ZERO, curl: DVec3::ZERO };

    /// At a position that is none.
    const NAN: Self = Self { potential: DVec3::NAN, curl: DVec3::NAN };
}
