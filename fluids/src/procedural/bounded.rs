//! Flows around solids: [`Bounded`].
//!
//! # What it computes
//! With the signed distance `phi` to a solid, positive outside, `R` an odd ramp from zero at the wall to one at the width `w`, and
//! `psi_w` a potential of the motion of the solid, `1/2 U x (x - anchor)` plus a constant vector,
//! ```text
//!   v = curl(psi_w + R(phi / w) (psi - psi_w))
//!     = v_w + R (curl psi - v_w) + R'/w  grad phi x (psi - psi_w)
//! ```
//! as \[Bridson07\] bounds curl noise, here for any potential, and for sums of them.
//!
//! # What it promises
//! * No divergence, as of every curl. Farther than the width from the solid nothing changes, bit for bit.
//! * At the wall, `phi = 0`, the velocity relative to the solid is `R'(0)/w grad phi x (psi - psi_w)`: perpendicular to the normal
//!   within the rounding of one cross product, whatever the potential and the ramp. It is not zero: the fluid slips.
//! * So the wall is a surface that the exact flow does not cross, from either side: along a path `phi` changes at a rate of
//!   at most a number times `phi`, and so has no zero.
//! * Nor does a path of steps ([`Scheme::follow`](welter_tracking::flows::Scheme::follow),
//!   [`Advection`](welter_tracking::flows::Advection)) lead into the solid, however long they are: an end within, or with the solid in
//!   between, is put back beside the wall ([`VelocityField::confine`]), whatever else is added to this flow in a
//!   [`WeightedSum`](super::WeightedSum). Steps by themselves would cross curved walls by their own error: paths of a fixed time by
//!   one of order four (of order two where second derivatives of the distance jump, as where a face joins a round edge). That much
//!   is put back, so the order of the path is that of the method.
//! * What is in the solid for another reason, as a new vertex in the middle of an edge along a round wall, or smoke that is released
//!   in it, is outside after the next step: at the nearest wall, as far as the gradient leads there.
//! * Of solids at rest without an anchor, one [`Bounded`] in another, all walls hold, also where their layers overlap. Steps
//!   end in none of several solids ([`confined`](welter_tracking::flows::confined)), also where these touch or overlap, as far as
//!   gradients lead out; of solids that move within roundings, and where they leave a place.
//! * Velocities have as many continuous derivatives as the gradient of the distance and the potential, up to four.
//!
//! # What it does not promise
//! * More than one wall where layers of moving or anchored solids overlap: there the last one holds. Two such
//!   solids that may meet are better united to one shape.
//! * Continuous velocities at kinks of the distance (around edges, half way between parts): there the part along the wall jumps
//!   in direction. The part across the kink does not, so there is no divergence in the kink.
//! * Tangential flow on edges and corners, where there is no normal; there steps of any length have to be put back.
//! * The volume of what is put out of the solid.
//! * To keep anybody out of a face that two solids share, which is in neither of them; solids that overlap a little have none.
//! * To see solids between the ends of a step that are thinner than 1/1024 of the width; or a place for a point that moving solids
//!   leave none.
//! * A flow inside that means something: it is that of the odd ramp, against the flow outside, and does not lead out. To keep a flow
//!   in a vessel, let the solid be the [`Complement`](welter_meshing::field::Complement) of what it holds.
//! * Rotation of solids, or speeds that do not grow where the width is small: they are of the order of `psi / w`.
//! * Numbers where the distance has none, as beyond 1e150.
//! * Gradients by finite differences: a distance that has no other is refused ([`ProceduralError::NoExactGradient`]); where only
//!   a part of it has none, velocities there are not numbers.
//!
//! # Complexity
//! That of the potential and the distance; in the layer also a gradient, and with an anchor a second potential. A step takes two more
//! distances, and near the wall two gradients.

use glam::DVec3;
use welter_meshing::field::ScalarField;
use welter_tracking::flows::VelocityField;

use super::ramp::ramp;
use super::wall::{NO_STEP, Wall};
use super::{LocalPotential, Path, ProceduralError, VectorPotential};

