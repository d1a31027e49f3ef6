//! Which corners outside of the volume are one vertex: [`Outside`].
//!
//! # Method
//! Two hexahedra in cells with a common side hang together across it if a triangle is in both, or a copy of a node of the side; then the
//! side is one, and so are its four corners. Copies of nodes are vertices of their own; corners outside become one where they are
//! corners of one side, never because they lie at one place.
//!
//! Complexity: near linear in the hexahedra of the extension and their triangles.

use rayon::prelude::*;

use super::cells::{CellHexahedra, OUTSIDE};
use super::error::Trouble;
use super::frame::Cut;
use crate::surface::topology::union_find::UnionFind;
use crate::{Cancelled, Monitor};

/// Rows that a thread takes at a time.
const ROWS: usize = 64;

/// What a corner outside is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Corner {
    /// A vertex outside, by number.
    Outside(u32),
    /// A copy of the node after all: its sheet is seen across a side only.
    Copy(u8),
}

/// The vertices outside of the volume.
pub(super) struct Outside {
    /// What each corner is, eight a hexahedron; meaningful for corners outside.
    corners: Vec<Corner>,
    pub(super) count: u32,
    /// A corner of each vertex.
    pub(super) first: Vec<u32>,
}

/// What the sides between some cells and the next say.
#[derive(Default)]
struct Sides {
    /// Corners outside that are one.
    same: Vec<[u32; 2]>,
    /// Corners outside that are a copy of their node.
    copies: Vec<(u32, u8)>,
    /// The number of a cell where two different copies would be one.
    torn: Option<usize>,
}

impl Outside {
    pub(super) fn new(cut: &Cut<'_>, cells: &CellHexahedra, monitor: &Monitor<'_>) -> Result<Self, Trouble> {
        let sides = sides(cut, cells, monitor)?;
        let mut sets = UnionFind::new(8 * cells.hexahedra.len());
        for part in &sides {
            if let Some(number) = part.torn {
                return Err(trouble(cut, number));
            }
            part.same.iter().for_each(|&[a, b]| sets.unite(a, b));
        }
        let mut corners = vec![Corner::Outside(u32::MAX); 8 * cells.hexahedra.len()];
        for &(corner, copy) in sides.iter().flat_map(|part| &part.copies) {
            let root = sets.root(corner) as usize;
            if !matches!(corners[root], Corner::Outside(_)) && corners[root] != Corner::Copy(copy) {
                let hexahedron = corner / 8;
                let number = cells.cell_of(hexahedron as usize);
                return Err(trouble(cut, number));
            }
            corners[root] = Corner::Copy(copy);
        }
        let (mut count, mut first) = (0, Vec::new());
        for corner in 0..corners.len() as u32 {
            if cells.hexahedra[corner as usize / 8].corners[corner as usize % 8] != OUTSIDE {
                continue;
            }
            let root = sets.root(corner);
            if root == corner {
                if let Corner::Outside(number) = &mut corners[corner as usize] {
                    *number = count;
                    count += 1;
                    first.push(corner);
                }
            } else {
                corners[corner as usize] = corners[root as usize];
            }
        }
        Ok(Self { corners, count, first })
    }

    /// What a corner outside is.
    pub(super) fn corner(&self, hexahedron: usize, corner: usize) -> Corner {
        self.corners[8 * hexahedron + corner]
    }
}

fn trouble(cut: &Cut<'_>, number: usize) -> Trouble {
    let cells = cut.extension.cells();
    let row = cells.row_of(number);
    let ny = cut.grid.nodes()[1] as usize;
    let cell = [cells.items()[number].i, (row % ny) as u32, (row / ny) as u32];
    Trouble::Cell { cell, what: "two copies of a node meet across a side" }
}

fn sides(cut: &Cut<'_>, cells: &CellHexahedra, monitor: &Monitor<'_>) -> Result<Vec<Sides>, Cancelled> {
    let rows = cut.extension.cells();
    let stage = monitor.stage("vertices outside", rows.count() as u64);
    let ny = cut.grid.nodes()[1] as usize;
    (0..rows.count().div_ceil(ROWS))
        .into_par_iter()
        .map(|chunk| {
            stage.check()?;
            let range = chunk * ROWS..rows.count().min((chunk + 1) * ROWS);
            let done = range.len() as u64;
            let mut sides = Sides::default();
            for row in range {
                for number in rows.range(row) {
                    let i = rows.items()[number].i;
                    let neighbours = [(row, i + 1), (row + 1, i), (row + ny, i)];
                    for (axis, (row, i)) in neighbours.into_iter().enumerate() {
                        if row < rows.count()
                            && let Some(other) = cut.extension.cell_at(row, i)
                        {
                            sides.between(cut, cells, axis, [number, other]);
                        }
                    }
                }
            }
            stage.advance(done);
            Ok(sides)
        })
        .collect()
}

impl Sides {
    /// Finds what hangs together across the side between two cells, the second behind the first along an axis.
    fn between(&mut self, cut: &Cut<'_>, cells: &CellHexahedra, axis: usize, numbers: [usize; 2]) {
        let [lower, upper] = numbers.map(|number| cells.of_cell(number));
        let mut glued: Vec<[u32; 2]> = Vec::new();
        let [(ours, of_ours), (theirs, of_theirs)] = numbers.map(|number| cut.extension.triangles(number));
        let (mut a, mut b) = (0, 0);
        while a < ours.len() && b < theirs.len() {
            match ours[a].triangle.cmp(&theirs[b].triangle) {
                std::cmp::Ordering::Less => a += 1,
                std::cmp::Ordering::Greater => b += 1,
                std::cmp::Ordering::Equal => {
                    let pair = [cells.of_extension(of_ours[a]), cells.of_extension(of_theirs[b])];
                    if !glued.contains(&pair) {
                        glued.push(pair);
                    }
                    (a, b) = (a + 1, b + 1);
                }
            }
        }
        let side = (0..8).filter(|corner| corner >> axis & 1 == 1);
        for below in lower {
            for above in upper.clone() {
                let pair = [below as u32, above as u32];
                let [first, second] = [below, above].map(|h| cells.hexahedra[h].corners);
                let common =
                    |corner: usize| first[corner] != OUTSIDE && first[corner] == second[corner ^ 1 << axis];
                if glued.contains(&pair) || side.clone().any(common) {
                    self.glue(numbers[0], axis, pair, [first, second]);
                }
            }
        }
    }

    /// Makes the corners of a side one.
    fn glue(&mut self, cell: usize, axis: usize, pair: [u32; 2], [first, second]: [[u8; 8]; 2]) {
        for corner in (0..8).filter(|corner| corner >> axis & 1 == 1) {
            let across = corner ^ 1 << axis;
            let corners = [8 * pair[0] + corner as u32, 8 * pair[1] + across as u32];
            match (first[corner], second[across]) {
                (OUTSIDE, OUTSIDE) => self.same.push(corners),
                (OUTSIDE, copy) => self.copies.push((corners[0], copy)),
                (copy, OUTSIDE) => self.copies.push((corners[1], copy)),
                (a, b) if a != b => self.torn = self.torn.or(Some(cell)),
                _ => {}
            }
        }
    }
}
