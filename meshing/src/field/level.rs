//! Fields by their values alone: [`Offset`], [`Shell`], [`Complement`].

use glam::DVec3;

use crate::field::error::{require, require_length};
use crate::field::{FieldError, ScalarField, nodes};
use crate::grid::Grid3;
use crate::shapes::MAX_LENGTH;
use crate::spatial::Box3;
use crate::{Cancelled, Monitor};

/// A field less a constant: of a distance, the surface at a distance outward, or inward for a negative one.
///
/// Of an exact distance it is one again outside of an outward offset and inside of an inward one; on the other side it is a bound, as
/// the offset of an edge is rounded on one side and keeps its edge on the other.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ball, Offset, ScalarField}};
/// let larger = Offset { field: Ball::default(), distance: 0.25 };
/// assert_eq!(larger.value(DVec3::new(2.25, 0.0, 0.0)), 1.0);
/// assert_eq!(larger.bounds().map(|b| b.max.x), Some(1.25));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Offset<F> {
    /// What is offset.
    pub field: F,
    /// How far outward; negative for inward. Default: 0.
    pub distance: f64,
}

impl<F> Offset<F> {
    /// Whether the distance is in range.
    ///
    /// # Errors
    /// [`FieldError`] if not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require(self.distance.abs() <= MAX_LENGTH, "distance", self.distance, "at most 1e75 in magnitude")
    }
}

impl<F: ScalarField> ScalarField for Offset<F> {
    fn value(&self, point: DVec3) -> f64 {
        self.field.value(point) - self.distance
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        self.field.gradient(point, step)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        self.field.sublevel_bounds(level + self.distance)
    }

    fn knows_nodes(&self) -> bool {
        self.field.knows_nodes()
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.field.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        Ok(nodes::mapped(self.field.at_nodes(grid, monitor)?, |value| value - self.distance))
    }
}

/// Everything within half of a thickness of the surface of a field, on both sides.
///
/// Its gradient on the surface is that of the field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shell<F> {
    /// What has the surface.
    pub field: F,
    /// Thickness, a positive length.
    pub thickness: f64,
}

impl<F> Shell<F> {
    /// Whether the thickness is in range.
    ///
    /// # Errors
    /// [`FieldError`] if not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_length("thickness", self.thickness)
    }
}

impl<F: ScalarField> ScalarField for Shell<F> {
    fn value(&self, point: DVec3) -> f64 {
        self.field.value(point).abs() - 0.5 * self.thickness
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        let gradient = self.field.gradient(point, step);
        if self.field.value(point) < 0.0 { -gradient } else { gradient }
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        self.field.sublevel_bounds(level + 0.5 * self.thickness)
    }

    fn knows_nodes(&self) -> bool {
        self.field.knows_nodes()
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.field.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        Ok(nodes::mapped(self.field.at_nodes(grid, monitor)?, |value| value.abs() - 0.5 * self.thickness))
    }
}

/// Everything that is not in a field: its negation. It has no bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Complement<F> {
    /// What is left out.
    pub field: F,
}

impl<F: ScalarField> ScalarField for Complement<F> {
    fn value(&self, point: DVec3) -> f64 {
        -self.field.value(point)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        -self.field.gradient(point, step)
    }

    fn knows_nodes(&self) -> bool {
        self.field.knows_nodes()
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.field.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        Ok(nodes::mapped(self.field.at_nodes(grid, monitor)?, |value| -value))
    }
}
