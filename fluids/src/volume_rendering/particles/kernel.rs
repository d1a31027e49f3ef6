//! The kernel of a particle, integrated along lines.
//!
//! `W(r) = 105 / (32 pi h^3) (1 - r^2/h^2)^2` inside of `h`. On a line at a distance `b` from the middle, with `w = 1 - b^2/h^2`, it is
//! `105 / (32 pi h^3) w^2 (1 - x^2)^2` with `x` from -1 to 1 over the chord of length `2 h sqrt(w)`. So the column through the whole of
//! it is `7 / (2 pi h^2) w^(5/2)`, and the part up to `x` is a polynomial.

use std::f64::consts::PI;

/// The column through the middle of a particle of volume `(h / radius_rel)^3`, as a length: its thickness in smoke of density 1.
pub(super) fn thickness(h: f64, radius_rel: f64) -> f64 {
    7.0 / (2.0 * PI) * h / (radius_rel * radius_rel * radius_rel)
}

/// The part of the column before a place, from 0 at -1 to 1 at 1.
#[inline]
pub(super) fn part_before(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    let square = x * x;
    0.5 + x * (0.9375 - square * (0.625 - 0.1875 * square))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_add_up_to_the_volume() {
        let (h, factor, rings) = (0.7_f64, 1.7, 20_000);
        let width = h / f64::from(rings);
        let sum: f64 = (0..rings)
            .map(|i| {
                let b = (f64::from(i) + 0.5) * width;
                2.0 * PI * b * width * thickness(h, factor) * (1.0 - (b / h) * (b / h)).powf(2.5)
            })
            .sum();
        let volume = (h / factor).powi(3);
        assert!((sum - volume).abs() < 1e-8 * volume, "{sum} {volume}");
    }

    #[test]
    fn parts_are_integrals_of_the_kernel() {
        assert_eq!([-2.0, -1.0, 0.0, 1.0, 3.0].map(part_before), [0.0, 0.0, 0.5, 1.0, 1.0]);
        let (steps, mut sum) = (2000, 0.0);
        for i in 0..steps {
            let middle = (f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0;
            sum += 15.0 / 16.0 * (1.0 - middle * middle).powi(2) * 2.0 / f64::from(steps);
            let end = f64::from(i + 1) / f64::from(steps) * 2.0 - 1.0;
            assert!((part_before(end) - sum).abs() < 1e-6, "{end}");
        }
    }
}
