//! Single coordinates, each function one family of finite `f64`.

use crate::entropy::Entropy;

/// `2^exponent` for `-1074..=1023`, exactly.
#[must_use]
pub fn power_of_two(exponent: i32) -> f64 {
    assert!((-1074..=1023).contains(&exponent), "2^{exponent} is not an f64");
    if exponent >= -1022 {
        f64::from_bits(u64::try_from(exponent + 1023).expect("a normal exponent") << 52)
    } else {
        f64::from_bits(1 << (exponent + 1074))
    }
}

/// The number that C writes as `text` in hexadecimal: `-0x1.8p-3` is -0.1875.
///
/// # Panics
/// If `text` is not `[-]0x1.<at most 13 digits>p<exponent of a normal number>`.
#[must_use]
pub fn hex(text: &str) -> f64 {
    let (negative, digits) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let (fraction, exponent) =
        digits.strip_prefix("0x1.").and_then(|rest| rest.split_once('p')).expect("0x1. and p");
    let bits = u64::from_str_radix(&format!("{fraction:0<13}"), 16).expect("hexadecimal digits");
    assert!(bits < 1 << 52, "more than 13 digits");
    let exponent: i32 = exponent.parse().expect("an exponent");
    let value = f64::from_bits(1.0f64.to_bits() | bits) * power_of_two(exponent);
    if negative { -value } else { value }
}

/// Uniform in `[-1, 1)`, a multiple of `2^-52`.
pub fn uniform(entropy: &mut Entropy<'_>) -> f64 {
    (entropy.word() >> 11) as f64 * power_of_two(-52) - 1.0
}

/// An integer of small magnitude with few bits: many sums and products of these cancel to zero.
pub fn grid(entropy: &mut Entropy<'_>) -> f64 {
    entropy.pick(&[1.0, -1.0, 2.0, -2.0, 4.0, -4.0, 0.0])
}

/// A multiple of 1/8 in `[-16, 16)`: differences and products are exact in `f64`.
pub fn dyadic(entropy: &mut Entropy<'_>) -> f64 {
    f64::from(entropy.byte()) / 8.0 - 16.0
}

/// A zero of either sign, the smallest numbers of either sign, and one.
pub fn signed_zero(entropy: &mut Entropy<'_>) -> f64 {
    let tiny = f64::from_bits(1);
    entropy.pick(&[0.0, -0.0, 0.0, -0.0, tiny, -tiny, 1.0, -1.0])
}

/// Any finite number, uniform in its exponent field, with few or many bits set in the fraction.
pub fn any_exponent(entropy: &mut Entropy<'_>) -> f64 {
    let bits = entropy.word();
    let kept = entropy.pick(&[u64::MAX, 0, 1 << 51, 0xf << 48, 1]);
    finite(bits & (kept | 0xfff << 52))
}

/// A subnormal number, or a normal one of the lowest exponents.
pub fn subnormal(entropy: &mut Entropy<'_>) -> f64 {
    let bits = entropy.word();
    let kept = entropy.pick(&[(1 << 52) - 1, 0xff, 3, (1 << 53) - 1]);
    f64::from_bits(bits & (kept | 1 << 63))
}

/// A number within a factor of 32 of the greatest, often the greatest itself.
pub fn near_max(entropy: &mut Entropy<'_>) -> f64 {
    let bits = entropy.word();
    let sign = bits & (1 << 63);
    match entropy.below(4) {
        0 => f64::from_bits(sign | f64::MAX.to_bits()),
        1 => f64::from_bits(sign | (f64::MAX.to_bits() - (bits & 7))),
        2 => f64::from_bits(sign | power_of_two(1023).to_bits()),
        _ => f64::from_bits(sign | ((2046 - (bits >> 52) % 5) << 52) | (bits & ((1 << 52) - 1))),
    }
}

