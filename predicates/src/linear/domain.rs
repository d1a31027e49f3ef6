//! The integers in which the exact stages compute: [`Domain`], of machine words, as expansions, or of any size.

use crate::Sign;
use crate::arithmetic::arena::{self, Arena, Int};
use crate::arithmetic::expansion::Expansion;
use crate::arithmetic::fixed_point::decompose;
use crate::arithmetic::scaled::{Scaled, power_of_two};

/// Integers with exact division where the quotient is known to be an integer.
///
/// A domain may run out of room; then its divisors or its signs are `None`, never wrong.
pub(super) trait Domain {
    type Number: Copy;
    /// A number prepared to divide by.
    type Divisor;
    const ZERO: Self::Number;

    /// `value * 2^shift`, an integer.
    fn load(&mut self, value: f64, shift: i32) -> Self::Number;
    /// Prepares to divide, to get minors of order `order`.
    fn divisor(&mut self, by: &Self::Number, order: usize) -> Option<Self::Divisor>;
    /// `(a b - c d) / by`, an integer.
    fn cross(
        &mut self,
        a: &Self::Number,
        b: &Self::Number,
        c: &Self::Number,
        d: &Self::Number,
        by: &Self::Divisor,
    ) -> Self::Number;
    fn sign(&self, a: &Self::Number) -> Option<Sign>;
    fn scaled(&self, a: &Self::Number) -> Scaled;
}

/// Binary digits of a bound of a minor of given order, the sum of `order!` products, in integers below
/// `2^bits`.
fn minor_bits(bits: i32, order: usize) -> i32 {
    /// ceil(log2(order!))
    const FACTORIAL_BITS: [i32; 7] = [0, 0, 1, 3, 5, 7, 10];
    order as i32 * bits + FACTORIAL_BITS[order]
}

/// Integers of 128 bits.
///
/// Products are formed modulo 2^128 and multiplied by the inverse of the divisor modulo 2^128 \[Jebelean93\]:
/// only the quotient, a minor, has to fit, and the factors of two of the divisor beside it.
pub(super) struct Machine {
    /// All loaded integers are below 2^bits.
    pub(super) bits: i32,
}

/// Integers that a `u64` shift can load.
const MOST_LOADED_BITS: i32 = 62;

impl Machine {
    /// A domain for integers below `2^bits`; `None` if it could not even hold these.
    pub(super) fn new(bits: i32) -> Option<Self> {
        (bits <= MOST_LOADED_BITS).then_some(Self { bits })
    }
}

pub(super) struct MachineDivisor {
    zeros: u32,
    inverse: i128,
}

impl Domain for Machine {
    type Number = i128;
    type Divisor = MachineDivisor;
    const ZERO: i128 = 0;

    #[inline]
    fn load(&mut self, value: f64, shift: i32) -> i128 {
        let (negative, mantissa, exponent) = decompose(value);
        if mantissa == 0 {
            return 0;
        }
        let shift = exponent + shift;
        // Nothing but zeros is shifted out, and the number stays below 2^62.
        let magnitude = i128::from(if shift < 0 { mantissa >> -shift } else { mantissa << shift });
        if negative { -magnitude } else { magnitude }
    }

