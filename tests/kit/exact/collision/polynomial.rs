//! Polynomials of one unknown with unbounded integer coefficients: [`Polynomial`].

use rug::ops::NegAssign;
use rug::{Complete, Integer, Rational};
use std::cmp::Ordering;

/// A polynomial by its coefficients, that of degree 0 first, the last one not zero; the zero polynomial has none.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Polynomial(Vec<Integer>);

impl Polynomial {
    pub(super) fn new(mut coefficients: Vec<Integer>) -> Self {
        while coefficients.last().is_some_and(Integer::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    pub(super) fn constant(value: i32) -> Self {
        Self::new(vec![Integer::from(value)])
    }

    /// `denominator * t - numerator`, which vanishes at `at` and grows.
    pub(super) fn vanishing_at(at: &Rational) -> Self {
        Self(vec![Integer::from(-at.numer()), at.denom().clone()])
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn coefficients(&self) -> &[Integer] {
        &self.0
    }

    /// The degree; nothing for the zero polynomial.
    pub(super) fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    /// Adds `factor * a * b`, where the factor is 1 or -1.
    pub(super) fn add_product(&mut self, negated: bool, a: &Self, b: &Self) {
        if a.is_zero() || b.is_zero() {
            return;
        }
        let length = a.0.len() + b.0.len() - 1;
        let mut sum = std::mem::take(&mut self.0);
        sum.resize(sum.len().max(length), Integer::new());
        for (i, x) in a.0.iter().enumerate() {
            for (j, y) in b.0.iter().enumerate() {
                if negated {
                    sum[i + j] -= x * y;
                } else {
                    sum[i + j] += x * y;
                }
            }
        }
        *self = Self::new(sum);
    }

    fn product(a: &Self, b: &Self) -> Self {
        let mut product = Self(Vec::new());
        product.add_product(false, a, b);
        product
    }

    pub(super) fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self::new(
            terms.map(|(power, c)| (c * u32::try_from(power).expect("a low degree")).complete()).collect(),
        )
    }

    /// The value at `numerator / denominator`, times the denominator to the power of the degree.
    fn scaled_value(&self, numerator: &Integer, denominator: &Integer) -> Integer {
        let mut power = Integer::from(1);
        let mut value = Integer::new();
        for c in self.0.iter().rev() {
            value *= numerator;
            value += (c * &power).complete();
            power *= denominator;
        }
        value
    }

    /// The sign at a rational number.
    pub(super) fn sign_at(&self, at: &Rational) -> Ordering {
        self.scaled_value(at.numer(), at.denom()).cmp0()
    }

    /// The coefficients times binomial coefficients in the Bernstein basis of the interval from `cell / 2^bits` to
    /// `(cell + 1) / 2^bits`, times a positive factor: those of `(1 + x)^degree p((low + high x) / (1 + x))`.
    fn bernstein(&self, cell: &Integer, bits: u32) -> Vec<Integer> {
        let Some(degree) = self.degree() else { return Vec::new() };
        let inside = Self::new(vec![cell.clone(), Integer::from(cell + 1)]);
        let scale = Integer::from(1) << bits;
        let whole = Self::new(vec![scale.clone(), scale]);
        // Horner's rule for sum c_i inside^i whole^(degree - i).
        let (mut sum, mut power) = (Self(Vec::new()), Self::constant(1));
        for c in self.0.iter().rev() {
            sum = Self::product(&sum, &inside);
            sum.add_product(false, &Self::new(vec![c.clone()]), &power);
            power = Self::product(&power, &whole);
        }
        sum.0.resize(degree + 1, Integer::new());
        sum.0
    }

    /// Changes of sign in the Bernstein coefficients of an open interval, and the sign of the first that is not zero.
    ///
    /// By Descartes' rule the number of roots inside, with multiplicities, is the number of changes or less by an even
    /// number. Without a change the polynomial has the returned sign throughout.
    pub(super) fn variations(&self, cell: &Integer, bits: u32) -> (usize, Ordering) {
        let signs: Vec<Ordering> =
            self.bernstein(cell, bits).iter().map(Integer::cmp0).filter(|sign| sign.is_ne()).collect();
        let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        (changes, signs.first().copied().unwrap_or(Ordering::Equal))
    }

    /// The same up to a positive factor, with coprime coefficients.
    pub(super) fn primitive(mut self) -> Self {
        let content = self.0.iter().fold(Integer::new(), |gcd, c| gcd.gcd(c));
        if content > 1 {
            self.0.iter_mut().for_each(|c| c.div_exact_mut(&content));
        }
        self
    }

    /// The same up to a constant factor, with coprime coefficients, the last one positive.
    pub(super) fn normal(self) -> Self {
        let mut primitive = self.primitive();
        if primitive.0.last().is_some_and(Integer::is_negative) {
            primitive.0.iter_mut().for_each(Integer::neg_assign);
        }
        primitive
    }

    /// Quotient and remainder by a polynomial that is not zero, both up to constant factors that are not zero.
    fn divide(&self, divisor: &Self) -> (Self, Self) {
        let (mut rest, low) = (self.clone(), divisor.0.len());
        let mut quotient = vec![Integer::new(); (self.0.len() + 1).saturating_sub(low)];
        let by = divisor.0.last().expect("a divisor is not zero");
        while rest.0.len() >= low {
            let (shift, lead) = (rest.0.len() - low, rest.0[rest.0.len() - 1].clone());
            for c in rest.0.iter_mut().chain(&mut quotient) {
                *c *= by;
            }
            quotient[shift] += &lead;
            for (c, d) in rest.0[shift..].iter_mut().zip(&divisor.0) {
                *c -= &lead * d;
            }
            rest = Self::new(rest.0);
        }
        (Self::new(quotient).primitive(), rest.primitive())
    }

    /// The greatest common divisor, by Euclid's algorithm, up to a constant factor.
    pub(super) fn gcd(a: &Self, b: &Self) -> Self {
        let (mut a, mut b) = (a.clone().primitive(), b.clone().primitive());
        while !b.is_zero() {
            let rest = a.divide(&b).1;
            a = std::mem::replace(&mut b, rest);
        }
        a
    }

    /// The quotient, up to a constant factor, by a polynomial that divides this one.
    pub(super) fn without(&self, factor: &Self) -> Self {
        let (quotient, rest) = self.divide(factor);
        assert!(rest.is_zero(), "{factor:?} does not divide {self:?}");
        quotient
    }

    /// A polynomial with the same roots, each once.
    pub(super) fn square_free(&self) -> Self {
        if self.degree() <= Some(1) {
            return self.clone().primitive();
        }
        self.without(&Self::gcd(self, &self.derivative()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly(coefficients: &[i32]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    fn product(factors: &[&[i32]]) -> Polynomial {
        factors.iter().fold(Polynomial::constant(1), |p, f| Polynomial::product(&p, &poly(f)))
    }

    /// Equal up to a constant factor.
    fn similar(a: &Polynomial, b: &Polynomial) -> bool {
        a.clone().normal() == b.clone().normal()
    }

    #[test]
    fn division_and_common_factors() {
        let (a, b, c): (&[i32], &[i32], &[i32]) = (&[1, -3], &[-2, 0, 7], &[5, 1]);
        assert!(similar(&Polynomial::gcd(&product(&[a, b]), &product(&[b, c])), &poly(b)));
        assert_eq!(Polynomial::gcd(&product(&[a, a]), &product(&[b, c])).degree(), Some(0));
        assert!(similar(&product(&[a, b, c]).without(&poly(b)), &product(&[a, c])));
        assert!(similar(&product(&[a, a, b, b, b]).square_free(), &product(&[a, b])));
        assert!(similar(&Polynomial::gcd(&poly(&[]), &poly(a)), &poly(a)));
        assert_eq!(poly(&[4]).square_free().degree(), Some(0));
        assert_eq!(poly(&[7, 5, 3, 0, 0]).derivative(), poly(&[5, 6]));
    }

    #[test]
    fn signs_and_variations() {
        // (3 t - 1)(2 t - 1)(t - 2)
        let p = product(&[&[-1, 3], &[-1, 2], &[-2, 1]]);
        let sign = |n: i32, d: i32| p.sign_at(&Rational::from((n, d)));
        assert_eq!(
            [sign(0, 1), sign(1, 3), sign(2, 5), sign(1, 1), sign(5, 2)].map(|s| s as i32),
            [-1, 0, 1, -1, 1]
        );
        let variations = |cell: i32, bits| p.variations(&Integer::from(cell), bits).0;
        assert_eq!([variations(0, 0), variations(0, 1), variations(1, 1), variations(3, 1)], [2, 1, 0, 0]);
        // The values at both ends are the outer Bernstein coefficients, exactly.
        assert_eq!(p.bernstein(&Integer::from(1), 1), [0, -6, -28, -16].map(Integer::from).to_vec());
    }
}
