//! Signs of two polynomials on a vector and points: on which side of a directed line a point lies.
//!
//! * [`side_of_direction`]: `d x (t - o)` in the plane.
//! * [`triple_sign`]: `d . ((s - o) x (t - o))` in space.
//!
//! A vector is given as it is, so that `o + d`, which would round, is never formed. Each is evaluated in floating
//! point first; where the error bound does not decide, in integers. With `u = 2^-53`, entries `d` exact and
//! differences of relative error at most `u`, the first has absolute error at most `(3u + O(u^2)) p`, the second
//! at most `(7u + O(u^2)) p`, where `p` is the same expression with absolute values of its terms; the bounds used
//! are `4u p` and `8u p`. They hold without underflow or overflow, that is, when each entry is zero or within
//! [2^-300, 2^300]: products of three then lie within [2^-960, 2^960], cancellation included.

use super::{P2, P3};
use crate::Sign;
use crate::arithmetic::fixed_point::{COORDINATE_LIMBS, Integer, Integers, Unit};
use crate::arithmetic::scaled::Scaled;
use crate::polynomial::{self, Additive};

/// 2^-53, the relative error of a rounded operation.
const U: f64 = f64::EPSILON / 2.0;
const SAFE_MIN: f64 = f64::from_bits((1023 - 300) << 52);
const SAFE_MAX: f64 = f64::from_bits((1023 + 300) << 52);

fn safe(entries: &[f64]) -> bool {
    entries.iter().all(|x| *x == 0.0 || (SAFE_MIN..=SAFE_MAX).contains(&x.abs()))
}

/// The sign of `d x (t - o)`: positive when `t` lies to the left of the line from `o` along `d`.
pub(super) fn side_of_direction(o: P2, d: P2, t: P2) -> Sign {
    let [x, y] = [t[0] - o[0], t[1] - o[1]];
    let (left, right) = (d[0] * y, d[1] * x);
    let value = left - right;
    if value.abs() > 4.0 * U * (left.abs() + right.abs()) && safe(&[x, y, d[0], d[1]]) {
        return Sign::of(value);
    }
    exact_side(o, d, t)
}

fn exact_side(o: P2, d: P2, t: P2) -> Sign {
    let unit = Unit::of([o[0], o[1], t[0], t[1]]);
    Scaled::from(polynomial::orient2d::<Integers>(&[integers(d), difference(unit, t, o)])).sign()
}

/// The sign of `d . ((s - o) x (t - o))`: positive when `d`, `s - o`, `t - o` are right-handed.
pub(super) fn triple_sign(d: P3, o: P3, s: P3, t: P3) -> Sign {
    let a: P3 = core::array::from_fn(|k| s[k] - o[k]);
    let b: P3 = core::array::from_fn(|k| t[k] - o[k]);
    let mut value = 0.0;
    let mut permanent = 0.0;
    for (k, &along) in d.iter().enumerate() {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (left, right) = (a[i] * b[j], a[j] * b[i]);
        value += along * (left - right);
        permanent += along.abs() * (left.abs() + right.abs());
    }
    if value.abs() > 8.0 * U * permanent && safe(&a) && safe(&b) && safe(&d) {
        return Sign::of(value);
    }
    exact_triple(d, o, s, t)
}

fn exact_triple(d: P3, o: P3, s: P3, t: P3) -> Sign {
    let unit = Unit::of([o, s, t].as_flattened().iter().copied());
    let rows = [integers(d), difference(unit, s, o), difference(unit, t, o)];
    Scaled::from(polynomial::orient3d::<Integers>(&rows)).sign()
}

/// A vector in its own unit, which has no part in the sign.
fn integers<const N: usize>(d: [f64; N]) -> [Integer<COORDINATE_LIMBS>; N] {
    let unit = Unit::of(d);
    d.map(|x| unit.integer(x))
}

