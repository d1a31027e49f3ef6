//! A number with its error bound and an exponent of its own: [`Bounded`].

use welter_predicates::Sign;

/// The true value lies within `bound * 2^exponent` of `significand * 2^exponent`.
///
/// The exponent keeps volumes like 1e-900 and 1e900 apart from 0 and infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The computed value, without the exponent. Finite.
    pub significand: f64,
    /// How far the true value can be, without the exponent. Finite, not negative.
    pub bound: f64,
    /// Power of two to scale both by.
    pub exponent: i32,
}

impl Bounded {
    /// The value as one `f64`: infinite where it is too large, and rounded to a multiple of 2^-1074 where it
    /// is tiny.
    #[must_use]
    pub fn value(self) -> f64 {
        libm::scalbn(self.significand, self.exponent)
    }

    /// The error bound as one `f64`; as [`Bounded::value`].
    #[must_use]
    pub fn error_bound(self) -> f64 {
        libm::scalbn(self.bound, self.exponent)
    }

    /// The sign of the true value where the bound leaves no doubt, and else `Zero`.
    #[must_use]
    pub fn sign(self) -> Sign {
        if self.significand.abs() > self.bound { Sign::of(self.significand) } else { Sign::Zero }
    }
}
