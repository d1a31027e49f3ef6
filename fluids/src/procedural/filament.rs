//! Vortex filaments along polylines: [`VortexFilament`].
//!
//! # What it computes
//! The potential of a polyline whose vorticity is spread over a core of thickness `a`, and its curl, the integral of Biot and
//! Savart with the kernel of \[Rosenhead30\],
//! ```text
//!   psi(x) = circulation / (4 pi)  integral over the line of  dl / sqrt(|x - y|^2 + a^2)
//!     v(x) = circulation / (4 pi)  integral over the line of  dl x (x - y) / (|x - y|^2 + a^2)^(3/2)
//! ```
//! over the segments as they are: an open line ends where it ends, and is not continued to infinity. Closed ones are what smoke rings
//! are made of \[Angelidis05\].
//!
//! # What it promises
//! * Both integrals are in closed form for each segment, within some 10 roundings of the integral of the magnitudes and what
//!   a shift of the position by three roundings of the length of the segment changes, also on the line, at its vertices and in line
//!   with segments.
//! * The velocity is the curl of the potential, so it has no divergence, whether the line is closed or not; it has all
//!   derivatives.
//! * All lengths times a power of two, the circulation times its square: velocities times the power, bit for bit, as long
//!   as nothing is below the smallest normal number.
//! * The same bits on every machine.
//!
//! # What it does not promise
//! Vorticity on the line alone if it is open: a vortex cannot end, so the curl of the velocity also has a part that leads from one end
//! to the other through all of space, as the current of two charges does. Beyond 2^500 times the size of the line the velocity is
//! zero.
//!
//! # Method
//! With `d_1`, `d_2` from the ends of a segment `l` to `x`, `r_i^2 = |d_i|^2 + a^2`, and `M = r_1 r_2 + d_1 . d_2 + a^2`:
//! ```text
//!   integral of dl / sqrt(...)          =  l / |l| ln(1 + |l| (r_1 + r_2 + |l|) / M)
//!   integral of dl x (x - y) / (...)^3  =  (1/r_1 + 1/r_2) / M  l x d_1
//! ```
//! Between the ends the terms of `M` cancel; there it is `(|l x d_1|^2 + a^2 |l|^2) / (r_1 r_2 - d_1 . d_2 - a^2)`, by the
//! identity of Lagrange.
//!
//! # Complexity
//! Linear in the number of segments: some 20 ns each, 30 with the potential.

use std::f64::consts::PI;

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::scale::{Frame, Place};
use super::{LocalPotential, ProceduralError, VectorPotential};

/// What a [`VortexFilament`] is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct VortexFilamentParameters {
    /// The line; vortices turn counterclockwise around it when seen against its direction. Vertices may coincide, but not
    /// all of them. Default: from -1 to 1 on the z axis.
    pub vertices: Vec<DVec3>,
    /// Whether a last segment leads back to the first vertex. Default: no.
    pub closed: bool,
    /// Thickness of the core, a length above 0, from 2^-100 to 2^100 times the size of the line. Default: 0.1.
    pub core: f64,
    /// Circulation around the line, length^2 / time. Default: 1.
    pub circulation: f64,
}

impl Default for VortexFilamentParameters {
    fn default() -> Self {
        Self { vertices: vec![DVec3::NEG_Z, DVec3::Z], closed: false, core: 0.1, circulation: 1.0 }
    }
}