fn difference<const N: usize>(unit: Unit, p: [f64; N], o: [f64; N]) -> [Integer<COORDINATE_LIMBS>; N] {
    core::array::from_fn(|k| unit.integer(p[k]).minus(&unit.integer(o[k])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersection::oracle::Sequence;

    /// A number of any magnitude up to 2^1000, or in [1, 2) up to sign.
    fn number(random: &mut Sequence, wide: bool) -> f64 {
        let bits = (random.next() << 31) ^ random.next();
        let mantissa = f64::from_bits((1023 << 52) | (bits % (1 << 52)));
        let sign = if random.next().is_multiple_of(2) { 1.0 } else { -1.0 };
        let exponent = if wide { (random.next() % 2001) as i32 - 1000 } else { 0 };
        sign * mantissa * f64::from_bits(((1023 + exponent) as u64) << 52)
    }

    /// Moves a number by at most two steps.
    fn nudged(random: &mut Sequence, x: f64) -> f64 {
        f64::from_bits(x.to_bits().wrapping_add(random.next() % 5).wrapping_sub(2))
    }

    /// Nearly dependent vectors, of all magnitudes: the filter must not decide wrongly.
    #[test]
    fn the_filter_agrees_with_the_integers() {
        let mut random = Sequence(21);
        let mut nonzero = 0;
        for round in 0..20000 {
            let wide = round % 2 == 0;
            let mut vector = || -> P3 { core::array::from_fn(|_| number(&mut random, wide)) };
            let (d, o, s) = (vector(), vector(), vector());
            let weight = number(&mut random, false);
            // In the plane of the others, but for rounding.
            let t: P3 = core::array::from_fn(|k| nudged(&mut random, s[k] + weight * d[k]));
            let exact = exact_triple(d, o, s, t);
            assert_eq!(triple_sign(d, o, s, t), exact, "{d:?} {o:?} {s:?} {t:?}");
            nonzero += usize::from(!exact.is_zero());
            let flat = |p: P3| [p[0], p[1]];
            let ahead: P2 = core::array::from_fn(|k| nudged(&mut random, o[k] + weight * d[k]));
            let exact = exact_side(flat(o), flat(d), ahead);
            assert_eq!(side_of_direction(flat(o), flat(d), ahead), exact, "{d:?} {o:?} {ahead:?}");
            nonzero += usize::from(!exact.is_zero());
        }
        assert!(nonzero > 20000, "{nonzero}");
    }

    /// Differences that round, times subnormal numbers: relative and absolute errors together.
    #[test]
    fn rounded_products_of_subnormal_numbers_do_not_decide() {
        let mut random = Sequence(22);
        for _ in 0..20000 {
            let d: P2 = [0; 2].map(|_| f64::from_bits((1 << 48) + (random.next() << 16)));
            let o: P2 = [0; 2].map(|_| random.next() as f64 * 2f64.powi(-85));
            let y = 0.5 + random.next() as f64 * 2f64.powi(-33);
            let t = [nudged(&mut random, y * (d[0] / d[1])), y];
            assert_eq!(side_of_direction(o, d, t), exact_side(o, d, t), "{o:?} {d:?} {t:?}");
        }
    }

    /// Each product underflows or overflows.
    #[test]
    fn entries_out_of_range_go_to_the_integers() {
        let tiny = f64::from_bits(1);
        let o = [0.0; 3];
        let sign = |d, s, t| triple_sign(d, o, s, t);
        assert_eq!(sign([tiny, 0.0, 0.0], [0.0, tiny, 0.0], [0.0, 0.0, tiny]), Sign::Positive);
        assert_eq!(sign([1e300, 0.0, 0.0], [0.0, 1e300, 0.0], [0.0, 0.0, -1e300]), Sign::Negative);
        // Two products of which rounding keeps only one.
        let (low, high) = (2f64.powi(-540), 2f64.powi(-530));
        assert_eq!(sign([1e200, 0.0, 0.0], [0.0, low, high], [0.0, -1.5 * low, -1.5 * high]), Sign::Zero);
        assert_eq!(
            sign([1e200, 0.0, 0.0], [0.0, low, high], [0.0, 1.5 * low, 1.5 * high + low]),
            Sign::Positive
        );
        let side = |d, t| side_of_direction([0.0; 2], d, t);
        assert_eq!(side([low, high], [1.5 * low, 1.5 * high]), Sign::Zero);
        assert_eq!(side([low, 3.0 * low], [low, 3.0 * low + 2f64.powi(-590)]), Sign::Positive);
        assert_eq!(side([-1e300, 1e300], [1e300, 1e300]), Sign::Negative);
    }
}
