//! Integers of any size in a caller's buffer: [`Arena`].
//!
//! What it computes: sums, differences and products of integers whose sizes are known only at run time, without
//! allocation. An [`Int`] is a sign and a run of limbs in the arena; results are written behind everything there is,
//! and [`Arena::keep`] throws away what lies between a mark and the results that are still wanted.
//!
//! Promises: exact results. Does not promise to fit: the buffer's size is the caller's proof obligation, and a
//! buffer that is too small is a panic by slice index, never a wrong number.
//!
//! Complexity: schoolbook, proportional to the product of the lengths.

use super::fixed_point::decompose;
use super::scaled::Scaled;
use crate::Sign;

/// A number in an arena. Zero has no limbs and is not negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Int {
    negative: bool,
    start: usize,
    len: usize,
}

impl Int {
    pub(crate) const ZERO: Self = Self { negative: false, start: 0, len: 0 };

    #[inline]
    pub(crate) fn sign(self) -> Sign {
        match (self.len, self.negative) {
            (0, _) => Sign::Zero,
            (_, true) => Sign::Negative,
            (_, false) => Sign::Positive,
        }
    }

    #[inline]
    pub(crate) fn negated(self) -> Self {
        Self { negative: !self.negative && self.len > 0, ..self }
    }

    #[inline]
    pub(crate) fn abs(self) -> Self {
        Self { negative: false, ..self }
    }
}

/// A number to divide by, prepared: see [`Arena::quotient`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Divisor {
    /// The number without its factors of two.
    odd: Int,
    /// How many factors of two.
    zeros: usize,
    /// The inverse of the lowest limb of `odd`, modulo 2^64.
    inverse: u64,
}

/// A stack of limbs.
pub(crate) struct Arena<'b> {
    limbs: &'b mut [u64],
    top: usize,
    #[cfg(test)]
    pub(crate) high_water: usize,
}

/// The place in an arena up to which everything is kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark(usize);

/// More than the coefficients of any polynomial.
const MOST_KEPT: usize = 8;

impl<'b> Arena<'b> {
    pub(crate) fn new(limbs: &'b mut [u64]) -> Self {
        Self {
            limbs,
            top: 0,
            #[cfg(test)]
            high_water: 0,
        }
    }

    pub(crate) fn mark(&self) -> Mark {
        Mark(self.top)
    }

