//! The faces of the complex, each with the hexahedra on both of its sides: [`visit`].
//!
//! A face is a set of four vertices at the corners of a face of the grid. Several may lie at the same place, and each can have several
//! hexahedra above and below it, all of which lie on one cell.
//!
//! Method: the hexahedra of the two cells at a face of the grid are sorted by the four vertices. Most often there are two at
//! most, and nothing is sorted. Complexity: O(n) while cells have few hexahedra, O(n log n) in any case.

use std::ops::Range;

use super::neighbours::{Cursor, occupied};
use super::{HexMesh, QUADRILATERALS};

/// A face of the complex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face<'a> {
    /// The axis that it is normal to.
    pub(super) axis: usize,
    /// Its vertices: counterclockwise seen from above.
    pub(super) vertices: [u32; 4],
    /// The hexahedra before it along the axis, of which it is the upper side, ascending.
    pub(super) below: &'a [usize],
    /// The hexahedra behind it, of which it is the lower side, ascending.
    pub(super) above: &'a [usize],
}

/// Calls `each` for every face of the hexahedra of a piece whose upper hexahedra are in the piece, or whose lower ones are where
/// there is nothing on the cell above. So all pieces together visit every face once.
pub(super) fn visit(mesh: &HexMesh, piece: Range<usize>, mut each: impl FnMut(&Face<'_>)) {
    let mut lower = [0, 1, 2].map(|axis| Cursor::along(axis, -1));
    let mut upper = [0, 1, 2].map(|axis| Cursor::along(axis, 1));
    let mut members = Members::default();
    for (cell, own) in occupied(mesh, piece) {
        for axis in 0..3 {
            let below = lower[axis].hexahedra(mesh, cell);
            members.visit(mesh, axis, below, own.clone(), &mut each);
            if upper[axis].hexahedra(mesh, cell).is_empty() {
                members.visit(mesh, axis, own.clone(), 0..0, &mut each);
            }
        }
    }
}

/// The corners of the lower and the upper side along an axis: those at the same place in turn have the same place in the list.
fn corners(axis: usize, upper: bool) -> [usize; 4] {
    let corners = QUADRILATERALS[2 * axis + 1];
    if upper { corners } else { corners.map(|corner| corner ^ (1 << axis)) }
}

fn quadrilateral(mesh: &HexMesh, hexahedron: usize, axis: usize, upper: bool) -> [u32; 4] {
    let vertices = mesh.hexahedra()[hexahedron];
    corners(axis, upper).map(|corner| vertices[corner])
}

/// The hexahedra at a face of the grid, sorted by their vertices on it. Vertices at different nodes differ, so the same
/// vertices always come in the same order.
#[derive(Default)]
struct Members {
    sorted: Vec<([u32; 4], bool, usize)>,
    hexahedra: Vec<usize>,
}

impl Members {
    fn visit(
        &mut self,
        mesh: &HexMesh,
        axis: usize,
        below: Range<usize>,
        above: Range<usize>,
        each: &mut impl FnMut(&Face<'_>),
    ) {
        if below.len() == 1 && above.len() == 1 {
            let pair = [below.start, above.start];
            let vertices = quadrilateral(mesh, pair[0], axis, true);
            if vertices == quadrilateral(mesh, pair[1], axis, false) {
                return each(&Face { axis, vertices, below: &pair[..1], above: &pair[1..] });
            }
        }
        self.sorted.clear();
        self.sorted.extend(below.map(|h| (quadrilateral(mesh, h, axis, true), false, h)));
        self.sorted.extend(above.map(|h| (quadrilateral(mesh, h, axis, false), true, h)));
        self.sorted.sort_unstable();
        for group in self.sorted.chunk_by(|a, b| a.0 == b.0) {
            self.hexahedra.clear();
            self.hexahedra.extend(group.iter().map(|&(_, _, h)| h));
            let split = group.partition_point(|&(_, is_above, _)| !is_above);
            let (below, above) = self.hexahedra.split_at(split);
            each(&Face { axis, vertices: group[0].0, below, above });
        }
    }
}
