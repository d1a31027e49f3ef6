//! Vortex rings: [`VortexRing`].
//!
//! # What it computes
//! The potential of a circle of radius `R` whose vorticity is spread over a core of thickness `a`, and its curl, the integral of
//! Biot and Savart with the kernel of \[Rosenhead30\],
//! ```text
//!   psi(x) = circulation / (4 pi)  integral over the circle of  dl / sqrt(|x - y|^2 + a^2)
//!     v(x) = circulation / (4 pi)  integral over the circle of  dl x (x - y) / (|x - y|^2 + a^2)^(3/2)
//! ```
//! [`VortexFilament`](super::VortexFilament) is the same of a polygon.
//!
//! # What it promises
//! * Potential and velocity are those integrals within some 10 roundings of the integral of the magnitudes, and what
//!   a shift of the position by a few roundings of the radius changes, at every finite point: on the circle, on the axis, at the centre.
//!   There is no `0/0`: see the method.
//! * The velocity is the curl of the potential, so it has no divergence; it has all derivatives.
//! * Far from the core, relative to `a`, the flow is that of an infinitely thin ring, with a relative error of the order `(a/s)^2`
//!   at a distance `s` from the circle; the circulation around the circle at that distance is `s^2 / (s^2 + a^2)` of the
//!   whole in the limit of a thin core.
//! * All lengths times a power of two, the circulation times its square: velocities times the power, bit for bit, as long
//!   as nothing is below the smallest normal number.
//! * The same bits on every machine.
//!
//! # What it does not promise
//! Vorticity that ends somewhere: it falls with the fourth power of the distance from the circle, and faster far away. Beyond
//! 2^500 radii the velocity is zero.
//!
//! # Method
//! With `z` along the axis, `r` away from it and `A = (axis x x)`, a vector of length `r`, substitute `phi = pi - 2 theta` for the angle
//! on the circle, and let `D^2 = (R + r)^2 + z^2 + a^2` and `m = 1 - k'^2 = 4 R r / D^2`:
//! ```text
//!   psi = 4 C R^2 / (pi D^3)  P  A,                  P = integral of sin^2 cos^2 / Delta^3
//!   v_z = C R / (pi D^3) ((R - r) I + 2 r J),        I = integral of 1 / Delta^3,   J = integral of cos^2 / Delta^3
//!   v_r = 4 C R^2 z r / (pi D^5)  Q,                 Q = integral of (sin^2 - cos^2) / (m Delta^3)
//! ```
//! with `C` for the circulation and `Delta^2 = cos^2 + k'^2 sin^2`. Textbooks have `K` and `E`, differences of which vanish as the square
//! of `r` on the axis and are divided by it; these integrals are positive and are computed without a difference.
//! That the core makes of `z^2` nothing but `z^2 + a^2` is why it costs nothing.
//!
//! The potential that \[Brochu12, section 5.4.2\] prints is `(x_3, 0, -x_1) / ((r - d)^2 + 2 r d)`. Its denominator is `r^2 + d^2`, so
//! it has no core on the circle, and `x` is meant to be relative to the centre. It points the same way as this one.
//!
//! # Complexity
//! Five or six steps of a transformation, with a square root each: some 100 ns.

use std::f64::consts::PI;

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::elliptic::RingIntegrals;
use super::scale::{Frame, Place, unit};
use super::{LocalPotential, ProceduralError, VectorPotential};

/// What a [`VortexRing`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexRingParameters {
    /// Middle of the circle. Default: the origin.
    pub center: DVec3,
    /// Direction of the axis, of any length: where the fluid goes in the middle if the circulation is positive. Default: y, up.
    pub axis: DVec3,
    /// Radius of the circle, a length from 2^-450 to 2^450. Default: 1.
    pub radius: f64,
    /// Thickness of the core, a length above 0, from 2^-100 to 2^100 radii. The speed is greatest at about this distance from
    /// the circle. Default: 0.1.
    pub core: f64,
    /// Circulation around the circle, length^2 / time. The speed in the middle is `circulation / (2 radius)` if the core
    /// is thin. Default: 2.
    pub circulation: f64,
}

impl Default for VortexRingParameters {
    fn default() -> Self {
        Self { center: DVec3::ZERO, axis: DVec3::Y, radius: 1.0, core: 0.1, circulation: 2.0 }
    }
}

