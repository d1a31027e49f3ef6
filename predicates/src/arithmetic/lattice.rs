//! Coordinates as 62-bit integers: the stage for points of one lattice.
//!
//! The coordinates of a mesh have similar magnitudes. If all bits of all coordinates of a query lie within 61
//! binary places, they are integers below 2^61 in a common unit, their differences fit an `i64`, and the whole
//! polynomial fits into a few machine words, where it is exact. This settles degenerate input (points of a grid,
//! coplanar faces) as well as nearly degenerate input, at the price of a few dozen multiplications.
//!
//! Differences are below 2^62. A minor of two rows is below 2^125 and a sum of three squares or of three minors below 2^127 (`i128`),
//! a minor of three rows below 2^189 ([`Wide`] of 3 words), the sums of degree 4 and 5 below 2^253 and 2^317
//! (4 and 5 words), the difference of two products of degree 3 below 2^379 (6 words). The tests recompute these sizes with the polynomials themselves.

use super::scaled::{Exact, Scaled, power_of_two};
use super::wide::Wide;
use crate::Sign;
use crate::polynomial::{Additive, Ring, SixthDegree, Times};

/// Coordinates are scaled to magnitudes below `2^WINDOW`, and must then be integers.
const WINDOW: i32 = 61;

/// Added to a number below 2^61, this leaves a multiple of 2^10, the bits of the sum count it.
const COARSE: f64 = 1.5 * (1u64 << 62) as f64;
const COARSE_PLACES: u32 = 10;
/// Added to the rest, at most 2^9, this leaves an integer.
pub(crate) const FINE: f64 = 1.5 * (1u64 << 52) as f64;

/// The larger of two numbers, in one instruction.
#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The exponent `t` of the largest coordinate: all are below `2^(t + 1)` in magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extent(i32);

/// Below this, an extent would make the scale overflow.
const LEAST_EXTENT: i32 = -930;

/// By what the coordinates of a smaller extent are to be multiplied first: exact, since they are tiny.
pub(crate) const RAISE: i32 = 512;

impl Extent {
    /// `None` if a coordinate is not finite.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(points: &[[f64; N]]) -> Option<Self> {
        // Four short chains of dependent operations.
        let mut maxima = [0.0; 4];
        let mut sums = [0.0; 4];
        for (k, x) in points.as_flattened().iter().enumerate() {
            let magnitude = x.abs();
            // Infinite or NaN in the end if a coordinate is: the factor keeps others from overflowing.
            sums[k % 4] += magnitude * (1.0 / 32.0);
            maxima[k % 4] = max(magnitude, maxima[k % 4]);
        }
        let sum: f64 = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        let largest: f64 = max(max(maxima[0], maxima[1]), max(maxima[2], maxima[3]));
        let top = (largest.to_bits() >> 52) as i32 - 1023;
        sum.is_finite().then_some(Self(top))
    }

    /// Whether the coordinates must be multiplied by `2^RAISE` first.
    #[inline(always)]
    pub(crate) fn is_tiny(self) -> bool {
        self.0 < LEAST_EXTENT
    }

    /// The power of two that brings the largest coordinate below `2^bits`.
    #[inline(always)]
    pub(crate) fn shift(self, bits: i32) -> i32 {
        // Of raised coordinates only zeros are tiny: any shift will do.
        bits - 1 - self.0.max(LEAST_EXTENT)
    }
}

/// The coordinates in a common unit `2^exponent`.
pub(crate) struct Lattice<const N: usize, const P: usize> {
    pub(crate) exponent: i32,
    pub(crate) points: [[i64; N]; P],
}

