//! The first stage of a square system: an approximate inverse, and a proof that it is good.
//!
//! # Method
//! `R` is an inverse of `A` computed in rounded arithmetic (Gauss-Jordan, partial pivoting); nothing is assumed
//! of it. Let `y = R b`, rounded; `r = b - A y`; `E = I - R A`. The solution `x` satisfies
//! `x - y = R r + E (x - y)`. If all row sums of `|E|` are at most `alpha < 1`, then `R A`, and so `A`, is
//! regular \[Rump10\], and with `d_i` above `|(R r)_i|`, `D` the largest `d_i`, and `e_i` above the sum of row `i` of `|E|`,
//!
//! ```text
//! |x_i - y_i|  <=  d_i + e_i D / (1 - alpha)  <=  d_i + 2 e_i D        for alpha <= 1/2.
//! ```
//!
//! The stage answers if every bound is at most [`RELATIVE_ERROR`] of `|y_i|`. So zero components, inconsistent
//! and dependent systems always go on to exact arithmetic.
//!
//! # Rounding
//! A sum of k + 1 terms of which k are products errs by at most `g = (k + 1) u / (1 - (k + 1) u)` times the
//! sum of the terms' magnitudes, plus 2^-1075 for each product that underflows. With `m_k` the largest
//! magnitude in row `k` of `A`, row `i` of the rounded `E` errs in each entry by at most
//! `g (1 + sum_k |R_ik| m_k)`, entry `k` of the rounded `r` by at most `g (|b_k| + m_k sum_j |y_j|)`. Both are added. [`GROWTH`]
//! exceeds `g` by the roundings of these bounds themselves, all sums of non-negative terms of depth below 30;
//! [`UNDERFLOW`] what may underflow.
//!
//! Coefficients are zero or between 2^-200 and 2^200; if they are not, rows and columns are multiplied by
//! powers of two first. Overflow makes a bound infinite or NaN, and comparisons with these fail.
//!
//! # Cost
//! About `2 n^3` additions and multiplications and `n` divisions, no branch that random input mispredicts but
//! the pivots'.

use crate::arithmetic::scaled::Scaled;

/// Relative error bound of a component that this stage answers: 2^-20.
pub(super) const RELATIVE_ERROR: f64 = 1.0 / 1_048_576.0;

/// Magnitudes between which coefficients are taken as they are: 2^-200 and 2^200.
const SMALLEST: f64 = f64::from_bits((1023 - 200) << 52);
const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);

/// Larger than the sum of all that underflow may add to a sum of seven terms; a normal number.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52); // 2^-1000

/// 10 u: for six products and one term more, `g` is below 7.01 u; thirty roundings of a bound take less than
/// another u.
const GROWTH: f64 = 10.0 * (f64::EPSILON / 2.0);

/// The solution, each component with a relative error of at most [`RELATIVE_ERROR`]; `None` if that is not
/// certain.
#[inline]
pub(super) fn solve<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    let (mut low, mut high) = (LARGEST, 0.0);
    for &x in a.as_flattened().iter().chain(b) {
        // Zeros do not count; NaN and infinities end in `high`.
        let (x, or_large) = (x.abs(), if x == 0.0 { LARGEST } else { x.abs() });
        low = if or_large < low { or_large } else { low };
        high = if x <= high { high } else { x };
    }
    if low >= SMALLEST && high <= LARGEST { certified(a, b) } else { rescaled(a, b) }
}