impl VortexFilamentParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ProceduralError`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        let least = if self.closed { 3 } else { 2 };
        if self.vertices.len() < least {
            return Err(ProceduralError::Line { vertices: self.vertices.len(), least });
        }
        if let Some(index) = self.vertices.iter().position(|v| !v.is_finite()) {
            return Err(ProceduralError::Vertex { index, position: self.vertices[index] });
        }
        let size = self.size();
        ProceduralError::require_length("longest side of the box around the filament", size)?;
        ProceduralError::require_core(self.core, size)?;
        let rate = self.circulation / size;
        ProceduralError::require(
            rate.is_finite(),
            "circulation",
            self.circulation,
            "finite, also over the size",
        )
    }

    /// The longest side of the box around the line.
    fn size(&self) -> f64 {
        let [first, rest @ ..] = &self.vertices[..] else { return 0.0 };
        let (min, max) = rest.iter().fold((*first, *first), |(min, max), &v| (min.min(v), max.max(v)));
        (max - min).max_element()
    }
}

/// A vortex along a polyline.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{VortexFilament, VortexFilamentParameters};
/// use welter_tracking::flows::VelocityField;
///
/// let ends = vec![DVec3::new(0.0, 0.0, -1e6), DVec3::new(0.0, 0.0, 1e6)];
/// let filament = VortexFilament::new(&VortexFilamentParameters { vertices: ends, core: 0.1, ..Default::default() })?;
/// // Of an infinite line: circulation s / (2 pi (s^2 + a^2)).
/// let v = filament.velocity(DVec3::new(0.3, 0.0, 0.0), 0.0);
/// let expected = 0.3 / (2.0 * std::f64::consts::PI * 0.1);
/// assert!((v - expected * DVec3::Y).length() < 1e-11);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct VortexFilament {
    frame: Frame,
    /// The first again at the end of a closed line.
    vertices: Vec<DVec3>,
    /// In units.
    core_squared: f64,
    /// Circulation over 4 pi.
    strength: f64,
    /// The same over a unit of length.
    rate: f64,
}

impl VortexFilament {
    /// The filament of some parameters.
    ///
    /// # Errors
    /// As [`VortexFilamentParameters::validate`].
    pub fn new(parameters: &VortexFilamentParameters) -> Result<Self, ProceduralError> {
        parameters.validate()?;
        let mut vertices = parameters.vertices.clone();
        let frame = Frame::new(vertices[0], parameters.size());
        if parameters.closed {
            vertices.push(vertices[0]);
        }
        let core = frame.scaled(parameters.core);
        let strength = parameters.circulation / (4.0 * PI);
        Ok(Self { frame, vertices, core_squared: core * core, strength, rate: frame.scaled(strength) })
    }
}

/// An end of a segment as seen from a point, in units.
#[derive(Clone, Copy)]
struct End {
    /// From the end to the point.
    difference: DVec3,
    /// Its length, with the core.
    distance: f64,
}

/// What a segment adds to the flow.
#[derive(Clone, Copy)]
struct Segment {
    along: DVec3,
    length: f64,
    /// `(r_1 + r_2 + |l|) / M`.
    spread: f64,
    velocity: DVec3,
}

impl Segment {
    fn new(from: End, to: End, along: DVec3, core_squared: f64) -> Self {
        let length = along.length();
        let across = along.cross(from.difference);
        let product = from.distance * to.distance;
        let inner = from.difference.dot(to.difference) + core_squared;
        let sum = if inner >= 0.0 {
            product + inner
        } else {
            (across.length_squared() + core_squared * (length * length)) / (product - inner)
        };
        let spread = (from.distance + to.distance + length) / sum;
        let inverses = 1.0 / from.distance + 1.0 / to.distance;
        Self { along, length, spread, velocity: inverses / sum * across }
    }

    fn potential(&self) -> DVec3 {
        self.spread * log1p_over(self.length * self.spread) * self.along
    }
}

/// `ln(1 + y) / y`, 1 at 0.
fn log1p_over(y: f64) -> f64 {
    if y > 0.0 { libm::log1p(y) / y } else { 1.0 }
}

impl VortexFilament {
    /// All segments, each with its flow at a position near enough.
    fn segments(&self, position: DVec3) -> impl Iterator<Item = Segment> {
        // From each vertex, not from the first one: the roundings are those of the distance.
        let end = move |vertex: DVec3| {
            let difference = self.frame.scaled(position - vertex);
            End { difference, distance: (difference.length_squared() + self.core_squared).sqrt() }
        };
        let mut from = end(self.vertices[0]);
        self.vertices.windows(2).map(move |pair| {
            let to = end(pair[1]);
            let along = self.frame.scaled(pair[1] - pair[0]);
            let segment = Segment::new(from, to, along, self.core_squared);
            from = to;
            segment
        })
    }
}

impl VectorPotential for VortexFilament {
    fn potential_and_curl(&self, position: DVec3, _time: f64) -> LocalPotential {
        match self.frame.place(position) {
            Place::Near(_) => {
                let add = |(potential, velocity): (DVec3, DVec3), segment: Segment| {
                    (potential + segment.potential(), velocity + segment.velocity)
                };
                let (potential, curl) = self.segments(position).fold((DVec3::ZERO, DVec3::ZERO), add);
                LocalPotential { potential: self.strength * potential, curl: self.rate * curl }
            }
            Place::Far => LocalPotential::ZERO,
            Place::Nowhere => LocalPotential::NAN,
        }
    }
}

impl VelocityField for VortexFilament {
    fn velocity(&self, position: DVec3, _time: f64) -> DVec3 {
        match self.frame.place(position) {
            Place::Near(_) => {
                let add = |velocity: DVec3, segment: Segment| velocity + segment.velocity;
                self.rate * self.segments(position).fold(DVec3::ZERO, add)
            }
            Place::Far => DVec3::ZERO,
            Place::Nowhere => DVec3::NAN,
        }
    }
}
