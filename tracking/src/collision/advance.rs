//! Conservative advancement along separating directions: how long a moving polygon stays away from the origin.
//!
//! # What it promises
//! [`advance`] returns a time before which the polygon is farther than `distance` from the origin, proven: at no time before it,
//! nor at it unless it is 0, is the exact distance of the exact motion `distance` or less.
//!
//! # What it does not promise
//! To get as near as [`SLACK`] to the distance: it says how near it got. It gives up after a number of steps, which a polygon that
//! turns while it stays near may use up, and where no direction that it tries proves a step.
//!
//! # Method
//! Conservative advancement \[Mirtich96\] with linear bounds. For any direction `d`, `d . P_i(t)` is linear in time, and
//! the polygon is farther than `D` from the origin while all of these exceed `D |d|`. From a time at which they do, this
//! holds up to the first time at which one of them does not any more: a step of Newton's method on the distance, which a
//! flat motion ends in one step and a smooth one in a few. The direction that carries farthest is taken, and new ones are
//! computed where it ends. How a direction was found plays no role in the proof.
//!
//! # Bound
//! With `S = sum |d_k| m_k`, `m_k` the largest magnitude of coordinate `k` of a corner, the rounded product `A_i` of a corner at
//! an end of the step errs by at most `5u S` (one rounding of the corner, one of the product, two of the sums), and
//! `A_i + t (B_i - A_i)` by `5u S` more: 2u of the difference, which is at most `2 S`, 2u of the product, u of the sum. [`DOT`]
//! takes 14u for these 10u and the roundings of the bound itself, [`NORM`] 16u for the at most 8 of `D |d|`, and
//! [`UNDERFLOW`] more than all that underflow may take: products of numbers below 2 lose 2^-1075 each.

use glam::DVec3;

use super::motion::Motion;
use super::polygon::{Polygon, ROUNDING, Spot, length};

/// 14u.
const DOT: f64 = 7.0 * f64::EPSILON;

/// 1 + 16u.
const NORM: f64 = 1.0 + 8.0 * f64::EPSILON;

/// 2^-1000: larger than what underflow may take away, a normal number.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

/// How near is near enough, relative to the size of the motion: 2^-44, eight times the error of a distance, so that the
/// distance is known to three bits where a search ends.
pub(super) const SLACK: f64 = f64::EPSILON * 256.0;

/// A time up to which nothing is met.
pub(super) struct Advance {
    /// The polygon is farther than the distance at all times before; more than 1 if it is so throughout.
    pub(super) time: f64,
    /// A unit direction along which the polygon is away from the origin up to then; none at time 0.
    pub(super) direction: Option<DVec3>,
    /// Steps taken.
    pub(super) steps: u32,
}

/// The closest point at a time, and bounds of the distance there.
pub(super) fn nearness<const K: usize>(motion: &Motion<K>, time: f64) -> (Spot, [f64; 2]) {
    let (closest, directions) = Polygon::new(motion.at(time)).closest();
    let lower = directions.map(|d| Support::new(motion, d).distance(time)).fold(0.0, f64::max);
    (closest, [lower, upper_bound(motion, &closest)])
}

fn upper_bound<const K: usize>(motion: &Motion<K>, closest: &Spot) -> f64 {
    closest.distance + ROUNDING * length(motion.maxima)
}

/// Advances from time 0 until the polygon is about as near as `distance`, at most `most_steps` times.
pub(super) fn advance<const K: usize>(motion: &Motion<K>, distance: f64, most_steps: u32) -> Advance {
    let near = distance + SLACK * length(motion.maxima);
    let mut reached = Advance { time: 0.0, direction: None, steps: 0 };
    loop {
        let (closest, directions) = Polygon::new(motion.at(reached.time)).closest();
        let mut farthest = (reached.time, None);
        for d in directions {
            let mut support = Support::new(motion, d);
            let until = support.safe_until(reached.time, distance);
            if until > farthest.0 {
                farthest = (until, Some(support.direction));
            }
        }
        let (time, direction) = farthest;
        if time > 1.0 {
            return Advance { time, direction, ..reached };
        }
        let is_near = upper_bound(motion, &closest) <= near;
        if is_near || direction.is_none() || reached.steps == most_steps {
            return reached;
        }
        reached = Advance { time, direction, steps: reached.steps + 1 };
    }
}

/// The products of a direction with the corners at both ends of the step.
struct Support<const K: usize> {
    direction: DVec3,
    norm: f64,
    error: f64,
    ends: [[f64; K]; 2],
}

impl<const K: usize> Support<K> {
    fn new(motion: &Motion<K>, direction: DVec3) -> Self {
        let ends = motion.ends.map(|corners| corners.map(|p| direction.dot(p)));
        let error = direction.abs().dot(motion.maxima) * DOT + UNDERFLOW;
        Self { direction, norm: direction.length() * NORM, error, ends }
    }

    fn at(&self, i: usize, time: f64) -> f64 {
        self.ends[0][i] + time * (self.ends[1][i] - self.ends[0][i])
    }

    /// A lower bound of the distance at a time.
    fn distance(&self, time: f64) -> f64 {
        let low = (0..K).fold(f64::INFINITY, |low, i| low.min(self.at(i, time)));
        let high = (0..K).fold(f64::NEG_INFINITY, |high, i| high.max(self.at(i, time)));
        let away = low.max(-high) - 2.0 * self.error;
        if away > 0.0 { away / (self.norm * NORM) } else { 0.0 }
    }

    /// A time up to which the polygon is proven to be farther than `distance`, from `time` on: `time` itself if nothing is proven,
    /// and more than 1 if it is so until the end. Turns the direction to the side where the polygon is.
    fn safe_until(&mut self, time: f64, distance: f64) -> f64 {
        if self.at(0, time) < 0.0 {
            self.direction = -self.direction;
            for x in self.ends.as_flattened_mut() {
                *x = -*x;
            }
        }
        let limit = distance * self.norm * NORM + self.error;
        let exceeds = |time: f64| (0..K).all(|i| self.at(i, time) > limit);
        if !exceeds(time) {
            return time;
        }
        if self.ends[1].iter().all(|&x| x > limit) {
            return f64::INFINITY;
        }
        // Where the first of them meets the limit, and a little before.
        let until = (0..K).filter(|&i| self.ends[1][i] <= limit).fold(1.0_f64, |until, i| {
            let [from, to] = [self.ends[0][i], self.ends[1][i]];
            until.min((from - limit) / (from - to))
        });
        let candidates = [until.next_down(), until * (1.0 - f64::EPSILON), until - self.error];
        candidates.into_iter().find(|&t| t > time && exceeds(t)).unwrap_or(time)
    }
}
