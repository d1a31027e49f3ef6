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
        for (i, &xi) in x.iter().enumerate() {
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
