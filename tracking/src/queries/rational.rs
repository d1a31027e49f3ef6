//! A fraction of decimal integers as an `f64`: [`nearest`].
//!
//! What it computes: the `f64` nearest to the fraction, ties to even, and whether the two are equal.
//!
//! Promises: correctly rounded for integers of any length, subnormal results and overflow to infinity included. The sign
//! of zero is plus.
//!
//! Method: with `2^top <= n / d < 2^(top + 1)` the spacing of `f64` at `n / d` is `2^unit`, `unit = max(top - 52, -1074)`;
//! one division gives `n = q d 2^unit + r`, and comparing `2 r` with `d 2^unit` rounds `q`.

use num_bigint::BigUint;
use std::cmp::Ordering;

/// A decimal integer: sign and digits without leading zeros, so zero has no digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal<'a> {
    negative: bool,
    digits: &'a str,
}

impl<'a> Decimal<'a> {
    /// The integer that `text` is: an optional sign, then at least one digit, nothing else.
    pub(super) fn parse(text: &'a str) -> Option<Self> {
        let (negative, digits) = match text.as_bytes().first()? {
            b'-' => (true, &text[1..]),
            b'+' => (false, &text[1..]),
            _ => (false, text),
        };
        let all_digits = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        all_digits.then(|| Self { negative, digits: digits.trim_start_matches('0') })
    }

    pub(super) fn is_zero(self) -> bool {
        self.digits.is_empty()
    }

    /// The magnitude.
    fn to_big(self) -> BigUint {
        BigUint::parse_bytes(self.digits.as_bytes(), 10).unwrap_or_default()
    }
}

/// The `f64` nearest to a fraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    /// Infinite where the fraction is beyond the range.
    pub(super) value: f64,
    /// Whether the fraction equals `value`.
    pub(super) exact: bool,
}

/// The `f64` nearest to `numerator / denominator`; the denominator is not zero.
pub(super) fn nearest(numerator: Decimal<'_>, denominator: Decimal<'_>) -> Nearest {
    if numerator.is_zero() {
        return Nearest { value: 0.0, exact: true };
    }
    let Nearest { value, exact } = match short(numerator.digits, denominator.digits) {
        Some(value) => Nearest { value, exact: true },
        None => long(&numerator.to_big(), &denominator.to_big()),
    };
    let negative = numerator.negative != denominator.negative && value != 0.0;
    Nearest { value: if negative { -value } else { value }, exact }
}

/// The quotient, if the integers fit in 128 bits, the denominator is a power of two and the quotient has at most 53
/// significant bits: the case of almost every coordinate that came from a program.
fn short(numerator: &str, denominator: &str) -> Option<f64> {
    let (n, d): (u128, u128) = (numerator.parse().ok()?, denominator.parse().ok()?);
    if !d.is_power_of_two() {
        return None;
    }
    let odd = n >> n.trailing_zeros();
    let exponent = n.trailing_zeros() as i32 - d.trailing_zeros() as i32;
    // The exponent is from -127 to 127, so nothing underflows.
    (odd >> f64::MANTISSA_DIGITS == 0).then(|| odd as f64 * power_of_two(exponent))
}

/// The quotient of two positive integers.
fn long(n: &BigUint, d: &BigUint) -> Nearest {
    // n has `n.bits()` bits, so 2^(estimate - 1) < n / d < 2^(estimate + 1).
    let estimate = n.bits() as i64 - d.bits() as i64;
    if estimate > i64::from(f64::MAX_EXP) {
        return Nearest { value: f64::INFINITY, exact: false };
    }
    let top = if shifted(n, -estimate) >= shifted(d, estimate) { estimate } else { estimate - 1 };
    let unit = (top - 52).max(i64::from(LEAST_EXPONENT));
    let (dividend, divisor) = (shifted(n, -unit), shifted(d, unit));
    let quotient = &dividend / &divisor;
    let rest = dividend - &quotient * &divisor;
    // Below 2^53 by the choice of the unit, so one word holds it.
    let whole = quotient.iter_u64_digits().next().unwrap_or(0);
    let rounded = match (&rest << 1u32).cmp(&divisor) {
        Ordering::Less => whole,
        Ordering::Equal => whole + whole % 2,
        Ordering::Greater => whole + 1,
    };
    if unit > i64::from(f64::MAX_EXP - 53) {
        return Nearest { value: f64::INFINITY, exact: false };
    }
    // Exact, because the product is an f64, but for 2^1024, which becomes infinite.
    let value = rounded as f64 * power_of_two(unit as i32);
    Nearest { value, exact: rest == BigUint::ZERO && value.is_finite() }
}

/// `x * 2^max(shift, 0)`.
fn shifted(x: &BigUint, shift: i64) -> BigUint {
    x << shift.max(0)
}

/// The exponent of the smallest positive `f64`.
const LEAST_EXPONENT: i32 = f64::MIN_EXP - f64::MANTISSA_DIGITS as i32;

