//! The closest points of two primitives at rest, with proven bounds of their distance: [`ClosestPoints`].
//!
//! # What it promises
//! * `distance[0] <= distance of the primitives <= distance of the two points <= distance[1]`, in exact
//!   arithmetic, the points being those that the weights say.
//! * Weights are not negative and sum to one over each primitive, without rounding.
//! * No overflow, no underflow: computed in units of the largest coordinate difference. Multiplying all
//!   coordinates by a power of two multiplies the distances by it, up to the last bit, and leaves the weights
//!   as they are.
//!
//! # What it does not promise
//! A bound of `distance[1] - distance[0]` known beforehand. Let `r` be the norm of the vector of the largest
//! coordinate differences between the primitives. For primitives whose distance is of the order of `r`,
//! thin triangles and nearly parallel edges included, it was at most 2^-46 `r` in tests. Where they nearly
//! touch at a vertex or edge, the lower bound is worse: the direction between points at distance `p` is known
//! to `u r / p`, so that it may be too low by `u r^2 / p`, but not by more than `p`: some 2^-26 `r` at worst.
//!
//! # Method
//! [`polygon`](super)'s candidates, and for the lower bound its directions. Complexity: constant.

use super::error::check_finite;
use super::motion::Motion;
use super::pair::{EDGE_EDGE, Pair, VERTEX_FACE, VERTEX_SEGMENT};
use super::support::Place;
use super::{CollisionError, coordinates};
use welter_predicates::Point;

/// Two points, one of each primitive, that are closest to each other up to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoints<const P: usize> {
    /// The weight of each vertex in the point of its primitive.
    pub weights: [f64; P],
    /// Bounds of the distance of the primitives; the second also of that of the points.
    pub distance: [f64; 2],
}

/// The closest points of the vertex `v` and the triangle `f0, f1, f2`.
///
/// ```
/// use welter_tracking::collision::closest_points;
/// let closest = closest_points::vertex_face([[1.0, 1.0, 3.0], [0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]])?;
/// assert_eq!(closest.weights, [1.0, 0.5, 0.25, 0.25]);
/// assert!(closest.distance[0] <= 3.0 && 3.0 <= closest.distance[1]);
/// assert!(closest.distance[1] - closest.distance[0] < 1e-12);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// [`CollisionError::NonFinite`], of time 0.
pub fn vertex_face(points: [impl Point<3>; 4]) -> Result<ClosestPoints<4>, CollisionError> {
    closest(&VERTEX_FACE, coordinates(points))
}

/// The closest points of the segments `ea0, ea1` and `eb0, eb1`.
///
/// ```
/// use welter_tracking::collision::closest_points;
/// let closest = closest_points::edge_edge([[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [1.0, -2.0, 0.0], [1.0, 2.0, 0.0]])?;
/// assert_eq!(closest.weights, [0.75, 0.25, 0.5, 0.5]);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// [`CollisionError::NonFinite`], of time 0.
pub fn edge_edge(points: [impl Point<3>; 4]) -> Result<ClosestPoints<4>, CollisionError> {
    closest(&EDGE_EDGE, coordinates(points))
}

/// The closest points of the vertex `v` and the segment `s0, s1` of the plane.
///
/// ```
/// use welter_tracking::collision::closest_points;
/// let closest = closest_points::vertex_segment_2d([[1.0, 1.0], [0.0, 0.0], [4.0, 0.0]])?;
/// assert_eq!(closest.weights, [1.0, 0.75, 0.25]);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// [`CollisionError::NonFinite`], of time 0.
pub fn vertex_segment_2d(points: [impl Point<2>; 3]) -> Result<ClosestPoints<3>, CollisionError> {
    closest(&VERTEX_SEGMENT, coordinates(points))
}

fn closest<const D: usize, const P: usize, const K: usize>(
    pair: &Pair<P, K>,
    points: [[f64; D]; P],
) -> Result<ClosestPoints<P>, CollisionError> {
    check_finite(&pair.names, [&points, &points])?;
    let motion = Motion::new(pair, &points, &points);
    let place = Place::new(&motion, 0.0);
    let weights = (pair.weights)(place.closest.parameters);
    Ok(ClosestPoints { weights, distance: motion.unscaled(place.distance(&motion)) })
}
