//! The volumetric extension of the surface, \[Gagniere22\] 3.5: [`Extension`].
//!
//! # What it computes
//! One hexahedron for each connected part of the surface in each cell that it meets. Two triangles with a common edge hang together
//! in a cell if the edge itself meets the cell, which is decided exactly. (In \[Gagniere22\] it is enough that both meet the cell; then the two arms of a
//! sharp fold are one where they are apart.)
//!
//! Complexity: O(pairs of triangle and cell), times the logarithm of those in one cell.

use rayon::prelude::*;
use welter_predicates::moved_grid::moved_box_meets_segment;

use super::pairing::Pairing;
use super::precursors::{Precursor, cell_box};
use super::rows::Rows;
use crate::grid::Grid3;
use crate::surface::topology::union_find::UnionFind;
use crate::surface::{TriId, TriMesh};
use crate::{Cancelled, Monitor};

/// Rows that a thread takes at a time.
const ROWS: usize = 256;

/// A cell that the surface meets.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SurfaceCell {
    /// First coordinate of its index.
    pub(super) i: u32,
    /// Its first precursor among all.
    first: u32,
    /// Its first hexahedron.
    hexahedron: u32,
}

/// The cells that the surface meets and their hexahedra, by row and number.
pub(super) struct Extension {
    precursors: Rows<Precursor>,
    /// The hexahedron of each precursor.
    hexahedra: Vec<u32>,
    cells: Rows<SurfaceCell>,
    count: u32,
}

/// What some rows contribute; hexahedra are numbered within.
struct Part {
    cells: Vec<SurfaceCell>,
    in_rows: Vec<usize>,
    hexahedra: Vec<u32>,
    count: u32,
}

