//! Conservative advancement: how long a moving polygon stays away from the origin.
//!
//! # What it promises
//! [`advance`] returns a time before which the polygon is farther than `distance` from the origin, proven: at
//! no time before it, nor at it unless it is 0, is the exact distance of the exact motion `distance` or less.
//!
//! # What it does not promise
//! To get as near as the slack to the distance. It gives up after a number of steps, which a polygon that
//! turns while it stays near may use up, and where no direction that it tries proves a step.
//!
//! # Method
//! Conservative advancement \[Mirtich96\]. From a time at which a direction holds the polygon away, it does
//! so up to the first time at which a corner comes too near along it: a motion without turning ends in one
//! step. Where that is short, because the polygon turns, a step of Newton's method on the distance tells
//! where it will be too near; a little before that place, or else at parts of the way to it, the direction
//! that belongs to the same feature is computed, and the direction that turns from the old to the new one
//! tried. So the distance that is left shrinks quadratically in the end. `support` holds the proofs.

use glam::DVec3;

use super::motion::Motion;
use super::support::{Place, Support};

/// How near is near enough, relative to the size of the motion: 2^-44, eight times the error of a distance,
/// so that the distance is known to three bits where a search ends.
pub(super) const SLACK: f64 = f64::EPSILON * 256.0;

/// Parts of Newton's step that are tried: nearly all of it, which succeeds in the end; a bit less, since the
/// distance may fall faster than in proportion; and what is left when it is far too long.
const PARTS: [f64; 4] = [1.0 - 1.0 / (1 << 20) as f64, 31.0 / 32.0, 0.5, 0.125];

/// The same for a step to the end of time, which is tried as a whole.
const PARTS_TO_END: [f64; 4] = [1.0, 0.75, 0.375, 0.125];

/// A time up to which nothing is met.
pub(super) struct Advance {
    /// The polygon is farther than the distance at all times before; more than 1 if it is so throughout.
    pub(super) time: f64,
    /// A unit direction along which the polygon is away from the origin up to then; none at time 0.
    pub(super) direction: Option<DVec3>,
    /// Steps taken.
    pub(super) steps: u32,
}

/// Advances from time 0 until the polygon is as near as `distance` and the slack, at most `most_steps` times.
pub(super) fn advance<const K: usize>(
    motion: &Motion<K>,
    distance: f64,
    slack: f64,
    most_steps: u32,
) -> Advance {
    let near = distance + slack * super::polygon::length(motion.maxima);
    let mut reached = Advance { time: 0.0, direction: None, steps: 0 };
    let mut place = Place::new(motion, 0.0);
    loop {
        let Step { time, direction, next } = step(motion, &place, distance);
        if time > 1.0 {
            return Advance { time, direction, ..reached };
        }
        let is_near = place.upper_bound(motion) <= near;
        if is_near || direction.is_none() || reached.steps == most_steps {
            return reached;
        }
        reached = Advance { time, direction, steps: reached.steps + 1 };
        place = next.unwrap_or_else(|| Place::new(motion, time));
    }
}

/// A step of advancement: as [`Advance`], with the polygon at its end if that was computed.
struct Step<const K: usize> {
    time: f64,
    direction: Option<DVec3>,
    next: Option<Place<K>>,
}

fn step<const K: usize>(motion: &Motion<K>, place: &Place<K>, distance: f64) -> Step<K> {
    let mut best = Step { time: place.time, direction: None, next: None };
    let mut highest = (0.0, None);
    for &d in place.directions.iter().flatten() {
        let support = Support::new(motion, d, place.time);
        let until = support.safe_until(place.time, distance);
        if until > best.time {
            best = Step { time: until, direction: Some(support.direction), next: None };
        }
        let away = support.distance(place.time);
        if away > highest.0 {
            highest = (away, Some(support.direction));
        }
    }
    let (away, Some(direction)) = highest else { return best };
    // Newton's step on the distance along that direction.
    let speed = -direction.dot(motion.velocity(place.closest.parameters));
    let way = if speed > 0.0 { (away - distance) / speed } else { f64::INFINITY };
    let left = 1.0 - place.time;
    let (way, parts) = if way < left { (way, PARTS) } else { (left, PARTS_TO_END) };
    for part in parts {
        let time = if part == 1.0 { 1.0 } else { place.time + part * way };
        if time <= best.time || time <= place.time {
            break;
        }
        let there = Place::new(motion, time);
        if let Some(direction) = place.stays_beyond(&there, motion, distance) {
            let time = if time == 1.0 { f64::INFINITY } else { time };
            return Step { time, direction: Some(direction), next: Some(there) };
        }
    }
    best
}
