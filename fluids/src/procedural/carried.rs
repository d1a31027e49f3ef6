//! Paths of points that a flow carries: [`Path::carried`].
//!
//! Method: the classical method of Runge and Kutta \[Kutta01\] from keyframe to keyframe, and between them the cubic polynomials that have
//! the velocities of the flow at the keyframes: both have an error of order four in the step.

use glam::DVec3;
use welter_tracking::flows::{Scheme, VelocityField};

use super::{Path, ProceduralError};

impl Path {
    /// The displacement of a point that starts somewhere at a time and goes with a flow until another, in equal steps. Before and after
    /// it rests. It does not cross the walls of the flow.
    ///
    /// ```
    /// use glam::DVec3;
    /// use welter_fluids::procedural::{Moving, Path, VortexRing, VortexRingParameters};
    ///
    /// // A ring that goes with a wind, and rises by itself.
    /// let ring = VortexRing::new(&VortexRingParameters::default())?;
    /// let speed = ring.own_speed();
    /// let wind = move |_: DVec3, time: f64| DVec3::new(time, speed, 0.0);
    /// let path = Path::carried(&wind, DVec3::ZERO, [0.0, 2.0], 20)?;
    /// assert!((path.at(1.7) - DVec3::new(0.5 * 1.7 * 1.7, 1.7 * speed, 0.0)).length() < 1e-14);
    /// let _rising = Moving { part: ring, path };
    /// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
    /// ```
    ///
    /// # Errors
    /// [`ProceduralError::Parameter`]: no step. [`ProceduralError::KeyTime`]: times that are not finite, not in order, or that steps
    /// cannot tell apart. [`ProceduralError::KeyValue`]: a position or velocity that is not finite, at the keyframe of that number.
    pub fn carried(
        flow: &impl VelocityField,
        start: DVec3,
        [from, to]: [f64; 2],
        steps: u32,
    ) -> Result<Self, ProceduralError> {
        ProceduralError::require(steps > 0, "steps", f64::from(steps), "at least 1")?;
        let time = |index: u32| {
            let part = f64::from(index) / f64::from(steps);
            from * (1.0 - part) + to * part
        };
        let mut position = start;
        let mut keys = vec![(from, DVec3::ZERO, flow.velocity(start, from))];
        for index in 0..steps {
            let (now, next) = (time(index), time(index + 1));
            position = Scheme::Rk4.follow(flow, position, now, next - now).unwrap_or(DVec3::NAN);
            keys.push((next, position - start, flow.velocity(position, next)));
        }
        Self::with_rates(&keys)
    }
}
