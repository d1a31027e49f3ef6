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

    /// Where a step of a point ends, if it would end at `to` by the velocities alone: fields with walls put back what has crossed
    /// one, for a step has an error, and its path is not known between its ends. `times` are those of the beginning and the end.
    ///
    /// Of several walls, the first that does not hold puts the end back by itself; [`confined`] repeats it until all hold. So an end
    /// that is given back as it is, is beside all walls. A field in others is asked by them. Default: there are no walls, so `to`,
    /// bit for bit, which is also what those with walls give where there is nothing to be put back.
    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        let _ = (from, times);
        to
    }
}

/// How often a wall puts an end back. For two plane walls a few times are enough, since their crease is known after two.
const TURNS: usize = 32;

/// How much farther toward a crease than by the last wall an end is put at once: where tangent planes are nearly parallel, their
/// crease may be anywhere, and the next turn knows better. Chosen, not tuned.
const FARTHEST: f64 = 8.0;

/// How often an end is put beyond a wall, each time twice as far, at most: from roundings to the size of a solid.
const PUSHES: usize = 64;

/// The end of a step beside all walls of a field: [`VelocityField::confine`], until nothing changes. If that is not so after 32 times,
/// as where walls meet at a small angle, the point stays with the walls: at the start, if they are at rest. If it was in one of
/// several that put it into each other, as solids side by side do, it is put out beyond them, ever farther, until it is beside all.
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::flows::{VelocityField, confined};
///
/// /// A wind against a floor and a wall.
/// struct Corner;
/// impl VelocityField for Corner {
///     fn velocity(&self, _: DVec3, _: f64) -> DVec3 {
///         DVec3::new(-1.0, 0.5, -1.0)
///     }
///     fn confine(&self, _: DVec3, to: DVec3, _: [f64; 2]) -> DVec3 {
///         DVec3::new(to.x.max(0.0), to.y, to.z.max(0.0))
///     }
/// }
/// assert_eq!(confined(&Corner, DVec3::ONE, DVec3::new(-1.0, 2.0, -1.0), [0.0, 2.0]), 2.0 * DVec3::Y);
/// ```
pub fn confined(field: &impl VelocityField, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
    in_turn(field, from, to, times).unwrap_or_else(|last| {
        in_turn(field, from, from, times)
            .ok()
            .or_else(|| beyond(field, from, last, times))
            .unwrap_or_else(|| field.confine(from, from, times))
    })
}

/// An end beside all walls, or one that is not after many turns. Two that put it back into each other are left along their crease.
fn in_turn(field: &impl VelocityField, from: DVec3, mut end: DVec3, times: [f64; 2]) -> Result<DVec3, DVec3> {
    let mut before = DVec3::ZERO;
    for _ in 0..TURNS {
        let next = field.confine(from, end, times);
        if next == end || !next.is_finite() {
            return Ok(next);
        }
        let gone = next - end;
        (end, before) = match to_crease(before, gone) {
            Some(step) => (next + step, DVec3::ZERO),
            None => (next, gone),
        };
    }
    Err(end)
}

/// From a point that one plane wall was left for by a displacement, and another one by a second that leads back: along the other one to
/// the crease of both, or toward it if it is far.
fn to_crease(first: DVec3, second: DVec3) -> Option<DVec3> {
    let [one, other] = [first, second].map(DVec3::normalize_or_zero);
    let behind = -one.dot(second);
    let along = one - one.dot(other) * other;
    let square = along.length_squared();
    // Of walls that are parallel within roundings there is none.
    if !(behind > 0.0 && square > 1e-20) {
        return None;
    }
    let step = behind / square * along;
    Some(step.clamp_length_max(FARTHEST * second.length()))
}

/// An end beside all walls, where those that put it back put it into each other: it is put beyond each by more and more, until
/// another wall leads out.
fn beyond(field: &impl VelocityField, from: DVec3, mut end: DVec3, times: [f64; 2]) -> Option<DVec3> {
    let mut push = 0.0;
    for _ in 0..PUSHES {
        let next = field.confine(from, end, times);
        if next == end || field.confine(from, next, times) == next {
            return Some(next);
        }
        let gone = next - end;
        push = if push == 0.0 { gone.length() } else { 2.0 * push };
        end = next + push * gone.normalize_or_zero();
    }
    None
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
    /// Where a point is after a step of `dt` with a field, beside its walls ([`confined`]). It need not be finite: a sum can overflow.
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
            return Ok(confined(field, start, start + dt * v1, [time, time + dt]));
        }
        let half = 0.5 * dt;
        let v2 = at(start + half * v1, time + half)?;
        let v3 = at(start + half * v2, time + half)?;
        let v4 = at(start + dt * v3, time + dt)?;
        let end = start + dt * ((v1 + 2.0 * (v2 + v3) + v4) / 6.0);
        Ok(confined(field, start, end, [time, time + dt]))
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
