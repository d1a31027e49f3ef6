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
use super::shared_union_find::SharedUnionFind;
use crate::{Cancelled, Monitor};

/// Rows that a thread takes at a time.
const ROWS: usize = 64;

/// Corners that a thread takes at a time.
const CORNERS: usize = 1 << 14;

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
    /// Corners outside that are a copy of their node.
    copies: Vec<(u32, u8)>,
    /// The number of a cell where two different copies would be one.
    torn: Option<usize>,
}

impl Outside {
    pub(super) fn new(cut: &Cut<'_>, cells: &CellHexahedra, monitor: &Monitor<'_>) -> Result<Self, Trouble> {
        let sets = SharedUnionFind::new(8 * cells.hexahedra.len());
        let mut corners = vec![Corner::Outside(u32::MAX); 8 * cells.hexahedra.len()];
        for part in sides(cut, cells, &sets, monitor)? {
            if let Some(number) = part.torn {
                return Err(trouble(cut, number));
            }
            for (corner, copy) in part.copies {
                let of_root = &mut corners[sets.root(corner) as usize];
                if !matches!(of_root, Corner::Outside(_)) && *of_root != Corner::Copy(copy) {
                    return Err(trouble(cut, cells.cell_of(corner as usize / 8)));
                }
                *of_root = Corner::Copy(copy);
            }
        }
        // Numbers for what is outside, in the order of the first corners: chunk by chunk.
        let is_outside = |corner: usize| cells.hexahedra[corner / 8].corners[corner % 8] == OUTSIDE;
        let firsts: Vec<Vec<u32>> = corners
            .par_chunks(CORNERS)
            .enumerate()
            .map(|(chunk, of)| {
                let own = (chunk * CORNERS..).zip(of).filter(|&(corner, what)| {
                    matches!(what, Corner::Outside(_)) && is_outside(corner) && sets.is_root(corner as u32)
                });
                own.map(|(corner, _)| corner as u32).collect()
            })
            .collect();
        let first = firsts.concat();
        for (number, &corner) in (0..).zip(&first) {
            corners[corner as usize] = Corner::Outside(number);
        }
        let corners = (0..corners.len())
            .into_par_iter()
            .with_min_len(CORNERS)
            .map(|corner| {
                if is_outside(corner) { corners[sets.root(corner as u32) as usize] } else { corners[corner] }
            })
            .collect();
        Ok(Self { corners, count: first.len() as u32, first })
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

/// Unites corners outside that are one, and gathers what else the sides say.
fn sides(
    cut: &Cut<'_>,
    cells: &CellHexahedra,
    sets: &SharedUnionFind,
    monitor: &Monitor<'_>,
) -> Result<Vec<Sides>, Cancelled> {
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
                            sides.between(cut, cells, sets, axis, [number, other]);
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
    fn between(
        &mut self,
        cut: &Cut<'_>,
        cells: &CellHexahedra,
        sets: &SharedUnionFind,
        axis: usize,
        numbers: [usize; 2],
    ) {
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
                    self.glue(sets, numbers[0], axis, pair, [first, second]);
                }
            }
        }
    }

    /// Makes the corners of a side one.
    fn glue(
        &mut self,
        sets: &SharedUnionFind,
        cell: usize,
        axis: usize,
        pair: [u32; 2],
        [first, second]: [[u8; 8]; 2],
    ) {
        for corner in (0..8).filter(|corner| corner >> axis & 1 == 1) {
            let across = corner ^ 1 << axis;
            let corners = [8 * pair[0] + corner as u32, 8 * pair[1] + across as u32];
            match (first[corner], second[across]) {
                (OUTSIDE, OUTSIDE) => sets.unite(corners[0], corners[1]),
                (OUTSIDE, copy) => self.copies.push((corners[0], copy)),
                (copy, OUTSIDE) => self.copies.push((corners[1], copy)),
                (a, b) if a != b => self.torn = self.torn.or(Some(cell)),
                _ => {}
            }
        }
    }
}
