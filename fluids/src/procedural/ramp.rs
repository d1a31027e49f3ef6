//! The function by which a potential goes to zero at a wall: [`ramp`].
//!
//! `R(s)` is the odd polynomial with `R(0) = 0`, `R(1) = 1` and five derivatives that vanish at 1, a member of the family whose one with two
//! is that of \[Bridson07\]:
//! ```text
//!   R(s) = 693/256 integral from 0 to s of (1 - t^2)^5,      R'(s) = 693/256 (1 - s^2)^5
//! ```
//! At the wall its slope is not zero, so the fluid slips along it. Odd, it continues smoothly through the wall, with the
//! same slope on both sides.

/// One over the integral from 0 to 1.
const SLOPE: f64 = 693.0 / 256.0;

/// `R` and `R'`; beyond -1 and 1, which count as those, `R` is constant. NaN for NaN.
pub(super) fn ramp(s: f64) -> (f64, f64) {
    let square = s * s;
    if square >= 1.0 {
        return (s.signum(), 0.0);
    }
    let terms = [1.0, -5.0 / 3.0, 2.0, -10.0 / 7.0, 5.0 / 9.0, -1.0 / 11.0];
    let sum = terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
    let inside = 1.0 - square;
    let fourth = (inside * inside) * (inside * inside);
    (SLOPE * sum * s, SLOPE * fourth * inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_is_odd_and_joins_smoothly() {
        assert_eq!([0.0, 1.0, -1.0, 7.0, -7.0].map(|s| ramp(s).0), [0.0, 1.0, -1.0, 1.0, -1.0]);
        assert_eq!(ramp(0.0).1, SLOPE);
        assert!(ramp(f64::NAN).0.is_nan());
        let mut before = 0.0;
        for i in 1..=1000_u32 {
            let s = f64::from(i) / 1000.0;
            let (value, slope) = ramp(s);
            assert_eq!(ramp(-s), (-value, slope));
            assert!(value >= before && slope >= 0.0, "{s}");
            // (1 - R) is of the order (1 - s)^6.
            let gap = 1.0 - s;
            assert!(1.0 - value <= SLOPE * 32.0 / 6.0 * gap.powi(6) + 2e-15, "{s}: {value}");
            // Simpson's rule on a step of 1/1000.
            let h = 1e-3;
            let way = h / 6.0 * (ramp(s - h).1 + 4.0 * ramp(s - 0.5 * h).1 + slope);
            assert!((value - before - way).abs() < 1e-13, "{s}");
            before = value;
        }
    }
}
