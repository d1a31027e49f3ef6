//! Exact numbers as sums of `f64`: expansions of fixed capacity.
//!
//! An expansion is a sequence of nonzero numbers of ascending magnitude, no two of which overlap in their bits; it
//! stands for their exact sum, and has its last component's sign. Sums are FAST-EXPANSION-SUM, products with
//! one number SCALE-EXPANSION, both with zero elimination, and COMPRESS shortens \[Shewchuk97\]. All results are
//! nonadjacent, which the algorithms need of their operands.
//!
//! An operation that would need more than `CAP` components gives an *overfull* expansion. Being overfull is
//! inherited by every result, and such a number has no sign: [`Expansion::sign`] is `None`. So a full array is
//! never a wrong answer.
//!
//! **Range.** Exact as long as no product overflows or underflows: for a polynomial of degree k in differences
//! of coordinates, these must be multiples of 2^(-1074 / k) below 2^(990 / k) (see [`in_range`]).
//!
//! Cost of `a + b`: 17 operations per component of both; of `a * b`: some 50 per pair of components.

use super::error_free::{fast_two_sum, two_difference, two_product, two_sum};
use super::scaled::{Exact, Scaled};
use crate::Sign;
use crate::polynomial::{Additive, Ring, Times};

/// A sum of at most `CAP` nonoverlapping components of ascending magnitude, none zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion<const CAP: usize> {
    components: [f64; CAP],
    /// How many components count; [`OVERFULL`] if there should be more than `CAP`.
    len: usize,
}

const OVERFULL: usize = usize::MAX;

/// From how many components on a result is compressed: fewer cost less in the next product than to compress.
const MANY: usize = 8;

impl<const CAP: usize> Expansion<CAP> {
    pub(crate) const ZERO: Self = Self { components: [0.0; CAP], len: 0 };

    /// `a - b`.
    #[inline]
    pub(crate) fn of_difference(a: f64, b: f64) -> Self {
        let (high, low) = two_difference(a, b);
        let mut result = Self::ZERO;
        result.push(low);
        result.push(high);
        result
    }

    #[inline(always)]
    fn push(&mut self, component: f64) {
        if component == 0.0 {
            return;
        }
        if let Some(place) = self.components.get_mut(self.len) {
            *place = component;
            self.len += 1;
        } else {
            self.len = OVERFULL;
        }
    }

    /// The components; none if overfull.
    #[inline(always)]
    pub(crate) fn components(&self) -> &[f64] {
        self.components.get(..self.len).unwrap_or(&[])
    }

    pub(crate) fn is_overfull(&self) -> bool {
        self.len == OVERFULL
    }

    /// The sign; `None` if overfull.
    #[inline]
    pub(crate) fn sign(&self) -> Option<Sign> {
        (!self.is_overfull()).then(|| Sign::of(self.components().last().copied().unwrap_or(0.0)))
    }

    /// The sum, rounded: off by less than one unit in the last place. Of the sign of the expansion.
    pub(crate) fn estimate(&self) -> f64 {
        self.components().iter().sum()
    }

    #[inline]
    pub(crate) fn negated(mut self) -> Self {
        let used = self.components().len();
        self.components[..used].iter_mut().for_each(|x| *x = -*x);
        self
    }

    /// `a + b`.
    pub(crate) fn sum<const A: usize, const B: usize>(a: &Expansion<A>, b: &Expansion<B>) -> Self {
        let mut result = Self::ZERO;
        if a.is_overfull() || b.is_overfull() {
            result.len = OVERFULL;
            return result;
        }
        let (a, b) = (a.components(), b.components());
        let mut merged = Merge { a, b };
        let Some(first) = merged.next() else { return result };
        let mut running = first;
        if let Some(second) = merged.next() {
            let (q, h) = fast_two_sum(second, running);
            result.push(h);
            running = q;
        }
        for next in merged {
            let (q, h) = two_sum(running, next);
            result.push(h);
            running = q;
        }
        result.push(running);
        result
    }

    /// `a * b`.
    pub(crate) fn scaled_by<const A: usize>(a: &Expansion<A>, b: f64) -> Self {
        let mut result = Self::ZERO;
        if a.is_overfull() {
            result.len = OVERFULL;
            return result;
        }
        let Some((&first, rest)) = a.components().split_first() else { return result };
        let (mut running, low) = two_product(first, b);
        result.push(low);
        for &x in rest {
            let (high, low) = two_product(x, b);
            let (q, h) = two_sum(running, low);
            result.push(h);
            let (q, h) = fast_two_sum(high, q);
            result.push(h);
            running = q;
        }
        result.push(running);
        result
    }

