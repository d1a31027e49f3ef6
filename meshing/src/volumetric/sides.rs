//! The sides of hexahedra that are the boundary of a mesh: [`boundary_sides`].
//!
//! # What it promises
//! Every face of the complex that has hexahedra on one side only, once, also where it is the side of several coincident hexahedra; in the
//! order of hexahedra and sides, for any number of threads.
//!
//! # What it does not promise
//! A surface without branches: where sheets are glued together, edges have more than two of these faces.
//!
//! # Complexity
//! O(n) while cells have few hexahedra, O(n log n) in any case; no memory but the result, twice.

use rayon::prelude::*;

use super::neighbours::pieces;
use super::{HexMesh, QUADRILATERALS, faces};
use crate::{Cancelled, Monitor};

/// A face with hexahedra on one side only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BoundarySide {
    /// The first hexahedron that it is a side of.
    pub hexahedron: usize,
    /// Which of its sides, 0 to 5, in the order of [`QUADRILATERALS`].
    pub side: usize,
    /// Its vertices: counterclockwise seen from outside.
    pub vertices: [u32; 4],
    /// How many hexahedra it is a side of, all on the same cell.
    pub hexahedra: usize,
}

/// The boundary of a mesh; in parallel.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{HexMesh, boundary_sides}};
/// let grid = Grid3::new([0.0; 3], 0.5, [1; 3])?;
/// let mesh = HexMesh::new(grid, (0..8).collect(), vec![[0, 1, 2, 3, 4, 5, 6, 7]], vec![0])?;
/// let sides = boundary_sides(&mesh, &Monitor::none())?;
/// assert_eq!(sides.len(), 6);
/// assert_eq!((sides[1].side, sides[1].vertices), (1, [1, 3, 7, 5]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn boundary_sides(mesh: &HexMesh, monitor: &Monitor<'_>) -> Result<Vec<BoundarySide>, Cancelled> {
    let stage = monitor.stage("boundary", mesh.len() as u64);
    let parts: Vec<Vec<BoundarySide>> = pieces(mesh)
        .into_par_iter()
        .map(|piece| {
            stage.check()?;
            let hexahedra = piece.len() as u64;
            let mut part = Vec::new();
            faces::visit(mesh, piece, |face| {
                let (members, side) = match (face.below, face.above) {
                    (below, []) => (below, 2 * face.axis + 1),
                    ([], above) => (above, 2 * face.axis),
                    _ => return,
                };
                let vertices = QUADRILATERALS[side].map(|corner| mesh.hexahedra()[members[0]][corner]);
                part.push(BoundarySide { hexahedron: members[0], side, vertices, hexahedra: members.len() });
            });
            stage.advance(hexahedra);
            Ok(part)
        })
        .collect::<Result<_, Cancelled>>()?;
    let mut sides = parts.concat();
    monitor.check()?;
    sides.par_sort_unstable();
    Ok(sides)
}
