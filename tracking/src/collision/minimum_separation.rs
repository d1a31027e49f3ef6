//! When two moving primitives are first within a distance of each other: [`Approach`].
//!
//! # What it computes
//! A time up to which they are farther apart, at which they are about that near, with the closest points and
//! a normal there.
//!
//! # What it promises
//! * Never a miss: if the exact distance is `distance` or less at some time of the step, an approach is
//!   returned, and its time is not after the first such time. `None` is a proof that they stay farther apart.
//! * False alarms are bounded: at the time of the approach their exact distance is between the two bounds
//!   that it tells. With `r` the norm of the vector of the largest coordinate differences between the
//!   primitives during the step, the upper one is at most `distance + 2^-44 r` up to its last bits, but for
//!   what is said below.
//! * For a distance of 0, an approach is returned if and only if there is a contact, exactly.
//! * All of this at every scale: nothing overflows or underflows.
//!
//! # What it does not promise
//! That 2^-44 `r` is reached in every case. Where a vertex or edge is met at a distance much smaller than
//! `r`, the lower bound is of bad condition ([`closest_points`](super::closest_points)), no direction may
//! prove a further step, and the alarm is early: tests with a distance of 1e-9 on small grids saw this about
//! once in a hundred approaches, at distances up to 2.0e-9. Where the primitives turn against each other
//! while they stay hardly farther apart than the distance, steps get short and may be used up: seen once
//! there, at 3.2e-9. The approach tells in both cases how near they came.
//!
//! # Method
//! Conservative advancement, with a proven bound in rounded arithmetic (`advance`); for a distance of 0,
//! exact contact first. Cost: a few steps in general, at most the number that the parameters allow.

use super::advance::{SLACK, advance};
use super::error::{check_finite, require};
use super::motion::Motion;
use super::pair::{EDGE_EDGE, Pair, VERTEX_FACE, VERTEX_SEGMENT};
use super::response::{normal, outward};
use super::support::Place;
use super::{CollisionError, coordinates};
use welter_predicates::{Point, ccd};

/// What is asked of the separation of two primitives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MinimumSeparationParameters {
    /// The distance to be kept, in the unit of the coordinates; not negative. Default: 0, contact itself.
    pub distance: f64,
    /// The most steps of advancement. Default: 1000, many times the 121 that all but one query of the
    /// tests took at most, among them thin triangles and fast flights.
    pub most_steps: u32,
}

impl Default for MinimumSeparationParameters {
    fn default() -> Self {
        Self { distance: 0.0, most_steps: 1000 }
    }
}

impl MinimumSeparationParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`CollisionError::Parameter`] with the one that is not.
    pub fn validate(&self) -> Result<(), CollisionError> {
        let holds = (0.0..=f64::MAX).contains(&self.distance);
        require(holds, "distance", self.distance, "a finite length, not negative")
    }
}

/// The first approach of two primitives of `D` dimensions with `P` vertices together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach<const D: usize, const P: usize> {
    /// They are farther apart than the distance at all times before; it is not after the first time at which
    /// they are not.
    pub time: f64,
    /// Bounds of their exact distance at that time. The upper one is infinite if the distance is beyond the
    /// range of `f64`.
    pub distance: [f64; 2],
    /// The weight of each vertex in the point of its primitive that is closest to the other at that time: not
    /// negative, with sum one over each primitive.
    pub weights: [f64; P],
    /// Unit vector from the second primitive to the first, chosen as that of an [`Impact`](super::Impact).
    pub normal: [f64; D],
    /// Steps of advancement that it took.
    pub steps: u32,
}

