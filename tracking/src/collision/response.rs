//! The normal of a contact: [`normal`].
//!
//! # What it computes
//! A unit vector that points from the second primitive to the first. In order, the first that applies:
//!
//! 1. the normal of the face, the common normal of the edges, the normal of the segment, where they come
//!    together across it \[Bridson02\]: turned against their relative velocity at the contact, whose part
//!    along it is at least [`STEEP`] of the whole;
//! 2. otherwise (coplanar or tangential motion, a face of no area, parallel edges, resting primitives) the
//!    direction along which they were last proven to be apart, which advancement leaves behind: it is
//!    perpendicular to the vertex or edge, or to the face or both edges, that is met; and if it is about that
//!    normal (tangential motion), the normal, on the same side;
//! 3. if they touch or as good as touch at time 0, the normal of the face, ... after all, on the side of the
//!    first primitive if rounding leaves one;
//! 4. from closest point to closest point, if rounding leaves a distance;
//! 5. against the relative velocity;
//! 6. across the longer edge, and finally the first axis.
//!
//! # What it promises
//! A unit vector up to 4u for every input, and one that turns with the primitives up to rounding, except in
//! the last case.

use glam::DVec3;

use super::advance::Advance;
use super::motion::Motion;
use super::pair::Pair;
use super::polygon::{Polygon, ROUNDING, Spot, length, unit};

/// Cosine below which primitives slide along a plane rather than come together across it: 2^-20, the
/// velocity's angle to the plane is then that of a millimetre in a kilometre, and the plane is not what stops
/// them.
const STEEP: f64 = 1.0 / (1 << 20) as f64;

/// Sine of the angle between the edges below which they count as parallel, a face as without area: rounded
/// corners leave such a normal fewer than 22 of its 52 bits.
const THIN: f64 = 1.0 / (1 << 30) as f64;

/// Cosine of the angle to the normal above which the direction of the last separation means that normal.
/// Advancement finds directions across the plane or in it, so any value well inside (0, 1) tells them apart.
const TANGENTIAL: f64 = 0.5;

/// The unit vector from the origin to the polygon at the time to which it advanced: the normal of a contact
/// up to its sign.
pub(super) fn normal<const K: usize>(motion: &Motion<K>, reached: &Advance, closest: &Spot) -> DVec3 {
    let polygon = Polygon::new(motion.at(reached.time));
    let across = polygon.normal().filter(|_| polygon.sine() > THIN);
    let velocity = motion.velocity(closest.parameters);
    if let Some(across) = across {
        let approach = across.dot(velocity);
        if approach.abs() > STEEP * length(velocity) {
            return if approach > 0.0 { -across } else { across };
        }
    }
    if let Some(direction) = reached.direction {
        return match across {
            Some(across) if across.dot(direction) > TANGENTIAL => across,
            Some(across) if across.dot(direction) < -TANGENTIAL => -across,
            _ => direction,
        };
    }
    if let Some(across) = across {
        return if across.dot(closest.place) < 0.0 { -across } else { across };
    }
    let apart = closest.distance > 2.0 * ROUNDING * length(motion.maxima);
    unit(closest.place)
        .filter(|_| apart)
        .or_else(|| unit(-velocity))
        .or_else(|| unit(polygon.longer_edge()).map(DVec3::any_orthonormal_vector))
        .unwrap_or(DVec3::X)
}

/// The vector from the second primitive to the first, given that from the origin to the polygon.
pub(super) fn outward<const D: usize, const P: usize, const K: usize>(
    pair: &Pair<P, K>,
    direction: DVec3,
) -> [f64; D] {
    let direction = if pair.first_minus_second { direction } else { -direction };
    // Zeros of one sign; the third coordinate of a vector of the plane is zero.
    let direction = (direction + DVec3::ZERO).to_array();
    std::array::from_fn(|k| direction[k])
}
