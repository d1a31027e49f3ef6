//! Roots of rational quadratics, and signs at them without rounding.

use rug::Rational;
use std::cmp::Ordering;

/// The number `p + q sqrt(d)` for some `d >= 0` of its context.
#[derive(Clone, Debug)]
pub(super) struct Surd {
    p: Rational,
    q: Rational,
}

/// The field in which [`Surd`]s are numbers.
pub(super) struct Field {
    d: Rational,
}

/// A polynomial, coefficient of `s^i` at `i`.
pub(super) type Quadratic = [Rational; 3];

/// A root in [0, 1], its field, and its multiplicity.
pub(super) struct Root {
    pub(super) field: Field,
    pub(super) s: Surd,
    pub(super) multiplicity: u32,
}

impl Surd {
    pub(super) fn rational(p: Rational) -> Self {
        Self { p, q: Rational::new() }
    }
}

impl Field {
    pub(super) fn rationals() -> Self {
        Self { d: Rational::new() }
    }

    pub(super) fn add(&self, a: &Surd, b: &Surd) -> Surd {
        Surd { p: Rational::from(&a.p + &b.p), q: Rational::from(&a.q + &b.q) }
    }

    pub(super) fn subtract(&self, a: &Surd, b: &Surd) -> Surd {
        Surd { p: Rational::from(&a.p - &b.p), q: Rational::from(&a.q - &b.q) }
    }

    pub(super) fn multiply(&self, a: &Surd, b: &Surd) -> Surd {
        Surd {
            p: Rational::from(&a.p * &b.p) + Rational::from(&a.q * &b.q) * &self.d,
            q: Rational::from(&a.p * &b.q) + Rational::from(&a.q * &b.p),
        }
    }

    pub(super) fn sign(&self, a: &Surd) -> Ordering {
        let irrational = if self.d.cmp0().is_eq() { Ordering::Equal } else { a.q.cmp0() };
        match (a.p.cmp0(), irrational) {
            (sign, Ordering::Equal) | (Ordering::Equal, sign) => sign,
            (p, q) if p == q => p,
            (p, q) => match a.p.clone().square().cmp(&(a.q.clone().square() * &self.d)) {
                Ordering::Greater => p,
                Ordering::Less => q,
                Ordering::Equal => Ordering::Equal,
            },
        }
    }

    /// `a + b s` at a root.
    pub(super) fn linear(&self, [a, b]: [&Rational; 2], s: &Surd) -> Surd {
        self.add(&Surd::rational(a.clone()), &self.multiply(&Surd::rational(b.clone()), s))
    }

    fn in_unit_interval(&self, s: &Surd) -> bool {
        let one = Surd::rational(Rational::from(1));
        self.sign(s).is_ge() && self.sign(&self.subtract(&one, s)).is_ge()
    }
}

/// The roots in [0, 1] of a polynomial; none for zero.
pub(super) fn roots([c, b, a]: &Quadratic) -> Vec<Root> {
    let rational = |p: Rational, multiplicity| (Field::rationals(), Surd::rational(p), multiplicity);
    let all = if a.cmp0().is_ne() {
        let discriminant = b.clone().square() - Rational::from(a * c) * 4u32;
        let twice = Rational::from(a * 2u32);
        let middle = -Rational::from(b / &twice);
        match discriminant.cmp0() {
            Ordering::Less => vec![],
            Ordering::Equal => vec![rational(middle, 2)],
            Ordering::Greater => [twice.clone(), -twice]
                .map(|twice| {
                    let s = Surd { p: middle.clone(), q: twice.recip() };
                    (Field { d: discriminant.clone() }, s, 1)
                })
                .into(),
        }
    } else if b.cmp0().is_ne() {
        vec![rational(-Rational::from(c / b), 1)]
    } else {
        vec![]
    };
    let all = all.into_iter().filter(|(field, s, _)| field.in_unit_interval(s));
    all.map(|(field, s, multiplicity)| Root { field, s, multiplicity }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_surds() {
        // 2 s^2 - 1: 1/sqrt 2 lies between 0.7 and 0.8.
        let [root] = &roots(&[-1, 0, 2].map(Rational::from))[..] else { panic!("one root in [0, 1]") };
        let compare =
            |n: i32| root.field.sign(&root.field.linear([&Rational::from((-n, 10)), &1.into()], &root.s));
        assert_eq!((compare(7), compare(8)), (Ordering::Greater, Ordering::Less));
        let square = root.field.multiply(&root.s, &root.s);
        let half = Surd::rational(Rational::from((1, 2)));
        assert_eq!(root.field.sign(&root.field.subtract(&square, &half)), Ordering::Equal);
        assert_eq!(roots(&[1, -4, 4].map(Rational::from))[0].multiplicity, 2);
        assert!(
            roots(&[2, -3, 0].map(Rational::from)).len() == 1
                && roots(&[3, -2, 0].map(Rational::from)).is_empty()
        );
    }
}
