//! The answer of a predicate: [`Sign`].

use core::ops::{Mul, Neg};

/// The sign of an exactly evaluated expression.
///
/// ```
/// use welter_predicates::Sign;
/// assert_eq!(Sign::of(-3.0), Sign::Negative);
/// assert_eq!(-Sign::Positive * Sign::Negative, Sign::Positive);
/// assert_eq!(Sign::Zero as i8, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Sign {
    /// Less than zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Greater than zero.
    Positive = 1,
}

impl Sign {
    /// The sign of one number; `Zero` for both zeros and for NaN.
    #[inline]
    #[must_use]
    pub fn of(value: f64) -> Self {
        if value > 0.0 {
            Self::Positive
        } else if value < 0.0 {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    /// The sign of a number that is known not to be zero or NaN: compiles without a branch.
    #[inline]
    pub(crate) fn of_nonzero(value: f64) -> Self {
        if value > 0.0 { Self::Positive } else { Self::Negative }
    }

    /// The sign of `a - b`, from their order.
    #[inline]
    #[must_use]
    pub fn of_difference(a: f64, b: f64) -> Self {
        if a > b {
            Self::Positive
        } else if a < b {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    /// True for [`Sign::Zero`].
    #[inline]
    #[must_use]
    pub fn is_zero(self) -> bool {
        self == Self::Zero
    }
}

impl Neg for Sign {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }
}

impl Mul for Sign {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if other.is_zero() {
            Self::Zero
        } else if other == Self::Positive {
            self
        } else {
            -self
        }
    }
}
