//! The hexahedra of the cells that the surface meets: [`CellHexahedra`].
//!
//! # What it computes
//! In each such cell the copies of its parts and the hexahedra of the extension hang together: through a crossing the copies before the
//! surface with those behind, and the copy that begins behind it with the hexahedron. Each connected set is one hexahedron of the mesh, the
//! part of one sheet of the volume in the cell. A corner of it is a copy of the grid's node, or lies outside. So two sides of a
//! thin wall are one hexahedron (merging with the boundary, \[Gagniere22\] 3.7.1), and a sheet that the surface of another one passes through
//! is a whole one.
//!
//! # What it promises
//! It refuses cells where a sheet would be in one place twice, or end where there is no surface: they are too large.
//!
//! Complexity: near linear in the crossings and copies of the cells.

use super::error::Trouble;
use super::frame::{Cut, Frame, in_all_cells};
use super::pieces::Regions;
use super::sheets::Sheets;
use crate::Monitor;
use crate::surface::topology::union_find::UnionFind;

/// The corner is no copy of a node: it lies outside.
pub(super) const OUTSIDE: u8 = u8::MAX;

/// A hexahedron in a cell that the surface meets.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellHexahedron {
    /// The copy of the node's region at each corner, or [`OUTSIDE`].
    pub(super) corners: [u8; 8],
    /// A region that it holds a copy of, the first by corners; `u32::MAX` if it lies between the edges of the grid.
    pub(super) region: u32,
    /// Which copy.
    pub(super) copy: u32,
}

/// The hexahedra of all cells that the surface meets, in the order of the cells.
pub(super) struct CellHexahedra {
    pub(super) hexahedra: Vec<CellHexahedron>,
    /// Where those of each cell begin, and the end.
    starts: Vec<u32>,
    /// The hexahedron here of each hexahedron of the extension.
    of_extension: Vec<u32>,
}

/// What some rows contribute; numbers are within.
#[derive(Default)]
struct Chunk {
    hexahedra: Vec<CellHexahedron>,
    in_cells: Vec<u32>,
    of_extension: Vec<u32>,
    /// The first thing that went wrong; nothing is added after it.
    trouble: Option<Trouble>,
}

impl CellHexahedra {
    pub(super) fn new(
        cut: &Cut<'_>,
        regions: &Regions<'_>,
        sheets: &Sheets,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Trouble> {
        let add = |chunk: &mut Chunk, frame: &Frame, cell: [u32; 3], number: usize| {
            if chunk.trouble.is_none() {
                let done = chunk.add(frame, regions, sheets, cut.extension.hexahedra(number));
                chunk.trouble = done.err().map(|what| Trouble::Cell { cell, what });
            }
        };
        let chunks: Vec<Chunk> =
            in_all_cells(cut, &regions.pieces, "sheets in cells", monitor, |_| true, add)?;
        let mut all = Self { hexahedra: Vec::new(), starts: vec![0], of_extension: Vec::new() };
        for chunk in chunks {
            if let Some(trouble) = chunk.trouble {
                return Err(trouble);
            }
            let before = all.hexahedra.len() as u32;
            all.of_extension.extend(chunk.of_extension.iter().map(|h| h + before));
            for count in chunk.in_cells {
                all.starts.push(all.starts[all.starts.len() - 1] + count);
            }
            all.hexahedra.extend(chunk.hexahedra);
        }
        Ok(all)
    }

    /// The hexahedra of a cell, by its number among those that the surface meets.
    pub(super) fn of_cell(&self, cell: usize) -> std::ops::Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }

    /// The cell of a hexahedron.
    pub(super) fn cell_of(&self, hexahedron: usize) -> usize {
        self.starts.partition_point(|&start| start as usize <= hexahedron) - 1
    }

    /// The hexahedron that holds a hexahedron of the extension.
    pub(super) fn of_extension(&self, hexahedron: u32) -> u32 {
        self.of_extension[hexahedron as usize]
    }
}

impl Chunk {
    /// Adds the hexahedra of one cell.
    fn add(
        &mut self,
        frame: &Frame,
        regions: &Regions<'_>,
        sheets: &Sheets,
        extension: std::ops::Range<u32>,
    ) -> Result<(), &'static str> {
        // Elements: the copies of each part, then the hexahedra of the extension.
        let places = frame.places();
        let copies_of = |part: u32| regions.pieces.winding(frame.piece(part)).max(0) as u32;
        let mut first = vec![0; places + 1];
        for place in 0..places {
            let own = frame.part(place) == place as u32;
            first[place + 1] = first[place] + if own { copies_of(place as u32) } else { 0 };
        }
        let copies = first[places];
        let mut sets = UnionFind::new((copies + extension.end - extension.start) as usize);
        let of_hexahedron = |h: u32| copies + h - extension.start;
        for crossing in frame.crossings() {
            let (outer, inner) = (first[crossing.outer as usize], first[crossing.inner as usize]);
            sets.unite(inner + sheets.copy_inside(crossing.id), of_hexahedron(crossing.hexahedron));
            for copy in 0..copies_of(crossing.outer) {
                sets.unite(outer + copy, inner + sheets.through(crossing.id, copy));
            }
        }
        for seam in frame.seams() {
            let [before, behind] = seam.parts.map(|part| first[part as usize]);
            for copy in 0..copies_of(seam.parts[0]) {
                sets.unite(before + copy, behind + sheets.over(seam.id, copy));
            }
        }
        // A hexahedron of the mesh for each set, in the order of first elements.
        let begin = self.hexahedra.len() as u32;
        let mut of_root = vec![u32::MAX; (copies + extension.end - extension.start) as usize];
        let mut with_surface = Vec::new();
        for element in 0..of_root.len() as u32 {
            let root = sets.root(element) as usize;
            if of_root[root] == u32::MAX {
                of_root[root] = self.hexahedra.len() as u32 - begin;
                self.hexahedra.push(CellHexahedron { corners: [OUTSIDE; 8], region: u32::MAX, copy: 0 });
                with_surface.push(false);
            }
            let hexahedron = of_root[root];
            if element >= copies {
                with_surface[hexahedron as usize] = true;
                self.of_extension.push(begin + hexahedron);
            }
        }
        self.in_cells.push(self.hexahedra.len() as u32 - begin);
        let hexahedra = &mut self.hexahedra[begin as usize..];
        let mut seen = vec![u32::MAX; hexahedra.len()];
        for place in 0..places as u32 {
            if frame.part(place as usize) != place {
                continue;
            }
            for copy in 0..copies_of(place) {
                let hexahedron = of_root[sets.root(first[place as usize] + copy) as usize] as usize;
                if seen[hexahedron] == place {
                    return Err("a sheet passes through the cell twice");
                }
                seen[hexahedron] = place;
                let hexahedron = &mut hexahedra[hexahedron];
                if hexahedron.region == u32::MAX {
                    (hexahedron.region, hexahedron.copy) = (regions.name(frame.piece(place)), copy);
                }
                for corner in (0..8).filter(|&corner| frame.part(corner) == place) {
                    hexahedron.corners[corner] = copy as u8;
                }
            }
        }
        let torn = |(h, surface): (&CellHexahedron, &bool)| !surface && h.corners.contains(&OUTSIDE);
        if hexahedra.iter().zip(&with_surface).any(torn) {
            return Err("a sheet ends where there is no surface");
        }
        Ok(())
    }
}
