//! `exp(-x)` in single precision, for the light at the samples of a ray.
//!
//! Promises: relative error below `(1 + x) 2^-22` for x from 0 to 86, constant beyond; the same bits
//! everywhere: additions, multiplications and shifts only.
//!
//! Method: `2^n 2^f` with `f` from -1/2 to 1/2, the second by its Taylor polynomial of degree 6, of which the
//! next term is below `(ln 2 / 2)^7 / 7! = 1.2e-7`.

/// Coefficients of `2^f`: powers of `ln 2` over factorials.
const TAYLOR: [f32; 7] =
    [1.0, std::f32::consts::LN_2, 0.240_226_5, 0.055_504_11, 0.009_618_129, 0.001_333_355_8, 0.000_154_035_3];

/// Arguments are taken as no larger: `exp(-86)` is 4e-38, next to the least normal number.
const LARGEST: f32 = 86.0;

/// `exp(-x)` for `x` from 0 on, at least `exp(-86)`; that also if `x` is not a number.
#[inline]
pub(super) fn exp_of_minus(x: f32) -> f32 {
    exps_of_minus(&[x])[0]
}

/// `exp(-x)` of each number, step by step for all of them, so that the steps are those of vectors.
#[inline]
pub(super) fn exps_of_minus<const N: usize>(x: &[f32; N]) -> [f32; N] {
    // Adding 1.5 2^23 rounds to an integer, which then is in the last bits.
    const ROUND: f32 = 12_582_912.0;
    let (mut shifted, mut part, mut sum) = ([0.0_f32; N], [0.0_f32; N], [TAYLOR[6]; N]);
    for k in 0..N {
        part[k] = -std::f32::consts::LOG2_E * if x[k] < LARGEST { x[k] } else { LARGEST };
    }
    for k in 0..N {
        shifted[k] = part[k] + ROUND;
    }
    for k in 0..N {
        part[k] -= shifted[k] - ROUND;
    }
    for &coefficient in TAYLOR[..6].iter().rev() {
        for k in 0..N {
            sum[k] = sum[k] * part[k] + coefficient;
        }
    }
    for k in 0..N {
        let power = shifted[k].to_bits().wrapping_sub(ROUND.to_bits()).wrapping_add(127);
        sum[k] *= f32::from_bits(power << 23);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_exponential() {
        let mut worst = 0.0_f64;
        for i in 0..860_000 {
            let x = i as f32 * 1e-4;
            let exact = libm::exp(-f64::from(x));
            worst = worst.max((f64::from(exp_of_minus(x)) - exact).abs() / exact / (1.0 + f64::from(x)));
        }
        // The argument of the power is rounded, which costs in proportion to it.
        assert!(worst < 1.0 / f64::from(1 << 22), "{worst}");
        assert_eq!(exp_of_minus(0.0), 1.0);
        for large in [86.0, 1e30, f32::INFINITY, f32::NAN] {
            assert!((0.0..1e-37).contains(&exp_of_minus(large)));
        }
    }
}
