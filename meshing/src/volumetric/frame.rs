//! What the edges of one cell look like where the surface cuts them: [`Frame`].
//!
//! # What it computes
//! The twelve edges of a cell that the surface meets fall into pieces at the crossings. *Parts* are the connected sets of these pieces
//! within the cell. Each crossing leads from an outer part to an inner one and belongs to one hexahedron of the extension.
//!
//! Two pieces that lie between the same two connected parts of the surface, on different edges, are in one part too: between two sheets of a
//! thin wall that cuts an edge twice there is no node to connect them. They must have the same winding number.
//!
//! This replaces the signs of \[Gagniere22\] 3.5: a vertex of the extension's hexahedron is inside if its part is the inner one of a
//! crossing of that hexahedron. No plane of a triangle, and no closest facet, is asked.
//!
//! Complexity: O(c log c) for c crossings.

use rayon::prelude::*;

use super::crossings::Crossings;
use super::extension::Extension;
use super::pieces::Pieces;
use crate::grid::Grid3;
use crate::surface::topology::union_find::UnionFind;
use crate::{Cancelled, Monitor};

/// Rows that a thread takes at a time.
const ROWS: usize = 64;

/// The edges of a cell by their lower corner, for each axis.
const EDGES: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];

/// What the frames of all cells are made from.
#[derive(Clone, Copy)]
pub(super) struct Cut<'a> {
    pub(super) grid: &'a Grid3,
    pub(super) crossings: &'a Crossings,
    pub(super) extension: &'a Extension,
}

/// A crossing of an edge of the cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellCrossing {
    /// Its number among the crossings of all axes.
    pub(super) id: u32,
    /// The hexahedron of the extension to which its triangle belongs here.
    pub(super) hexahedron: u32,
    /// The part before the surface.
    pub(super) outer: u32,
    /// The part behind it.
    pub(super) inner: u32,
}

/// An edge that is not cut, between two regions that are parts of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellSeam {
    /// Its number among all seams.
    pub(super) id: u32,
    /// The parts at its ends, in the order of the seam.
    pub(super) parts: [u32; 2],
}

/// The frame of one cell; its memory is used again for the next.
#[derive(Default)]
pub(super) struct Frame {
    /// The pieces at the corners, then those between two crossings of an edge.
    pieces: Vec<u32>,
    crossings: Vec<CellCrossing>,
    seams: Vec<CellSeam>,
    /// The part of each piece, as the lowest place of one of its pieces.
    parts: Vec<u32>,
    /// Pieces between crossings: the two sheets beside each, and its place.
    walls: Vec<([u64; 2], u32)>,
}

impl Frame {
    /// Makes it that of a cell of a row, the `number`-th that the surface meets.
    pub(super) fn fill(&mut self, cut: &Cut<'_>, pieces: &Pieces<'_>, [i, j, k]: [u32; 3], number: usize) {
        let ny = cut.grid.nodes()[1] as usize;
        let row_of = |corner: usize| (j as usize + (corner >> 1 & 1)) + ny * (k as usize + (corner >> 2));
        self.pieces.clear();
        self.crossings.clear();
        self.seams.clear();
        self.walls.clear();
        for rows in 0..4 {
            let row = row_of(2 * rows);
            let (low, high) = (pieces.run(row, i), pieces.run(row, i + 1));
            self.pieces.extend([low, high]);
        }
        let mut whole = Vec::with_capacity(12);
        for (axis, edges) in EDGES.iter().enumerate() {
            for &corner in edges {
                let (row, at) = (row_of(corner), i + (corner & 1) as u32);
                let range = cut.crossings.on_edge(axis, row, at);
                let end = corner | 1 << axis;
                if range.is_empty() {
                    if axis > 0 && pieces.part(self.pieces[corner], self.pieces[end]) {
                        let id = pieces
                            .seam(axis, row, at)
                            .expect("edges that are not cut between two runs have a seam");
                        self.seams.push(CellSeam { id, parts: [corner as u32, end as u32] });
                    } else {
                        whole.push([corner as u32, end as u32]);
                    }
                } else {
                    self.follow(cut, pieces, [axis, row, number], range, [corner as u32, end as u32]);
                }
            }
        }
        let mut sets = UnionFind::new(self.pieces.len());
        for [a, b] in whole {
            sets.unite(a, b);
        }
        self.walls.sort_unstable();
        for pair in self.walls.windows(2) {
            let [a, b] = [pair[0].1, pair[1].1];
            let same_depth =
                pieces.winding(self.pieces[a as usize]) == pieces.winding(self.pieces[b as usize]);
            if pair[0].0 == pair[1].0 && same_depth {
                sets.unite(a, b);
            }
        }
        self.parts.clear();
        self.parts.extend((0..self.pieces.len() as u32).map(|piece| sets.root(piece)));
        for crossing in &mut self.crossings {
            crossing.outer = self.parts[crossing.outer as usize];
            crossing.inner = self.parts[crossing.inner as usize];
        }
        for seam in &mut self.seams {
            seam.parts = seam.parts.map(|place| self.parts[place as usize]);
        }
    }

