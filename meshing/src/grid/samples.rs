//! [`Samples`]: one number at each node of a grid.

use rayon::prelude::*;
use thiserror::Error;

use super::Grid;
use crate::field::ScalarField;
use crate::{Cancelled, Monitor};

/// A sample is NaN.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("the sample at node {node:?}, position {position:?}, is not a number")]
pub struct NotANumber {
    /// The index of the first such node along each axis, in the order of node numbers.
    pub node: Vec<u32>,
    /// Its coordinates.
    pub position: Vec<f64>,
}

/// A number at each node of a grid, x fastest. Numbers may be infinite or NaN; who cannot use those says so.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}};
/// let grid = Grid3::covering([-1.0; 3], [1.0; 3], 0.25, 0)?;
/// let samples = Samples::of(&grid, &|p: DVec3| p.length() - 0.8, &Monitor::none())?;
/// assert_eq!(samples.at([4, 4, 4]), -0.8);
/// assert!((samples.interpolate([0.3, 0.0, 0.0]) + 0.5).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Samples<const D: usize> {
    grid: Grid<D>,
    values: Vec<f64>,
}

impl<const D: usize> Samples<D> {
    /// The samples with these values, in the order of node numbers.
    ///
    /// # Panics
    /// If there are not as many values as the grid has nodes.
    #[must_use]
    pub fn new(grid: Grid<D>, values: Vec<f64>) -> Self {
        assert_eq!(values.len(), grid.node_count(), "one value at each node");
        Self { grid, values }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid<D> {
        &self.grid
    }

    /// The values in the order of node numbers.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values in the order of node numbers, to be changed.
    #[must_use]
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The values, taken out.
    #[must_use]
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// The value at a node.
    #[inline]
    #[must_use]
    pub fn at(&self, node: [u32; D]) -> f64 {
        self.values[self.grid.node_index(node)]
    }

    /// The multilinear interpolant; outside of the grid, that at the nearest point of it.
    #[must_use]
    pub fn interpolate(&self, point: [f64; D]) -> f64 {
        let (cell, inside) = self.grid.locate(point);
        let mut sum = 0.0;
        for corner in 0..1_usize << D {
            let far = |axis: usize| (corner >> axis & 1) as u32;
            let weight: f64 =
                (0..D).map(|axis| if far(axis) == 1 { inside[axis] } else { 1.0 - inside[axis] }).product();
            if weight != 0.0 {
                sum += weight * self.at(std::array::from_fn(|axis| cell[axis] + far(axis)));
            }
        }
        sum
    }

    /// Whether every sample is a number; infinite ones are.
    ///
    /// # Errors
    /// [`NotANumber`] with the first node whose sample is not.
    pub fn require_numbers(&self) -> Result<(), NotANumber> {
        match self.values.par_iter().position_first(|v| v.is_nan()) {
            None => Ok(()),
            Some(number) => {
                let node = self.grid.node_at(number);
                Err(NotANumber { node: node.to_vec(), position: self.grid.node(node).to_vec() })
            }
        }
    }
}

impl Samples<3> {
    /// The values of a field at the nodes of a grid; in parallel.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn of(grid: &Grid<3>, field: &impl ScalarField, monitor: &Monitor<'_>) -> Result<Self, Cancelled> {
        Ok(Self { grid: *grid, values: field.at_nodes(grid, monitor)? })
    }
}
