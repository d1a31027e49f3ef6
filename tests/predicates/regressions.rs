//! Named inputs on which floating point predicates are known to go wrong, and input that is no number.

use crate::family::{self, Predicate, for_each_predicate};
use welter_kit::generate::number::{hex, power_of_two};
use welter_predicates::{Sign, incircle, orient2d, orient3d};

#[test]
fn incircle_of_mixed_exponents() {
    // Products leave the range of f64 at both ends: expansion arithmetic without a last stage gives infinity here.
    let a = [hex("0x1.7d386e6243a54p-290"), hex("0x1.2a08ae0b08674p-512")];
    let b = [hex("-0x1.099dc4b93b81ap-440"), hex("-0x1.1112a6c3b2514p-40")];
    let c = [hex("0x1.4721c97f24c24p+654"), hex("0x1.596e20e00e41ap-347")];
    let d = [hex("-0x1.2b4e39b73efc0p-997"), hex("-0x1.a69d63ec35c3cp-608")];
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
