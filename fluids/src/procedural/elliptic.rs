//! Complete elliptic integrals of the vortex ring: [`RingIntegrals`].
//!
//! # Method
//! All are of the form that the algorithm of \[Bulirsch69\] takes,
//! ```text
//!   cel(k', p, a, b) = integral over [0, pi/2] of  (a cos^2 + b sin^2) / ((cos^2 + p sin^2) D),     D^2 = cos^2 + k'^2 sin^2
//! ```
//! a Landen transformation that is repeated until the integrand is constant, and converges quadratically. With `p = k'^2`
//! three are direct; the fourth is `(1/m) cel(k', 1, -1, 1)` by integration by parts. The numbers `a` of opposite sign that
//! the small differences have are gone after the first transformation, which is done here on paper: `m`, the first order
//! of what is left, is cancelled, and all numbers are positive from there on. So the integrals have no `0/0` at `m = 0`
//! and no cancellation anywhere. By chance the sequence of `p` is the same for all four.

use std::f64::consts::FRAC_PI_2;

/// Integrals over [0, pi/2], with `D^2 = cos^2 + k'^2 sin^2` and `m = 1 - k'^2`. All are positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RingIntegrals {
    /// Of `sin^2 cos^2 / D^3`.
    pub(super) product: f64,
    /// Of `1 / D^3`.
    pub(super) one: f64,
    /// Of `cos^2 / D^3`.
    pub(super) cosine: f64,
    /// Of `(sin^2 - cos^2) / D^3`, over `m`.
    pub(super) difference: f64,
}

/// The relative difference of the means at which the next error, its square, is below the rounding.
const CLOSE: f64 = 1e-8;

/// The ratio of the means goes to twice its root in each step while it is small, and the relative difference to an eighth of its square
/// once that is: from `k'` of 2^-200 it takes 8 steps to come near one, and 5 from there.
const MOST_STEPS: usize = 16;

impl RingIntegrals {
    /// The integrals for `k'` in (0, 1].
    pub(super) fn new(k: f64) -> Self {
        let inverse = 1.0 / k;
        let squared = inverse * inverse;
        // Each pair is (a, b) after the first transformation.
        let mut pairs = [
            [0.0, 2.0 / (1.0 + k)],
            [1.0 + squared, 2.0 * (inverse + 1.0)],
            [1.0, 2.0],
            [squared, 2.0 * inverse / (1.0 + k)],
        ];
        let (mut p, mut mean, mut geometric, mut before) = (1.0 + k, 1.0 + k, k, 1.0);
        for _ in 0..MOST_STEPS {
            if (before - geometric).abs() <= CLOSE * before {
                break;
            }
            geometric = 2.0 * (geometric * before).sqrt();
            let g = geometric * mean / p;
            for [a, b] in &mut pairs {
                let old = *a;
                *a += *b / p;
                *b = 2.0 * (*b + old * g);
            }
            p += g;
            before = mean;
            mean += geometric;
        }
        let [product, one, cosine, difference] =
            pairs.map(|[a, b]| FRAC_PI_2 * (b + a * mean) / (mean * (mean + p)));
        Self { product, one, cosine, difference }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The periodic trapezoid rule, which converges exponentially.
    fn by_quadrature(k: f64) -> [f64; 4] {
        let points = (40.0 / k).ceil() as u32;
        let mut sums = [0.0; 4];
        for i in 0..points {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(points));
            let (s, c) = (sin * sin, cos * cos);
            let square = c + k * k * s;
            let cubed = square * square.sqrt();
            // By parts: (s - c) / D^3 / m is 3 s c / D^5.
            let terms = [s * c / cubed, 1.0 / cubed, c / cubed, 3.0 * s * c / (cubed * square)];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        sums.map(|sum: f64| sum * FRAC_PI_2 / f64::from(points))
    }

    #[test]
    fn integrals_are_those_of_the_trapezoid_rule() {
        for k in [1.0, 1.0 - 1e-9, 0.999, 0.9, 0.5, 0.1, 0.01] {
            let RingIntegrals { product, one, cosine, difference } = RingIntegrals::new(k);
            let expected = by_quadrature(k);
            for (found, expected) in [product, one, cosine, difference].into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 2e-14, "{k}: {found} {expected}");
            }
        }
        assert_eq!(RingIntegrals::new(1.0).one, FRAC_PI_2);
    }

    /// E = 1 and K = ln(4 / k') at the far end, so that the integrals are `1/k'^2`, `K - E` and so on.
    #[test]
    fn thin_cores() {
        for exponent in [-20, -60, -100] {
            let k = libm::scalbn(1.0, exponent);
            let integrals = RingIntegrals::new(k);
            let log = libm::log(4.0 / k);
            let expected = [log - 2.0, 1.0 / (k * k), log - 1.0, 1.0 / (k * k)];
            let found = [integrals.product, integrals.one, integrals.cosine, integrals.difference];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-10, "{k:e}: {found} {expected}");
            }
        }
    }
}
