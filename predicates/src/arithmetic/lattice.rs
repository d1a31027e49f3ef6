//! Coordinates as 62-bit integers: the stage for points of one lattice.
//!
//! The coordinates of a mesh have similar magnitudes. If all bits of all coordinates of a query lie within 61
//! binary places, they are integers below 2^61 in a common unit, their differences fit an `i64`, and the whole
//! polynomial fits into a few machine words, where it is exact. This settles degenerate input (points of a grid,
//! coplanar faces) as well as nearly degenerate input, at the price of a few dozen multiplications.
//!
//! Differences are below 2^62. A minor of two rows is below 2^125 and a sum of three squares below 2^126 (`i128`),
//! a minor of three rows below 2^189 ([`Wide`] of 3 words), the sums of degree 4 and 5 below 2^253 and 2^317
//! (4 and 5 words). The tests recompute these sizes with the polynomials themselves.

use super::scaled::{Exact, Scaled};
use super::wide::Wide;
use crate::Sign;
use crate::polynomial::{Additive, Ring, Times};

/// Binary places below the leading bit of the largest coordinate.
const WINDOW: u32 = 61;
/// Places that the window has beyond a mantissa.
const GUARD: u32 = WINDOW - f64::MANTISSA_DIGITS;

const SIGN_BIT: u64 = 1 << 63;
const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
/// Biased exponent of infinities and NaN.
const NOT_FINITE: u64 = 0x7ff;
const FRACTION: u64 = (1 << FRACTION_BITS) - 1;

/// The coordinates in a common unit `2^exponent`.
pub(crate) struct Lattice<const N: usize, const P: usize> {
    pub(crate) exponent: i32,
    pub(crate) points: [[i64; N]; P],
}

impl<const N: usize, const P: usize> Lattice<N, P> {
    /// The lattice of `points`; `None` if their bits do not lie within the window or one is not finite.
    #[inline(always)]
    pub(crate) fn of(points: &[[f64; N]; P]) -> Option<Self> {
        let mut largest = 0;
        for x in points.as_flattened() {
            largest = largest.max(x.to_bits() & !SIGN_BIT);
        }
        // Subnormal numbers have the exponent of the smallest normal ones.
        let top = (largest >> FRACTION_BITS).max(1);
        let mut lost = 0;
        let points = points.map(|point| {
            point.map(|x| {
                let bits = x.to_bits();
                let biased = (bits & !SIGN_BIT) >> FRACTION_BITS;
                let normal = u64::from(biased != 0);
                let mantissa = ((bits & FRACTION) | (normal << FRACTION_BITS)) << GUARD;
                let shift = (top - biased - (1 - normal)).min(63);
                let magnitude = mantissa >> shift;
                lost |= (magnitude << shift) ^ mantissa;
                let negative = (bits as i64) >> 63;
                (magnitude as i64 ^ negative) - negative
            })
        });
        let exponent = top as i32 - 1 + f64::MIN_EXP - f64::MANTISSA_DIGITS as i32 - GUARD as i32;
        (lost == 0 && top < NOT_FINITE).then_some(Self { exponent, points })
    }

    /// Differences of the first points to the last one.
    #[inline(always)]
    pub(crate) fn rows<const R: usize>(&self) -> [[i64; N]; R] {
        core::array::from_fn(|i| core::array::from_fn(|j| self.points[i][j] - self.points[P - 1][j]))
    }
}

/// Machine integers of as many words as each degree needs.
pub(crate) struct Words;

impl Ring for Words {
    type D1 = i64;
    type D2 = i128;
    type D3 = Wide<3>;
    type D4 = Wide<4>;
    type D5 = Wide<5>;
    type Outcome = Wide<5>;
}

macro_rules! machine {
    ($($int:ty)*) => {$(
        impl Additive for $int {
            #[inline(always)]
            fn plus(&self, other: &Self) -> Self {
                self + other
            }
            #[inline(always)]
            fn minus(&self, other: &Self) -> Self {
                self - other
            }
        }
    )*};
}
machine!(i64 i128);

impl Times<i64> for i64 {
    type Product = i128;
    #[inline(always)]
    fn times(&self, other: &i64) -> i128 {
        i128::from(*self) * i128::from(*other)
    }
}

