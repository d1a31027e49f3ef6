//! The part of a grid where a level set is negative, cell by cell: [`CutCells`].
//!
//! # What it computes
//! For every cell that the surface passes through, the polyhedron of its negative part, the triangles of the surface in it and the polygons on its faces; and
//! which cells are negative as a whole. Quadrature over all of them.
//!
//! # What it promises
//! * The surface is that of [`marching_cubes_open`](crate::isosurface::marching_cubes_open) with the same parameters, vertex by vertex.
//! * Tetrahedra are positively oriented and tile the polyhedron, whatever the samples are ([`CellCase`](crate::isosurface::CellCase)); volumes and areas add up to those
//!   of the whole surface, but for rounding.
//! * Quadrature with a rule of a degree integrates polynomials of that degree over polyhedra, surfaces and faces without error, but for rounding. The degrees that
//!   products of quadratic B-splines need are constants: [`MASS_DEGREE`], [`DIVERGENCE_DEGREE`], [`BOUNDARY_DEGREE`].
//! * The same bits for any number of threads.
//!
//! # What it does not promise
//! The positive part: that is the negative part of the opposite samples, and their surface differs on ambiguous faces.
//!
//! # Method
//! Marching cubes with tetrahedra \[Gagniere22\] (2.5.1). The integrals there are over these pieces; all integrands are polynomials on a cell.
//!
//! # Complexity
//! One pass over the samples, with one bit for each while it runs; all else in the number of cut cells and, for cells inside, of rows.

mod cell;
mod cells;
mod integration;

pub use cell::CutCell;
pub use cells::{CellKind, CutCells};
pub use integration::{
    BOUNDARY_DEGREE, DIVERGENCE_DEGREE, LUMPED_MASS_DEGREE, MASS_DEGREE, SurfacePoint, VolumePoint,
};