/// `2^exponent`, for exponents from -1074 to 1023.
fn power_of_two(exponent: i32) -> f64 {
    let bits = if exponent < f64::MIN_EXP - 1 {
        1 << (exponent - LEAST_EXPONENT)
    } else {
        ((exponent + f64::MAX_EXP - 1) as u64) << (f64::MANTISSA_DIGITS - 1)
    };
    f64::from_bits(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(numerator: &str, denominator: &str) -> Nearest {
        nearest(Decimal::parse(numerator).unwrap(), Decimal::parse(denominator).unwrap())
    }

    #[test]
    fn integers_are_a_sign_and_digits() {
        for text in ["", "-", "+", "--1", "1.5", "1e3", "0x1", " 1", "1 ", "\u{0663}", "nan"] {
            assert_eq!(Decimal::parse(text), None, "{text:?}");
        }
        for text in ["0", "-0", "+000"] {
            assert!(Decimal::parse(text).unwrap().is_zero(), "{text}");
        }
        assert_eq!(Decimal::parse("-0012"), Some(Decimal { negative: true, digits: "12" }));
    }

    #[test]
    fn powers_of_two() {
        for exponent in LEAST_EXPONENT..f64::MAX_EXP {
            // Two factors, each of which is normal.
            let expected = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
            assert_eq!(power_of_two(exponent).to_bits(), expected.to_bits(), "{exponent}");
        }
    }

    #[test]
    fn short_and_long_ways_agree() {
        let big = |text: &str| Decimal::parse(text).unwrap().to_big();
        for (n, d) in [("1", "1"), ("3", "8"), ("9007199254740991", "1"), ("12345678901234567", "2")] {
            if let Some(value) = short(n, d) {
                assert_eq!(long(&big(n), &big(d)), Nearest { value, exact: true }, "{n}/{d}");
            }
        }
        assert_eq!(short("9007199254740993", "1"), None, "54 bits");
        assert_eq!(short("18014398509481984", "1"), Some(18014398509481984.0));
        let most = (1u128 << 127).to_string();
        assert_eq!(short("1", &most), Some(2f64.powi(-127)));
        assert_eq!(short(&most, "1"), Some(2f64.powi(127)));
    }

    #[test]
    fn signs_multiply_and_zero_is_positive() {
        assert_eq!(of("-6", "4").value, -1.5);
        assert_eq!(of("6", "-4").value, -1.5);
        assert_eq!(of("-6", "-4").value, 1.5);
        assert_eq!(of("-0", "7").value.to_bits(), 0);
        // Rounded to zero from below.
        let tiny = Nearest { value: 0.0, exact: false };
        let huge = "9".repeat(400);
        assert_eq!(of("-1", &huge), tiny);
        assert_eq!(of("-1", &huge).value.to_bits(), 0);
    }

    #[test]
    fn fractions_need_not_be_in_lowest_terms() {
        assert_eq!(of("3", "6"), Nearest { value: 0.5, exact: true });
        assert_eq!(of("1", "3"), Nearest { value: 1.0 / 3.0, exact: false });
    }

    #[test]
    fn halves_of_the_last_bit_go_to_even() {
        let p53 = 1u64 << 53;
        let cases = [(1, p53, false), (2, p53 + 2, true), (3, p53 + 4, false), (5, p53 + 4, false)];
        for (more, expected, exact) in cases {
            let found = of(&(p53 + more).to_string(), "1");
            assert_eq!(found, Nearest { value: expected as f64, exact }, "2^53 + {more}");
        }
    }

    #[test]
    fn the_ends_of_the_range() {
        let power = |exponent: u32| BigUint::from(1u8) << exponent;
        let text = |x: BigUint| x.to_string();
        let nearest_of = |n: BigUint, d: BigUint| of(&text(n), &text(d));
        let largest = power(1024) - power(971);
        let exactly = |value| Nearest { value, exact: true };
        let rounded = |value| Nearest { value, exact: false };
        assert_eq!(nearest_of(largest, power(0)), exactly(f64::MAX));
        // Half a unit beyond the largest is a tie between it and 2^1024, which is the even one.
        assert_eq!(nearest_of(power(1024) - power(970), power(0)), rounded(f64::INFINITY));
        assert_eq!(nearest_of(power(1024) - power(970) - power(0), power(0)), rounded(f64::MAX));
        assert_eq!(nearest_of(power(1024), power(0)), rounded(f64::INFINITY));
        assert_eq!(nearest_of(power(5000), power(0)), rounded(f64::INFINITY));
        let least = f64::from_bits(1);
        assert_eq!(nearest_of(power(0), power(1074)), exactly(least));
        assert_eq!(nearest_of(power(0), power(1075)), rounded(0.0));
        assert_eq!(nearest_of(power(100) + power(0), power(1175)), rounded(least));
        assert_eq!(nearest_of(power(0) * 3u8, power(1075)), rounded(2.0 * least));
        assert_eq!(nearest_of(power(52) - power(0), power(1074)), exactly(f64::MIN_POSITIVE - least));
        assert_eq!(nearest_of(power(53) - power(0), power(1075)), rounded(f64::MIN_POSITIVE));
    }
}
