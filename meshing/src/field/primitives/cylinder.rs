//! Cylinders with flat ends: [`Cylinder`].
//!
//! Method: in the half plane through the axis and the point it is a rectangle, whose distance is that of a box.

use glam::DVec3;

use crate::field::error::{require, require_coordinates, require_length};
use crate::field::{FieldError, ScalarField, direction, grown};
use crate::shapes::MIN_LENGTH;
use crate::spatial::Box3;

/// The signed distance to a cylinder with flat ends.
///
/// Its gradient inside is that to the nearest of side and ends, the side where they are equally near; half way between the ends it is
/// the second end.
///
/// ```
/// use welter_meshing::{DVec3, field::{Cylinder, ScalarField}};
/// let rod = Cylinder { ends: [DVec3::ZERO, 4.0 * DVec3::X], radius: 1.0 };
/// assert_eq!(rod.value(DVec3::new(2.0, 0.0, 0.0)), -1.0);
/// assert_eq!(rod.value(DVec3::new(8.0, 4.0, 0.0)), 5.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Middles of the ends, not equal. Default: -1 and 1 on the z axis.
    pub ends: [DVec3; 2],
    /// Radius, a positive length. Default: 0.5.
    pub radius: f64,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self { ends: [DVec3::NEG_Z, DVec3::Z], radius: 0.5 }
    }
}

impl Cylinder {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("ends", self.ends[0])?;
        require_coordinates("ends", self.ends[1])?;
        require_length("radius", self.radius)?;
        let length = self.ends[0].distance(self.ends[1]);
        require(length >= MIN_LENGTH, "ends", length, "at least 1e-75 apart")
    }

    /// The point relative to the edge of the rectangle (away from the axis, along it), and the two directions.
    fn relative_to_edge(&self, point: DVec3) -> ([f64; 2], [DVec3; 2]) {
        let [a, b] = self.ends;
        let axis = direction(b - a, DVec3::Z);
        let from_center = point - 0.5 * (a + b);
        let height = from_center.dot(axis);
        let radial = from_center - height * axis;
        let outward = direction(radial, axis.any_orthonormal_vector());
        let q = [radial.length() - self.radius, height.abs() - 0.5 * a.distance(b)];
        (q, [outward, if height < 0.0 { -axis } else { axis }])
    }
}

impl ScalarField for Cylinder {
    fn value(&self, point: DVec3) -> f64 {
        let ([across, along], _) = self.relative_to_edge(point);
        if across.is_nan() || along.is_nan() {
            return f64::NAN;
        }
        let (x, y) = (across.max(0.0), along.max(0.0));
        (x * x + y * y).sqrt() + across.max(along).min(0.0)
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let ([across, along], [outward, axis]) = self.relative_to_edge(point);
        let inside = if across >= along { outward } else { axis };
        direction(across.max(0.0) * outward + along.max(0.0) * axis, inside)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let [a, b] = self.ends;
        let axis = direction(b - a, DVec3::Z);
        let reach = self.radius * (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt);
        Some(grown(&Box3::of([a - reach, a + reach, b - reach, b + reach]), level))
    }
}
