//! Ellipsoids with axes along the coordinate axes: [`Ellipsoid`].
//!
//! # Method
//! The nearest point `x` of the boundary to a point `p` of the first octant has the normal `x_k / a_k^2`, so
//! `p_k = x_k + t x_k / a_k^2` for one number `t`, and
//! ```text
//! x_k = a_k^2 p_k / (t + a_k^2),    g(t) = sum over k of (a_k p_k / (t + a_k^2))^2 - 1 = 0
//! ```
//! Right of `-c`, the square of the least semi-axis among those with `p_k > 0`, `g` is convex and decreases from infinity to -1: one
//! root. Newton's method from a start where `g >= 0` rises to it without passing it; `t = max(a_k p_k - a_k^2)` is such a start.
//!
//! With `p_m = 0` for the least semi-axis `a_m` of all, that root may lie left of `-a_m^2`, and then the nearest point is off the plane
//! `x_m = 0`, at `t = -a_m^2`, with `x_m` from the equation of the ellipsoid.

use glam::DVec3;

use crate::field::error::{require_coordinates, require_length};
use crate::field::{FieldError, ScalarField, direction, grown};
use crate::spatial::Box3;

/// Newton steps taken at most. From the start it takes about log2 of the ratio of the axes to come near the root, then
/// doubles the digits: 20 suffice for ratios of up to a thousand.
const MAX_STEPS: u32 = 200;

/// The signed distance to an ellipsoid: exact, to a few roundings of the largest semi-axis.
///
/// Its gradient at a point that has several nearest points of the boundary leads to one on the positive side.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ellipsoid, ScalarField}};
/// let egg = Ellipsoid { center: DVec3::ZERO, semi_axes: DVec3::new(1.0, 2.0, 3.0) };
/// assert!((egg.value(DVec3::new(0.0, 0.0, 5.0)) - 2.0).abs() < 1e-15);
/// assert!((egg.value(DVec3::ZERO) + 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Centre. Default: the origin.
    pub center: DVec3,
    /// Half of the extents along x, y and z, positive lengths. Default: 1, 0.75, 0.5.
    pub semi_axes: DVec3,
}

impl Default for Ellipsoid {
    fn default() -> Self {
        Self { center: DVec3::ZERO, semi_axes: DVec3::new(1.0, 0.75, 0.5) }
    }
}

impl Ellipsoid {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("center", self.center)?;
        self.semi_axes.to_array().into_iter().try_for_each(|a| require_length("semi_axes", a))
    }

    /// The nearest point of the boundary relative to the centre, in units of the largest semi-axis, in the octant of the point; and
    /// the point there.
    fn nearest(&self, point: DVec3) -> (DVec3, DVec3) {
        let unit = self.semi_axes.max_element();
        let axes = self.semi_axes / unit;
        let point = (point - self.center) / unit;
        let p = point.abs();
        let signs = point.map(|c| if c < 0.0 { -1.0 } else { 1.0 });
        let squares = axes * axes;
        let least = squares.min_element();
        // In terms of s = t + least, so that points next to the plane of a least axis keep their digits.
        let shifts = squares - least;
        let over = |numerator: DVec3, s: f64| {
            let quotient = numerator / (s + shifts);
            DVec3::select(p.cmpgt(DVec3::ZERO), quotient, DVec3::ZERO)
        };
        let x = if self.nearest_is_off_plane(p / axes, squares) {
            let mut x = DVec3::select(shifts.cmpgt(DVec3::ZERO), squares * p / shifts, DVec3::ZERO);
            let axis = (0..3).find(|&k| shifts[k] == 0.0).unwrap_or(0);
            x[axis] = axes[axis] * (1.0 - (x / axes).length_squared()).max(0.0).sqrt();
            x
        } else {
            let mut s = (axes * p - shifts).max_element();
            for _ in 0..MAX_STEPS {
                let y = over(axes * p, s);
                let value = y.length_squared() - 1.0;
                let slope = -2.0 * over(y * y, s).element_sum();
                let next = s - value / slope;
                // Rising stops where rounding makes the step nothing or turns it.
                if !(value > 0.0 && next > s) {
                    break;
                }
                s = next;
            }
            over(squares * p, s)
        };
        (signs * x, point)
    }

    /// Whether the root lies left of the pole of a least semi-axis along which the point has no coordinate: `g` there is negative.
    fn nearest_is_off_plane(&self, scaled: DVec3, squares: DVec3) -> bool {
        let least = squares.min_element();
        let mut sum = 0.0;
        for k in 0..3 {
            if squares[k] == least {
                if scaled[k] > 0.0 {
                    return false;
                }
            } else {
                let x = scaled[k] * squares[k] / (squares[k] - least);
                sum += x * x;
            }
        }
        sum < 1.0
    }
}

impl ScalarField for Ellipsoid {
    fn value(&self, point: DVec3) -> f64 {
        if !point.is_finite() {
            return f64::NAN;
        }
        let unit = self.semi_axes.max_element();
        let (nearest, point) = self.nearest(point);
        let distance = unit * nearest.distance(point);
        let inside = (point * unit / self.semi_axes).length_squared() < 1.0;
        if inside { -distance } else { distance }
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        // The normal of the boundary at the nearest point; well defined on the boundary too.
        let (nearest, _) = self.nearest(point);
        direction(nearest / (self.semi_axes * self.semi_axes) * self.semi_axes.max_element(), DVec3::X)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        Some(grown(&Box3 { min: self.center - self.semi_axes, max: self.center + self.semi_axes }, level))
    }
}
