//! Integers of bounded size: the stage that has no exponent range to leave.
//!
//! Every finite `f64` is an integer multiple of 2^-1074 below 2^1024 in magnitude, hence an integer of at most
//! 2098 bits after division by the smallest unit among the inputs. Sums and products of such integers have
//! known sizes, so their capacity is fixed at compile time and nothing is allocated.
//!
//! * [`Integer<L>`] is a sign and a magnitude of at most `L` 64-bit limbs; only the used limbs cost time.
//! * [`Unit`] is the common unit of a set of coordinates.

use super::scaled::{Exact, Scaled};
use crate::Sign;
use crate::polynomial::{Additive, Ring, SixthDegree, Times};

/// Limbs of a coordinate or of a difference of two: 2099 bits in 33 limbs of 64 (2112 bits).
pub(crate) const COORDINATE_LIMBS: usize = 33;

/// Exponent of the least significant bit of `f64::MIN_POSITIVE`'s subnormal neighbours.
const MIN_EXPONENT: i32 = -1074;

/// Splits a finite `value` into `(negative, mantissa, exponent)` with `|value| = mantissa * 2^exponent`.
pub(crate) fn decompose(value: f64) -> (bool, u64, i32) {
    let bits = value.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if biased == 0 { fraction } else { fraction | (1 << 52) };
    (bits >> 63 == 1, mantissa, biased.max(1) - 1 + MIN_EXPONENT)
}

/// The largest power of two that divides every coordinate of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unit {
    exponent: i32,
}

impl Unit {
    /// The unit of `values`, all finite.
    pub(crate) fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut exponent = i32::MAX;
        for value in values {
            let (_, mantissa, e) = decompose(value);
            if mantissa != 0 {
                exponent = exponent.min(e + mantissa.trailing_zeros() as i32);
            }
        }
        // All zero: any unit will do.
        Self { exponent: if exponent == i32::MAX { 0 } else { exponent } }
    }

    /// The power of two that it is.
    pub(crate) fn exponent(self) -> i32 {
        self.exponent
    }

    /// How many limbs the largest of `values`, all finite, has in their common unit, with a bit to spare.
    pub(crate) fn limbs(values: impl Iterator<Item = f64> + Clone) -> usize {
        let unit = Self::of(values.clone()).exponent;
        let bits = values.map(|value| {
            let (_, mantissa, exponent) = decompose(value);
            if mantissa == 0 { 0 } else { exponent + 64 - mantissa.leading_zeros() as i32 - unit }
        });
        (bits.max().unwrap_or(0) as usize + 1).div_ceil(64)
    }

    /// `value` as an integer number of units. `value` belongs to the set that the unit was made of.
    pub(crate) fn integer(self, value: f64) -> Integer<COORDINATE_LIMBS> {
        let (negative, mantissa, exponent) = decompose(value);
        let mut result = Integer::ZERO;
        if mantissa == 0 {
            return result;
        }
        let zeros = mantissa.trailing_zeros();
        let shift = (exponent + zeros as i32 - self.exponent) as usize;
        let wide = u128::from(mantissa >> zeros) << (shift % 64);
        let limb = shift / 64;
        result.limbs[limb] = wide as u64;
        result.len = limb + 1;
        let high = (wide >> 64) as u64;
        if high != 0 {
            result.limbs[limb + 1] = high;
            result.len = limb + 2;
        }
        result.negative = negative;
        result
    }
}

/// A signed integer of at most `L` limbs. `limbs[len..]` are zero, `limbs[len - 1]` is not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Integer<const L: usize> {
    negative: bool,
    len: usize,
    limbs: [u64; L],
}

impl<const L: usize> Integer<L> {
    pub(crate) const ZERO: Self = Self { negative: false, len: 0, limbs: [0; L] };

    /// The leading bits, in units of 1.
    fn scaled(&self) -> Scaled {
        let Some(top) = self.len.checked_sub(1) else { return Scaled::ZERO };
        let below = if top > 0 { self.limbs[top - 1] } else { 0 };
        Scaled::of_words(self.negative, self.limbs[top], below, 64 * (top as i32 - 1))
    }

    pub(crate) fn negated(mut self) -> Self {
        self.negative = !self.negative;
        self
    }

