//! The zero of a field along a line: how vertices get onto the surface.
//!
//! # What it computes
//! The point `p + t n` with `f(p + t n) = 0`, `|t| <= reach`, for a unit vector `n` along which the field increases; from `p` the search goes only
//! uphill where the field is negative and only downhill where it is positive. So it finds the sheet whose
//! outside is that of `n`, and not the other side of a thin wall.
//!
//! # Method
//! Newton's step with the slope given, then secants until the zero is between two points, then regula falsi
//! with halving \[Dowell71\], and bisection where that is slow. Each step is kept inside the bracket. The
//! smallest bracket asked for is [`ACCURACY`] of the edge length; the search also ends where the field is as
//! small as its slope times that. Where the gradient vanishes on the surface, as that of a cube of a distance
//! does, the slope is that of differences and the search may end at (STEP_REL^2 ACCURACY)^(1/3) = 5e-6 edge
//! lengths from the zero.
//!
//! # Complexity
//! Three or four values of a smooth field; at most [`MOST_VALUES`].

use super::workpiece::Workpiece;
use crate::DVec3;
use crate::field::ScalarField;

/// How far from the zero the search may end, in edge lengths: 2^-33, about a ten-thousandth of what triangles
/// of a millionth of the radius are off.
const ACCURACY: f64 = 1.0 / (1_u64 << 33) as f64;

/// Values of the field in one search: enough to bisect from an edge length to [`ACCURACY`].
const MOST_VALUES: usize = 48;

/// Values after which bisection takes over.
const MOST_SECANTS: usize = 14;

/// First step where no slope is known, in units of the reach.
const BLIND_STEP: f64 = 0.125;

/// How far vertices are projected, in edge lengths: to the neighbours' places and no farther.
pub(super) const REACH_REL: f64 = 0.5;

impl<F: ScalarField> Workpiece<'_, F> {
    /// The point of the surface on the line through `start` along a unit normal, along which the field
    /// changes at about the rate `slope` (0 if unknown); none if there is no zero within [`REACH_REL`] edge
    /// lengths, or a value on the way is not a number.
    pub(super) fn project(&self, start: DVec3, normal: DVec3, slope: f64) -> Option<DVec3> {
        let value = |t: f64| {
            let value = self.side * self.field.value(start + t * normal);
            (!value.is_nan()).then_some(value)
        };
        zero_along(value, slope, REACH_REL * self.length, ACCURACY * self.length)
            .map(|t| if t == 0.0 { start } else { start + t * normal })
    }
}

/// A zero of an increasing function in `[-reach, reach]`.
fn zero_along(f: impl Fn(f64) -> Option<f64>, slope: f64, reach: f64, accuracy: f64) -> Option<f64> {
    let small = slope * accuracy;
    let (mut near, mut f_near) = (0.0, f(0.0)?);
    if f_near == 0.0 || f_near.abs() <= small {
        return Some(near);
    }
    let way = -f_near.signum();
    let newton = f_near.abs() / slope;
    let mut step = if newton <= reach { newton } else { BLIND_STEP * reach };
    // Until the zero is passed.
    let (mut far, mut f_far, mut values) = loop {
        let t = way * step;
        let value = f(t)?;
        if value == 0.0 || value.abs() <= small {
            return Some(t);
        }
        if value.signum() == way {
            break (t, value, 2);
        }
        if step >= reach {
            return None;
        }
        // Where the secant points to, and somewhat beyond; at least half as far again, at most three times.
        let secant = f_near * (t - near) / (f_near - value);
        let ahead = if secant.is_finite() { (near + 1.25 * secant).abs() } else { 0.0 };
        (near, f_near) = (t, value);
        step = ahead.clamp(1.5 * step, 3.0 * step).min(reach);
    };
    while (far - near).abs() > accuracy && values < MOST_VALUES {
        let mut t = near - f_near * (far - near) / (f_far - f_near);
        let inside = (t - near) * (t - far) < 0.0;
        if !inside || values >= MOST_SECANTS {
            t = near + 0.5 * (far - near);
        }
        let value = f(t)?;
        values += 1;
        if value == 0.0 || value.abs() <= small {
            return Some(t);
        }
        if value.signum() == f_far.signum() {
            f_near *= 0.5; // the end that stays pulls less
        } else {
            (near, f_near) = (far, f_far);
        }
        (far, f_far) = (t, value);
    }
    Some(if f_near.abs() < f_far.abs() { near } else { far })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_of_all_kinds_are_found_within_the_accuracy() {
        type Case = (&'static str, fn(f64) -> f64, f64, f64);
        let functions: [Case; 7] = [
            ("line", |t| t - 0.3, 1.0, 0.3),
            ("line, slope unknown", |t| t - 0.3, 0.0, 0.3),
            ("slope twice too small", |t| t + 0.2, 0.5, -0.2),
            ("slope far too large", |t| t + 0.2, 100.0, -0.2),
            ("triple zero", |t| (t - 0.3).powi(3), 0.0, 0.3),
            ("step", |t| if t < 0.3 { -1.0 } else { 1.0 }, 0.0, 0.3),
            ("infinite", |t| if t < 0.3 { f64::NEG_INFINITY } else { f64::INFINITY }, 0.0, 0.3),
        ];
        for (name, f, slope, zero) in functions {
            let t = zero_along(|t| Some(f(t)), slope, 1.0, 1e-9).unwrap();
            assert!((t - zero).abs() <= 2e-9, "{name}: {t}");
        }
    }

    #[test]
    fn smooth_functions_take_few_values() {
        for zero in [-0.4, -0.1, 1e-3, 0.2] {
            let values = std::cell::Cell::new(0);
            let f = |t: f64| {
                values.set(values.get() + 1);
                Some((t - zero) * (1.0 + 0.2 * (t - zero)))
            };
            zero_along(f, 1.0, 0.5, 1e-10).unwrap();
            assert!(values.get() <= 8, "{} values", values.get());
        }
    }

    #[test]
    fn the_search_goes_uphill_and_ends_at_the_reach() {
        // A zero behind, and none ahead.
        assert_eq!(zero_along(|t| Some(-1.0 - t), 1.0, 0.5, 1e-9), None);
        assert_eq!(zero_along(|t| Some(t - 0.6), 1.0, 0.5, 1e-9), None);
        assert_eq!(zero_along(|_| None, 1.0, 0.5, 1e-9), None);
    }
}
