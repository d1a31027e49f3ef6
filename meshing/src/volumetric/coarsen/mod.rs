//! Half as many hexahedra along each axis, with the topology kept where the coarse grid can: [`coarsen`].
//!
//! # What it computes
//! The mesh on cells twice as large. The fine hexahedra in one coarse cell that hang together there become one coarse hexahedron; two
//! that do not hang together there become two on the same cell.
//!
//! # What it promises
//! * Every fine hexahedron lies within its coarse one, and hexahedra with a face in common get coarse ones that are the
//!   same or have a side in common. No others are glued, so components are not joined.
//! * [`coarsen_checked`] reports every component whose number of pieces or Euler characteristic changed, and Betti numbers too where these
//!   are affordable.
//! * The same for any number of threads.
//!
//! # What it does not promise
//! That the topology is kept: a tunnel or cavity smaller than a coarse cell is filled, and hexahedra that hang together by edges or corners
//! only come apart. The report tells; the caller stays at the finer mesh then.
//!
//! # Method
//! \[Gagniere22\] 3.8. Each fine hexahedron is thought to be a coarse one of its own, with corners of its own. Two with a face in common that
//! are not coincident and in the same coarse cell are one; in different coarse cells, they get the vertices of the side where these meet in
//! common; coincident ones, those of the side that the face is of them. Here the first rule is applied by union-find over
//! hexahedra, and the others over the corners of what it leaves.
//!
//! # Complexity
//! O(n log n) time; 8 bytes a fine hexahedron and 72 a coarse one, apart from the result.

mod gluing;
mod groups;
mod report;

use thiserror::Error;

use super::HexMesh;
use crate::grid::{Grid3, GridError};
use crate::{Cancelled, Monitor};
use groups::Groups;
pub use report::{TopologyChange, TopologyReport, coarsen_checked};

/// A coarse mesh and what became of the fine hexahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct Coarsening {
    /// The coarse mesh. Its grid has the same first node, and one more layer of fine cells where their number is odd.
    pub mesh: HexMesh,
    /// The coarse hexahedron of each fine one.
    pub coarse_of: Vec<u32>,
}

/// Why a mesh was not coarsened.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CoarsenError {
    /// There is no grid of cells twice as large.
    #[error("the coarse grid: {0}")]
    Grid(#[from] GridError),
    /// Hexahedra or corners of coarse ones cannot be numbered with 32 bits.
    #[error("{hexahedra} hexahedra in {groups} groups are too many")]
    TooMany {
        /// Fine hexahedra.
        hexahedra: usize,
        /// Coarse ones; 0 if they were not counted.
        groups: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The mesh on cells twice as large; in parallel.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{HexMesh, coarsen}};
/// // Two hexahedra one after the other, of one coarse cell.
/// let grid = Grid3::new([0.0; 3], 0.5, [2, 1, 1])?;
/// let mesh = HexMesh::new(
///     grid,
///     (0..12).collect(),
///     vec![[0, 1, 3, 4, 6, 7, 9, 10], [1, 2, 4, 5, 7, 8, 10, 11]],
///     vec![0, 1],
/// )?;
/// let coarsening = coarsen(&mesh, &Monitor::none())?;
/// assert_eq!(coarsening.mesh.grid().cells(), [1; 3]);
/// assert_eq!(coarsening.mesh.grid().spacing(), 1.0);
/// assert_eq!(coarsening.coarse_of, [0, 0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CoarsenError`]: no such grid, too many hexahedra, or cancelled.
pub fn coarsen(mesh: &HexMesh, monitor: &Monitor<'_>) -> Result<Coarsening, CoarsenError> {
    let coarse = doubled(mesh.grid())?;
    if u32::try_from(mesh.len()).is_err() {
        return Err(CoarsenError::TooMany { hexahedra: mesh.len(), groups: 0 });
    }
    let groups = Groups::of(mesh, &coarse, monitor)?;
    if u32::try_from(8 * groups.cells.len()).is_err() {
        return Err(CoarsenError::TooMany { hexahedra: mesh.len(), groups: groups.cells.len() });
    }
    let corners = gluing::glue(mesh, &groups, monitor)?;
    let (mesh, hexahedron_of) = gluing::assemble(coarse, &groups, &corners, monitor)?;
    let mut coarse_of = groups.of;
    coarse_of.iter_mut().for_each(|group| *group = hexahedron_of[*group as usize]);
    Ok(Coarsening { mesh, coarse_of })
}

/// The grid of cells twice as large with the same first node, that covers a grid.
fn doubled(grid: &Grid3) -> Result<Grid3, GridError> {
    Grid3::new(grid.origin(), 2.0 * grid.spacing(), grid.cells().map(|cells| cells.div_ceil(2)))
}
