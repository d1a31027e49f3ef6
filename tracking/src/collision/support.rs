//! Proofs that a moving polygon stays away from the origin for a while: [`Support`], along a direction at
//! rest, and [`Place::stays_beyond`], along one that turns.
//!
//! # Method
//! For any direction `d`, a polygon with `d . P_i > D |d|` for all corners is farther than `D` from the
//! origin.
//!
//! *At rest*: `d . P_i(t)` is linear in time, so an interval at whose ends this holds is proven.
//!
//! *Turning* from `d` at time `a` to `e` at time `b`, linearly: `d(t) . P_i(t)` is a quadratic, which exceeds
//! `D max(|d|, |e|)` if its three Bernstein coefficients `d . P_i(a)`, `(d . P_i(b) + e . P_i(a)) / 2` and `e
//! . P_i(b)` do; and `|d(t)| <= max(|d|, |e|)`.
//!
//! How a direction was found plays no role in the proofs.
//!
//! # Bounds
//! Let `S = sum |d_k| m_k`, `m_k` the largest magnitude of coordinate `k` of a corner. The rounded product of
//! `d` with a corner at an end of the step errs by at most `5u S` (one rounding of the corner, one of the
//! product, two of the sums), and `A_i + t (B_i - A_i)`, made of two of them, by `5u S` more: 2u of the
//! difference, which is at most `2 S`, 2u of the product, u of the sum: 10u, for which [`AT_REST`] takes 14u.
//! The product with a corner computed at a time, whose coordinates err by `8u m_k`, errs by at most `11u S`,
//! the mean of two by 12u: [`TURNING`] takes 20u. The spare parts and [`NORM`], 1 + 16u, cover the at most
//! eight roundings of `D |d|` and of the bound itself. [`UNDERFLOW`] is more than all that underflow may take
//! away: products of numbers below 2 lose 2^-1075 each.

use glam::DVec3;

use super::motion::Motion;
use super::polygon::{MOST_DIRECTIONS, Polygon, ROUNDING, Spot, length};

/// 14u.
const AT_REST: f64 = 7.0 * f64::EPSILON;

/// 20u.
const TURNING: f64 = 10.0 * f64::EPSILON;

/// 1 + 16u.
const NORM: f64 = 1.0 + 8.0 * f64::EPSILON;

/// 2^-1000: larger than what underflow may take away, a normal number.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

/// The products of a direction at rest with the corners at both ends of the step.
pub(super) struct Support<const K: usize> {
    /// The direction, on the side where the polygon was when it was made.
    pub(super) direction: DVec3,
    norm: f64,
    error: f64,
    ends: [[f64; K]; 2],
}

impl<const K: usize> Support<K> {
    /// With the direction turned to the side where the polygon is at a time.
    pub(super) fn new(motion: &Motion<K>, direction: DVec3, time: f64) -> Self {
        let error = direction.abs().dot(motion.maxima) * AT_REST + UNDERFLOW;
        let ends = motion.ends.map(|corners| corners.map(|p| direction.dot(p)));
        let mut support = Self { direction, norm: direction.length() * NORM, error, ends };
        if (0..K).map(|i| support.at(i, time)).sum::<f64>() < 0.0 {
            support.direction = -direction;
            support.ends = ends.map(|products| products.map(|x| -x));
        }
        support
    }

    fn at(&self, i: usize, time: f64) -> f64 {
        self.ends[0][i] + time * (self.ends[1][i] - self.ends[0][i])
    }

    /// A lower bound of the distance at a time.
    pub(super) fn distance(&self, time: f64) -> f64 {
        let low = (0..K).fold(f64::INFINITY, |low, i| low.min(self.at(i, time)));
        let away = low - 2.0 * self.error;
        if away > 0.0 { away / (self.norm * NORM) } else { 0.0 }
    }

    /// A time up to which, and at which, the polygon is proven to be farther than `distance`, from `time` on:
    /// `time` itself if nothing is proven, and infinity if it is so until the end.
    pub(super) fn safe_until(&self, time: f64, distance: f64) -> f64 {
        let limit = distance * self.norm * NORM + self.error;
        let exceeds = |time: f64| (0..K).all(|i| self.at(i, time) > limit);
        if !exceeds(time) {
            return time;
        }
        if self.ends[1].iter().all(|&x| x > limit) {
            return f64::INFINITY;
        }
        // Where the first of them comes so near to the limit that rounding leaves no doubt.
        let safe = limit + 2.0 * self.error;
        let until = (0..K).filter(|&i| self.ends[1][i] <= safe).fold(1.0_f64, |until, i| {
            let [from, to] = [self.ends[0][i], self.ends[1][i]];
            until.min((from - safe) / (from - to))
        });
        if until > time && exceeds(until) { until } else { time }
    }
}

/// The polygon at a time.
pub(super) struct Place<const K: usize> {
    pub(super) time: f64,
    corners: [DVec3; K],
    /// The closest point.
    pub(super) closest: Spot,
    /// Directions along which it is likely to be away from the origin, by the feature that gave them.
    pub(super) directions: [Option<DVec3>; MOST_DIRECTIONS],
}

impl<const K: usize> Place<K> {
    pub(super) fn new(motion: &Motion<K>, time: f64) -> Self {
        let corners = motion.at(time);
        let (closest, directions) = Polygon::new(corners).closest();
        Self { time, corners, closest, directions }
    }

    /// Bounds of the distance.
    pub(super) fn distance(&self, motion: &Motion<K>) -> [f64; 2] {
        let lower = |d: &DVec3| Support::new(motion, *d, self.time).distance(self.time);
        [self.directions.iter().flatten().map(lower).fold(0.0, f64::max), self.upper_bound(motion)]
    }

    /// An upper bound of the distance.
    pub(super) fn upper_bound(&self, motion: &Motion<K>) -> f64 {
        self.closest.distance + ROUNDING * length(motion.maxima)
    }

    /// A direction, that at the later of the two times, whose turning proves that the polygon is farther than
    /// `distance` from here to `there`, ends included.
    pub(super) fn stays_beyond(&self, there: &Self, motion: &Motion<K>, distance: f64) -> Option<DVec3> {
        self.directions.iter().zip(&there.directions).find_map(|(&d, &e)| {
            let (d, e) = (self.towards(d?), there.towards(e?));
            let error = d.abs().max(e.abs()).dot(motion.maxima) * TURNING + UNDERFLOW;
            let limit = distance * d.length().max(e.length()) * NORM + error;
            let exceeds = |(p, q): (&DVec3, &DVec3)| {
                d.dot(*p) > limit && 0.5 * (d.dot(*q) + e.dot(*p)) > limit && e.dot(*q) > limit
            };
            self.corners.iter().zip(&there.corners).all(exceeds).then_some(e)
        })
    }

    /// The direction or its opposite, to the side where the polygon is.
    fn towards(&self, direction: DVec3) -> DVec3 {
        let side: f64 = self.corners.iter().map(|p| direction.dot(*p)).sum();
        if side < 0.0 { -direction } else { direction }
    }
}
