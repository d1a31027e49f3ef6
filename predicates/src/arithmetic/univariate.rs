//! Polynomials of one variable with integer coefficients, and signs at their roots: [`roots_in_unit_interval`].
//!
//! What it computes: for a polynomial `p` of degree at most 3, how many distinct roots lie in the open interval (0, 1),
//! and at each of them the signs of other polynomials of degree at most 2.
//!
//! Method: Tarski queries \[Basu06\]. Let `T(p, q)` be the sum over the distinct roots of `p` in (0, 1) of the sign of `q`;
//! it is the Cauchy index of `p' q / p`, and Sturm's theorem gives it from the sign variations, at 0 and at 1,
//! of the signed remainder sequence of `p` and `p' q mod p`. No root is ever approximated, so close roots cost as
//! much as distant ones. The signs at each single root follow from a few queries:
//!
//! ```text
//! roots             signs of p', p''         solved from
//! one                                        T(p, q)
//! two simple        s, -s                    T(p, q), T(p, q p')               s = -sign p(0)
//! double + simple   0,  M                    T(p, q), T(p, q p')               M = T(p, p')
//! three             s, -s, s; -s, c, s       T(p, q), T(p, q p'), T(p, q p'')  c = T(p, p'')
//! ```
//!
//! Promises: exact, and the number of operations is bounded by a constant. Remainders are pseudo-remainders with a
//! positive factor, so that signs are kept without a division.

use super::arena::{Arena, Int, Mark};
use crate::Sign;

/// Coefficients of the largest product formed: degree 2 times degree 2.
const MOST: usize = 5;

/// A polynomial, coefficient of `t^i` at `i`; no leading zeros.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    coefficients: [Int; MOST],
    len: usize,
}

impl Polynomial {
    pub(crate) const ZERO: Self = Self { coefficients: [Int::ZERO; MOST], len: 0 };

    pub(crate) fn new(coefficients: &[Int]) -> Self {
        let mut result = Self::ZERO;
        result.coefficients[..coefficients.len()].copy_from_slice(coefficients);
        result.len = coefficients.len();
        result.trim();
        result
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.len == 0
    }

    fn lead(&self) -> Int {
        self.coefficients[self.len - 1]
    }

    fn trim(&mut self) {
        while self.len > 0 && self.coefficients[self.len - 1].sign().is_zero() {
            self.len -= 1;
        }
    }

