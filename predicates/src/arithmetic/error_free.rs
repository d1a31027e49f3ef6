//! Sums and products with their rounding errors.
//!
//! Each function gives `(x, y)` with `x` the rounded result and `x + y` the exact one [Dekker71, Knuth97,
//! Shewchuk97]. Conditions, which the callers meet by scaling: no overflow (a factor of a product is below 2^996,
//! where splitting overflows); a product's exact value is a multiple of 2^-1074, else its `y` is off by the
//! underflow. Sums never underflow. No fused multiply-add is assumed: the baseline of x86-64 has none.

/// `a + b`.
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    let b_virtual = x - a;
    let a_virtual = x - b_virtual;
    (x, (a - a_virtual) + (b - b_virtual))
}

/// `a + b` for `|a| >= |b|` or `a = 0`.
#[inline(always)]
pub(crate) fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    (x, b - (x - a))
}

/// `a - b`.
#[inline(always)]
pub(crate) fn two_difference(a: f64, b: f64) -> (f64, f64) {
    two_sum(a, -b)
}

/// `a` as a sum of two numbers of at most 26 bits.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    /// 2^27 + 1.
    const SPLITTER: f64 = 134_217_729.0;
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// `a * b`.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let x = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    let y = a_low * b_low - (((x - a_high * b_high) - a_low * b_high) - a_high * b_low);
    (x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_exact() {
        assert_eq!(two_sum(1e16, 1.0), (1e16, 1.0));
        assert_eq!(two_difference(1e-30, 1e16), (-1e16, 1e-30));
        // (2^30 + 1)(2^29 + 1) = 2^59 + 2^30 + 2^29 + 1.
        let (x, y) = two_product(1_073_741_825.0, 536_870_913.0);
        assert_eq!((x as i64) + (y as i64), (1 << 59) + (1 << 30) + (1 << 29) + 1);
        assert_eq!(y, 1.0);
    }
}
