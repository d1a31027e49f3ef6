//! The final mesh from the regions and the hexahedra at the surface: [`assemble`].
//!
//! # Method
//! Vertices are the copies of the nodes of each run, one run after the other, so that those along a row of cells follow each other; then
//! the vertices outside. Between the cells that the surface meets each cell of a region has as many hexahedra as the
//! region has copies. All rows know beforehand where their part of the mesh begins, and are written in parallel.
//!
//! Complexity: O(rows + hexahedra).

use std::ops::Range;

use rayon::prelude::*;

use super::HexMesh;
use super::cells::{CellHexahedra, OUTSIDE};
use super::error::Trouble;
use super::frame::Cut;
use super::gluing::{Corner, Outside};
use super::hex_mesh::corner_node;
use super::pieces::Regions;
use super::sheets::Sheets;
use crate::{Cancelled, Monitor};

/// The mesh, and what its hexahedra are.
pub(super) struct Assembled {
    pub(super) mesh: HexMesh,
    /// A region that each hexahedron holds a copy of; `u32::MAX` if it lies between the edges of the grid.
    pub(super) regions: Vec<u32>,
    /// Which copy of the region.
    pub(super) copies: Vec<u8>,
    /// The hexahedron of the mesh of each hexahedron at the surface.
    pub(super) of_surface: Vec<u32>,
}

/// Where the vertices and hexahedra of each row are.
struct Layout<'a> {
    cut: Cut<'a>,
    regions: &'a Regions<'a>,
    sheets: &'a Sheets,
    cells: &'a CellHexahedra,
    outside: &'a Outside,
    /// First vertex of each run.
    first_of_run: Vec<u32>,
    /// First vertex outside.
    first_outside: u32,
    /// First hexahedron of each row of cells, and the end.
    first_of_row: Vec<usize>,
}

/// Cells of a row: those that the surface meets and those between.
enum Stretch {
    /// A cell by its number among those that the surface meets, and its place in the row.
    Surface(usize, u32),
    /// Cells of one region, by the first and the end.
    Between(u32, u32),
}

/// What one row of the mesh is written to.
struct RowOut<'a> {
    row: usize,
    hexahedra: &'a mut [[u32; 8]],
    cells: &'a mut [u64],
    regions: &'a mut [u32],
    copies: &'a mut [u8],
    of_surface: &'a mut [u32],
}

pub(super) fn assemble(
    cut: Cut<'_>,
    regions: &Regions<'_>,
    sheets: &Sheets,
    cells: &CellHexahedra,
    outside: &Outside,
    monitor: &Monitor<'_>,
) -> Result<Assembled, Trouble> {
    let layout = Layout::new(cut, regions, sheets, cells, outside)?;
    let nodes = layout.nodes();
    let count = layout.first_of_row[layout.first_of_row.len() - 1];
    let mut hexahedra = vec![[0; 8]; count];
    let mut of_cells = vec![0; count];
    let mut of_regions = vec![0; count];
    let mut copies = vec![0; count];
    let mut of_surface = vec![0; cells.hexahedra.len()];
    let stage = monitor.stage("hexahedra", count as u64);
    {
        let mut rest = (
            hexahedra.as_mut_slice(),
            of_cells.as_mut_slice(),
            of_regions.as_mut_slice(),
            copies.as_mut_slice(),
            of_surface.as_mut_slice(),
        );
        let mut rows = Vec::new();
        for row in 0..layout.first_of_row.len() - 1 {
            let n = layout.first_of_row[row + 1] - layout.first_of_row[row];
            let range = cut.extension.cells().range(row);
            let s = layout.first_at_surface(range.end) - layout.first_at_surface(range.start);
            if n == 0 {
                continue;
            }
            let (a, b, c, d, e) = rest;
            let (hexahedra, a) = a.split_at_mut(n);
            let (cells, b) = b.split_at_mut(n);
            let (regions, c) = c.split_at_mut(n);
            let (copies, d) = d.split_at_mut(n);
            let (of_surface, e) = e.split_at_mut(s);
            rest = (a, b, c, d, e);
            rows.push(RowOut { row, hexahedra, cells, regions, copies, of_surface });
        }
        rows.into_par_iter().with_min_len(16).try_for_each(|out| {
            stage.check()?;
            let done = out.hexahedra.len() as u64;
            layout.write(out);
            stage.advance(done);
            Ok::<(), Cancelled>(())
        })?;
    }
    let mesh = HexMesh::by_construction(*cut.grid, nodes, hexahedra, of_cells);
    Ok(Assembled { mesh, regions: of_regions, copies, of_surface })
}

/// Copies of a run of nodes: the vertices of copy `c` are `first + c * length` and those behind.
#[derive(Clone, Copy)]
struct RunVertices {
    first: u32,
    begin: u32,
    length: u32,
}