    /// `a * b`.
    pub(crate) fn product<const A: usize, const B: usize>(a: &Expansion<A>, b: &Expansion<B>) -> Self {
        let mut result = Self::ZERO;
        if a.is_overfull() || b.is_overfull() {
            result.len = OVERFULL;
            return result;
        }
        let Some((&first, rest)) = b.components().split_first() else { return result };
        result = Self::scaled_by(a, first);
        for &y in rest {
            result = Self::sum(&result, &Self::scaled_by(a, y));
            result.shorten();
        }
        result
    }

    /// `a / b`, which is known to be an integer; `a` and `b` are integers, `b` is not zero.
    ///
    /// Long division: each step divides the leading parts and takes the quotient, as an integer, times `b` from the rest.
    /// It is off by less than 2^-50 of itself, so the rest shrinks by that factor, and once the quotient is below
    /// 2^48, rounding to an integer makes it exact and the rest zero.
    pub(crate) fn quotient(a: &Self, b: &Self) -> Self {
        let mut result = Self::ZERO;
        if a.is_overfull() || b.is_overfull() {
            result.len = OVERFULL;
            return result;
        }
        let mut rest = *a;
        let divisor = b.estimate();
        while !rest.components().is_empty() {
            let digit = nearest_integer(rest.estimate() / divisor);
            result = Self::sum(&result, &Expansion::<2>::of_difference(digit, 0.0));
            rest = Self::sum(&rest, &Self::scaled_by(b, -digit));
            rest.compress();
        }
        if rest.is_overfull() {
            result.len = OVERFULL;
        }
        result
    }

    /// Compresses if there is little room left, or enough components for it to pay.
    #[inline(always)]
    fn shorten(&mut self) {
        if self.components().len() > (CAP / 2).min(MANY) {
            self.compress();
        }
    }

    /// The same number in about as few components as it needs, the last of which nearly equals it.
    pub(crate) fn compress(&mut self) {
        let n = self.components().len();
        if n < 2 {
            return;
        }
        // From the largest down: what each partial sum leaves over moves on, finished parts gather at the end.
        let mut running = self.components[n - 1];
        let mut bottom = n - 1;
        for i in (0..n - 1).rev() {
            let (q, h) = fast_two_sum(running, self.components[i]);
            running = q;
            if h != 0.0 {
                self.components[bottom] = running;
                bottom -= 1;
                running = h;
            }
        }
        self.components[bottom] = running;
        // And up again, eliminating zeros.
        self.len = 0;
        for i in bottom + 1..n {
            let (q, h) = fast_two_sum(self.components[i], running);
            running = q;
            self.push(h);
        }
        self.push(running);
    }
}

/// The nearest integer; one of the two nearest to a half.
fn nearest_integer(x: f64) -> f64 {
    /// 2^52: from here on every number is an integer.
    const INTEGERS: f64 = 4_503_599_627_370_496.0;
    if x.abs() < INTEGERS { ((x.abs() + INTEGERS) - INTEGERS).copysign(x) } else { x }
}

/// The components of two expansions in ascending order of magnitude.
struct Merge<'a> {
    a: &'a [f64],
    b: &'a [f64],
}

impl Iterator for Merge<'_> {
    type Item = f64;
    #[inline(always)]
    fn next(&mut self) -> Option<f64> {
        let from = match (self.a.first(), self.b.first()) {
            (Some(x), Some(y)) if x.abs() < y.abs() => &mut self.a,
            (_, Some(_)) => &mut self.b,
            _ => &mut self.a,
        };
        let (&first, rest) = from.split_first()?;
        *from = rest;
        Some(first)
    }
}

/// Whether finite coordinates times `2^exponent`, below 2^(990 / degree) in magnitude, have no bits below
/// 2^(-1074 / degree).
pub(crate) fn in_range<const N: usize>(points: &[[f64; N]], exponent: i32, degree: i32) -> bool {
    points.as_flattened().iter().all(|&x| {
        let Scaled { mantissa, exponent: unit } = Scaled::of_f64(x);
        mantissa == 0 || degree * (exponent + unit + mantissa.trailing_zeros() as i32) >= -1074
    })
}

/// Expansions with the capacity that a compressed value of each degree rarely exceeds.
pub(crate) struct Expansions;

impl Ring for Expansions {
    type D1 = Expansion<2>;
    type D2 = Expansion<24>;
    type D3 = Expansion<40>;
    type D4 = Expansion<56>;
    type D5 = Expansion<72>;
    type Outcome = Expansion<72>;
}

impl<const CAP: usize> Additive for Expansion<CAP> {
    fn plus(&self, other: &Self) -> Self {
        let mut result = Self::sum(self, other);
        result.shorten();
        result
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }
}

macro_rules! products {
    ($($a:literal * $b:literal = $c:literal;)*) => {$(
        impl Times<Expansion<$b>> for Expansion<$a> {
            type Product = Expansion<$c>;
            fn times(&self, other: &Expansion<$b>) -> Self::Product {
                Expansion::product(other, self)
            }
        }
    )*};
}

