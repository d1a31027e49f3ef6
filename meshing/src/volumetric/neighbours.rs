//! Which hexahedra lie on the cells around a cell: [`pieces`], [`occupied`], [`Cursor`].
//!
//! Method: cells ascend, so the cells at a fixed step from them ascend too. A cursor for each step walks through the list of cells once
//! as the cells do: no table of the grid is kept, and memory is read in order.
//!
//! Complexity: O(log n) to begin, then O(1) amortised for each cell asked for.

use std::ops::Range;

use super::HexMesh;
use crate::grid::Grid3;

/// About how many hexahedra one thread takes at a time. A fixed number, so that pieces do not depend on the number of threads.
const PIECE: usize = 1 << 14;

/// The hexahedra in ranges of about the same length that begin and end where a cell does.
pub(super) fn pieces(mesh: &HexMesh) -> Vec<Range<usize>> {
    let cells = mesh.cells();
    let mut starts: Vec<usize> =
        (0..cells.len()).step_by(PIECE).map(|at| cells.partition_point(|&cell| cell < cells[at])).collect();
    starts.dedup();
    starts.push(cells.len());
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

/// The occupied cells of a piece, ascending, each with its hexahedra.
pub(super) fn occupied(
    mesh: &HexMesh,
    piece: Range<usize>,
) -> impl Iterator<Item = ([u32; 3], Range<usize>)> + '_ {
    let mut first = piece.start;
    mesh.cells()[piece].chunk_by(|a, b| a == b).map(move |run| {
        let own = first..first + run.len();
        first = own.end;
        (mesh.grid().cell_at(run[0] as usize), own)
    })
}

/// Finds the hexahedra at one step from cells that are asked for in ascending order.
#[derive(Clone, Debug)]
pub(super) struct Cursor {
    step: [i32; 3],
    at: usize,
}

impl Cursor {
    pub(super) fn new(step: [i32; 3]) -> Self {
        Self { step, at: 0 }
    }

    /// A step of `by` cells along one axis.
    pub(super) fn along(axis: usize, by: i32) -> Self {
        let mut step = [0; 3];
        step[axis] = by;
        Self::new(step)
    }

    /// The hexahedra on the cell at the step from `cell`, none if the grid has no such cell. `cell` must not be before one asked for.
    pub(super) fn hexahedra(&mut self, mesh: &HexMesh, cell: [u32; 3]) -> Range<usize> {
        let Some(cell) = stepped(mesh.grid(), cell, self.step) else { return 0..0 };
        let number = mesh.grid().cell_index(cell) as u64;
        let cells = mesh.cells();
        self.at = first_not_below(cells, self.at, number);
        let count = cells[self.at..].iter().take_while(|&&c| c == number).count();
        self.at..self.at + count
    }
}

fn stepped(grid: &Grid3, cell: [u32; 3], step: [i32; 3]) -> Option<[u32; 3]> {
    let mut to = [0; 3];
    for axis in 0..3 {
        to[axis] = cell[axis].checked_add_signed(step[axis]).filter(|&i| i < grid.cells()[axis])?;
    }
    Some(to)
}

/// The first place from `from` on whose cell is not below a number: steps that double, then bisection.
fn first_not_below(cells: &[u64], from: usize, number: u64) -> usize {
    let rest = &cells[from..];
    let mut bound = 1;
    while bound <= rest.len() && rest[bound - 1] < number {
        bound *= 2;
    }
    let low = bound / 2;
    from + low + rest[low..bound.min(rest.len())].partition_point(|&cell| cell < number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn galloping_finds_what_a_scan_finds() {
        let cells = [1, 1, 3, 4, 4, 4, 7, 9, 9, 12];
        for from in 0..=cells.len() {
            for number in 0..14 {
                let scan = (from..cells.len()).find(|&i| cells[i] >= number).unwrap_or(cells.len());
                assert_eq!(first_not_below(&cells, from, number), scan, "{from} {number}");
            }
        }
    }

    #[test]
    fn steps_end_at_the_grid() {
        let grid = Grid3::new([0.0; 3], 1.0, [2, 3, 4]).unwrap();
        assert_eq!(stepped(&grid, [0, 0, 0], [-1, 0, 0]), None);
        assert_eq!(stepped(&grid, [1, 2, 3], [0, 0, 1]), None);
        assert_eq!(stepped(&grid, [1, 2, 2], [-1, 0, 1]), Some([0, 2, 3]));
    }
}