impl Extension {
    pub(super) fn new(
        mesh: &TriMesh,
        pairing: &Pairing,
        grid: &Grid3,
        precursors: Rows<Precursor>,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Cancelled> {
        let unite = |cell: [u32; 3], triangles: &[Precursor], sets: &mut UnionFind| {
            unite_neighbours(mesh, pairing, grid, cell, triangles, sets);
        };
        Self::from_parts(grid, precursors, unite, monitor)
    }

    /// From the precursors and what unites those that hang together in a cell, by their places among the precursors of the cell.
    pub(super) fn from_parts(
        grid: &Grid3,
        precursors: Rows<Precursor>,
        unite: impl Fn([u32; 3], &[Precursor], &mut UnionFind) + Sync,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Cancelled> {
        let stage = monitor.stage("volumetric extension", precursors.count() as u64);
        let parts: Vec<Part> = (0..precursors.count().div_ceil(ROWS))
            .into_par_iter()
            .map(|chunk| {
                stage.check()?;
                let rows = chunk * ROWS..precursors.count().min((chunk + 1) * ROWS);
                let count = rows.len() as u64;
                let part = Part::of(grid, &precursors, rows, &unite);
                stage.advance(count);
                Ok(part)
            })
            .collect::<Result<_, Cancelled>>()?;
        let mut starts = Vec::with_capacity(precursors.count() + 1);
        let mut cells = Vec::with_capacity(parts.iter().map(|part| part.cells.len()).sum());
        let mut hexahedra = Vec::with_capacity(precursors.items().len());
        let mut count = 0;
        starts.push(0);
        for part in parts {
            let mut before = cells.len();
            starts.extend(part.in_rows.iter().map(|n| {
                before += n;
                before
            }));
            cells.extend(
                part.cells.iter().map(|cell| SurfaceCell { hexahedron: cell.hexahedron + count, ..*cell }),
            );
            hexahedra.extend(part.hexahedra.iter().map(|h| h + count));
            count += part.count;
        }
        Ok(Self { precursors, hexahedra, cells: Rows::new(starts, cells), count })
    }

    /// The cells that the surface meets.
    pub(super) fn cells(&self) -> &Rows<SurfaceCell> {
        &self.cells
    }

    /// The triangles in a cell, by its number among those that the surface meets, and the hexahedron of each.
    pub(super) fn triangles(&self, cell: usize) -> (&[Precursor], &[u32]) {
        let cells = self.cells.items();
        let end = cells.get(cell + 1).map_or(self.hexahedra.len(), |next| next.first as usize);
        let range = cells[cell].first as usize..end;
        (&self.precursors.items()[range.clone()], &self.hexahedra[range])
    }

    /// Number of hexahedra in all cells.
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// The hexahedra in a cell.
    pub(super) fn hexahedra(&self, cell: usize) -> std::ops::Range<u32> {
        let cells = self.cells.items();
        cells[cell].hexahedron..cells.get(cell + 1).map_or(self.count, |next| next.hexahedron)
    }

    /// The hexahedron of a triangle in a cell, if it meets the cell.
    pub(super) fn hexahedron_of(&self, cell: usize, triangle: u32) -> Option<u32> {
        let (triangles, hexahedra) = self.triangles(cell);
        let place = triangles.binary_search_by_key(&triangle, |precursor| precursor.triangle).ok()?;
        Some(hexahedra[place])
    }

    /// The number of a cell among those that the surface meets, if it does.
    pub(super) fn cell_at(&self, row: usize, i: u32) -> Option<usize> {
        let place = self.cells.row(row).binary_search_by_key(&i, |cell| cell.i).ok()?;
        Some(self.cells.range(row).start + place)
    }
}

impl Part {
    fn of(
        grid: &Grid3,
        precursors: &Rows<Precursor>,
        rows: std::ops::Range<usize>,
        unite: &impl Fn([u32; 3], &[Precursor], &mut UnionFind),
    ) -> Self {
        let ny = grid.nodes()[1] as usize;
        let mut part = Self { cells: Vec::new(), in_rows: Vec::new(), hexahedra: Vec::new(), count: 0 };
        for row in rows {
            let before = part.cells.len();
            let mut first = precursors.range(row).start;
            for triangles in precursors.row(row).chunk_by(|a, b| a.i == b.i) {
                let i = triangles[0].i;
                part.cells.push(SurfaceCell { i, first: first as u32, hexahedron: part.count });
                first += triangles.len();
                part.connect([i, (row % ny) as u32, (row / ny) as u32], triangles, unite);
            }
            part.in_rows.push(part.cells.len() - before);
        }
        part
    }

    /// Finds the connected parts of the surface in a cell.
    fn connect(
        &mut self,
        cell: [u32; 3],
        triangles: &[Precursor],
        unite: &impl Fn([u32; 3], &[Precursor], &mut UnionFind),
    ) {
        if triangles.len() == 1 {
            self.hexahedra.push(self.count);
            self.count += 1;
            return;
        }
        let mut sets = UnionFind::new(triangles.len());
        unite(cell, triangles, &mut sets);
        let begin = self.hexahedra.len();
        for place in 0..triangles.len() as u32 {
            let root = sets.root(place);
            if root == place {
                self.hexahedra.push(self.count);
                self.count += 1;
            } else {
                self.hexahedra.push(self.hexahedra[begin + root as usize]);
            }
        }
    }
}

/// Unites the triangles of a cell that have an edge in common within it.
fn unite_neighbours(
    mesh: &TriMesh,
    pairing: &Pairing,
    grid: &Grid3,
    cell: [u32; 3],
    triangles: &[Precursor],
    sets: &mut UnionFind,
) {
    let [min, max] = cell_box(grid, cell);
    for (place, precursor) in triangles.iter().enumerate() {
        let corners = mesh.corners(TriId(precursor.triangle)).map(|p| p.to_array());
        for k in 0..3 {
            let neighbour = pairing.neighbour(precursor.triangle, k);
            if neighbour <= precursor.triangle {
                continue;
            }
            let Ok(other) = triangles.binary_search_by_key(&neighbour, |p| p.triangle) else { continue };
            if sets.root(place as u32) != sets.root(other as u32)
                && moved_box_meets_segment(min, max, [corners[k], corners[(k + 1) % 3]])
            {
                sets.unite(place as u32, other as u32);
            }
        }
    }
}
