//! [`IsosurfaceError`]: why there is no surface.

use thiserror::Error;

use crate::Cancelled;
use crate::grid::NotANumber;

/// Why a field has no surface on a grid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum IsosurfaceError {
    /// A sample is NaN: it lies on no side.
    #[error(transparent)]
    NotANumber(#[from] NotANumber),
    /// A parameter is outside of its range.
    #[error("{parameter} is {value}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
    /// So far from the origin there are too few numbers between neighbouring nodes to keep a sample off both of them.
    #[error(
        "along axis {axis} the nodes are {spacing:e} apart but numbers near {coordinate:e} are {gap:e} apart: \
         too few lie between two nodes; move the grid nearer to the origin"
    )]
    TooFine {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The largest coordinate along that axis.
        coordinate: f64,
        /// The distance of numbers there.
        gap: f64,
        /// The spacing of the grid.
        spacing: f64,
    },
    /// More vertices or triangles than ids.
    #[error("the surface has {count} {what}, more than can be numbered with 32 bits")]
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// How many.
        count: u64,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