products! {
    2 * 2 = 24;
    2 * 24 = 40;
    24 * 24 = 56;
    24 * 40 = 72;
}

macro_rules! widened {
    ($($cap:literal)*) => {$(
        impl From<Expansion<$cap>> for Expansion<72> {
            fn from(value: Expansion<$cap>) -> Self {
                Self::sum(&value, &Expansion::<0>::ZERO)
            }
        }
    )*};
}

widened!(24 40 56);

impl<const CAP: usize> Exact for Expansion<CAP> {
    /// The sign of an expansion that is not overfull.
    fn sign(&self) -> Sign {
        Expansion::sign(self).unwrap_or(Sign::Zero)
    }
    fn scaled(&self) -> Scaled {
        Scaled::of_f64(self.estimate())
    }
}

#[cfg(test)]
mod tests {
    use super::super::scaled::power_of_two;
    use super::*;

    fn of(values: &[f64]) -> Expansion<64> {
        values
            .iter()
            .fold(Expansion::ZERO, |sum, &x| Expansion::sum(&sum, &Expansion::<2>::of_difference(x, 0.0)))
    }

    #[test]
    fn sums_and_products_are_exact() {
        // (1 + 2^-70 + 2^-200) (1 - 2^-70) (2^100 - 2^-20), against its expanded terms.
        let a = of(&[1.0, power_of_two(-70), power_of_two(-200)]);
        let b = of(&[1.0, -power_of_two(-70)]);
        let c = of(&[power_of_two(100), -power_of_two(-20)]);
        let product = Expansion::<64>::product(&Expansion::<64>::product(&a, &b), &c);
        let p = power_of_two;
        let terms = [p(100), -p(-40), p(-100), -p(-170), -p(-20), p(-160), -p(-220), p(-290)];
        assert_eq!(product.minus(&of(&terms)).sign(), Some(Sign::Zero));
        assert_eq!(product.plus(&of(&[-p(-300)])).minus(&of(&terms)).sign(), Some(Sign::Negative));
        assert_eq!(product.estimate(), p(100));
    }

    #[test]
    fn compression_keeps_the_sum() {
        let wide = of(&[1.0, power_of_two(-60), power_of_two(-61), power_of_two(-62), -power_of_two(-300)]);
        let mut compressed = wide;
        compressed.compress();
        assert!(compressed.components().len() <= 3);
        assert_eq!(wide.minus(&compressed).sign(), Some(Sign::Zero));
        assert_eq!(*compressed.components().last().expect("not zero"), 1.0);
    }

    #[test]
    fn a_full_array_is_reported_and_inherited() {
        let sum = |a: &Expansion<2>, x: f64| Expansion::<2>::sum(a, &Expansion::<2>::of_difference(x, 0.0));
        let two = sum(&Expansion::of_difference(1.0, 0.0), power_of_two(-100));
        assert_eq!(two.sign(), Some(Sign::Positive));
        let three = sum(&two, power_of_two(-200));
        assert!(three.is_overfull());
        assert_eq!(three.sign(), None);
        assert_eq!(three.minus(&three).sign(), None);
        assert_eq!(Expansion::<9>::product(&three, &two).sign(), None);
        assert_eq!(Expansion::<9>::scaled_by(&three, 2.0).sign(), None);
    }

    #[test]
    fn quotients_undo_products() {
        let p = power_of_two;
        let values = [
            of(&[1.0]),
            of(&[-3.0]),
            of(&[p(60), 1.0]),
            of(&[p(150), -p(90), 7.0]),
            of(&[-p(200), p(140) + p(100), p(80), p(40), -1.0]),
        ];
        for a in &values {
            for b in &values {
                let product = Expansion::<64>::product(a, b);
                assert_eq!(Expansion::quotient(&product, b).minus(a).sign(), Some(Sign::Zero));
                assert_eq!(Expansion::quotient(&product, a).minus(b).sign(), Some(Sign::Zero));
            }
            assert_eq!(Expansion::quotient(&of(&[]), a).sign(), Some(Sign::Zero));
        }
        assert_eq!(
            Expansion::<1>::quotient(&Expansion::of_difference(1.0, p(60)), &Expansion::ZERO).sign(),
            None
        );
    }

    #[test]
    fn range_is_that_of_the_last_bit() {
        assert!(in_range(&[[power_of_two(190), power_of_two(-214), 0.0]], 0, 5));
        assert!(!in_range(&[[power_of_two(190), power_of_two(-214), 0.0]], -1, 5));
        assert!(!in_range(&[[1.0 + f64::EPSILON, power_of_two(-170) * (1.0 + f64::EPSILON)]], 0, 5));
        assert!(in_range(&[[f64::from_bits(1)]], 600, 2));
        assert!(!in_range(&[[f64::from_bits(1)]], 500, 2));
    }
}
