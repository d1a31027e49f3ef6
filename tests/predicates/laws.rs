//! Equivariance: what an exact sign does under a change of its arguments that is itself exact.
//!
//! All five determinants change sign when two points or two axes are swapped or one axis is mirrored, and keep it under
//! scaling by powers of two and under translation.

use crate::family::{Predicate, check, for_each_predicate};
use proptest::prelude::*;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::generate::{Kind, number, points};

fn swapping_points_negates<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        let inputs = (points::<D, N>(kind), 0..N, 1..N);
        check((predicate.name, kind), predicate.cases / 4, &inputs, |(p, i, step)| {
            let mut swapped = p;
            swapped.swap(i, (i + step) % N);
            prop_assert_eq!((predicate.sign)(&swapped), -(predicate.sign)(&p));
            Ok(())
        });
    }
}

fn swapping_or_mirroring_axes_negates<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        let inputs = (points::<D, N>(kind), 0..D, 1..D);
        check((predicate.name, kind), predicate.cases / 4, &inputs, |(p, i, step)| {
            let (mut swapped, mut mirrored) = (p, p);
            for (s, m) in swapped.iter_mut().zip(&mut mirrored) {
                s.swap(i, (i + step) % D);
                m[i] = -m[i];
            }
            let sign = (predicate.sign)(&p);
            prop_assert_eq!((predicate.sign)(&swapped), -sign, "axes {} and {}", i, (i + step) % D);
            prop_assert_eq!((predicate.sign)(&mirrored), -sign, "axis {}", i);
            Ok(())
        });
    }
}

fn scaling_by_powers_of_two_keeps<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    // Kinds whose coordinates are of moderate size, scaled as far down and up as stays exact.
    for kind in [Kind::Uniform, Kind::Dyadic, Kind::Grid, Kind::FlatGrid] {
        let inputs = (points::<D, N>(kind), -1020..=1018_i32);
        check((predicate.name, kind), predicate.cases / 2, &inputs, |(p, exponent)| {
            let factor = number::power_of_two(exponent);
            let scaled = p.map(|point| point.map(|c| c * factor));
            prop_assert!(scaled.iter().zip(&p).all(|(s, q)| (0..D).all(|i| s[i] / factor == q[i])));
            prop_assert_eq!((predicate.sign)(&scaled), (predicate.sign)(&p));
            Ok(())
        });
    }
}

fn translating_keeps<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    // Multiples of 1/8 below 2^5; a shift by a multiple of 1/8 below 2^47 is exact.
    for kind in [Kind::Dyadic, Kind::Grid, Kind::FlatGrid] {
        let inputs = (points::<D, N>(kind), proptest::array::uniform4(-4096..4096_i64), 0..38_u32);
        check((predicate.name, kind), predicate.cases / 2, &inputs, |(p, shift, magnitude)| {
            let shift = shift.map(|s| (s << magnitude) as f64 / 8.0);
            let moved = p.map(|point| std::array::from_fn(|i| point[i] + shift[i]));
            prop_assert!(moved.iter().zip(&p).all(|(m, q)| (0..D).all(|i| m[i] - shift[i] == q[i])));
            prop_assert_eq!((predicate.sign)(&moved), (predicate.sign)(&p));
            Ok(())
        });
    }
}

fn single_precision_lifts<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for seed in 0..u64::from(predicate.cases) {
        let bytes = stream(seed, 4 * D * N + 4);
        let mut entropy = Entropy::new(&bytes);
        let mask = entropy.pick(&[u32::MAX, 0xffff_0000, 0x8080_0000, 0x81ff_ffff]);
        let p = [(); N].map(|()| {
            [(); D].map(|()| {
                let bits = u32::from_le_bytes([0; 4].map(|_: u8| entropy.byte())) & mask;
                let value = f32::from_bits(bits);
                if value.is_finite() { value } else { f32::from_bits(bits & !(1 << 23)) }
            })
        });
        let lifted = p.map(|point| point.map(f64::from));
        assert_eq!((predicate.sign_f32)(&p), (predicate.sign)(&lifted), "{} {p:?}", predicate.name);
    }
}

fn repeating_a_point_gives_zero<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        let inputs = (points::<D, N>(kind), 0..N, 1..N);
        check((predicate.name, kind), predicate.cases / 8, &inputs, |(mut p, i, step)| {
            p[i] = p[(i + step) % N];
            prop_assert!((predicate.sign)(&p).is_zero());
            Ok(())
        });
    }
}

for_each_predicate! {
    swapping_points_negates
    swapping_or_mirroring_axes_negates
    scaling_by_powers_of_two_keeps
    translating_keeps
    single_precision_lifts
    repeating_a_point_gives_zero
}
