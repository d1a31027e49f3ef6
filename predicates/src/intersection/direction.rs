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
