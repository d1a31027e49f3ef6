//! Named inputs on which floating point predicates are known to go wrong, and input that is no number.

use crate::family::{self, Predicate, for_each_predicate};
use welter_kit::generate::number::power_of_two;
use welter_predicates::{Sign, incircle, orient2d, orient3d};

/// `mantissa * 2^exponent` with the mantissa's bits as a hexadecimal literal `0x1.<fraction>p<exponent>` has them.
fn hex(negative: bool, fraction: u64, exponent: i32) -> f64 {
    let value = f64::from_bits(1.0f64.to_bits() | fraction) * power_of_two(exponent);
    if negative { -value } else { value }
}

#[test]
fn incircle_of_mixed_exponents() {
    // Products leave the range of f64 at both ends: expansion arithmetic without a last stage gives infinity here.
    let a = [hex(false, 0x7d38_6e62_43a5_4, -290), hex(false, 0x2a08_ae0b_0867_4, -512)];
    let b = [hex(true, 0x099d_c4b9_3b81_a, -440), hex(true, 0x1112_a6c3_b251_4, -40)];
    let c = [hex(false, 0x4721_c97f_24c2_4, 654), hex(false, 0x596e_20e0_0e41_a, -347)];
    let d = [hex(true, 0x2b4e_39b7_3efc_0, -997), hex(true, 0xa69d_63ec_35c3_c, -608)];
    assert_eq!(incircle(a, b, c, d), Sign::Negative);
    assert_eq!((family::INCIRCLE.oracle)(&[a, b, c, d]), -1);
}

#[test]
fn orient3d_of_tiny_points_is_no_false_zero() {
    // Products of three differences are below the smallest number.
    let s = power_of_two(-350);
    assert_eq!(orient3d([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s], [0.0; 3]), Sign::Positive);
    assert_eq!(orient3d([0.0, s, 0.0], [s, 0.0, 0.0], [0.0, 0.0, s], [0.0; 3]), Sign::Negative);
    let coplanar = [[s, s, 2.0 * s], [2.0 * s, s, 3.0 * s], [s, 3.0 * s, 4.0 * s], [0.0; 3]];
    assert_eq!((family::ORIENT3D.sign)(&coplanar), Sign::Zero);
}

#[test]
fn orient3d_of_huge_points_is_no_nan() {
    let s = power_of_two(450);
    assert_eq!(orient3d([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s], [0.0; 3]), Sign::Positive);
    let coplanar = [[s, s, 2.0 * s], [2.0 * s, s, 3.0 * s], [s, 3.0 * s, 4.0 * s], [0.0; 3]];
    assert_eq!((family::ORIENT3D.sign)(&coplanar), Sign::Zero);
    let lifted = [coplanar[0], coplanar[1], coplanar[2], [0.0, 0.0, 1e-300]];
    assert_eq!(i32::from((family::ORIENT3D.sign)(&lifted) as i8), (family::ORIENT3D.oracle)(&lifted));
}

#[test]
fn orient2d_differences_that_overflow() {
    let m = f64::MAX;
    assert_eq!(orient2d([-m, -m], [m, -m], [m, m]), Sign::Positive);
    assert_eq!(orient2d([-m, -m], [m, m], [0.0, 0.0]), Sign::Zero);
    assert_eq!(orient2d([-m, -m], [m, m], [0.0, f64::from_bits(1)]), Sign::Positive);
}

#[test]
fn orient2d_on_a_line_near_one_half() {
    // The classic picture of [Kettner08]: points a few ulp around (0.5, 0.5) against a line through (12, 12) and
    // (24, 24), where rounded determinants give a speckled pattern instead of a line.
    let ulp = power_of_two(-53);
    for i in 0..32_u32 {
        for j in 0..32_u32 {
            let p = [0.5 + f64::from(i) * ulp, 0.5 + f64::from(j) * ulp];
            assert_eq!(orient2d(p, [12.0, 12.0], [24.0, 24.0]), Sign::of_difference(p[1], p[0]), "{i} {j}");
        }
    }
}

fn input_that_is_no_number_gives_zero<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    let simplex: [[f64; D]; N] =
        std::array::from_fn(|i| std::array::from_fn(|axis| f64::from(i == axis + 1)));
    for point in 0..N {
        for axis in 0..D {
            for bad in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut p = simplex;
                p[point][axis] = bad;
                assert_eq!((predicate.sign)(&p), Sign::Zero, "{} {p:?}", predicate.name);
            }
        }
    }
}

for_each_predicate! { input_that_is_no_number_gives_zero }