impl RunVertices {
    fn at(&self, copy: u32, i: u32) -> u32 {
        self.first + copy * self.length + (i - self.begin)
    }
}

impl<'a> Layout<'a> {
    fn new(
        cut: Cut<'a>,
        regions: &'a Regions<'a>,
        sheets: &'a Sheets,
        cells: &'a CellHexahedra,
        outside: &'a Outside,
    ) -> Result<Self, Trouble> {
        let (first_of_run, first_of_row) = (Vec::new(), vec![0]);
        let mut layout =
            Self { cut, regions, sheets, cells, outside, first_of_run, first_outside: 0, first_of_row };
        let mut vertices = 0u64;
        for row in 0..cut.crossings.axes[0].count() {
            layout.for_each_run(row, |run, nodes| {
                let first = vertices;
                vertices += nodes.len() as u64 * u64::from(regions.copies(run));
                first
            });
        }
        let all = vertices + u64::from(outside.count);
        if all >= u64::from(u32::MAX) {
            return Err(Trouble::TooLarge { what: "vertices", count: all, most: u64::from(u32::MAX) - 1 });
        }
        layout.first_outside = vertices as u32;
        let [_, ny, nz] = cut.grid.nodes().map(|n| n as usize);
        for row in 0..ny * nz {
            let mut count = layout.first_of_row[row];
            if row % ny + 1 < ny && row / ny + 1 < nz {
                layout.for_each_stretch(row, |stretch| {
                    count += match stretch {
                        Stretch::Surface(number, _) => cells.of_cell(number).len(),
                        Stretch::Between(begin, end) => {
                            (end - begin) as usize * regions.copies(regions.pieces.run(row, begin)) as usize
                        }
                    };
                });
            }
            layout.first_of_row.push(count);
        }
        Ok(layout)
    }

    /// Calls `number` with each run of a row and its nodes, and keeps what it returns as the first vertex of the run.
    fn for_each_run(&mut self, row: usize, mut number: impl FnMut(u32, Range<u32>) -> u64) {
        let crossings = self.cut.crossings.axes[0].row(row);
        let ends = crossings.iter().map(|crossing| crossing.i + 1).chain([self.cut.grid.nodes()[0]]);
        let mut begin = 0;
        for (run, end) in (self.regions.pieces.first_run(row)..).zip(ends) {
            // Too many vertices are refused before any number is used.
            self.first_of_run.push(number(run, begin..end) as u32);
            begin = end;
        }
    }

    /// Calls `f` with the cells of a row in order.
    fn for_each_stretch(&self, row: usize, mut f: impl FnMut(Stretch)) {
        let surface = self.cut.extension.cells();
        let mut begin = 0;
        for number in surface.range(row) {
            let i = surface.items()[number].i;
            if begin < i {
                f(Stretch::Between(begin, i));
            }
            f(Stretch::Surface(number, i));
            begin = i + 1;
        }
        let end = self.cut.grid.cells()[0];
        if begin < end {
            f(Stretch::Between(begin, end));
        }
    }

    /// The first hexahedron at the surface of a cell, by its number; all of them at the end.
    fn first_at_surface(&self, number: usize) -> usize {
        if number < self.cut.extension.cells().items().len() {
            self.cells.of_cell(number).start
        } else {
            self.cells.hexahedra.len()
        }
    }

    /// The node of each vertex.
    fn nodes(&self) -> Vec<u64> {
        let mut nodes = vec![0; (self.first_outside + self.outside.count) as usize];
        let (copies, outside) = nodes.split_at_mut(self.first_outside as usize);
        let rows = &self.cut.crossings.axes[0];
        let (mut rest, mut parts) = (copies, Vec::with_capacity(rows.count()));
        for row in 0..rows.count() {
            let [begin, end] = [row, row + 1].map(|row| self.first_vertex(row));
            let (part, behind) = rest.split_at_mut((end - begin) as usize);
            rest = behind;
            parts.push((row, part));
        }
        let nx = self.cut.grid.nodes()[0];
        parts.into_par_iter().with_min_len(64).for_each(|(row, part)| {
            let of_row = row as u64 * u64::from(nx);
            let (mut place, mut begin) = (0, 0);
            let ends = rows.row(row).iter().map(|crossing| crossing.i + 1).chain([nx]);
            for (run, end) in (self.regions.pieces.first_run(row)..).zip(ends) {
                for _ in 0..self.regions.copies(run) {
                    for i in begin..end {
                        part[place] = of_row + u64::from(i);
                        place += 1;
                    }
                }
                begin = end;
            }
        });
        outside.par_iter_mut().zip(&self.outside.first).with_min_len(1024).for_each(|(node, &corner)| {
            let number = self.cells.cell_of(corner as usize / 8);
            let cell = self.index_of(number);
            *node = self.cut.grid.node_index(corner_node(cell, corner as usize % 8)) as u64;
        });
        nodes
    }