/// [`solve`] with rows, columns and the right-hand side multiplied by powers of two that bring the largest of
/// each near one.
#[cold]
fn rescaled<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    /// The exponent of a magnitude: it is between 2^exponent and 2^(exponent + 1). Finite, not zero.
    fn exponent(x: f64) -> i32 {
        let Scaled { mantissa, exponent } = Scaled::of_f64(x);
        exponent + 63 - mantissa.unsigned_abs().leading_zeros() as i32
    }
    fn largest<'v>(values: impl Iterator<Item = (&'v f64, i32)>) -> Option<i32> {
        values.filter(|(x, _)| **x != 0.0).map(|(x, shift)| exponent(*x) + shift).max()
    }
    if !a.as_flattened().iter().chain(b).all(|x| x.is_finite()) {
        return None;
    }
    // A row or column of zeros makes no unique solution.
    let mut rows = [0; N];
    for (shift, row) in rows.iter_mut().zip(a) {
        *shift = -largest(row.iter().map(|x| (x, 0)))?;
    }
    let mut columns = [0; N];
    for (j, shift) in columns.iter_mut().enumerate() {
        *shift = -largest(a.iter().zip(&rows).map(|(row, &shift)| (&row[j], shift)))?;
    }
    let right = -largest(b.iter().zip(rows))?;
    let mut scaled = (*a, *b);
    for (i, row) in scaled.0.iter_mut().enumerate() {
        for (j, x) in row.iter_mut().enumerate() {
            *x = times_power(*x, rows[i] + columns[j])?;
        }
        scaled.1[i] = times_power(b[i], rows[i] + right)?;
    }
    let mut solution = certified(&scaled.0, &scaled.1)?;
    for (x, shift) in solution.iter_mut().zip(columns) {
        *x = Scaled::of_f64(*x).times_power_of_two(shift - right).to_f64();
    }
    Some(solution)
}

/// `x 2^power`, exactly; `None` if it leaves the magnitudes that the bounds allow.
fn times_power(x: f64, power: i32) -> Option<f64> {
    if x == 0.0 {
        return Some(0.0);
    }
    let scaled = Scaled::of_f64(x).times_power_of_two(power).to_f64();
    (SMALLEST..=LARGEST).contains(&scaled.abs()).then_some(scaled)
}

/// The stage, for coefficients of moderate magnitude.
#[inline(always)]
fn certified<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    let inverse = inverse(a)?;
    let y = inverse.map(|row| dot(&row, b));
    let size: f64 = y.iter().map(|y| y.abs()).sum();
    // Of each row of A the largest magnitude, of each entry of r a bound.
    let mut largest = [0.0; N];
    let mut residual = [0.0; N];
    for k in 0..N {
        let mut most = 0.0;
        for x in a[k] {
            most = if x.abs() > most { x.abs() } else { most };
        }
        let r = b[k] - dot(&a[k], &y);
        largest[k] = most;
        residual[k] = r.abs() + (GROWTH * (b[k].abs() + most * size) + UNDERFLOW);
    }
    let mut distance = [0.0; N];
    let mut defect = [0.0; N];
    for i in 0..N {
        let row = &inverse[i];
        let mut product = [0.0; N];
        product[i] = -1.0;
        let (mut reach, mut far) = (0.0, 0.0);
        for k in 0..N {
            for j in 0..N {
                product[j] += row[k] * a[k][j];
            }
            reach += row[k].abs() * largest[k];
            far += row[k].abs() * residual[k];
        }
        let sum: f64 = product.iter().map(|x| x.abs()).sum();
        defect[i] = (sum + (N as f64 * GROWTH * (1.0 + reach) + UNDERFLOW)) * (1.0 + GROWTH);
        distance[i] = (far + UNDERFLOW) * (1.0 + GROWTH);
    }
    let most = distance.iter().fold(0.0, |most, &d| if d > most { d } else { most });
    let certain = (0..N).all(|i| {
        defect[i] <= 0.5 && distance[i] + 2.0 * defect[i] * most <= (0.5 * RELATIVE_ERROR) * y[i].abs()
    });
    certain.then_some(y)
}

#[inline(always)]
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for k in 0..N {
        sum += a[k] * b[k];
    }
    sum
}

/// An approximate inverse, in place, with partial pivoting; `None` at a pivot of zero.
#[inline(always)]
fn inverse<const N: usize>(a: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut m = *a;
    let mut swaps = [0; N];
    for k in 0..N {
        let mut pivot = k;
        for i in k + 1..N {
            if m[i][k].abs() > m[pivot][k].abs() {
                pivot = i;
            }
        }
        if m[pivot][k] == 0.0 {
            return None;
        }
        m.swap(k, pivot);
        swaps[k] = pivot;
        let reciprocal = 1.0 / m[k][k];
        m[k][k] = 1.0;
        for x in &mut m[k] {
            *x *= reciprocal;
        }
        let above = m[k];
        for (i, row) in m.iter_mut().enumerate() {
            if i != k {
                let factor = row[k];
                row[k] = 0.0;
                for j in 0..N {
                    row[j] -= factor * above[j];
                }
            }
        }
    }
    for k in (0..N).rev() {
        for row in &mut m {
            row.swap(k, swaps[k]);
        }
    }
    Some(m)
}
