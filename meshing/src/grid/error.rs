//! [`GridError`]: why there is no such grid.

use thiserror::Error;

use super::{MAX_CELLS_ALONG_AXIS, MAX_NODES};
use crate::io::text::Decimal;
use crate::shapes::{MAX_LENGTH, MIN_LENGTH};

/// Why a grid is refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GridError {
    /// The spacing is no length.
    #[error("spacing is {}, must be a length between {MIN_LENGTH:e} and {MAX_LENGTH:e}", Decimal(*spacing))]
    Spacing {
        /// The spacing asked for.
        spacing: f64,
    },
    /// A coordinate of the origin or of the box to be covered is not finite, or too large.
    #[error("coordinate {axis} is {}, must be at most {MAX_LENGTH:e} in magnitude", Decimal(*value))]
    Coordinate {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// The box to be covered has its corners the wrong way round.
    #[error("the box ends at {} along axis {axis}, before it begins at {}", Decimal(*max), Decimal(*min))]
    Inverted {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// Where it begins.
        min: f64,
        /// Where it ends.
        max: f64,
    },
    /// No cell, or too many, along an axis.
    #[error("{} cells along axis {axis}, must be from 1 to {MAX_CELLS_ALONG_AXIS}", Decimal(*cells))]
    Cells {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// How many cells the grid would have; a float because it may be far beyond what can be counted.
        cells: f64,
    },
    /// More nodes than can be indexed.
    #[error("{nodes:.3e} nodes, more than {MAX_NODES}")]
    Nodes {
        /// How many nodes the grid would have.
        nodes: f64,
    },
    /// A coordinate of a node could only be had rounded.
    #[error(
        "along axis {axis} the nodes from {origin:e} on, {spacing:e} apart, have no exact coordinates; \
         take a spacing and an origin with fewer digits"
    )]
    Inexact {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The first coordinate.
        origin: f64,
        /// The spacing.
        spacing: f64,
    },
}
