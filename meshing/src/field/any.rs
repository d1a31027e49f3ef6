//! [`AnyField`]: a field whose type is known only when the program runs.

use std::fmt;
use std::sync::Arc;

use glam::DVec3;

use super::ScalarField;
use crate::grid::Grid3;
use crate::spatial::Box3;
use crate::{Cancelled, Monitor};

/// A field of any type, shared: a node of a tree of fields that is built when the program runs. Copies share the field.
///
/// ```
/// use welter_meshing::{DVec3, field::{AnyField, Ball, ScalarField, Union}};
/// let parts = vec![AnyField::new(Ball::default()), AnyField::new(|p: DVec3| p.x - 2.0)];
/// let union = Union { parts, blend_width: 0.0 };
/// assert_eq!(union.value(DVec3::new(0.5, 0.0, 0.0)), -1.5);
/// ```
#[derive(Clone)]
pub struct AnyField<'a>(Arc<dyn ScalarField + Send + 'a>);

impl<'a> AnyField<'a> {
    /// Shares a field.
    pub fn new(field: impl ScalarField + Send + 'a) -> Self {
        Self(Arc::new(field))
    }
}

impl fmt::Debug for AnyField<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnyField").field("bounds", &self.0.bounds()).finish_non_exhaustive()
    }
}

impl ScalarField for AnyField<'_> {
    fn value(&self, point: DVec3) -> f64 {
        self.0.value(point)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        self.0.gradient(point, step)
    }

    fn bounds(&self) -> Option<Box3> {
        self.0.bounds()
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        self.0.sublevel_bounds(level)
    }

    fn knows_nodes(&self) -> bool {
        self.0.knows_nodes()
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        self.0.at_nodes(grid, monitor)
    }
}