    /// `self + other`.
    ///
    /// # Panics
    /// If the sum needs more than `L` limbs; the callers' capacities are chosen so that it cannot.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        if self.negative == other.negative {
            return self.magnitude_sum(other);
        }
        let (big, small) = if self.magnitude_less(other) { (other, self) } else { (self, other) };
        let mut result = *big;
        let mut borrow = false;
        for i in 0..big.len {
            if i >= small.len && !borrow {
                break;
            }
            let (d, b1) = big.limbs[i].overflowing_sub(if i < small.len { small.limbs[i] } else { 0 });
            let (d, b2) = d.overflowing_sub(u64::from(borrow));
            result.limbs[i] = d;
            borrow = b1 | b2;
        }
        result.trim();
        result
    }

    /// `a * b`; the capacity is checked when the program is compiled.
    pub(crate) fn product<const A: usize, const B: usize>(a: &Integer<A>, b: &Integer<B>) -> Self {
        const { assert!(L >= A + B, "a product has as many limbs as its factors together") };
        let mut result = Self::ZERO;
        if a.len == 0 || b.len == 0 {
            return result;
        }
        for (i, &x) in a.limbs[..a.len].iter().enumerate() {
            if x == 0 {
                continue;
            }
            let mut carry = 0u64;
            for (r, &y) in result.limbs[i..i + b.len].iter_mut().zip(&b.limbs[..b.len]) {
                let t = u128::from(x) * u128::from(y) + u128::from(*r) + u128::from(carry);
                *r = t as u64;
                carry = (t >> 64) as u64;
            }
            result.limbs[i + b.len] = carry;
        }
        result.len = a.len + b.len;
        result.negative = a.negative != b.negative;
        result.trim();
        result
    }

    fn magnitude_less(&self, other: &Self) -> bool {
        if self.len != other.len {
            return self.len < other.len;
        }
        self.limbs[..self.len].iter().rev().lt(other.limbs[..self.len].iter().rev())
    }

    fn magnitude_sum(&self, other: &Self) -> Self {
        let (long, short) = if self.len < other.len { (other, self) } else { (self, other) };
        let mut result = *long;
        let mut carry = false;
        for i in 0..long.len {
            if i >= short.len && !carry {
                break;
            }
            let (s, c1) = long.limbs[i].overflowing_add(if i < short.len { short.limbs[i] } else { 0 });
            let (s, c2) = s.overflowing_add(u64::from(carry));
            result.limbs[i] = s;
            carry = c1 | c2;
        }
        if carry {
            result.limbs[long.len] = 1;
            result.len = long.len + 1;
        }
        result
    }

    fn trim(&mut self) {
        while self.len > 0 && self.limbs[self.len - 1] == 0 {
            self.len -= 1;
        }
        if self.len == 0 {
            self.negative = false;
        }
    }
}

/// The integers of each degree.
pub(crate) struct Integers;

impl Ring for Integers {
    type D1 = Integer<COORDINATE_LIMBS>;
    type D2 = Integer<{ 2 * COORDINATE_LIMBS }>;
    type D3 = Integer<{ 3 * COORDINATE_LIMBS }>;
    type D4 = Integer<{ 4 * COORDINATE_LIMBS }>;
    type D5 = Integer<{ 5 * COORDINATE_LIMBS }>;
    type Outcome = Scaled;
}

impl<const L: usize> Additive for Integer<L> {
    fn plus(&self, other: &Self) -> Self {
        self.plus(other)
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }
}

impl<const L: usize> From<Integer<L>> for Scaled {
    fn from(value: Integer<L>) -> Self {
        value.scaled()
    }
}

macro_rules! products {
    ($($a:literal * $b:literal;)*) => {$(
        impl Times<Integer<{ $b * COORDINATE_LIMBS }>> for Integer<{ $a * COORDINATE_LIMBS }> {
            type Product = Integer<{ ($a + $b) * COORDINATE_LIMBS }>;
            fn times(&self, other: &Integer<{ $b * COORDINATE_LIMBS }>) -> Self::Product {
                Integer::product(self, other)
            }
        }
    )*};
}

products! {
    1 * 1;
    1 * 2;
    2 * 2;
    2 * 3;
    3 * 3;
}

impl SixthDegree for Integers {
    type D6 = Integer<{ 6 * COORDINATE_LIMBS }>;
}

impl<const L: usize> Exact for Integer<L> {
    fn sign(&self) -> Sign {
        match (self.len, self.negative) {
            (0, _) => Sign::Zero,
            (_, true) => Sign::Negative,
            (_, false) => Sign::Positive,
        }
    }
    fn scaled(&self) -> Scaled {
        Integer::scaled(self)
    }
}

/// The differences of the first points to the last one as numbers of units, and the exponent of the unit.
/// All coordinates are finite.
pub(crate) fn differences<const N: usize, const P: usize, const R: usize>(
    points: &[[f64; N]; P],
) -> (i32, [[Integer<COORDINATE_LIMBS>; N]; R]) {
    let unit = Unit::of(points.as_flattened().iter().copied());
    let last = points[P - 1].map(|x| unit.integer(x));
    let row = |i: usize| core::array::from_fn(|j| unit.integer(points[i][j]).minus(&last[j]));
    (unit.exponent, core::array::from_fn(row))
}
