//! The rounded numbers in which a time step is examined: [`Number`], for `f64` and for double-double numbers.

use crate::arithmetic::double_double::DoubleDouble;
use crate::polynomial::{Additive, Times};

/// A number whose operations round, with a known relative error.
pub(super) trait Number: Copy + Additive + Times<Self, Product = Self> {
    /// A bound of the relative error of a sum, a difference and a product.
    const UNIT: f64;
    /// `x - y`, with a relative error of at most a unit.
    fn difference(x: f64, y: f64) -> Self;
    fn of(value: f64) -> Self;
    /// The nearest `f64`, or one beside it.
    fn leading(self) -> f64;
}

impl Number for f64 {
    /// Half an ulp of 1.
    const UNIT: f64 = f64::EPSILON / 2.0;

    #[inline(always)]
    fn difference(x: f64, y: f64) -> Self {
        x - y
    }
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn leading(self) -> f64 {
        self
    }
}

impl Number for DoubleDouble {
    /// 8 v, v = 2^-106: products err by at most 7 v, sums by 4 v (see [`crate::arithmetic::double_double`]).
    const UNIT: f64 = 2.0 * f64::EPSILON * f64::EPSILON;

    #[inline(always)]
    fn difference(x: f64, y: f64) -> Self {
        Self::of_difference(x, y)
    }
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::of_f64(value)
    }
    #[inline(always)]
    fn leading(self) -> f64 {
        self.high
    }
}
