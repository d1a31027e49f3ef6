//! Bodies at a constant distance from a point, a segment or a circle: [`Ball`], [`Capsule`], [`Torus`].
//!
//! Method: the distance to the point, segment or circle, less a radius. Exact inside and outside, as the boundary is smooth and the
//! radius at most that of its curvature.

use glam::DVec3;

use crate::field::error::{require, require_coordinates, require_direction, require_length};
use crate::field::{FieldError, ScalarField, direction, grown};
use crate::spatial::Box3;

/// The signed distance to a sphere.
///
/// Its gradient at the centre is taken along +x.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ball, ScalarField}};
/// let ball = Ball { center: DVec3::X, radius: 0.5 };
/// assert_eq!(ball.value(DVec3::new(3.0, 0.0, 0.0)), 1.5);
/// assert_eq!(ball.bounds().map(|b| b.max), Some(DVec3::new(1.5, 0.5, 0.5)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre. Default: the origin.
    pub center: DVec3,
    /// Radius, a positive length. Default: 1.
    pub radius: f64,
}

impl Default for Ball {
    fn default() -> Self {
        Self { center: DVec3::ZERO, radius: 1.0 }
    }
}

impl Ball {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("center", self.center)?;
        require_length("radius", self.radius)
    }
}

impl ScalarField for Ball {
    fn value(&self, point: DVec3) -> f64 {
        point.distance(self.center) - self.radius
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        direction(point - self.center, DVec3::X)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        Some(grown(&Box3::of([self.center]), self.radius + level))
    }
}

/// The signed distance to all points within a distance of a segment.
///
/// Its gradient on the segment is taken across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Ends of the segment; a ball if they are equal. Default: from -1 to 1 on the z axis.
    pub ends: [DVec3; 2],
    /// Radius, a positive length. Default: 0.5.
    pub radius: f64,
}

impl Default for Capsule {
    fn default() -> Self {
        Self { ends: [DVec3::NEG_Z, DVec3::Z], radius: 0.5 }
    }
}

impl Capsule {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("ends", self.ends[0])?;
        require_coordinates("ends", self.ends[1])?;
        require_length("radius", self.radius)
    }

    fn relative_to_segment(&self, point: DVec3) -> DVec3 {
        let [a, b] = self.ends;
        let along = b - a;
        let parameter = (point - a).dot(along) / along.length_squared();
        // NaN, for a segment of no length, counts as 0.
        let parameter = if parameter > 0.0 { parameter.min(1.0) } else { 0.0 };
        point - (a + along * parameter)
    }
}

impl ScalarField for Capsule {
    fn value(&self, point: DVec3) -> f64 {
        self.relative_to_segment(point).length() - self.radius
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let across = direction(self.ends[1] - self.ends[0], DVec3::Z).any_orthonormal_vector();
        direction(self.relative_to_segment(point), across)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        Some(grown(&Box3::of(self.ends), self.radius + level))
    }
}

/// The signed distance to a torus.
///
/// Its gradient on the axis and on the circle in the middle of the tube is taken away from the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Centre. Default: the origin.
    pub center: DVec3,
    /// Direction of the axis, of any length. Default: z.
    pub axis: DVec3,
    /// Radius of the circle in the middle of the tube, a positive length. Default: 1.
    pub radius: f64,
    /// Radius of the tube, a positive length of at most `radius`. Default: 0.4.
    pub tube_radius: f64,
}

impl Default for Torus {
    fn default() -> Self {
        Self { center: DVec3::ZERO, axis: DVec3::Z, radius: 1.0, tube_radius: 0.4 }
    }
}

impl Torus {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_coordinates("center", self.center)?;
        require_direction("axis", self.axis)?;
        require_length("radius", self.radius)?;
        require_length("tube_radius", self.tube_radius)?;
        require(self.tube_radius <= self.radius, "tube_radius", self.tube_radius, "at most the radius")
    }

    /// The point relative to the nearest point of the middle circle, and the direction away from the axis.
    fn relative_to_circle(&self, point: DVec3) -> (DVec3, DVec3) {
        let axis = direction(self.axis, DVec3::Z);
        let from_center = point - self.center;
        let height = from_center.dot(axis);
        let radial = from_center - height * axis;
        let outward = direction(radial, axis.any_orthonormal_vector());
        ((radial.length() - self.radius) * outward + height * axis, outward)
    }
}

impl ScalarField for Torus {
    fn value(&self, point: DVec3) -> f64 {
        self.relative_to_circle(point).0.length() - self.tube_radius
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let (from_circle, outward) = self.relative_to_circle(point);
        direction(from_circle, outward)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let axis = direction(self.axis, DVec3::Z);
        // The middle circle reaches `radius sqrt(1 - axis_k^2)` along coordinate k.
        let reach = self.radius * (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt);
        let circle = Box3 { min: self.center - reach, max: self.center + reach };
        Some(if self.tube_radius + level < 0.0 {
            Box3::EMPTY
        } else {
            grown(&circle, self.tube_radius + level)
        })
    }
}
