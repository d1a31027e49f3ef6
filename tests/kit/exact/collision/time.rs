//! Times of the closed interval [0, 1] as exact numbers: rational ones, and roots of polynomials ([`Time`]).

use super::polynomial::Polynomial;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// A real number of [0, 1].
#[derive(Clone, Debug)]
pub(super) enum Time {
    Rational(Rational),
    /// The only root of a square-free polynomial strictly between `cell / 2^bits` and `(cell + 1) / 2^bits`; it does not
    /// vanish at these.
    Root {
        of: Polynomial,
        cell: Integer,
        bits: u32,
    },
}

impl Time {
    pub(super) fn integer(value: i32) -> Self {
        Self::Rational(Rational::from(value))
    }

    /// Rational bounds: equal to the number, or strictly below and above it.
    pub(super) fn bounds(&self) -> (Rational, Rational) {
        match self {
            Self::Rational(value) => (value.clone(), value.clone()),
            Self::Root { cell, bits, .. } => {
                (dyadic(cell.clone(), *bits), dyadic(Integer::from(cell + 1), *bits))
            }
        }
    }

    /// Halves the distance of the bounds.
    pub(super) fn refine(&mut self) {
        let Self::Root { of, cell, bits } = self else { return };
        *cell <<= 1;
        *bits += 1;
        let middle = dyadic(Integer::from(&*cell + 1), *bits);
        let low = of.sign_at(&dyadic(cell.clone(), *bits));
        match of.sign_at(&middle) {
            Ordering::Equal => *self = Self::Rational(middle),
            // The root is simple, so signs differ on its two sides.
            sign if sign == low => *cell += 1,
            _ => {}
        }
    }

    /// The sign of a polynomial at this number.
    pub(super) fn sign(&mut self, p: &Polynomial) -> Ordering {
        if let Self::Root { of, cell, bits } = self {
            if let (0, sign) = p.variations(cell, *bits) {
                return sign;
            }
            // A common factor divides `of`, so it has at most this one root inside, a simple one, and none at the ends.
            let common = Polynomial::gcd(of, p);
            let at = |cell: Integer| common.sign_at(&dyadic(cell, *bits));
            if at(cell.clone()) != at(Integer::from(&*cell + 1)) {
                return Ordering::Equal;
            }
        }
        // Not a root of `p`, or rational.
        loop {
            match self {
                Self::Rational(value) => return p.sign_at(value),
                Self::Root { cell, bits, .. } => {
                    if let (0, sign) = p.variations(cell, *bits) {
                        return sign;
                    }
                }
            }
            self.refine();
        }
    }

    /// How often a polynomial that is not zero has this number as a root.
    pub(super) fn multiplicity(&mut self, p: &Polynomial) -> u32 {
        let (mut derivative, mut count) = (p.clone(), 0);
        while self.sign(&derivative).is_eq() {
            derivative = derivative.derivative();
            count += 1;
        }
        count
    }

    fn equals(&mut self, other: &Self) -> bool {
        match other {
            Self::Rational(value) => self.sign(&Polynomial::vanishing_at(value)).is_eq(),
            Self::Root { of, .. } => {
                let (low, high) = other.bounds();
                self.sign(of).is_eq()
                    && self.sign(&Polynomial::vanishing_at(&low)).is_gt()
                    && self.sign(&Polynomial::vanishing_at(&high)).is_lt()
            }
        }
    }

    /// The order of two numbers.
    pub(super) fn order(&mut self, other: &mut Self) -> Ordering {
        if let (Self::Rational(a), Self::Rational(b)) = (&*self, &*other) {
            return a.cmp(b);
        }
        if self.equals(other) {
            return Ordering::Equal;
        }
        loop {
            let (a, b) = (self.bounds(), other.bounds());
            if a.1 <= b.0 {
                return Ordering::Less;
            }
            if b.1 <= a.0 {
                return Ordering::Greater;
            }
            self.refine();
            other.refine();
        }
    }

    /// A rational number strictly between this one and a greater one.
    pub(super) fn before(&mut self, greater: &mut Self) -> Rational {
        loop {
            let (above, below) = (self.bounds().1, greater.bounds().0);
            if above < below {
                return (above + below) / 2u32;
            }
            self.refine();
            greater.refine();
        }
    }
}

fn dyadic(numerator: Integer, bits: u32) -> Rational {
    Rational::from(numerator) >> bits
}