    /// Follows an edge from crossing to crossing.
    fn follow(
        &mut self,
        cut: &Cut<'_>,
        pieces: &Pieces<'_>,
        [axis, row, number]: [usize; 3],
        range: std::ops::Range<usize>,
        [begin, end]: [u32; 2],
    ) {
        let offset: usize = cut.crossings.axes[..axis].iter().map(|rows| rows.items().len()).sum();
        let mut before = begin;
        let mut wall = None;
        for q in range.clone() {
            let crossing = cut.crossings.axes[axis].items()[q];
            let hexahedron = cut
                .extension
                .hexahedron_of(number, crossing.triangle)
                .expect("a triangle that crosses an edge of a cell meets the cell");
            let behind = if q + 1 == range.end {
                end
            } else {
                self.pieces.push(pieces.behind(axis, row, q));
                self.pieces.len() as u32 - 1
            };
            // A sheet, and on which side of it the piece lies.
            let sheet = |outside: bool| u64::from(hexahedron) << 1 | u64::from(outside);
            if let Some(other) = wall {
                let mut sheets = [other, sheet(crossing.enters)];
                sheets.sort_unstable();
                self.walls.push((sheets, before));
            }
            wall = Some(sheet(!crossing.enters));
            let [outer, inner] = if crossing.enters { [before, behind] } else { [behind, before] };
            self.crossings.push(CellCrossing { id: (offset + q) as u32, hexahedron, outer, inner });
            before = behind;
        }
    }

    /// The crossings of all edges.
    pub(super) fn crossings(&self) -> &[CellCrossing] {
        &self.crossings
    }

    /// The seams on its edges.
    pub(super) fn seams(&self) -> &[CellSeam] {
        &self.seams
    }

    /// Number of places for parts: parts are below it, but not all numbers below are parts.
    pub(super) fn places(&self) -> usize {
        self.parts.len()
    }

    /// The part of a place; parts are their own.
    pub(super) fn part(&self, place: usize) -> u32 {
        self.parts[place]
    }

    /// The piece at a place; those of one part are of one region.
    pub(super) fn piece(&self, place: u32) -> u32 {
        self.pieces[place as usize]
    }
}

/// Calls `add` with the frame of every cell that the surface meets in the rows that are `wanted`, its index and its number, to gather a value
/// for some rows each; in parallel.
pub(super) fn in_all_cells<T: Default + Send>(
    cut: &Cut<'_>,
    pieces: &Pieces<'_>,
    name: &'static str,
    monitor: &Monitor<'_>,
    wanted: impl Fn(usize) -> bool + Sync,
    add: impl Fn(&mut T, &Frame, [u32; 3], usize) + Sync,
) -> Result<Vec<T>, Cancelled> {
    let cells = cut.extension.cells();
    let stage = monitor.stage(name, cells.count() as u64);
    let ny = cut.grid.nodes()[1] as usize;
    (0..cells.count().div_ceil(ROWS))
        .into_par_iter()
        .map(|chunk| {
            stage.check()?;
            let (mut value, mut frame) = (T::default(), Frame::default());
            let rows = chunk * ROWS..cells.count().min((chunk + 1) * ROWS);
            let done = rows.len() as u64;
            for row in rows.filter(|&row| wanted(row)) {
                for number in cells.range(row) {
                    let cell = [cells.items()[number].i, (row % ny) as u32, (row / ny) as u32];
                    frame.fill(cut, pieces, cell, number);
                    add(&mut value, &frame, cell, number);
                }
            }
            stage.advance(done);
            Ok(value)
        })
        .collect()
}