/// How a flow is led around a solid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryParameters {
    /// How far from the solid the flow is changed, a length from 2^-450 to 2^450. There is no default but 0, which is refused: about the
    /// size of the solid for wind, the longest wavelength for noise.
    pub ramp_width: f64,
    /// A point in the middle of the solid, where it is before the path displaces it. If there is one, the potential there is taken off:
    /// the flow around the solid does then not depend on constants in the potential, such as the origin of
    /// [`Wind`](super::Wind). Default: none.
    pub anchor: Option<DVec3>,
    /// The displacement of the solid over time. Default: it rests.
    pub path: Option<Path>,
}

impl BoundaryParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ProceduralError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), ProceduralError> {
        ProceduralError::require_length("ramp_width", self.ramp_width)?;
        ProceduralError::require_finite_vector("anchor", self.anchor.unwrap_or(DVec3::ZERO))
    }
}

/// A flow that goes around a solid.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{BoundaryParameters, Bounded, Wind, WindParameters};
/// use welter_meshing::field::Ball;
/// use welter_tracking::flows::VelocityField;
/// let wind = Wind::new(&WindParameters::default())?;
/// let around = Bounded::new(wind, Ball::default(), &BoundaryParameters { ramp_width: 1.0, ..Default::default() })?;
/// // The wind stops in front of the ball, passes at its side, and is as it was far away.
/// assert_eq!(around.velocity(DVec3::NEG_X, 0.0), DVec3::ZERO);
/// assert!(around.velocity(DVec3::Y, 0.0).x > 1.0);
/// assert_eq!(around.velocity(DVec3::new(0.0, 2.5, 0.0), 0.0), DVec3::X);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Bounded<P, S> {
    flow: P,
    solid: S,
    parameters: BoundaryParameters,
}

impl<P: VectorPotential, S: ScalarField> Bounded<P, S> {
    /// Leads a flow around a solid, which is where the field is negative; best a signed distance.
    ///
    /// # Errors
    /// As [`BoundaryParameters::validate`]; [`ProceduralError::NoExactGradient`] for a field without a gradient in closed form.
    pub fn new(flow: P, solid: S, parameters: &BoundaryParameters) -> Result<Self, ProceduralError> {
        parameters.validate()?;
        if !solid.gradient(DVec3::ZERO, NO_STEP).is_finite() {
            return Err(ProceduralError::NoExactGradient);
        }
        Ok(Self { flow, solid, parameters: parameters.clone() })
    }

    /// Displacement and velocity of the solid.
    fn motion(&self, time: f64) -> (DVec3, DVec3) {
        self.parameters.path.as_ref().map_or((DVec3::ZERO, DVec3::ZERO), |path| path.value_and_rate(time))
    }
}

impl<P: VectorPotential, S: ScalarField> VectorPotential for Bounded<P, S> {
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential {
        let free = self.flow.potential_and_curl(position, time);
        let (displacement, velocity) = self.motion(time);
        let in_solid = position - displacement;
        let (value, slope) = ramp(self.solid.value(in_solid) / self.parameters.ramp_width);
        if value == 1.0 && slope == 0.0 {
            return free;
        }
        let anchor = self.parameters.anchor.unwrap_or(DVec3::ZERO);
        let mut wall = velocity.cross(0.5 * (in_solid - anchor));
        if self.parameters.anchor.is_some() {
            wall += self.flow.potential_and_curl(anchor + displacement, time).potential;
        }
        let (potential, curl) = (free.potential - wall, free.curl - velocity);
        let mut sum = velocity + value * curl;
        if slope != 0.0 {
            let normal = self.solid.gradient(in_solid, NO_STEP) / self.parameters.ramp_width;
            sum += slope * normal.cross(potential);
        }
        LocalPotential { potential: wall + value * potential, curl: sum }
    }
}

impl<P: VectorPotential, S: ScalarField> VelocityField for Bounded<P, S> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.potential_and_curl(position, time).curl
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        let end = self.flow.confine(from, to, times);
        if end != to {
            return end;
        }
        let displacements = times.map(|time| self.motion(time).0);
        Wall { solid: &self.solid, displacements, width: self.parameters.ramp_width }.confine(from, to)
    }
}