/// When the moving vertex is first within a distance of the moving triangle; `None` if it stays farther away.
///
/// `t0` and `t1` are the places of `v, f0, f1, f2` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{MinimumSeparationParameters, minimum_separation::vertex_face};
/// let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// let v = |z| [[0.0, 0.0, z], face[0], face[1], face[2]];
/// let parameters = |distance| MinimumSeparationParameters { distance, ..Default::default() };
/// let within = |distance| vertex_face(v(3.0), v(1.0), &parameters(distance));
/// let approach = within(2.0)?.expect("it comes near");
/// assert!(0.499_999 < approach.time && approach.time <= 0.5);
/// assert_eq!(approach.normal, [0.0, 0.0, 1.0]);
/// assert_eq!(within(0.999)?, None);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// [`CollisionError`] for a coordinate that is not finite, or a parameter out of range.
pub fn vertex_face(
    t0: [impl Point<3>; 4],
    t1: [impl Point<3>; 4],
    parameters: &MinimumSeparationParameters,
) -> Result<Option<Approach<3, 4>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_approach(&VERTEX_FACE, [&t0, &t1], parameters, || ccd::vertex_face(t0, t1))
}

/// When the moving edges are first within a distance of each other; `None` if they stay farther apart.
///
/// `t0` and `t1` are the places of `ea0, ea1, eb0, eb1` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{MinimumSeparationParameters, minimum_separation::edge_edge};
/// let e = |z| [[-1.0, 0.0, z], [1.0, 0.0, z], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
/// let parameters = MinimumSeparationParameters { distance: 0.5, ..Default::default() };
/// let approach = edge_edge(e(2.0), e(-1.0), &parameters)?.expect("they come near");
/// assert!(0.499_999 < approach.time && approach.time <= 0.5);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// As [`vertex_face`].
pub fn edge_edge(
    t0: [impl Point<3>; 4],
    t1: [impl Point<3>; 4],
    parameters: &MinimumSeparationParameters,
) -> Result<Option<Approach<3, 4>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_approach(&EDGE_EDGE, [&t0, &t1], parameters, || ccd::edge_edge(t0, t1))
}

/// When the moving vertex is first within a distance of the moving segment of the plane; `None` if it stays
/// farther away.
///
/// `t0` and `t1` are the places of `v, s0, s1` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{MinimumSeparationParameters, minimum_separation::vertex_segment_2d};
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// let parameters = MinimumSeparationParameters { distance: 1.0, ..Default::default() };
/// // It flies past the end of the segment, at a distance of one.
/// let step = [[2.0, 1.0], [2.0, -1.0]].map(|v| [v, s[0], s[1]]);
/// let approach = vertex_segment_2d(step[0], step[1], &parameters)?.expect("it comes near");
/// assert!(approach.time <= 0.5 && approach.distance[0] <= 1.0 + 1e-12);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// As [`vertex_face`].
pub fn vertex_segment_2d(
    t0: [impl Point<2>; 3],
    t1: [impl Point<2>; 3],
    parameters: &MinimumSeparationParameters,
) -> Result<Option<Approach<2, 3>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_approach(&VERTEX_SEGMENT, [&t0, &t1], parameters, || ccd::vertex_segment_2d(t0, t1))
}

/// The stages: exact contact for a distance of 0, advance, respond.
fn first_approach<const D: usize, const P: usize, const K: usize>(
    pair: &Pair<P, K>,
    ends: [&[[f64; D]; P]; 2],
    parameters: &MinimumSeparationParameters,
    contact: impl FnOnce() -> bool,
) -> Result<Option<Approach<D, P>>, CollisionError> {
    parameters.validate()?;
    check_finite(&pair.names, ends)?;
    let motion = Motion::new(pair, ends[0], ends[1]);
    let distance = motion.scaled_up(parameters.distance);
    if motion.boxes_apart(distance) || (distance == 0.0 && !contact()) {
        return Ok(None);
    }
    let reached = advance(&motion, distance, SLACK, parameters.most_steps);
    if reached.time > 1.0 {
        return Ok(None);
    }
    let place = Place::new(&motion, reached.time);
    Ok(Some(Approach {
        time: reached.time,
        distance: motion.unscaled(place.distance(&motion)),
        weights: (pair.weights)(place.closest.parameters),
        normal: outward(pair, normal(&motion, &reached, &place.closest)),
        steps: reached.steps,
    }))
}