/// The roots in [0, 1] of a polynomial that is not zero, each once, in no order.
///
/// Bisection with Descartes' rule on the square-free part; a root at an end or a middle is divided out.
pub(super) fn roots(p: &Polynomial) -> Vec<Time> {
    let mut rest = p.square_free();
    let mut found = Vec::new();
    let take = |rest: Polynomial, at: Rational, found: &mut Vec<Time>| {
        if rest.sign_at(&at).is_ne() {
            return rest;
        }
        let quotient = rest.without(&Polynomial::vanishing_at(&at));
        found.push(Time::Rational(at));
        quotient
    };
    rest = take(rest, Rational::new(), &mut found);
    rest = take(rest, Rational::from(1), &mut found);
    let mut cells = vec![(rest, Integer::new(), 0)];
    while let Some((of, cell, bits)) = cells.pop() {
        match of.variations(&cell, bits).0 {
            0 => {}
            1 => found.push(match of.coefficients() {
                [constant, slope] => Time::Rational(-Rational::from((constant.clone(), slope.clone()))),
                _ => Time::Root { of, cell, bits },
            }),
            _ => {
                let left = cell << 1;
                let right = Integer::from(&left + 1);
                let of = take(of, dyadic(right.clone(), bits + 1), &mut found);
                cells.push((of.clone(), left, bits + 1));
                cells.push((of, right, bits + 1));
            }
        }
    }
    found
}

/// Numbers in ascending order, each once.
pub(super) fn sorted(times: Vec<Time>) -> Vec<Time> {
    let mut all: Vec<Time> = Vec::new();
    'next: for mut time in times {
        // All before `low` are less, all from `high` on are greater.
        let (mut low, mut high) = (0, all.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            match all[middle].order(&mut time) {
                Ordering::Less => low = middle + 1,
                Ordering::Equal => continue 'next,
                Ordering::Greater => high = middle,
            }
        }
        all.insert(low, time);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly(coefficients: &[i32]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    fn near(time: &mut Time) -> f64 {
        for _ in 0..60 {
            time.refine();
        }
        time.bounds().0.to_f64()
    }

    #[test]
    fn roots_of_known_polynomials() {
        let find = |p: &[i32]| sorted(roots(&poly(p))).iter_mut().map(near).collect::<Vec<f64>>();
        // t (t - 1)(2 t - 1), a double root, one outside, none at all.
        assert_eq!(find(&[0, 1, -3, 2]), [0.0, 0.5, 1.0]);
        assert_eq!(find(&[1, -4, 4]), [0.5]);
        assert_eq!(find(&[-2, 1]), [] as [f64; 0]);
        assert_eq!(find(&[1, 0, 1]), [] as [f64; 0]);
        assert_eq!(find(&[3]), [] as [f64; 0]);
        // 8 t^2 - 8 t + 1: (2 - sqrt 2) / 4 and (2 + sqrt 2) / 4.
        let roots = find(&[1, -8, 8]);
        assert!(
            (roots[0] - (0.5 - 0.125f64.sqrt())).abs() < 1e-15
                && (roots[1] - (0.5 + 0.125f64.sqrt())).abs() < 1e-15
        );
        // Roots 2^-30 apart: (2^30 t - 2^29)(2^30 t - 2^29 - 1), with coefficients beyond i32 in between.
        let (a, b) = (poly(&[-(1 << 29), 1 << 30]), poly(&[-(1 << 29) - 1, 1 << 30]));
        let mut product = Polynomial::new(Vec::new());
        product.add_product(false, &a, &b);
        let close: Vec<f64> = sorted(super::roots(&product)).iter_mut().map(near).collect();
        assert!(close.len() == 2 && (close[1] - close[0] - 2f64.powi(-30)).abs() < 1e-15);
    }

    #[test]
    fn signs_at_irrational_numbers() {
        // The root 1/sqrt 2 of 2 t^2 - 1.
        let mut root = roots(&poly(&[-1, 0, 2])).pop().expect("a root");
        assert!(root.sign(&poly(&[1, 0, -2])).is_eq());
        assert!(root.sign(&poly(&[0, -1, 0, 2])).is_eq());
        // 99/140 is above it by 3.6e-5, 239/338 below it by 6.2e-6.
        assert!(root.sign(&poly(&[-99, 140])).is_lt());
        assert!(root.sign(&poly(&[-239, 338])).is_gt());
        assert_eq!((root.multiplicity(&poly(&[1, 0, -4, 0, 4])), root.multiplicity(&poly(&[3, 1]))), (2, 0));
    }

    #[test]
    fn equal_numbers_of_different_polynomials() {
        // 1/sqrt 2 as a root of 2 t^2 - 1 and of (2 t^2 - 1)(t + 1), 1/2 as a root of 2 t - 1 and of (2 t - 1)(t + 3).
        let polynomials: [&[i32]; 4] = [&[-1, 0, 2], &[-1, -1, 2, 2], &[-1, 2], &[-3, 5, 2]];
        let mut times = sorted(polynomials.iter().flat_map(|p| roots(&poly(p))).collect());
        assert_eq!(times.len(), 2);
        let (left, right) = times.split_at_mut(1);
        let between = left[0].before(&mut right[0]);
        assert!(between > 0.5 && Rational::from(between.square_ref()) < 0.5);
    }
}