impl Times<i128> for i64 {
    type Product = Wide<3>;
    #[inline(always)]
    fn times(&self, other: &i128) -> Wide<3> {
        Wide::product(Wide::of_i64(*self), Wide::of_i128(*other))
    }
}

impl Times<i128> for i128 {
    type Product = Wide<4>;
    #[inline(always)]
    fn times(&self, other: &i128) -> Wide<4> {
        Wide::product(Wide::of_i128(*self), Wide::of_i128(*other))
    }
}

impl Times<Wide<3>> for i128 {
    type Product = Wide<5>;
    #[inline(always)]
    fn times(&self, other: &Wide<3>) -> Wide<5> {
        Wide::product(Wide::of_i128(*self), *other)
    }
}

impl From<i128> for Wide<5> {
    #[inline(always)]
    fn from(value: i128) -> Self {
        Wide::of_i128(value).widened()
    }
}

impl From<Wide<3>> for Wide<5> {
    #[inline(always)]
    fn from(value: Wide<3>) -> Self {
        value.widened()
    }
}

impl From<Wide<4>> for Wide<5> {
    #[inline(always)]
    fn from(value: Wide<4>) -> Self {
        value.widened()
    }
}

impl Exact for Wide<5> {
    #[inline(always)]
    fn sign(&self) -> Sign {
        Wide::sign(self)
    }
    fn scaled(&self) -> Scaled {
        Wide::scaled(self)
    }
}

#[cfg(test)]
mod tests {
    use super::super::scaled::power_of_two;
    use super::*;
    use crate::polynomial;

    /// A bound of a magnitude in units of `2^(62 degree)`.
    struct Size(f64);
    struct Sizes;

    impl Ring for Sizes {
        type D1 = Size;
        type D2 = Size;
        type D3 = Size;
        type D4 = Size;
        type D5 = Size;
        type Outcome = Size;
    }
    impl Additive for Size {
        fn plus(&self, other: &Self) -> Self {
            Self(self.0 + other.0)
        }
        fn minus(&self, other: &Self) -> Self {
            self.plus(other)
        }
    }
    impl Times<Size> for Size {
        type Product = Size;
        fn times(&self, other: &Self) -> Self {
            Self(self.0 * other.0)
        }
    }

    #[test]
    fn sizes_fit() {
        fn differences<const N: usize, const R: usize>() -> [[Size; N]; R] {
            core::array::from_fn(|_| core::array::from_fn(|_| Size(1.0)))
        }
        let fits = |size: Size, degree: i32, words: i32| size.0 < power_of_two(64 * words - 1 - 62 * degree);
        assert!(fits(polynomial::orient2d::<Sizes>(&differences()), 2, 2));
        assert!(fits(polynomial::orient3d::<Sizes>(&differences()), 3, 3));
        assert!(fits(polynomial::orient4d::<Sizes>(&differences()), 4, 4));
        assert!(fits(polynomial::incircle::<Sizes>(&differences()), 4, 4));
        assert!(fits(polynomial::insphere::<Sizes>(&differences()), 5, 5));
        // The sum of three squares.
        assert!(fits(Size(3.0), 2, 2));
    }

    #[test]
    fn window_is_61_places() {
        let lattice = Lattice::of(&[[1.0, -3.0], [power_of_two(-59), 0.0]]).expect("inside");
        assert_eq!(lattice.exponent, 1 - 60);
        assert_eq!(lattice.points, [[1 << 59, -3 << 59], [1, 0]]);
        assert!(Lattice::of(&[[1.0, -3.0], [power_of_two(-60), 0.0]]).is_none());
        assert!(Lattice::of(&[[f64::MAX], [f64::from_bits(1)]]).is_none());
        assert!(Lattice::of(&[[f64::INFINITY], [1.0]]).is_none());
        assert!(Lattice::of(&[[f64::NAN, f64::MAX]]).is_none());
    }

    #[test]
    fn subnormals_are_integers_too() {
        let tiny = f64::from_bits(1);
        let lattice = Lattice::of(&[[tiny, -tiny], [f64::MIN_POSITIVE, 0.0]]).expect("inside");
        assert_eq!(lattice.exponent, -1074 - 8);
        assert_eq!(lattice.points, [[1 << 8, -1 << 8], [1 << 60, 0]]);
    }
}
