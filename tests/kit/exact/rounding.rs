//! The `f64` nearest to a rational number.

use rug::Rational;
use std::cmp::Ordering;

/// The `f64` nearest to `value`, ties to even, and whether they are equal; infinite where `value` rounds beyond the range.
///
/// Finds the greatest `f64` that is not above the magnitude by bisecting the bit patterns, then compares with the middle
/// between it and the next.
#[must_use]
pub fn nearest_f64(value: &Rational) -> (f64, bool) {
    let magnitude = value.clone().abs();
    let of = |bits: u64| Rational::from_f64(f64::from_bits(bits)).expect("a finite pattern");
    let (mut below, mut above) = (0, f64::INFINITY.to_bits());
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if of(middle) <= magnitude { below = middle } else { above = middle }
    }
    let (lower, exact) = (of(below), of(below) == magnitude);
    // The spacing above the greatest f64 is that below it.
    let spacing =
        if above == f64::INFINITY.to_bits() { lower.clone() - of(below - 1) } else { of(above) - &lower };
    let bits = match (magnitude - lower).cmp(&(spacing / 2)) {
        Ordering::Less => below,
        Ordering::Equal => below + below % 2,
        Ordering::Greater => above,
    };
    let rounded = f64::from_bits(bits);
    (if *value < 0 { -rounded } else { rounded }, exact)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rounds_as_the_hardware_does() {
        // One rounded division is correctly rounded by IEEE 754.
        for (n, d) in [(1, 3), (2, 3), (-1, 10), (22, 7), (1, 1 << 30), (0, 5), (i32::MAX, 3)] {
            let (found, exact) = nearest_f64(&Rational::from((n, d)));
            assert_eq!(found, f64::from(n) / f64::from(d), "{n}/{d}");
            assert_eq!(exact, Rational::from_f64(found) == Some(Rational::from((n, d))), "{n}/{d}");
        }
        let two = |power: u32| Rational::from(rug::Integer::from(1) << power);
        assert_eq!(nearest_f64(&(two(53) + 1u32)), (two(53).to_f64(), false));
        assert_eq!(nearest_f64(&(two(1024) - two(970))), (f64::INFINITY, false));
        assert_eq!(nearest_f64(&(two(1024) - two(970) - 1u32)), (f64::MAX, false));
        assert_eq!(nearest_f64(&two(1075).recip()), (0.0, false));
        assert_eq!(nearest_f64(&two(1074).recip()), (f64::from_bits(1), true));
    }
}
