//! The variants that give a value, and the checked ones.

use crate::family::{Predicate, check, for_each_predicate};
use proptest::prelude::*;
use welter_kit::generate::{Kind, points, seeded};
use welter_predicates::{NonFinite, Sign};

fn value_has_the_sign<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        check((predicate.name, kind), predicate.cases / 2, &points::<D, N>(kind), |p| {
            let value = (predicate.value)(&p);
            prop_assert!(value.is_finite(), "{value:e}");
            prop_assert_eq!(Sign::of(value), (predicate.sign)(&p), "{:e}", value);
            Ok(())
        });
    }
}

fn value_is_the_determinant<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    // Multiples of 1/8 of magnitude at most 16: differences have 9 bits, so a sum of products of five of them has less
    // than 53 and every way to evaluate the polynomial is exact.
    for p in seeded::<D, N>(Kind::Dyadic, u64::from(predicate.cases / 4)) {
        assert_eq!((predicate.value)(&p), (predicate.determinant)(&p), "{} {p:?}", predicate.name);
    }
}

fn checked_variant_agrees<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        for p in seeded::<D, N>(kind, 50) {
            assert_eq!((predicate.checked)(&p), Ok((predicate.sign)(&p)), "{} {p:?}", predicate.name);
        }
    }
}

fn checked_variant_names_the_first_bad_coordinate<const D: usize, const N: usize>(
    predicate: &Predicate<D, N>,
) {
    for place in 0..N * D {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut p = [[1.0; D]; N];
            let (argument, coordinate) = (place / D, place % D);
            p[argument][coordinate] = value;
            p[N - 1][D - 1] = value;
            let expected = Err(NonFinite { argument, coordinate, value });
            assert_eq!((predicate.checked)(&p), expected, "{} {p:?}", predicate.name);
            let message = NonFinite { argument, coordinate, value }.to_string();
            assert!(message.contains(&argument.to_string()) && message.contains(&coordinate.to_string()));
        }
    }
}

fn value_of_input_that_is_no_number_is_zero<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for place in 0..N * D {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut p: [[f64; D]; N] =
                std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j + 1)));
            p[place / D][place % D] = bad;
            assert_eq!((predicate.value)(&p), 0.0, "{} {p:?}", predicate.name);
        }
    }
}

for_each_predicate! {
    value_has_the_sign
    value_is_the_determinant
    checked_variant_agrees
    checked_variant_names_the_first_bad_coordinate
    value_of_input_that_is_no_number_is_zero
}
