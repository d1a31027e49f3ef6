//! Surfaces from fields: [`marching_cubes`], and its twin in the plane, [`marching_squares`].
//!
//! # What it promises
//! * The surface of any samples is closed, oriented and free of self-intersection, with two triangles at every edge and one fan at every vertex,
//!   by construction: see the proof in [`CellCase`]'s module and below. No tolerance decides which samples are negative, and there is no exception for
//!   samples that are exactly zero; vertices that would lie on a node are kept off it by [`MarchingCubes::margin`].
//! * Vertices are shared by keys, not by position: no crack, no duplicate.
//! * The same bits for any number of threads.
//!
//! # What it does not promise
//! * Well-shaped triangles: where the surface passes by a node, triangles are thin.
//! * The topology of the field between its samples.
//!
//! # Why the surface is embedded
//! Nodes have exact coordinates ([`crate::grid`]) and a sample differs from a node in one coordinate: it lies exactly on its edge. In a cell the surface is
//! a part of the boundary of a star-shaped polyhedron, so it does not meet itself; two cells have in common only points of a face, edge or corner,
//! and there both have the same segments. Rounding cannot spoil this: it only decides where on its edge a sample is.
//!
//! # Complexity
//! One pass over the samples, then linear in the rows of the grid and in the cells with surface.

mod cell;
mod crossing;
mod cubes;
mod error;
mod mixed;
mod signs;
mod squares;
mod table;
mod wall;

pub use cubes::{MarchingCubes, marching_cubes, marching_cubes_open};
pub use error::IsosurfaceError;
pub(crate) use mixed::MixedCells;
pub use squares::{Contours, MarchingSquares, SquareCase, SquarePoint, marching_squares};
pub use table::{CellCase, CellPoint, FacePolygon};
