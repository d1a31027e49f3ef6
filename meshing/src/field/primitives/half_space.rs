//! One side of a plane: [`HalfSpace`].

use glam::DVec3;

use crate::field::error::{require_coordinates, require_direction};
use crate::field::{FieldError, ScalarField, direction};

/// The signed distance to a plane; inside is the side opposite to the normal. It has no bounds.
///
/// ```
/// use welter_meshing::{DVec3, field::{HalfSpace, ScalarField}};
/// let below = HalfSpace { point: DVec3::ZERO, normal: 2.0 * DVec3::Z };
/// assert_eq!(below.value(DVec3::new(5.0, 0.0, -3.0)), -3.0);
/// assert_eq!(below.bounds(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// A point of the plane. Default: the origin.
    pub point: DVec3,
    /// Normal, of any length, out of the body. Default: z.
    pub normal: DVec3,
}

impl Default for HalfSpace {
    fn default() -> Self {
        Self { point: DVec3::ZERO, normal: DVec3::Z }
    }
}

impl HalfSpace {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("point", self.point)?;
        require_direction("normal", self.normal)
    }
}

impl ScalarField for HalfSpace {
    fn value(&self, point: DVec3) -> f64 {
        (point - self.point).dot(direction(self.normal, DVec3::Z))
    }

    fn gradient(&self, _point: DVec3, _step: f64) -> DVec3 {
        direction(self.normal, DVec3::Z)
    }
}