impl VortexRingParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ProceduralError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        let &Self { center, axis, radius, core, circulation } = self;
        ProceduralError::require_finite_vector("center", center)?;
        ProceduralError::require_direction("axis", axis)?;
        ProceduralError::require_length("radius", radius)?;
        ProceduralError::require_core(core, radius)?;
        let speed = circulation / radius;
        ProceduralError::require(
            speed.is_finite(),
            "circulation",
            circulation,
            "finite, also over the radius",
        )
    }
}

/// A vortex ring.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{VectorPotential, VortexRing, VortexRingParameters};
/// use welter_tracking::flows::VelocityField;
///
/// let ring = VortexRing::new(&VortexRingParameters { core: 1e-6, ..Default::default() })?;
/// // On the axis: circulation R^2 / (2 (R^2 + y^2)^(3/2)).
/// let v = ring.velocity(DVec3::new(0.0, 0.75, 0.0), 0.0);
/// assert!((v - 0.512 * DVec3::Y).length() < 1e-11);
/// assert_eq!(v, ring.potential_and_curl(DVec3::new(0.0, 0.75, 0.0), 0.0).curl);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexRing {
    frame: Frame,
    axis: DVec3,
    circulation: f64,
    /// Circulation over a unit of length.
    rate: f64,
    /// In units.
    radius: f64,
    /// In units.
    core: f64,
}

impl VortexRing {
    /// The ring of some parameters.
    ///
    /// # Errors
    /// As [`VortexRingParameters::validate`].
    pub fn new(parameters: &VortexRingParameters) -> Result<Self, ProceduralError> {
        parameters.validate()?;
        let &VortexRingParameters { center, axis, radius, core, circulation } = parameters;
        let frame = Frame::new(center, radius);
        let rate = frame.scaled(circulation);
        let (radius, core) = (frame.scaled(radius), frame.scaled(core));
        Ok(Self { frame, axis: unit(axis), circulation, rate, radius, core })
    }

    /// The speed along the axis with which the ring moves itself: that of the flow on the circle. With a thin core it is
    /// `circulation / (4 pi radius) (ln(8 radius / core) - 1)`.
    ///
    /// ```
    /// use welter_fluids::procedural::{VortexRing, VortexRingParameters};
    /// let ring = VortexRing::new(&VortexRingParameters { core: 1e-3, ..Default::default() })?;
    /// let expected = 2.0 / (4.0 * std::f64::consts::PI) * (8000_f64.ln() - 1.0);
    /// assert!((ring.own_speed() - expected).abs() < 1e-5);
    /// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
    /// ```
    #[must_use]
    pub fn own_speed(&self) -> f64 {
        self.meridian(self.radius, 0.0).axial * self.rate
    }

    /// The flow at a distance from the axis and a height above the plane of the circle, in units of length, for a circulation of one.
    fn meridian(&self, distance: f64, height: f64) -> Meridian {
        let core_and_height = self.core * self.core + height * height;
        let (inward, outward) = (self.radius - distance, self.radius + distance);
        let across = (outward * outward + core_and_height).sqrt();
        let integrals = RingIntegrals::new((inward * inward + core_and_height).sqrt() / across);
        // Powers of its inverse vanish far away, where its own are beyond the largest number.
        let inverse = 1.0 / across;
        let cubed = inverse * inverse * inverse;
        let of_radius = self.radius / PI;
        let of_square = 4.0 * self.radius * of_radius;
        Meridian {
            potential: of_square * cubed * integrals.product,
            axial: of_radius * cubed * (inward * integrals.one + 2.0 * distance * integrals.cosine),
            radial: of_square * cubed * (height * inverse * inverse) * integrals.difference,
        }
    }
}

/// The flow in a half plane through the axis.
#[derive(Clone, Copy)]
struct Meridian {
    /// Length of the potential over the distance from the axis.
    potential: f64,
    /// Velocity along the axis.
    axial: f64,
    /// Velocity away from the axis, over the distance from it.
    radial: f64,
}

impl VectorPotential for VortexRing {
    fn potential_and_curl(&self, position: DVec3, _time: f64) -> LocalPotential {
        let relative = match self.frame.place(position) {
            Place::Near(relative) => relative,
            Place::Far => return LocalPotential::ZERO,
            Place::Nowhere => return LocalPotential::NAN,
        };
        let height = relative.dot(self.axis);
        let away = relative - height * self.axis;
        let Meridian { potential, axial, radial } = self.meridian(away.length(), height);
        LocalPotential {
            potential: self.circulation * (potential * self.axis.cross(relative)),
            curl: self.rate * (axial * self.axis + radial * away),
        }
    }
}

impl VelocityField for VortexRing {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.potential_and_curl(position, time).curl
    }
}