    /// The first vertex of the runs of a row; of the row behind the last, the first outside.
    fn first_vertex(&self, row: usize) -> u32 {
        if row == self.cut.crossings.axes[0].count() {
            return self.first_outside;
        }
        self.first_of_run[self.regions.pieces.first_run(row) as usize]
    }

    /// The index of a cell, by its number among those that the surface meets.
    fn index_of(&self, number: usize) -> [u32; 3] {
        let cells = self.cut.extension.cells();
        let (row, ny) = (cells.row_of(number), self.cut.grid.nodes()[1] as usize);
        [cells.items()[number].i, (row % ny) as u32, (row / ny) as u32]
    }

    /// The vertices of the run that holds a node.
    fn vertices_at(&self, row: usize, i: u32) -> RunVertices {
        let crossings = self.cut.crossings.axes[0].row(row);
        let run = self.regions.pieces.run(row, i);
        let before = (run - self.regions.pieces.first_run(row)) as usize;
        let begin = if before == 0 { 0 } else { crossings[before - 1].i + 1 };
        let end = crossings.get(before).map_or(self.cut.grid.nodes()[0], |crossing| crossing.i + 1);
        RunVertices { first: self.first_of_run[run as usize], begin, length: end - begin }
    }

    /// The copies in the rows of a cell, which the surface does not meet, as which a copy of the first row goes on.
    fn copies_beside(&self, row: usize, i: u32, copy: u32) -> [u32; 4] {
        let pieces = &self.regions.pieces;
        let ny = self.cut.grid.nodes()[1] as usize;
        let over = |axis: usize, row: usize, copy: u32| {
            let other = if axis == 1 { row + 1 } else { row + ny };
            if pieces.part(pieces.run(row, i), pieces.run(other, i))
                && let Some(seam) = pieces.seam(axis, row, i)
            {
                return self.sheets.over(seam, copy);
            }
            copy
        };
        let (y, z) = (over(1, row, copy), over(2, row, copy));
        [copy, y, z, over(2, row + 1, y)]
    }

    /// Writes a row of hexahedra.
    fn write(&self, mut out: RowOut<'_>) {
        let row = out.row;
        let [nx, ny, _] = self.cut.grid.cells().map(u64::from);
        let nodes = self.cut.grid.nodes()[1] as usize;
        let first_cell = nx * ((row % nodes) as u64 + ny * (row / nodes) as u64);
        let rows = [row, row + 1, row + nodes, row + nodes + 1];
        let (mut place, mut at_surface) = (0, 0);
        self.for_each_stretch(row, |stretch| match stretch {
            Stretch::Between(begin, end) => {
                let run = self.regions.pieces.run(row, begin);
                let (region, copies) = (self.regions.name(run), self.regions.copies(run));
                if copies == 0 {
                    return;
                }
                let runs = rows.map(|row| self.vertices_at(row, begin));
                // The copy of each run that copies of the first go on as, and the first vertex of each.
                let of_runs: Vec<[u32; 4]> = (0..copies)
                    .map(|copy| {
                        let copies = self.copies_beside(row, begin, copy);
                        std::array::from_fn(|r| runs[r].at(copies[r], begin))
                    })
                    .collect();
                for i in 0..end - begin {
                    for (copy, first) in of_runs.iter().enumerate() {
                        let corners: [u32; 8] = std::array::from_fn(|c| first[c >> 1] + i + (c & 1) as u32);
                        out.put(place, corners, first_cell + u64::from(begin + i), region, copy as u8);
                        place += 1;
                    }
                }
            }
            Stretch::Surface(number, i) => {
                for hexahedron in self.cells.of_cell(number) {
                    let of = &self.cells.hexahedra[hexahedron];
                    let corners: [u32; 8] = std::array::from_fn(|c| {
                        let copy = match of.corners[c] {
                            OUTSIDE => match self.outside.corner(hexahedron, c) {
                                Corner::Outside(vertex) => return self.first_outside + vertex,
                                Corner::Copy(copy) => copy,
                            },
                            copy => copy,
                        };
                        let at = i + (c & 1) as u32;
                        self.vertices_at(rows[c >> 1], at).at(u32::from(copy), at)
                    });
                    out.of_surface[at_surface] = (self.first_of_row[row] + place) as u32;
                    at_surface += 1;
                    out.put(place, corners, first_cell + u64::from(i), of.region, of.copy as u8);
                    place += 1;
                }
            }
        });
    }
}

impl RowOut<'_> {
    fn put(&mut self, place: usize, corners: [u32; 8], cell: u64, region: u32, copy: u8) {
        self.hexahedra[place] = corners;
        self.cells[place] = cell;
        self.regions[place] = region;
        self.copies[place] = copy;
    }
}
