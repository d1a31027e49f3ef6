//! Flows that move along a path: [`Moving`].

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::{LocalPotential, Path, VectorPotential};

/// A flow displaced by a path: at each time that of the part, at the position less the displacement.
///
/// The path moves the shape of the flow. It does not add its own velocity to that of the fluid, so what is free of divergence
/// stays so, and a vortex ring that should move with the speed of [`own_speed`](super::VortexRing::own_speed) is given it as a path.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{Interpolation, Moving, Path, VortexRing, VortexRingParameters};
/// use welter_tracking::flows::VelocityField;
/// let ring = VortexRing::new(&VortexRingParameters::default())?;
/// let rise = Path::new(vec![(0.0, DVec3::ZERO), (4.0, 8.0 * DVec3::Y)], Interpolation::Linear)?;
/// let moving = Moving { part: ring, path: rise };
/// assert_eq!(moving.velocity(2.5 * DVec3::Y, 1.0), ring.velocity(0.5 * DVec3::Y, 0.0));
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Moving<F> {
    /// What moves.
    pub part: F,
    /// Its displacement at each time.
    pub path: Path,
}

impl<F: VectorPotential> VectorPotential for Moving<F> {
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential {
        self.part.potential_and_curl(position - self.path.at(time), time)
    }
}

impl<F: VelocityField> VelocityField for Moving<F> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.part.velocity(position - self.path.at(time), time)
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        let [before, after] = times.map(|time| self.path.at(time));
        let unconfined = to - after;
        let end = self.part.confine(from - before, unconfined, times);
        if end == unconfined { to } else { end + after }
    }
}
