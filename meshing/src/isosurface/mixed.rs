//! [`MixedCells`]: the cells that a surface passes through and the vertices on their edges, for the crate's own use.

use super::crossing::{Crossings, require_room};
use super::cubes::{for_each_mixed_cell, positions};
use super::signs::Signs;
use super::{CellCase, IsosurfaceError, MarchingCubes};
use crate::grid::Samples;
use crate::{DVec3, Monitor};

/// The cells of a grid that the surface of samples passes through.
pub(crate) struct MixedCells<'a> {
    signs: Signs,
    crossings: Crossings<'a>,
}

impl<'a> MixedCells<'a> {
    pub(crate) fn new(
        samples: &'a Samples<3>,
        parameters: &'a MarchingCubes<'a>,
        monitor: &Monitor<'_>,
    ) -> Result<Self, IsosurfaceError> {
        parameters.validate()?;
        require_room(samples.grid(), parameters.margin)?;
        let signs = Signs::new(samples, parameters.level, false, monitor)?;
        Ok(Self { signs, crossings: Crossings { samples, parameters } })
    }

    pub(crate) fn is_negative(&self, node: [u32; 3]) -> bool {
        self.signs.is_negative(node)
    }

    /// The vertices, in the order of their numbers.
    pub(crate) fn positions(&self, monitor: &Monitor<'_>) -> Result<Vec<DVec3>, IsosurfaceError> {
        positions(&self.signs, &self.crossings, monitor)
    }

    /// Calls `visit` with every such cell of a layer, in the order of cell numbers, and the numbers of the vertices on its edges.
    pub(crate) fn for_each_in_layer(&self, k: u32, mut visit: impl FnMut([u32; 3], CellCase, [u32; 12])) {
        for_each_mixed_cell(&self.signs, k, |cell, case, edges| visit(cell, case, edges.numbers()));
    }
}
