//! Boxes, sharp or rounded: [`Cuboid`].
//!
//! Method: by symmetry the point is taken relative to the corner of the box without its rounding; outside the distance is that to the
//! nearest corner, edge or face, inside that to the nearest face.

use glam::DVec3;

use crate::field::error::{require, require_coordinates, require_length_or_zero};
use crate::field::{FieldError, ScalarField, grown};
use crate::spatial::Box3;

/// The signed distance to an axis-parallel box whose edges and corners are rounded, or not.
///
/// Its gradient inside is that to the nearest face; of faces at the same distance, x before y before z, and the positive side.
///
/// ```
/// use welter_meshing::{DVec3, field::{Cuboid, ScalarField}};
/// let cube = Cuboid { rounding: 0.25, ..Cuboid::default() };
/// assert_eq!(cube.value(DVec3::ZERO), -1.0);
/// assert_eq!(cube.value(DVec3::new(0.0, 3.0, 0.5)), 2.0);
/// assert!(cube.value(DVec3::ONE) > 0.1, "the corner is rounded off");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Corner with the smallest coordinates. Default: (-1, -1, -1).
    pub min: DVec3,
    /// Corner with the largest coordinates. Default: (1, 1, 1).
    pub max: DVec3,
    /// Radius of edges and corners, from 0 to half of the shortest side. Default: 0.
    pub rounding: f64,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { min: DVec3::NEG_ONE, max: DVec3::ONE, rounding: 0.0 }
    }
}

impl Cuboid {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("min", self.min)?;
        require_coordinates("max", self.max)?;
        require_length_or_zero("rounding", self.rounding)?;
        let shortest = (self.max - self.min).min_element();
        require(shortest > 0.0, "max", shortest, "above min in each coordinate")?;
        require(
            2.0 * self.rounding <= shortest,
            "rounding",
            self.rounding,
            "at most half of the shortest side",
        )
    }

    /// The point relative to the core's nearest corner, and the signs of the octant.
    fn relative_to_core(&self, point: DVec3) -> (DVec3, DVec3) {
        let (center, half) = (0.5 * (self.min + self.max), 0.5 * (self.max - self.min));
        let from_center = point - center;
        let signs = from_center.map(|c| if c < 0.0 { -1.0 } else { 1.0 });
        (from_center.abs() - (half - self.rounding), signs)
    }
}

impl ScalarField for Cuboid {
    fn value(&self, point: DVec3) -> f64 {
        let (q, _) = self.relative_to_core(point);
        if q.is_nan() {
            return f64::NAN;
        }
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0) - self.rounding
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let (q, signs) = self.relative_to_core(point);
        let outside = q.max(DVec3::ZERO);
        if outside != DVec3::ZERO {
            return signs * outside / outside.length();
        }
        let axis = if q.x >= q.y && q.x >= q.z {
            DVec3::X
        } else if q.y >= q.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        signs * axis
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        Some(grown(&Box3 { min: self.min, max: self.max }, level))
    }
}
