//! Regular grids of square and cubic cells: [`Grid`], and numbers at their nodes: [`Samples`].
//!
//! # What it promises
//! * Every coordinate of a node is computed without rounding. So a predicate that is asked about a node speaks of the real
//!   node, and a point that is moved along an edge of the grid lies on that edge exactly.
//! * Nodes are numbered with x fastest, then y, then z; so are cells.
//!
//! # What it does not promise
//! That a grid begins exactly where it was asked to: [`Grid::covering`] rounds its spacing to 24 significant bits and its
//! origin to a multiple of that, so as to keep the first promise.
//!
//! # Method
//! An origin and a spacing whose multiples fit into 53 bits, which is checked when a grid is made.

mod error;
mod lattice;
mod samples;
mod search;

pub use error::GridError;
pub use lattice::{Grid, Grid2, Grid3, MAX_CELLS_ALONG_AXIS, MAX_NODES};
pub use samples::{NotANumber, Samples};
pub(crate) use search::{first_at, first_where, nodes_between};
