//! Scalar fields in space: [`ScalarField`]. A surface is where a field is zero; it is negative inside and positive outside.

use glam::DVec3;

use crate::spatial::Box3;

/// A number at each point of space. Negative inside of the surface that it stands for, positive outside.
///
/// Every function of a point is one:
///
/// ```
/// use welter_meshing::{DVec3, field::ScalarField};
/// let ball = |p: DVec3| p.length() - 1.0;
/// assert_eq!(ball.value(DVec3::ZERO), -1.0);
/// assert!(ball.gradient(DVec3::X, 1e-3).abs_diff_eq(DVec3::X, 1e-6));
/// ```
pub trait ScalarField: Sync {
    /// The value at a point.
    fn value(&self, point: DVec3) -> f64;

    /// The gradient at a point. Fields without a closed form take central differences over `step` to each side, a
    /// length over which the field changes little; others do not look at it.
    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        let along = |axis: DVec3| self.value(point + step * axis) - self.value(point - step * axis);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)) / (2.0 * step)
    }

    /// A box outside of which the field is positive, if it is known.
    fn bounds(&self) -> Option<Box3> {
        None
    }
}

impl<F: Fn(DVec3) -> f64 + Sync> ScalarField for F {
    fn value(&self, point: DVec3) -> f64 {
        self(point)
    }
}