    /// Frees what has been formed since the mark, but for this.
    pub(crate) fn keep(&mut self, mark: Mark, arena: &mut Arena<'_>) {
        arena.keep(mark, self.values_mut());
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut Int> {
        self.coefficients[..self.len].iter_mut()
    }

    /// The sign at `t = 0`.
    pub(crate) fn sign_at_0(&self) -> Sign {
        self.coefficients[0].sign()
    }

    /// The sign at `t = 1`.
    pub(crate) fn sign_at_1(&self, arena: &mut Arena<'_>) -> Sign {
        let mark = arena.mark();
        let mut sum = Int::ZERO;
        for &c in &self.coefficients[..self.len] {
            sum = arena.add(sum, c);
        }
        arena.keep(mark, []);
        sum.sign()
    }

    /// The sign just after `t = 0`.
    pub(crate) fn sign_after_0(&self, _: &mut Arena<'_>) -> Sign {
        let signs = self.coefficients[..self.len].iter().map(|c| c.sign());
        signs.into_iter().find(|s| !s.is_zero()).unwrap_or(Sign::Zero)
    }

    /// The sign just before `t = 1`.
    pub(crate) fn sign_before_1(&self, arena: &mut Arena<'_>) -> Sign {
        let mark = arena.mark();
        let mut derivative = *self;
        let mut sign = derivative.sign_at_1(arena);
        let mut order = Sign::Positive;
        while sign.is_zero() && !derivative.is_zero() {
            derivative = derivative.derivative(arena);
            order = -order;
            sign = derivative.sign_at_1(arena) * order;
        }
        arena.keep(mark, []);
        sign
    }

    /// The strict sign that the Bernstein coefficients on [0, 1] agree on: that of the polynomial throughout. `Zero`
    /// for the zero polynomial, `None` when they differ or some are zero.
    pub(crate) fn steady_sign(&self, arena: &mut Arena<'_>) -> Option<Sign> {
        /// Coefficients of `t^i` in the multiples of the inner Bernstein coefficients, by degree.
        const INNER: [&[[u64; 3]]; 4] = [&[], &[], &[[2, 1, 0]], &[[3, 1, 0], [3, 2, 1]]];
        if self.len <= 1 {
            return Some(self.sign_at_0());
        }
        let sign = self.sign_at_0();
        if sign.is_zero() || self.sign_at_1(arena) != sign {
            return None;
        }
        let mark = arena.mark();
        let mut steady = true;
        for weights in INNER[self.len - 1] {
            let mut sum = Int::ZERO;
            for (i, &weight) in weights.iter().enumerate().filter(|&(_, &weight)| weight > 0) {
                let term = arena.mul_small(self.coefficients[i], weight);
                sum = arena.add(sum, term);
            }
            steady &= sum.sign() == sign;
        }
        arena.keep(mark, []);
        steady.then_some(sign)
    }

    pub(crate) fn add(&self, other: &Self, arena: &mut Arena<'_>) -> Self {
        let mut result = Self { len: self.len.max(other.len), ..Self::ZERO };
        for i in 0..result.len {
            result.coefficients[i] = arena.add(self.coefficients[i], other.coefficients[i]);
        }
        result.trim();
        result
    }

    pub(crate) fn negated(&self) -> Self {
        Self { coefficients: self.coefficients.map(Int::negated), len: self.len }
    }

    pub(crate) fn mul(&self, other: &Self, arena: &mut Arena<'_>) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let mut result = Self { len: self.len + other.len - 1, ..Self::ZERO };
        let mark = arena.mark();
        for k in 0..result.len {
            let inner = arena.mark();
            let mut sum = Int::ZERO;
            for i in 0..self.len.min(k + 1) {
                if k - i < other.len {
                    let term = arena.mul(self.coefficients[i], other.coefficients[k - i]);
                    sum = arena.add(sum, term);
                }
            }
            arena.keep(inner, [&mut sum]);
            result.coefficients[k] = sum;
        }
        arena.keep(mark, result.values_mut());
        result.trim();
        result
    }

    pub(crate) fn derivative(&self, arena: &mut Arena<'_>) -> Self {
        let mut result = Self { len: self.len.saturating_sub(1), ..Self::ZERO };
        for i in 0..result.len {
            result.coefficients[i] = arena.mul_small(self.coefficients[i + 1], i as u64 + 1);
        }
        result
    }

    /// A positive multiple of the remainder of `self` by `divisor`, which is not zero.
    fn remainder(mut self, divisor: &Self, arena: &mut Arena<'_>) -> Self {
        let scale = divisor.lead().abs();
        let negative = divisor.lead().sign() == Sign::Negative;
        while self.len >= divisor.len {
            let mark = arena.mark();
            let offset = self.len - divisor.len;
            let factor = if negative { self.lead().negated() } else { self.lead() };
            for i in 0..self.len - 1 {
                let inner = arena.mark();
                let mut c = arena.mul(self.coefficients[i], scale);
                if i >= offset {
                    let term = arena.mul(divisor.coefficients[i - offset], factor);
                    c = arena.sub(c, term);
                }
                arena.keep(inner, [&mut c]);
                self.coefficients[i] = c;
            }
            self.len -= 1;
            self.coefficients[self.len] = Int::ZERO;
            arena.keep(mark, self.values_mut());
            self.trim();
        }
        self
    }

    /// Divides by `t` as often as that is possible without remainder, then by `t - 1`: no root at 0 or 1 is left.
    fn without_roots_at_ends(mut self, arena: &mut Arena<'_>) -> Self {
        while self.len > 0 && self.sign_at_0().is_zero() {
            self.coefficients.rotate_left(1);
            self.len -= 1;
        }
        while self.len > 0 && self.sign_at_1(arena).is_zero() {
            // Synthetic division; the last remainder is the value at 1, zero.
            let mut quotient = Self { len: self.len - 1, ..Self::ZERO };
            let mut carry = Int::ZERO;
            for i in (0..quotient.len).rev() {
                carry = arena.add(carry, self.coefficients[i + 1]);
                quotient.coefficients[i] = carry;
            }
            self = quotient;
        }
        self
    }
}

/// The distinct roots of a polynomial in the open interval (0, 1), and what is needed to ask for signs at them.
pub(crate) struct Roots {
    p: Polynomial,
    derivative: Polynomial,
    second: Polynomial,
    count: usize,
    /// Two roots: `M = T(p, p')`. Three: `c` times the sign of the leading coefficient, `T(p, p'')`.
    marker: i32,
}

/// The most roots that are asked for.
pub(crate) const MOST_ROOTS: usize = 3;

/// The roots in (0, 1) of a polynomial of degree at most 3 that is not zero.
pub(crate) fn roots_in_unit_interval(p: &Polynomial, arena: &mut Arena<'_>) -> Roots {
    let p = p.without_roots_at_ends(arena);
    if p.steady_sign(arena).is_some() {
        return Roots { p, derivative: Polynomial::ZERO, second: Polynomial::ZERO, count: 0, marker: 0 };
    }
    let derivative = p.derivative(arena);
    let second = derivative.derivative(arena);
    let mut roots = Roots { p, derivative, second, count: 0, marker: 0 };
    let mark = arena.mark();
    roots.count = index(&p, derivative, arena) as usize;
    if roots.count == 2 {
        let square = derivative.mul(&derivative, arena);
        roots.marker = index(&p, square.remainder(&p, arena), arena);
    } else if roots.count == 3 {
        let product = derivative.mul(&second, arena);
        roots.marker = index(&p, product.remainder(&p, arena), arena);
    }
    arena.keep(mark, []);
    roots
}

/// The sign of `q`, of degree at most 2, at the root of `p`, of degree at most 3: the only one in (0, 1), where `p` changes its
/// sign. `p` is not zero at 0 and 1.
///
/// The Cauchy index of `q / p` is the sign of `q` there if `p` increases, its opposite if `p` decreases.
pub(crate) fn sign_at_root(p: &Polynomial, q: &Polynomial, arena: &mut Arena<'_>) -> Sign {
    let mark = arena.mark();
    let remainder = q.remainder(p, arena);
    let index = index(p, remainder, arena);
    arena.keep(mark, []);
    let sign = match index {
        0 => return Sign::Zero,
        1.. => Sign::Positive,
        _ => Sign::Negative,
    };
    -p.sign_at_0() * sign
}

impl Roots {
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The signs of `q`, of degree at most 2, at each of the roots, in an order that is the same for every `q`.
    pub(crate) fn signs(&self, q: &Polynomial, arena: &mut Arena<'_>) -> [Sign; MOST_ROOTS] {
        if let Some(sign) = q.steady_sign(arena) {
            return [sign; MOST_ROOTS];
        }
        if self.count == 0 {
            return [Sign::Zero; MOST_ROOTS];
        }
        let mark = arena.mark();
        let h = self.derivative.mul(q, arena).remainder(&self.p, arena);
        let a = index(&self.p, h, arena);
        let mut signs = [a, 0, 0];
        if self.count > 1 {
            let with_derivative = h.mul(&self.derivative, arena).remainder(&self.p, arena);
            let b = index(&self.p, with_derivative, arena);
            if self.count == 3 {
                let with_second = h.mul(&self.second, arena).remainder(&self.p, arena);
                let c = index(&self.p, with_second, arena);
                let lead = if self.p.lead().sign() == Sign::Negative { -1 } else { 1 };
                // p' has the signs lead, -lead, lead; p'' the signs -lead, marker, lead.
                let middle = (a - lead * b) / 2;
                let sum = (a + lead * b) / 2;
                let difference = lead * (c - self.marker * middle);
                signs = [(sum - difference) / 2, middle, (sum + difference) / 2];
            } else if self.marker == 0 {
                let s = if self.p.sign_at_0() == Sign::Positive { -1 } else { 1 };
                signs = [(a + s * b) / 2, (a - s * b) / 2, 0];
            } else {
                signs = [a - self.marker * b, self.marker * b, 0];
            }
        }
        arena.keep(mark, []);
        signs.map(|s| match s {
            1 => Sign::Positive,
            -1 => Sign::Negative,
            _ => Sign::Zero,
        })
    }
}

/// The Cauchy index of `h / p` on (0, 1): the variations of sign in the signed remainder sequence, at 0 less at 1.
/// `p` has no root at 0 or 1, and `h` is of smaller degree than `p`.
fn index(p: &Polynomial, h: Polynomial, arena: &mut Arena<'_>) -> i32 {
    let mark = arena.mark();
    let (mut a, mut b) = (*p, h);
    let mut last = [p.sign_at_0(), p.sign_at_1(arena)];
    let mut variations = [0, 0];
    while !b.is_zero() {
        let signs = [b.sign_at_0(), b.sign_at_1(arena)];
        for end in 0..2 {
            if signs[end] == -last[end] {
                variations[end] += 1;
            }
            if !signs[end].is_zero() {
                last[end] = signs[end];
            }
        }
        let next = a.remainder(&b, arena).negated();
        (a, b) = (b, next);
    }
    arena.keep(mark, []);
    variations[0] - variations[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use Sign::{Negative as N, Positive as P, Zero as Z};

    fn polynomial(coefficients: &[f64], arena: &mut Arena<'_>) -> Polynomial {
        let mut ints = [Int::ZERO; MOST];
        for (i, &c) in coefficients.iter().enumerate() {
            ints[i] = arena.load(c, 0);
        }
        Polynomial::new(&ints[..coefficients.len()])
    }

    /// Count of roots, and the signs of `q` at them, sorted.
    fn ask(p: &[f64], q: &[f64]) -> (usize, [Sign; 3]) {
        let mut limbs = [0; 4096];
        let mut arena = Arena::new(&mut limbs);
        let (p, q) = (polynomial(p, &mut arena), polynomial(q, &mut arena));
        let roots = roots_in_unit_interval(&p, &mut arena);
        let mut signs = roots.signs(&q, &mut arena);
        signs[..roots.count()].sort();
        signs[roots.count()..].fill(Z);
        (roots.count(), signs)
    }

    #[test]
    fn signs_at_roots_of_every_kind() {
        // 8t - 4, root 1/2.
        assert_eq!(ask(&[-4.0, 8.0], &[-1.0, 3.0]), (1, [P, Z, Z]));
        assert_eq!(ask(&[-4.0, 8.0], &[-1.0, 2.0]), (1, [Z, Z, Z]));
        // (4t - 1)(4t - 3): roots 1/4 and 3/4.
        assert_eq!(ask(&[3.0, -16.0, 16.0], &[-1.0, 2.0]), (2, [N, P, Z]));
        assert_eq!(ask(&[3.0, -16.0, 16.0], &[-1.0, 4.0]), (2, [Z, P, Z]));
        assert_eq!(ask(&[3.0, -16.0, 16.0], &[-3.0, 16.0, -16.0]), (2, [Z, Z, Z]));
        // (2t - 1)^2.
        assert_eq!(ask(&[1.0, -4.0, 4.0], &[-1.0, 3.0]), (1, [P, Z, Z]));
        // (2t - 1)^2 (4t - 1) and (2t - 1)^2 (4t - 3).
        assert_eq!(ask(&[-1.0, 8.0, -20.0, 16.0], &[-1.0, 3.0]), (2, [N, P, Z]));
        assert_eq!(ask(&[-3.0, 16.0, -28.0, 16.0], &[-1.0, 2.0]), (2, [Z, P, Z]));
        // (4t - 1)(4t - 2)(4t - 3) and its negation, with q = (4t - 2)^2 - 1/2, 2 - 4t, t.
        let cubic = [-6.0, 44.0, -96.0, 64.0];
        for sign in [1.0, -1.0] {
            let p = cubic.map(|c| sign * c);
            assert_eq!(ask(&p, &[7.0, -32.0, 32.0]), (3, [N, P, P]));
            assert_eq!(ask(&p, &[2.0, -4.0]), (3, [N, Z, P]));
            assert_eq!(ask(&p, &[0.0, 1.0]), (3, [P, P, P]));
            assert_eq!(ask(&p, &[-3.0, 8.0]), (3, [N, P, P]));
        }
        // Roots at the ends do not count: t (t - 1) (2t - 1), t^2 (t - 1), t^2 + 1.
        assert_eq!(ask(&[0.0, 1.0, -3.0, 2.0], &[-1.0, 3.0]), (1, [P, Z, Z]));
        assert_eq!(ask(&[0.0, 0.0, -1.0, 1.0], &[1.0]), (0, [Z, Z, Z]));
        assert_eq!(ask(&[1.0, 0.0, 1.0], &[1.0]), (0, [Z, Z, Z]));
        // 8t^3 - 1 and a q that vanishes there; irrational: 2t^2 - 1 and 4t^2 - 2, 3t - 2, 10t - 7.
        assert_eq!(ask(&[-1.0, 0.0, 0.0, 8.0], &[-1.0, 0.0, 4.0]), (1, [Z, Z, Z]));
        assert_eq!(ask(&[-1.0, 0.0, 2.0], &[-2.0, 0.0, 4.0]), (1, [Z, Z, Z]));
        assert_eq!(ask(&[-1.0, 0.0, 2.0], &[-2.0, 3.0]), (1, [P, Z, Z]));
        assert_eq!(ask(&[-1.0, 0.0, 2.0], &[-71.0, 100.0]), (1, [N, Z, Z]));
    }
}
