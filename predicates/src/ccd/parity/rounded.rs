//! The first stage: the whole surface in rounded arithmetic, if every sign that is asked for is certain.
//!
//! **Bounds.** `u = 2^-53`, and `m_k` is at least the magnitude of coordinate `k` of every corner, which is a
//! rounded difference. Multiply a polynomial out: each monomial has been through at most so many roundings
//! `1 + e`, `|e| <= u`, so the error is at most that number of `u`, to first order, times the sum of the
//! monomials' magnitudes:
//!
//! ```text
//!                                                roundings   monomials, at most
//! side, free direction   y_i z_j - y_j z_i            8      8 m_y m_z
//! side, given direction  det(R, p_i, p_j)             7      2 (|R_x| m_y m_z + |R_y| m_z m_x + ...)
//! volume                 det(p_i, p_j, p_k)           8      6 m_x m_y m_z
//! phi                                                18      72 (m_x m_y m_z)^2
//! ```
//!
//! Tests recompute the bounds from the text of the polynomials, step by step as in [`crate::filter`], which
//! gives somewhat less than this table. The constants have at least one `u` to spare, for the higher orders
//! and the rounding of the bound.
//!
//! **Direction.** If it is free it is `(1, g, h)`, whose `det(R, p_i, p_j)` is a minor of `y - g x` and
//! `z - h x`. `g` and `h` are any numbers, those of [`TILT`] times `m_y / m_x` and `m_z / m_x`, so that both
//! terms of a difference are of one order; each is at most that ratio, by a margin that covers its rounding.
//!
//! **Range.** All `m_k` are in [2^-150, 2^150], and the largest magnitude of `R` too. Then nothing overflows,
//! and each underflow adds at most 2^-1075 times four of the `m_k` (at least 1) or less. There are fewer than
//! 2^13 of these, so for `phi` they add less than `2^-1062 m^4` with `m = max(1, m_k)`, against a spare
//! `u (m_x m_y m_z)^2 >= 2^-53 (m 2^-300)^2 = 2^-653 m^2`, or `2^-953` if `m = 1`; for the others the margin
//! is larger.

use super::super::corners::Corners;
use super::surface::{Face, Image, Parity, surface};
use crate::Sign;
use crate::filter::U;
use crate::polynomial::{Rounded, determinant3, minor2, patch_side};

const SIDE: f64 = 57.0 * U;
const SIDE_OF_GIVEN: f64 = 16.0 * U;
const VOLUME: f64 = 47.0 * U;
const PATCH: f64 = 1249.0 * U;

/// 2^-150 and 2^150.
const SMALLEST: f64 = f64::from_bits((1023 - 150) << 52);
const LARGEST: f64 = f64::from_bits((1023 + 150) << 52);

/// In no simple ratio to each other or to 1, so that the planes of a regular mesh do not hold the ray.
const TILT: [f64; 2] = [0.618_033_988_749_894_9, 0.324_717_957_244_746];

/// Corners, rounded, with the errors of what is computed from them.
struct RoundedImage<'c, S> {
    corners: &'c [[f64; 3]],
    side: S,
    side_error: f64,
    volume_error: f64,
    patch_error: f64,
}

impl<'c, S> RoundedImage<'c, S> {
    fn new(corners: &'c [[f64; 3]], [x, y, z]: [f64; 3], side: S, side_error: f64) -> Self {
        let box_volume = x * y * z;
        let patch_error = PATCH * box_volume * box_volume;
        Self { corners, side, side_error, volume_error: VOLUME * box_volume, patch_error }
    }
}

/// The sign of a value, if it is larger than its error.
#[inline(always)]
fn certain(value: f64, error: f64) -> Option<Sign> {
    (value.abs() > error).then(|| Sign::of_nonzero(value))
}

