//! Numbers of about 106 bits: the unevaluated sum of two `f64`.
//!
//! This stage settles what is neither clear to rounded arithmetic nor on one lattice: nearly degenerate input of
//! mixed exponents. Differences of coordinates are exact in it. Sums are by AccurateDWPlusDW, relative error at
//! most 3 v / (1 - 4u), products by DWTimesDW1, relative error at most 7 v, with v = u^2 = 2^-106 \[Joldes17\]; the
//! bound below takes 4 v and 8 v.
//!
//! **Bound.** Let P be the permanent of a value: its polynomial with the magnitudes of the differences and every
//! minus made a plus. The error is at most e P + c 2^-1000 m^(degree - 1), where no difference exceeds m >= 1 and
//! X m^degree bounds the value:
//!
//! ```text
//! difference  X = 1            e = 0                                         c = 1
//! product     X = X1 X2        e = e1 + e2 + e1 e2 + 8v (1 + e1)(1 + e2)     c = X1 c2 + X2 c1 + c1 c2 + 1
//! sum         X = X1 + X2      e = max(e1, e2) + 4v (1 + max(e1, e2))        c = c1 + c2
//! ```
//!
//! The 2^-1000 is what underflow can do. A product whose leading parts' product is above 2^-960 loses only in its
//! cross terms, at most 2^-1074 each; one below has all its roundings, some twenty, below 2^-1012. A difference
//! loses a few 2^-1074 when the coordinates are scaled down.
//!
//! **Range.** All coordinates are first scaled by one power of two, so that the largest is near 2^(990 / degree):
//! nothing overflows, and underflow matters only for terms some 2^-1200 times the largest.

use super::error_free::{fast_two_sum, two_difference, two_product, two_sum};
use super::scaled::{Exact, Scaled, power_of_two};
use crate::Sign;
use crate::polynomial::{Additive, Ring, Times};

/// `high + low`, with `high` the `f64` nearest to the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) high: f64,
    low: f64,
}

impl DoubleDouble {
    #[inline(always)]
    pub(crate) fn of_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// `a - b`, exactly.
    #[inline(always)]
    pub(crate) fn of_difference(a: f64, b: f64) -> Self {
        let (high, low) = two_difference(a, b);
        Self { high, low }
    }
}

impl Additive for DoubleDouble {
    /// AccurateDWPlusDW, algorithm 6 of \[Joldes17\].
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        let (s_high, s_low) = two_sum(self.high, other.high);
        let (t_high, t_low) = two_sum(self.low, other.low);
        let (v_high, v_low) = fast_two_sum(s_high, s_low + t_high);
        let (high, low) = fast_two_sum(v_high, t_low + v_low);
        Self { high, low }
    }

    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        self.plus(&Self { high: -other.high, low: -other.low })
    }
}

impl Times<DoubleDouble> for DoubleDouble {
    type Product = DoubleDouble;
    /// DWTimesDW1, algorithm 10 of \[Joldes17\].
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        let (c_high, c_low) = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        let (high, low) = fast_two_sum(c_high, c_low + cross);
        Self { high, low }
    }
}

/// Double-double numbers for every degree.
pub(crate) struct DoubleDoubles;

impl Ring for DoubleDoubles {
    type D1 = DoubleDouble;
    type D2 = DoubleDouble;
    type D3 = DoubleDouble;
    type D4 = DoubleDouble;
    type D5 = DoubleDouble;
    type Outcome = DoubleDouble;
}

/// A rounded permanent: a magnitude, whose difference is a sum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Magnitude(pub(crate) f64);

/// Permanents for every degree.
pub(crate) struct Magnitudes;

impl Ring for Magnitudes {
    type D1 = Magnitude;
    type D2 = Magnitude;
    type D3 = Magnitude;
    type D4 = Magnitude;
    type D5 = Magnitude;
    type Outcome = Magnitude;
}

impl Additive for Magnitude {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        self.plus(other)
    }
}

impl Times<Magnitude> for Magnitude {
    type Product = Magnitude;
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }
}

/// The exponent to which the largest coordinate of a polynomial of some degree is scaled: `m^degree` stays below
/// 2^1000, and each factor far below 2^996.
pub(crate) const fn target_exponent(degree: i32) -> i32 {
    985 / degree - 1
}

/// First-order coefficient of the error in units of v, plus one for higher orders, for the rounding of the
/// permanent, and for the difference between `high` and the sum; by degree and lift.
pub(crate) const ORIENT2D: f64 = 13.0;
pub(crate) const ORIENT3D: f64 = 29.0;
pub(crate) const ORIENT4D: f64 = 45.0;
pub(crate) const INCIRCLE: f64 = 41.0;
pub(crate) const INSPHERE: f64 = 61.0;
pub(crate) const CROSSINGS: f64 = 61.0;
pub(crate) const SLOPES: f64 = 45.0;

/// v = u^2 = 2^-106.
const V: f64 = f64::EPSILON * f64::EPSILON / 4.0;

/// A power of two of which one factor alone may be out of range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// Coordinates are multiplied by `2^exponent`.
    pub(crate) exponent: i32,
    first: f64,
    second: f64,
}