/// One of the families above, drawn anew for each number.
pub fn mixed(entropy: &mut Entropy<'_>) -> f64 {
    match entropy.below(8) {
        0 => uniform(entropy),
        1 => grid(entropy),
        2 => dyadic(entropy),
        3 => signed_zero(entropy),
        4 => any_exponent(entropy),
        5 => subnormal(entropy),
        6 => near_max(entropy),
        _ => {
            f64::from_bits(entropy.word() & (1 << 63) | power_of_two(entropy.between(-1074, 1023)).to_bits())
        }
    }
}

/// The number `steps` places further along the ordered finite `f64`, stopping at the greatest in magnitude.
#[must_use]
pub fn nudge(value: f64, steps: i64) -> f64 {
    // Finite numbers in order are integers in order once negative ones count downwards from zero.
    const GREATEST: i64 = 0x7fef_ffff_ffff_ffff;
    let magnitude = i64::try_from(value.to_bits() & !(1 << 63)).expect("the sign bit is cleared");
    let place = if value.is_sign_negative() { -magnitude } else { magnitude };
    let moved = place.saturating_add(steps).clamp(-GREATEST, GREATEST);
    f64::from_bits(moved.unsigned_abs()).copysign(if moved < 0 { -1.0 } else { 1.0 })
}

/// Bits as a number, with the exponent field of infinities replaced by that of the greatest numbers.
fn finite(bits: u64) -> f64 {
    let value = f64::from_bits(bits);
    if value.is_finite() { value } else { f64::from_bits(bits & !(1 << 52)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entropy::stream;

    #[test]
    fn powers_of_two() {
        assert_eq!(power_of_two(-1074), f64::from_bits(1));
        assert_eq!(power_of_two(-1023) * 2.0, f64::MIN_POSITIVE);
        assert_eq!(
            (power_of_two(-1022), power_of_two(0), power_of_two(10)),
            (f64::MIN_POSITIVE, 1.0, 1024.0)
        );
        assert!((power_of_two(1023) * 2.0).is_infinite());
    }

    #[test]
    fn hexadecimal_text() {
        assert_eq!(
            (hex("-0x1.8p-3"), hex("0x1.0p+1"), hex("0x1.fffffffffffffp+1023")),
            (-0.1875, 2.0, f64::MAX)
        );
    }

    #[test]
    fn nudge_walks_the_finite_numbers_in_order() {
        assert_eq!(nudge(1.0, 1), 1.0f64.next_up());
        assert_eq!(nudge(-1.0, 1), (-1.0f64).next_up());
        assert_eq!(nudge(0.0, -1), -f64::from_bits(1));
        assert_eq!(nudge(-f64::from_bits(1), 2), f64::from_bits(1));
        assert_eq!((nudge(f64::MAX, 5), nudge(-f64::MAX, -5)), (f64::MAX, -f64::MAX));
    }

    #[test]
    fn every_family_is_finite_and_reaches_its_range() {
        let bytes = stream(11, 200_000);
        let mut entropy = Entropy::new(&bytes);
        let (mut smallest, mut greatest, mut negative_zero) = (f64::MAX, 0.0, false);
        while entropy.rest().len() > 100 {
            for value in
                [uniform(&mut entropy), grid(&mut entropy), dyadic(&mut entropy), mixed(&mut entropy)]
            {
                assert!(value.is_finite());
            }
            let (tiny, huge) = (subnormal(&mut entropy), near_max(&mut entropy));
            assert!(
                tiny.abs() <= power_of_two(-1020) && huge.abs() >= power_of_two(1019) && huge.is_finite()
            );
            let value = any_exponent(&mut entropy);
            assert!(value.is_finite());
            if value != 0.0 {
                smallest = value.abs().min(smallest);
            }
            greatest = value.abs().max(greatest);
            negative_zero |= signed_zero(&mut entropy).to_bits() == (-0.0f64).to_bits();
        }
        assert!(smallest < power_of_two(-1022) && greatest > power_of_two(1022) && negative_zero);
    }
}
