//! The outcome of an exact evaluation: [`Scaled`], leading bits and a wide exponent.

use crate::Sign;

/// The leading bits of an exact number: `mantissa * 2^exponent`, truncated. The mantissa has the sign of the
/// number, is zero only if the number is, and any `i32` exponent is possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scaled {
    pub(crate) mantissa: i64,
    pub(crate) exponent: i32,
}

/// An exactly known number.
pub(crate) trait Exact {
    fn sign(&self) -> Sign;
    fn scaled(&self) -> Scaled;
}

impl Exact for Scaled {
    #[inline]
    fn sign(&self) -> Sign {
        Scaled::sign(*self)
    }
    #[inline]
    fn scaled(&self) -> Scaled {
        *self
    }
}

impl Scaled {
    pub(crate) const ZERO: Self = Self { mantissa: 0, exponent: 0 };

    #[inline]
    pub(crate) fn sign(self) -> Sign {
        match self.mantissa.signum() {
            1 => Sign::Positive,
            -1 => Sign::Negative,
            _ => Sign::Zero,
        }
    }

    /// A finite number.
    pub(crate) fn of_f64(value: f64) -> Self {
        let bits = value.to_bits();
        let biased = ((bits >> 52) & 0x7ff) as i32;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let magnitude = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mantissa = if value < 0.0 { -magnitude } else { magnitude };
        Self { mantissa, exponent: biased.max(1) - 1075 }
    }

    /// The number whose magnitude has the leading words `high`, not zero, and `low`, the latter in units of
    /// `2^exponent`.
    pub(crate) fn of_words(negative: bool, high: u64, low: u64, exponent: i32) -> Self {
        let wide = u128::from(high) << 64 | u128::from(low);
        // The upper 62 bits from the leading one on: never zero.
        let shift = 128 - 62 - wide.leading_zeros() as i32;
        let mantissa = (if shift >= 0 { wide >> shift } else { wide << -shift }) as i64;
        Self { mantissa: if negative { -mantissa } else { mantissa }, exponent: exponent + shift }
    }

    #[inline(always)]
    pub(crate) fn times_power_of_two(self, power: i32) -> Self {
        Self { exponent: self.exponent + power, ..self }
    }

    /// The nearest finite nonzero `f64` or one of its neighbours; zero for zero. Numbers out of range become
    /// the largest finite or the smallest subnormal number of their sign.
    pub(crate) fn to_f64(self) -> f64 {
        if self.mantissa == 0 {
            return 0.0;
        }
        // In [1, 2^63]: scaling by at most 2^1023 twice reaches every exponent of an f64, and past both ends.
        let mantissa = self.mantissa as f64;
        let exponent = self.exponent.clamp(-1200, 1100);
        let half = exponent / 2;
        let value = mantissa * power_of_two(half) * power_of_two(exponent - half);
        if value == 0.0 { f64::from_bits(1).copysign(mantissa) } else { value.clamp(-f64::MAX, f64::MAX) }
    }
}

/// `2^exponent` for exponents of normal numbers.
#[inline(always)]
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&exponent));
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_to_finite_and_nonzero() {
        let to_f64 = |mantissa, exponent| Scaled { mantissa, exponent }.to_f64();
        assert_eq!(to_f64(3, 1), 6.0);
        assert_eq!(to_f64(-1, -1074), -f64::from_bits(1));
        assert_eq!(to_f64(-1, -20000), -f64::from_bits(1));
        assert_eq!(to_f64(i64::MAX, 20000), f64::MAX);
        assert_eq!(to_f64(1, 1023), power_of_two(1023));
        assert_eq!(to_f64(0, 5), 0.0);
    }
}
