//! Floating point numbers as unbounded integers, without rounding.

use rug::Integer;

/// The odd (or zero) integer `m` and the exponent `e` with `value == m * 2^e`.
fn decode(value: f64) -> (i64, i32) {
    assert!(value.is_finite(), "an oracle speaks of finite numbers, not of {value}");
    let bits = value.to_bits();
    let field = i32::try_from(bits >> 52 & 0x7ff).expect("eleven bits");
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).expect("52 bits");
    let (magnitude, exponent) = match field {
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, field - 1075),
    };
    if magnitude == 0 {
        return (0, 0);
    }
    let even = magnitude.trailing_zeros();
    let (odd, exponent) = (magnitude >> even, exponent + even.cast_signed());
    (if value.is_sign_negative() { -odd } else { odd }, exponent)
}

/// All coordinates times one power of two that makes them integers.
///
/// One factor for all of them leaves the sign of every homogeneous polynomial, and every answer about positions,
/// unchanged.
#[must_use]
pub fn lift<const D: usize>(points: &[[f64; D]]) -> Vec<[Integer; D]> {
    let coordinates = points.iter().flatten().map(|&c| decode(c));
    let lowest = coordinates.filter(|&(m, _)| m != 0).map(|(_, e)| e).min().unwrap_or(0);
    let whole = |value: f64| {
        let (magnitude, exponent) = decode(value);
        if magnitude == 0 {
            return Integer::new();
        }
        Integer::from(magnitude) << u32::try_from(exponent - lowest).expect("not below the lowest exponent")
    };
    points.iter().map(|point| point.map(whole)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn lifted_coordinates_keep_their_ratios() {
        let tiny = f64::from_bits(1);
        let points = [[1.5, -tiny], [f64::MAX, 0.0], [-0.0, f64::MIN_POSITIVE]];
        let lifted = lift(&points);
        let factor = Rational::from(1) << 1074;
        for (point, whole) in points.iter().zip(&lifted) {
            for (&c, w) in point.iter().zip(whole) {
                assert_eq!(Rational::from_f64(c).unwrap() * &factor, *w);
            }
        }
        assert_eq!(lift(&[[0.0, -0.0]]), [[Integer::new(), Integer::new()]]);
        assert_eq!(lift(&[[0.5], [3.0]]), [[Integer::from(1)], [Integer::from(6)]]);
    }
}
