//! The relative motion of two primitives, scaled to size one: [`Motion`].
//!
//! # What it promises
//! * The corners are differences of vertices, each rounded once and then multiplied by one power of two that
//!   brings the largest coordinate to [1/2, 1): relative error `u` a coordinate, or 2^-1074 absolute. Nothing
//!   overflows. So the motion is the same, bit for bit, when all coordinates are multiplied by a power of two
//!   that leaves them representable.
//! * A corner computed at a time errs by at most `8u` of the largest magnitude in its coordinate: one
//!   rounding of the difference of vertices (u), of that of the ends (4u with theirs), of the product (2u)
//!   and of the sum (u).

use glam::DVec3;

use super::pair::Pair;

/// A convex polygon whose corners move linearly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<const K: usize> {
    /// The corners at times 0 and 1.
    pub(super) ends: [[DVec3; K]; 2],
    /// The largest magnitude in each coordinate.
    pub(super) maxima: DVec3,
    /// A length is `2^exponent` times the scaled one.
    exponent: i32,
}

impl<const K: usize> Motion<K> {
    /// The motion of a pair's difference; all coordinates are finite.
    pub(super) fn new<const D: usize, const P: usize>(
        pair: &Pair<P, K>,
        t0: &[[f64; D]; P],
        t1: &[[f64; D]; P],
    ) -> Self {
        let plain = differences(pair, [t0, t1], 1.0);
        if plain.as_flattened().iter().all(|p| p.is_finite()) {
            Self::scaled(plain, 0)
        } else {
            // The largest is above 2^1023 then; what halving takes from subnormal numbers does not count
            // beside it.
            Self::scaled(differences(pair, [t0, t1], 0.5), 1)
        }
    }

    fn scaled(mut ends: [[DVec3; K]; 2], halvings: i32) -> Self {
        let largest =
            |ends: &[[DVec3; K]; 2]| ends.as_flattened().iter().fold(DVec3::ZERO, |m, p| m.max(p.abs()));
        let (_, exponent) = libm::frexp(largest(&ends).max_element());
        // Two factors, each a normal number.
        let half = exponent / 2;
        let factors = [libm::scalbn(1.0, -half), libm::scalbn(1.0, half - exponent)];
        for p in ends.as_flattened_mut() {
            *p = *p * factors[0] * factors[1];
        }
        Self { ends, maxima: largest(&ends), exponent: exponent + halvings }
    }

    /// The corners at a time.
    pub(super) fn at(&self, time: f64) -> [DVec3; K] {
        let [p, q] = &self.ends;
        if time == 1.0 {
            return *q;
        }
        std::array::from_fn(|i| p[i] + (q[i] - p[i]) * time)
    }

    /// A length of the caller in the unit of the motion: not below the exact one, and infinite where that is
    /// large.
    pub(super) fn scaled_up(&self, length: f64) -> f64 {
        let scaled = libm::scalbn(length, -self.exponent);
        // Exact for a normal number.
        if length == 0.0 || scaled >= f64::MIN_POSITIVE { scaled } else { scaled.next_up() }
    }

    /// Bounds of a distance in the caller's unit.
    pub(super) fn unscaled(&self, [lower, upper]: [f64; 2]) -> [f64; 2] {
        let value = |length| libm::scalbn(length, self.exponent);
        [value(lower).next_down().max(0.0), value(upper).next_up()]
    }

    /// True when along some axis the polygon is farther than `distance` from the origin throughout the step.
    pub(super) fn boxes_apart(&self, distance: f64) -> bool {
        // A coordinate errs by a factor of 1 + u.
        let limit = distance * (1.0 + 4.0 * f64::EPSILON);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &p in self.ends.as_flattened() {
            (low, high) = (low.min(p), high.max(p));
        }
        low.max_element() > limit || high.min_element() < -limit
    }

    /// The velocity of the point with these parameters.
    pub(super) fn velocity(&self, [s, t]: [f64; 2]) -> DVec3 {
        let [p, q] = &self.ends;
        let v = |i: usize| q[i] - p[i];
        let last = if K > 2 { t * (v(K - 1) - v(0)) } else { DVec3::ZERO };
        v(0) + s * (v(1) - v(0)) + last
    }
}

fn differences<const D: usize, const P: usize, const K: usize>(
    pair: &Pair<P, K>,
    ends: [&[[f64; D]; P]; 2],
    factor: f64,
) -> [[DVec3; K]; 2] {
    ends.map(|points| {
        pair.corners.map(|(i, j)| {
            let mut difference = [0.0; 3];
            for (k, x) in difference.iter_mut().enumerate().take(D) {
                *x = points[i][k] * factor - points[j][k] * factor;
            }
            DVec3::from_array(difference)
        })
    })
}
