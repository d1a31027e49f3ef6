//! Motion with a velocity that is given at every point and time: [`Advection`].
//!
//! Each vertex follows `dx/dt = v(x, t)` on its own, by the explicit Euler method (error of order 1 in the time step)
//! or the classical method of Runge and Kutta \[Kutta01\] (order 4 where the field has four continuous derivatives).

use glam::DVec3;
use welter_meshing::surface::VertexId;

use super::{Flow, FlowError, Prediction, move_each, require_step};
use crate::surface::MovingSurface;

/// A velocity at every point and time. Closures of a position and a time are such fields.
pub trait VelocityField: Sync {
    /// The velocity at a position and a time.
    fn velocity(&self, position: DVec3, time: f64) -> DVec3;
}

impl<F: Fn(DVec3, f64) -> DVec3 + Sync> VelocityField for F {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self(position, time)
    }
}

/// How positions follow from velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// One evaluation, at the beginning.
    Euler,
    /// Four evaluations: at the beginning, twice in the middle, at the end.
    #[default]
    Rk4,
}

/// A place where a field has no velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoVelocity {
    /// Where.
    pub position: DVec3,
    /// When.
    pub time: f64,
    /// What the field gave, which is not finite.
    pub velocity: DVec3,
}

impl Scheme {
    /// Where a point is after a step of `dt` with a field. It need not be finite: a sum can overflow.
    ///
    /// ```
    /// use glam::DVec3;
    /// use welter_tracking::flows::Scheme;
    /// let growth = |p: DVec3, _: f64| p;
    /// assert_eq!(Scheme::Euler.follow(&growth, DVec3::X, 0.0, 0.5), Ok(1.5 * DVec3::X));
    /// let end = Scheme::Rk4.follow(&growth, DVec3::X, 0.0, 0.5).map(|end| end.x);
    /// assert!(end.is_ok_and(|x| (x - 0.5_f64.exp()).abs() < 3e-4));
    /// ```
    ///
    /// # Errors
    /// [`NoVelocity`]: where the velocity is infinite or not a number.
    pub fn follow(
        self,
        field: &impl VelocityField,
        start: DVec3,
        time: f64,
        dt: f64,
    ) -> Result<DVec3, NoVelocity> {
        let at = |position: DVec3, time: f64| {
            let velocity = field.velocity(position, time);
            if velocity.is_finite() { Ok(velocity) } else { Err(NoVelocity { position, time, velocity }) }
        };
        let v1 = at(start, time)?;
        if self == Self::Euler {
            return Ok(start + dt * v1);
        }
        let half = 0.5 * dt;
        let v2 = at(start + half * v1, time + half)?;
        let v3 = at(start + half * v2, time + half)?;
        let v4 = at(start + dt * v3, time + dt)?;
        Ok(start + dt * ((v1 + 2.0 * (v2 + v3) + v4) / 6.0))
    }
}

/// The flow of a velocity field.
///
/// ```
/// use glam::DVec3;
/// use welter_meshing::shapes::{Sphere, sphere};
/// use welter_tracking::flows::{Advection, Flow};
/// use welter_tracking::surface::MovingSurface;
///
/// let surface = MovingSurface::new(&*sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?)?;
/// let flow = Advection::new(|p: DVec3, t: f64| t * p);
/// let prediction = flow.advance(&surface, 0.0, 0.2)?;
/// // Positions grow by e to the integral of t.
/// let ratio = prediction.ends[0].length() / surface.positions()[0].length();
/// assert!((ratio - 0.02_f64.exp()).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Advection<F> {
    /// The velocities.
    pub field: F,
    /// How to follow them. Default: Runge and Kutta.
    pub scheme: Scheme,
}

impl<F: VelocityField> Advection<F> {
    /// The flow of a field by the method of Runge and Kutta.
    pub fn new(field: F) -> Self {
        Self { field, scheme: Scheme::Rk4 }
    }

    fn end(&self, vertex: VertexId, start: DVec3, time: f64, dt: f64) -> Result<DVec3, FlowError> {
        self.scheme.follow(&self.field, start, time, dt).map_err(|stray| {
            let NoVelocity { position, time, velocity } = stray;
            FlowError::Velocity { vertex, position, time, velocity }
        })
    }
}

impl<F: VelocityField> Flow for Advection<F> {
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError> {
        require_step(dt)?;
        let ends = move_each(surface, |vertex, start| self.end(vertex, start, time, dt))?;
        Ok(Prediction { ends, dt })
    }
}