impl Scale {
    /// Brings the largest of some finite coordinates to `target_exponent(degree)`.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(points: &[[f64; N]], degree: i32) -> Self {
        let largest = points.as_flattened().iter().fold(0, |m: u64, x| m.max(x.abs().to_bits()));
        // Subnormal numbers end below the target, which does not matter.
        let biased = (largest >> 52).max(1) as i32;
        let exponent = target_exponent(degree) - (biased - 1023) - 1;
        let half = exponent / 2;
        Self { exponent, first: power_of_two(half), second: power_of_two(exponent - half) }
    }

    /// The scaled coordinates: exact unless they underflow.
    #[inline(always)]
    pub(crate) fn apply<const N: usize, const P: usize>(self, points: &[[f64; N]; P]) -> [[f64; N]; P] {
        points.map(|point| point.map(|x| x * self.first * self.second))
    }
}

/// Differences of the first points to the last one, exact but for what scaling loses.
#[inline(always)]
pub(crate) fn differences<const N: usize, const P: usize, const R: usize>(
    scaled: &[[f64; N]; P],
) -> [[DoubleDouble; N]; R] {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| DoubleDouble::of_difference(scaled[i][j], scaled[P - 1][j]))
    })
}

/// Error bound of a value of `degree` whose permanent, rounded, is `magnitude`.
#[inline(always)]
pub(crate) fn error_bound(coefficient: f64, magnitude: f64, degree: i32) -> f64 {
    // 2^13 covers the count c.
    let underflow = power_of_two((degree - 1) * (target_exponent(degree) + 1) + 13 - 1000);
    magnitude * (coefficient * V) + underflow
}

impl Exact for DoubleDouble {
    /// The sign, once the error bound is known to be exceeded.
    #[inline(always)]
    fn sign(&self) -> Sign {
        Sign::of_nonzero(self.high)
    }
    fn scaled(&self) -> Scaled {
        Scaled::of_f64(self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial;

    /// X, e (of which the coefficients of v and v^2) and c of the module's head.
    #[derive(Clone, Copy)]
    struct Bound {
        size: u64,
        first: u64,
        second: u64,
        underflows: u64,
    }

    struct Bounds;

    impl Ring for Bounds {
        type D1 = Bound;
        type D2 = Bound;
        type D3 = Bound;
        type D4 = Bound;
        type D5 = Bound;
        type Outcome = Bound;
    }

    impl Additive for Bound {
        fn plus(&self, other: &Self) -> Self {
            let first = self.first.max(other.first);
            let second = self.second.max(other.second);
            Self {
                size: self.size + other.size,
                first: first + 4,
                // The third order, below v times these, is put into the second.
                second: second + 4 * first + 1,
                underflows: self.underflows + other.underflows,
            }
        }
        fn minus(&self, other: &Self) -> Self {
            self.plus(other)
        }
    }

    impl Times<Bound> for Bound {
        type Product = Bound;
        fn times(&self, other: &Self) -> Self {
            Self {
                size: self.size * other.size,
                first: self.first + other.first + 8,
                second: self.second
                    + other.second
                    + self.first * other.first
                    + 8 * (self.first + other.first)
                    + 1,
                underflows: self.size * other.underflows
                    + other.size * self.underflows
                    + self.underflows * other.underflows
                    + 1,
            }
        }
    }

    fn check(bound: Bound, coefficient: f64) {
        assert_eq!(bound.first as f64 + 1.0, coefficient);
        // The one covers v, and a relative 64 u for the rounding of the permanent.
        assert!(bound.second < 1 << 20 && coefficient * 64.0 * f64::EPSILON < 0.5);
        assert!(bound.underflows < 1 << 12);
    }

    #[test]
    fn constants_cover_the_errors_of_the_same_text() {
        let d = Bound { size: 1, first: 0, second: 0, underflows: 1 };
        check(polynomial::orient2d::<Bounds>(&[[d; 2]; 2]), ORIENT2D);
        check(polynomial::orient3d::<Bounds>(&[[d; 3]; 3]), ORIENT3D);
        check(polynomial::orient4d::<Bounds>(&[[d; 4]; 4]), ORIENT4D);
        check(polynomial::incircle::<Bounds>(&[[d; 2]; 3]), INCIRCLE);
        check(polynomial::insphere::<Bounds>(&[[d; 3]; 4]), INSPHERE);
        check(polynomial::crossings::<Bounds>(&[[d; 3]; 6]), CROSSINGS);
        check(polynomial::slopes::<Bounds>(&[[d; 3]; 5], 0), SLOPES);
        check(polynomial::slopes::<Bounds>(&[[d; 3]; 5], 1), SLOPES);
    }

    #[test]
    fn scales_every_magnitude() {
        for largest in [f64::from_bits(1), f64::MIN_POSITIVE, 1.0, f64::MAX] {
            for degree in 2..=5 {
                let [[scaled]] = Scale::of(&[[largest]], degree).apply(&[[largest]]);
                assert!(scaled > 0.0 && scaled < power_of_two(target_exponent(degree)));
            }
        }
    }

    #[test]
    fn products_keep_106_bits() {
        // (1 + 2^-60)^2 - 1 = 2^-59 + 2^-120: the last term is 2^-61 of the first.
        let one = DoubleDouble { high: 1.0, low: 0.0 };
        let x = DoubleDouble { high: 1.0, low: power_of_two(-60) };
        let difference = x.times(&x).minus(&one);
        assert!((difference.high - power_of_two(-59)).abs() < power_of_two(-103));
    }
}