impl<S: Fn(usize, usize) -> f64> Image for RoundedImage<'_, S> {
    #[inline(always)]
    fn side(&self, i: usize, j: usize) -> Option<Sign> {
        certain((self.side)(i, j), self.side_error)
    }
    #[inline(always)]
    fn volume(&self, [i, j, k]: [usize; 3]) -> Option<Sign> {
        let [p, q, r] = [i, j, k].map(|i| &self.corners[i]);
        certain(determinant3::<Rounded>(p, q, r), self.volume_error)
    }
    #[inline(always)]
    fn patch_side(&self, patch: [usize; 4]) -> Option<Sign> {
        certain(patch_side::<Rounded>(patch.map(|i| &self.corners[i])), self.patch_error)
    }
    fn edge_holds_origin(&self, _: usize, _: usize) -> Option<bool> {
        None
    }
    fn flat_patch_holds_origin(&self, _: [usize; 4]) -> Option<bool> {
        None
    }
}

/// The parity for the corners at both ends of a step, and a direction of its own.
#[inline]
pub(super) fn parity_of_step<const K: usize>(corners: &Corners<f64, K>, faces: &[Face]) -> Option<Parity> {
    let maxima = corners.maxima;
    if !in_range(&maxima) {
        return None;
    }
    let [mx, my, mz] = maxima;
    let [g, h] = [TILT[0] * (my / mx), TILT[1] * (mz / mx)];
    let ends = corners.by_corner();
    let across = ends.map(|end| end.map(|[x, y, z]| [y - g * x, z - h * x]));
    let across = across.as_flattened();
    let side = |i: usize, j: usize| {
        let ([y, z], [v, w]) = (across[i], across[j]);
        minor2::<Rounded>(&y, &z, &v, &w)
    };
    surface(&RoundedImage::new(ends.as_flattened(), maxima, side, SIDE * my * mz), faces)
}

/// The parity for a patch and a given direction.
#[inline]
pub(super) fn parity_of_patch(
    corners: &[[f64; 3]; 4],
    direction: &[f64; 3],
    faces: &[Face],
) -> Option<Parity> {
    let maxima = core::array::from_fn(|k| corners.iter().map(|p| p[k].abs()).fold(0.0, f64::max));
    let [rx, ry, rz] = direction.map(f64::abs);
    if !in_range(&maxima) || !in_range(&[rx.max(ry).max(rz)]) {
        return None;
    }
    let [mx, my, mz] = maxima;
    let side = |i: usize, j: usize| determinant3::<Rounded>(direction, &corners[i], &corners[j]);
    let side_error = SIDE_OF_GIVEN * (rx * my * mz + ry * mx * mz + rz * mx * my);
    surface(&RoundedImage::new(corners, maxima, side, side_error), faces)
}

fn in_range(magnitudes: &[f64]) -> bool {
    magnitudes.iter().all(|m| (SMALLEST..=LARGEST).contains(m))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::tests::{Bound, Bounds, DIFFERENCE, EXACT, check};
    use crate::polynomial::{Additive, Times};

    /// Large enough not to matter: overflow is excluded by the range.
    const ANY_SIZE: f64 = 1e9;

    #[test]
    fn constants_cover_the_errors_of_the_same_text() {
        let row = [DIFFERENCE; 3];
        check(determinant3::<Bounds>(&row, &row, &row), 46, VOLUME / U, ANY_SIZE);
        check(patch_side::<Bounds>([&row; 4]), 1248, PATCH / U, ANY_SIZE);
        // y - g x with |g| m_x <= m_y.
        let across: Bound = DIFFERENCE.minus(&EXACT.times(&DIFFERENCE));
        check(minor2::<Bounds>(&across, &across, &across, &across), 56, SIDE / U, ANY_SIZE);
        // Of a given direction the three terms of the bound are 1 here.
        let given = determinant3::<Bounds>(&[EXACT; 3], &row, &row);
        check(given, 40, 3.0 * SIDE_OF_GIVEN / U, ANY_SIZE);
    }
}
