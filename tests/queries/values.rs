//! Fractions as coordinates, against rational arithmetic of unbounded integers.

use rug::{Integer, Rational};
use welter_kit::entropy::stream;
use welter_kit::exact::nearest_f64;
use welter_tracking::queries::{Parameters, Queries, ReadError};

/// What a reader makes of a fraction: as x of the first of eight vertices.
fn read(fraction: &str, rounded: bool) -> Result<(f64, u64), ReadError> {
    let text = format!("{fraction},0,1,0,1\n") + &"0,1,0,1,0,1\n".repeat(7);
    let mut queries = Queries::new(text.as_bytes(), Parameters { rounded });
    let query = queries.next().expect("one query")?;
    Ok((query.t0[0][0], queries.rounded()))
}

fn two(power: i32) -> Rational {
    let whole = Rational::from(Integer::from(1) << power.unsigned_abs());
    if power < 0 { whole.recip() } else { whole }
}

/// The reader against the oracle on one value and its negative, with and without rounding, in and not in lowest terms.
#[track_caller]
fn check(value: &Rational) {
    for value in [value.clone(), -value.clone()] {
        let (expected, exact) = nearest_f64(&value);
        for factor in [1, 3, -10] {
            let fraction = format!(
                "{},{}",
                Integer::from(value.numer() * factor),
                Integer::from(value.denom() * factor)
            );
            match read(&fraction, true) {
                Ok((found, rounded)) => {
                    assert_eq!(found, expected, "{fraction}");
                    assert_eq!(rounded, u64::from(!exact), "{fraction}");
                }
                Err(ReadError::BeyondRange { line: 1, column: 1, .. }) => {
                    assert!(expected.is_infinite(), "{fraction}");
                }
                Err(other) => panic!("{other}"),
            }
            match read(&fraction, false) {
                Ok((found, 0)) => assert!(exact && found == expected, "{fraction}"),
                Err(ReadError::NotRepresentable { line: 1, column: 1, nearest, .. }) => {
                    assert!(!exact && nearest == expected, "{fraction}");
                }
                Err(ReadError::BeyondRange { .. }) => assert!(expected.is_infinite(), "{fraction}"),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// A number, the middle between it and the next, and a hair beside either.
fn around(x: f64) {
    let this = Rational::from_f64(x).expect("finite");
    let next = Rational::from_f64(x.next_up()).unwrap_or_else(|| two(1024));
    let middle = Rational::from(&this + &next) / 2;
    for place in [this, middle] {
        for hair in [-1, 0, 1] {
            check(&(place.clone() + two(-1200) * hair));
        }
    }
}

#[test]
fn edges_of_the_range() {
    let least = f64::from_bits(1);
    let mut places =
        vec![0.0, least, f64::from_bits(2), f64::from_bits(3), 1.0, 1.0f64.next_down(), f64::MAX];
    places.extend([f64::MIN_POSITIVE, f64::MIN_POSITIVE.next_down(), f64::MIN_POSITIVE.next_up()]);
    places.extend([2f64.powi(53), 2f64.powi(53).next_down(), 2f64.powi(54), 2f64.powi(127), 2f64.powi(-127)]);
    places.push(f64::MAX.next_down());
    for x in places {
        around(x);
    }
    check(&two(1024));
    check(&two(4000));
    check(&two(-1075));
    check(&two(-1076));
    check(&two(-4000));
}

#[test]
fn every_power_of_two() {
    for power in -1074..1024 {
        let value = two(power);
        let (found, rounded) = read(&format!("{},{}", value.numer(), value.denom()), false).unwrap();
        assert_eq!((Rational::from_f64(found), rounded), (Some(value), 0), "2^{power}");
    }
}

#[test]
fn random_numbers_of_every_size_and_their_middles() {
    for bits in stream(1, 8 * 400).chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().unwrap())) {
        let x = f64::from_bits(bits & (u64::MAX >> 1));
        if x.is_finite() {
            around(x);
        }
        // Subnormal, and with few significant bits.
        around(f64::from_bits(bits >> 12));
        around(f64::from_bits(bits & 0x7fef_f800_0000_0000));
    }
}

#[test]
fn random_fractions() {
    for bytes in stream(2, 64 * 500).chunks_exact(64) {
        let (n, d) = bytes.split_at(usize::from(bytes[0]) % 63 + 1);
        let integer = |bytes: &[u8]| Integer::from_digits(bytes, rug::integer::Order::Lsf);
        let denominator = integer(d) + 1u32;
        check(&Rational::from((integer(n), denominator)));
    }
}

#[test]
fn the_longest_exact_fractions() {
    // 309 and 324 digits, and both at once in a fraction not in lowest terms.
    let largest = Rational::from_f64(f64::MAX).unwrap();
    assert_eq!(largest.numer().to_string().len(), 309);
    assert_eq!(read(&format!("{},1", largest.numer()), false).unwrap(), (f64::MAX, 0));
    let denominator = two(1074).into_numer_denom().0.to_string();
    assert_eq!(denominator.len(), 324);
    assert_eq!(read(&format!("1,{denominator}"), false).unwrap(), (f64::from_bits(1), 0));
    assert_eq!(read(&format!("-{denominator},{denominator}"), false).unwrap(), (-1.0, 0));
}
