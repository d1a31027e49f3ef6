//! Integers of one or two machine words: points of a coarse grid.
//!
//! When the coordinates are integers of at most 29 bits (23 for degree 5) in some common unit, their differences
//! have one bit more, a value of degree 1 or 2 fits an `i64` and one of degree 3 to 5 an `i128`. The product of two
//! of degree 3 is a [`Wide`] of 4 words.

use super::lattice::{Extent, FINE};
use super::scaled::{Exact, Scaled, power_of_two};
use super::wide::Wide;
use crate::Sign;
use crate::polynomial::{Additive, Ring, SixthDegree, Times};

/// Degrees 1 and 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Single<const DEGREE: u32>(i64);

/// Degrees 3 to 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Double(i128);

/// The bits that differences may have for a polynomial of some degree.
const fn difference_bits(degree: i32) -> i32 {
    if degree == 5 { 24 } else { 30 }
}

/// The differences of the first points to the last one in units of some `2^exponent`, and that exponent; `None` if
/// they are no integers of few enough bits for a polynomial of `degree`.
#[inline(always)]
pub(crate) fn rows<const N: usize, const P: usize, const R: usize>(
    points: &[[f64; N]; P],
    extent: Extent,
    degree: i32,
) -> Option<(i32, [[Single<1>; N]; R])> {
    // Coordinates have one bit less than differences.
    let shift = extent.shift(difference_bits(degree) - 1);
    let (scale, inverse) = (power_of_two(shift), power_of_two(-shift));
    let mut integers = [[0; N]; P];
    let mut lost = 0;
    for (integer, &x) in integers.as_flattened_mut().iter_mut().zip(points.as_flattened()) {
        let shifted = x * scale + FINE;
        // Bits below the unit, and bits that the scaling lost to underflow.
        lost |= ((shifted - FINE) * inverse).to_bits() ^ x.to_bits();
        *integer = shifted.to_bits().wrapping_sub(FINE.to_bits()) as i64;
    }
    // Zeros of either sign are the same.
    if lost << 1 != 0 {
        return None;
    }
    let last = integers[P - 1];
    let rows = core::array::from_fn(|i| core::array::from_fn(|j| Single(integers[i][j] - last[j])));
    Some((-shift, rows))
}

/// One word, two words.
pub(crate) struct Small;

impl Ring for Small {
    type D1 = Single<1>;
    type D2 = Single<2>;
    type D3 = Double;
    type D4 = Double;
    type D5 = Double;
    type Outcome = Double;
}

impl<const D: u32> Additive for Single<D> {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Additive for Double {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Times<Single<1>> for Single<1> {
    type Product = Single<2>;
    #[inline(always)]
    fn times(&self, other: &Single<1>) -> Single<2> {
        Single(self.0 * other.0)
    }
}

impl Times<Single<2>> for Single<1> {
    type Product = Double;
    #[inline(always)]
    fn times(&self, other: &Single<2>) -> Double {
        Double(i128::from(self.0) * i128::from(other.0))
    }
}

impl Times<Single<2>> for Single<2> {
    type Product = Double;
    #[inline(always)]
    fn times(&self, other: &Single<2>) -> Double {
        Double(i128::from(self.0) * i128::from(other.0))
    }
}

impl Times<Double> for Single<2> {
    type Product = Double;
    #[inline(always)]
    fn times(&self, other: &Double) -> Double {
        Double(i128::from(self.0) * other.0)
    }
}

impl SixthDegree for Small {
    type D6 = Wide<4>;
}

impl Times<Double> for Double {
    type Product = Wide<4>;
    #[inline(always)]
    fn times(&self, other: &Double) -> Wide<4> {
        Wide::product(Wide::of_i128(self.0), Wide::of_i128(other.0))
    }
}

impl From<Single<2>> for Double {
    #[inline(always)]
    fn from(value: Single<2>) -> Self {
        Self(i128::from(value.0))
    }
}

impl Exact for Double {
    #[inline(always)]
    fn sign(&self) -> Sign {
        if self.0 == 0 {
            Sign::Zero
        } else if self.0 > 0 {
            Sign::Positive
        } else {
            Sign::Negative
        }
    }
    fn scaled(&self) -> Scaled {
        Wide::of_i128(self.0).scaled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial;

    #[test]
    fn extremes_of_every_polynomial_fit() {
        // Overflow panics in tests. The largest values are below X * 2^(bits * degree) with X = 72 for insphere and crossings
        // and 24 for the others (the magnitudes of crate::filter).
        assert!(72f64.log2() + 5.0 * f64::from(difference_bits(5)) < 127.0);
        assert!(24f64.log2() + 4.0 * f64::from(difference_bits(4)) < 127.0);
        assert!(2.0 * f64::from(difference_bits(4)) + 1.0 < 63.0 && 2.0 * 24.0 + 2.0 < 63.0);
        // The sum of three minors.
        assert!(6f64.log2() + 2.0 * f64::from(difference_bits(4)) < 63.0);
        let d = |bits: i32, negative: bool| Single(if negative { 1 - (1 << bits) } else { (1 << bits) - 1 });
        for signs in 0..1 << 12 {
            let at = |bits, i: usize| d(bits, signs >> i & 1 == 1);
            let row = |bits, i| [at(bits, i), at(bits, i + 1), at(bits, i + 2)];
            let _: Double = polynomial::orient3d::<Small>(&[row(30, 0), row(30, 3), row(30, 6)]);
            let _: Double = polynomial::insphere::<Small>(&[row(24, 0), row(24, 3), row(24, 6), row(24, 9)]);
            let (a, b, c, d) = (row(24, 0), row(24, 3), row(24, 6), row(24, 9));
            let _: Double = polynomial::crossings::<Small>(&[a, b, c, d, row(24, 1), row(24, 5)]);
            let (a, b, c, d) = (row(30, 0), row(30, 3), row(30, 6), row(30, 9));
            let _: Double = polynomial::slopes::<Small>(&[a, b, c, d, row(30, 1)], 0);
        }
    }

    #[test]
    fn units_are_relative_to_the_largest_coordinate() {
        let few = |points: [[f64; 1]; 2]| rows::<1, 2, 1>(&points, Extent::of(&points)?, 5);
        assert_eq!(few([[3.0 * power_of_two(40)], [power_of_two(40)]]), Some((41 - 22, [[Single(2 << 21)]])));
        assert_eq!(few([[1.0], [-power_of_two(-22)]]), Some((-22, [[Single((1 << 22) + 1)]])));
        assert_eq!(few([[1.0], [power_of_two(-23)]]), None);
        assert_eq!(few([[1.0], [f64::from_bits(1)]]), None);
        assert_eq!(few([[0.0], [-0.0]]).map(|few| few.1), Some([[Single(0)]]));
        assert_eq!(few([[f64::NAN], [1.0]]), None);
    }

    extern crate std;
}