impl<const N: usize, const P: usize> Lattice<N, P> {
    /// The lattice of `points`; `None` if their bits do not lie within the window.
    ///
    /// Conversion is by sums and differences alone, which run in pairs on any machine.
    #[inline(always)]
    pub(crate) fn of(points: &[[f64; N]; P], extent: Extent) -> Option<Self> {
        let shift = extent.shift(WINDOW);
        let (scale, inverse) = (power_of_two(shift), power_of_two(-shift));
        let mut integers = [[0; N]; P];
        let mut lost = 0;
        for (integer, &x) in integers.as_flattened_mut().iter_mut().zip(points.as_flattened()) {
            let scaled = x * scale;
            let coarse = scaled + COARSE;
            let rest = scaled - (coarse - COARSE);
            let fine = rest + FINE;
            // Bits below the unit, and bits that the scaling lost to underflow.
            lost |= (fine - FINE).to_bits() ^ rest.to_bits();
            lost |= (scaled * inverse).to_bits() ^ x.to_bits();
            let high = coarse.to_bits().wrapping_sub(COARSE.to_bits()) << COARSE_PLACES;
            let low = fine.to_bits().wrapping_sub(FINE.to_bits());
            *integer = high.wrapping_add(low) as i64;
        }
        // Zeros of either sign are the same.
        (lost << 1 == 0).then_some(Self { exponent: -shift, points: integers })
    }

    /// Differences of the first points to the last one.
    #[inline(always)]
    pub(crate) fn rows<const R: usize>(&self) -> [[i64; N]; R] {
        let mut rows = [[0; N]; R];
        for (row, point) in rows.iter_mut().zip(&self.points) {
            for j in 0..N {
                row[j] = point[j] - self.points[P - 1][j];
            }
        }
        rows
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

impl SixthDegree for Words {
    type D6 = Wide<6>;
}

impl Times<Wide<3>> for Wide<3> {
    type Product = Wide<6>;
    #[inline(always)]
    fn times(&self, other: &Wide<3>) -> Wide<6> {
        Wide::product(*self, *other)
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

impl<const L: usize> Exact for Wide<L> {
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
    impl SixthDegree for Sizes {
        type D6 = Size;
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
        assert!(fits(polynomial::crossings::<Sizes>(&differences()), 5, 5));
        assert!((0..2).all(|k| fits(polynomial::slopes::<Sizes>(&differences(), k), 4, 4)));
        let [a, b, c, d] = &differences();
        assert!(fits(polynomial::patch_side::<Sizes>([a, b, c, d]), 6, 6));
        // The sum of three squares.
        assert!(fits(Size(3.0), 2, 2));
        // The sum of three minors.
        assert!(fits(Size(6.0), 2, 2));
    }

    fn lattice<const N: usize, const P: usize>(points: [[f64; N]; P]) -> Option<Lattice<N, P>> {
        Lattice::of(&points, Extent::of(&points)?)
    }

    #[test]
    fn window_is_61_places() {
        let inside = lattice([[1.0, -3.0], [power_of_two(-59), -0.0]]).expect("inside");
        assert_eq!(inside.exponent, 1 - 60);
        assert_eq!(inside.points, [[1 << 59, -3 << 59], [1, 0]]);
        assert_eq!(lattice([[-0.0], [0.0]]).expect("inside").points, [[0], [0]]);
        assert!(lattice([[1.0, -3.0], [power_of_two(-60), 0.0]]).is_none());
        assert!(lattice([[1.0, -3.0], [-1.0 - f64::EPSILON, power_of_two(-1000)]]).is_none());
        assert!(lattice([[f64::MAX], [f64::from_bits(1)]]).is_none());
        assert!(lattice([[power_of_two(1000)], [f64::from_bits(1)]]).is_none());
        assert!(Extent::of(&[[f64::from_bits(1)], [0.0]]).expect("finite").is_tiny());
        assert!(lattice([[f64::MAX; 5]; 4]).is_some());
        assert!(lattice([[f64::INFINITY], [1.0]]).is_none());
        assert!(lattice([[f64::NAN, f64::MAX]]).is_none());
        assert!(lattice([[1.0, f64::NAN, 2.0]]).is_none());
    }

    #[test]
    fn conversion_is_exact() {
        let mut bits = 0x9e37_79b9_7f4a_7c15u64;
        for _ in 0..10_000 {
            bits = bits.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(1);
            // Any 53-bit integer, shifted within the window, is found again.
            let mantissa = (bits >> 11) as i64 - (1 << 52);
            let x = mantissa as f64 * power_of_two((bits % 9) as i32 - 300);
            let inside = lattice([[power_of_two(-300 + 60), x]]).expect("inside");
            assert_eq!(inside.exponent, -300);
            assert_eq!(inside.points[0][1], mantissa << (bits % 9));
        }
    }
}