    /// Moves `values`, which do not overlap, down to the mark and frees the rest above it. Those below the mark stay
    /// where they are.
    ///
    /// # Panics
    /// If there are more than `MOST_KEPT`.
    pub(crate) fn keep<'v>(&mut self, mark: Mark, values: impl IntoIterator<Item = &'v mut Int>) {
        let mut above: [Option<&mut Int>; MOST_KEPT] = [const { None }; MOST_KEPT];
        let mut count = 0;
        for value in values.into_iter().filter(|value| value.len > 0 && value.start >= mark.0) {
            above[count] = Some(value);
            count += 1;
        }
        let above = &mut above[..count];
        above.sort_unstable_by_key(|value| value.as_ref().map(|value| value.start));
        let mut top = mark.0;
        for value in above.iter_mut().flatten() {
            self.limbs.copy_within(value.start..value.start + value.len, top);
            value.start = top;
            top += value.len;
        }
        self.top = top;
    }

    /// The finite `value` in units of `2^unit`, of which it is a multiple.
    pub(crate) fn load(&mut self, value: f64, unit: i32) -> Int {
        let (negative, mantissa, exponent) = decompose(value);
        if mantissa == 0 {
            return Int::ZERO;
        }
        let zeros = mantissa.trailing_zeros();
        let shift = (exponent + zeros as i32 - unit) as usize;
        let wide = u128::from(mantissa >> zeros) << (shift % 64);
        let (start, below) = (self.top, shift / 64);
        self.limbs[start..start + below].fill(0);
        self.limbs[start + below] = wide as u64;
        self.limbs[start + below + 1] = (wide >> 64) as u64;
        self.push(negative, below + 2)
    }

    pub(crate) fn add(&mut self, a: Int, b: Int) -> Int {
        if a.negative == b.negative {
            return self.add_magnitudes(a, b);
        }
        match self
            .magnitude(a)
            .len()
            .cmp(&self.magnitude(b).len())
            .then_with(|| self.magnitude(a).iter().rev().cmp(self.magnitude(b).iter().rev()))
        {
            core::cmp::Ordering::Equal => Int::ZERO,
            core::cmp::Ordering::Greater => self.subtract_magnitudes(a, b),
            core::cmp::Ordering::Less => self.subtract_magnitudes(b, a),
        }
    }

    pub(crate) fn sub(&mut self, a: Int, b: Int) -> Int {
        self.add(a, b.negated())
    }

    pub(crate) fn mul(&mut self, a: Int, b: Int) -> Int {
        if a.len == 0 || b.len == 0 {
            return Int::ZERO;
        }
        let (used, free) = self.limbs.split_at_mut(self.top);
        let (x, y) = (&used[a.start..a.start + a.len], &used[b.start..b.start + b.len]);
        let result = &mut free[..x.len() + y.len()];
        result.fill(0);
        // Differences of numbers that are far apart are mostly zeros.
        for (i, &xi) in x.iter().enumerate().filter(|&(_, &xi)| xi != 0) {
            let mut carry = 0;
            for (r, &yj) in result[i..].iter_mut().zip(y) {
                let t = u128::from(xi) * u128::from(yj) + u128::from(*r) + u128::from(carry);
                *r = t as u64;
                carry = (t >> 64) as u64;
            }
            result[i + y.len()] = carry;
        }
        self.push(a.negative != b.negative, a.len + b.len)
    }

    /// `factor * a`.
    pub(crate) fn mul_small(&mut self, a: Int, factor: u64) -> Int {
        let (used, free) = self.limbs.split_at_mut(self.top);
        let mut carry = 0;
        for (r, &x) in free.iter_mut().zip(&used[a.start..a.start + a.len]) {
            let t = u128::from(x) * u128::from(factor) + u128::from(carry);
            *r = t as u64;
            carry = (t >> 64) as u64;
        }
        if a.len > 0 {
            free[a.len] = carry;
        }
        self.push(a.negative, if a.len > 0 { a.len + 1 } else { 0 })
    }

    /// Prepares to divide by `a`, which is not zero.
    pub(crate) fn divisor(&mut self, a: Int) -> Divisor {
        let limbs = self.magnitude(a);
        let whole = limbs.iter().position(|&limb| limb != 0).unwrap_or(0);
        let zeros = 64 * whole + limbs.get(whole).map_or(0, |limb| limb.trailing_zeros() as usize);
        let odd = self.shifted_right(a, zeros);
        // Newton's iteration doubles the correct bits: 5, 10, 20, 40, 80.
        let low = self.magnitude(odd).first().copied().unwrap_or(1);
        let mut inverse = low.wrapping_mul(3) ^ 2;
        for _ in 0..4 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(low.wrapping_mul(inverse)));
        }
        Divisor { odd, zeros, inverse }
    }

    /// `a / by`, which is known to be an integer: limb by limb from the lowest \[Jebelean93\].
    pub(crate) fn quotient(&mut self, a: Int, by: &Divisor) -> Int {
        let rest = self.shifted_right(a, by.zeros);
        let len = if rest.len > 0 { (rest.len + 1).saturating_sub(by.odd.len) } else { 0 };
        if len == 0 {
            return Int::ZERO;
        }
        let (used, free) = self.limbs.split_at_mut(rest.start);
        let (divisor, rest_limbs) = (&used[by.odd.start..by.odd.start + by.odd.len], &mut free[..len]);
        for i in 0..len {
            let digit = rest_limbs[i].wrapping_mul(by.inverse);
            let mut carry = 0u64;
            for (j, r) in rest_limbs[i..].iter_mut().enumerate() {
                if j >= divisor.len() && carry == 0 {
                    break;
                }
                let t =
                    u128::from(digit) * u128::from(divisor.get(j).copied().unwrap_or(0)) + u128::from(carry);
                let (d, borrow) = r.overflowing_sub(t as u64);
                *r = d;
                carry = (t >> 64) as u64 + u64::from(borrow);
            }
            rest_limbs[i] = digit;
        }
        self.top = rest.start;
        self.push(rest.negative != by.odd.negative, len)
    }

    /// `a / 2^bits`, rounded towards zero, in limbs of its own.
    fn shifted_right(&mut self, a: Int, bits: usize) -> Int {
        let (whole, part) = (bits / 64, bits % 64);
        let Some(len) = a.len.checked_sub(whole) else { return Int::ZERO };
        let from = a.start + whole;
        for i in 0..len {
            let above = if i + 1 < len { self.limbs[from + i + 1] } else { 0 };
            let both = u128::from(above) << 64 | u128::from(self.limbs[from + i]);
            self.limbs[self.top + i] = (both >> part) as u64;
        }
        self.push(a.negative, len)
    }

    /// The leading bits, in units of 1.
    pub(crate) fn scaled(&self, a: Int) -> Scaled {
        match *self.magnitude(a) {
            [] => Scaled::ZERO,
            [only] => Scaled::of_words(a.negative, only, 0, -64),
            [.., below, top] => Scaled::of_words(a.negative, top, below, 64 * (a.len as i32 - 2)),
        }
    }

    fn magnitude(&self, a: Int) -> &[u64] {
        &self.limbs[a.start..a.start + a.len]
    }

    fn add_magnitudes(&mut self, a: Int, b: Int) -> Int {
        let (long, short) = if a.len < b.len { (b, a) } else { (a, b) };
        if short.len == 0 {
            return long;
        }
        let (used, free) = self.limbs.split_at_mut(self.top);
        let (x, y) = (&used[long.start..long.start + long.len], &used[short.start..short.start + short.len]);
        let mut carry = false;
        for (i, &xi) in x.iter().enumerate() {
            let (s, c1) = xi.overflowing_add(y.get(i).copied().unwrap_or(0));
            let (s, c2) = s.overflowing_add(u64::from(carry));
            free[i] = s;
            carry = c1 | c2;
        }
        free[x.len()] = u64::from(carry);
        self.push(long.negative, long.len + 1)
    }

    /// `|a| - |b|` with the sign of `a`, for `|a| > |b|`.
    fn subtract_magnitudes(&mut self, a: Int, b: Int) -> Int {
        let (used, free) = self.limbs.split_at_mut(self.top);
        let (x, y) = (&used[a.start..a.start + a.len], &used[b.start..b.start + b.len]);
        let mut borrow = false;
        for (i, &xi) in x.iter().enumerate() {
            let (d, b1) = xi.overflowing_sub(y.get(i).copied().unwrap_or(0));
            let (d, b2) = d.overflowing_sub(u64::from(borrow));
            free[i] = d;
            borrow = b1 | b2;
        }
        self.push(a.negative, a.len)
    }

    /// Takes the `len` limbs above the top as a number, less its leading zeros.
    fn push(&mut self, negative: bool, len: usize) -> Int {
        let start = self.top;
        let written = &self.limbs[start..start + len];
        let len = written.iter().rposition(|&limb| limb != 0).map_or(0, |i| i + 1);
        self.top += len;
        #[cfg(test)]
        {
            self.high_water = self.high_water.max(self.top + 2);
        }
        if len == 0 { Int::ZERO } else { Int { negative, start, len } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_undo_products() {
        let mut limbs = [0; 4000];
        let mut arena = Arena::new(&mut limbs);
        let values = [1.0, -3.0, 6.0, 1e17, -1e40, 2f64.powi(200), 1e300 - 1e284, 2f64.powi(64) - 2048.0];
        for x in values {
            for y in values {
                for z in values {
                    let mark = arena.mark();
                    let [a, b, c] = [x, y, z].map(|v| arena.load(v, 0));
                    // Not a single mantissa: a (b + 1), divided by either factor.
                    let one = arena.load(1.0, 0);
                    let more = arena.add(b, one);
                    let more = arena.mul(more, c);
                    let product = arena.mul(a, more);
                    for (by, expected) in [(a, more), (more, a)] {
                        let by = arena.divisor(by);
                        let quotient = arena.quotient(product, &by);
                        let difference = arena.sub(quotient, expected);
                        assert_eq!(difference.sign(), Sign::Zero, "{x} {y} {z}");
                        assert_eq!(arena.quotient(Int::ZERO, &by), Int::ZERO);
                    }
                    arena.keep(mark, []);
                }
            }
        }
    }

    #[test]
    fn leading_bits() {
        let mut limbs = [0; 400];
        let mut arena = Arena::new(&mut limbs);
        for x in [0.0, 5.0, -1e19, 1e20, -2f64.powi(700), 1e200] {
            let a = arena.load(x, 0);
            assert_eq!(arena.scaled(a).to_f64(), x);
        }
    }

    extern crate std;
}