    #[inline]
    fn divisor(&mut self, by: &i128, order: usize) -> Option<MachineDivisor> {
        let zeros = by.trailing_zeros();
        if minor_bits(self.bits, order) + zeros as i32 > 127 {
            return None;
        }
        let odd = by >> zeros;
        // Newton's iteration doubles the correct bits: 5, 10, 20, 40, 80, 160.
        let mut inverse = odd.wrapping_mul(3) ^ 2;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2i128.wrapping_sub(odd.wrapping_mul(inverse)));
        }
        Some(MachineDivisor { zeros, inverse })
    }

    #[inline(always)]
    fn cross(&mut self, a: &i128, b: &i128, c: &i128, d: &i128, by: &MachineDivisor) -> i128 {
        let difference = a.wrapping_mul(*b).wrapping_sub(c.wrapping_mul(*d));
        let quotient = (difference >> by.zeros).wrapping_mul(by.inverse);
        // The upper bits, as many as there were zeros, are unknown: they repeat the sign.
        quotient << by.zeros >> by.zeros
    }

    #[inline]
    fn sign(&self, a: &i128) -> Option<Sign> {
        Some(match a.signum() {
            1 => Sign::Positive,
            -1 => Sign::Negative,
            _ => Sign::Zero,
        })
    }

    fn scaled(&self, a: &i128) -> Scaled {
        let magnitude = a.unsigned_abs();
        match ((magnitude >> 64) as u64, magnitude as u64) {
            (0, 0) => Scaled::ZERO,
            (0, low) => Scaled::of_words(*a < 0, low, 0, -64),
            (high, low) => Scaled::of_words(*a < 0, high, low, 0),
        }
    }
}

/// Expansions.
pub(super) struct Expansions;

/// Components of an expansion: with 90 bits a coefficient, the largest product has 920 bits, 18 components of
/// 53 bits each. Zeros between them make it more; what does not fit is left to the next stage.
const COMPONENTS: usize = 48;

/// Bits of the coefficients of which the products of two minors of order five, with ten bits to spare, stay
/// below 2^990.
const MOST_EXPANSION_BITS: i32 = 97;

impl Expansions {
    /// A domain for integers below `2^bits`; `None` if their products could overflow.
    pub(super) fn new(bits: i32) -> Option<Self> {
        (bits <= MOST_EXPANSION_BITS).then_some(Self)
    }
}

impl Domain for Expansions {
    type Number = Expansion<COMPONENTS>;
    type Divisor = Self::Number;
    const ZERO: Self::Number = Expansion::ZERO;

    fn load(&mut self, value: f64, shift: i32) -> Self::Number {
        // In two steps, neither of which leaves the range or loses a bit: the result is an integer below 2^97,
        // and so is the value times any power of two between 1 and that of the result.
        let half = shift / 2;
        let scaled = value * power_of_two(half) * power_of_two(shift - half);
        Expansion::sum(&Expansion::<2>::of_difference(scaled, 0.0), &Expansion::<0>::ZERO)
    }

    fn divisor(&mut self, by: &Self::Number, _: usize) -> Option<Self::Number> {
        (!by.is_overfull()).then_some(*by)
    }

    fn cross(
        &mut self,
        a: &Self::Number,
        b: &Self::Number,
        c: &Self::Number,
        d: &Self::Number,
        by: &Self::Number,
    ) -> Self::Number {
        let mut difference =
            Expansion::sum(&Self::Number::product(a, b), &Self::Number::product(c, d).negated());
        difference.compress();
        let mut quotient = Expansion::quotient(&difference, by);
        quotient.compress();
        quotient
    }

    fn sign(&self, a: &Self::Number) -> Option<Sign> {
        a.sign()
    }

    fn scaled(&self, a: &Self::Number) -> Scaled {
        Scaled::of_f64(a.estimate())
    }
}

impl Domain for Arena<'_> {
    type Number = Int;
    type Divisor = arena::Divisor;
    const ZERO: Int = Int::ZERO;

    fn load(&mut self, value: f64, shift: i32) -> Int {
        Arena::load(self, value, -shift)
    }

    fn divisor(&mut self, by: &Int, _: usize) -> Option<arena::Divisor> {
        Some(Arena::divisor(self, *by))
    }

    fn cross(&mut self, a: &Int, b: &Int, c: &Int, d: &Int, by: &arena::Divisor) -> Int {
        let mark = self.mark();
        let first = self.mul(*a, *b);
        let second = self.mul(*c, *d);
        let difference = self.sub(first, second);
        let mut quotient = self.quotient(difference, by);
        self.keep(mark, [&mut quotient]);
        quotient
    }

    fn sign(&self, a: &Int) -> Option<Sign> {
        Some(a.sign())
    }

    fn scaled(&self, a: &Int) -> Scaled {
        Arena::scaled(self, *a)
    }
}
