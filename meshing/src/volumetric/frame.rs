//! What the edges of one cell look like where the surface cuts them: [`Frame`].
//!
//! # What it computes
//! The twelve edges of a cell that the surface meets fall into pieces at the crossings. *Parts* are the connected sets of these pieces
//! within the cell. Each crossing leads from an outer part to an inner one and belongs to one hexahedron of the extension.
//!
//! Pieces that no edge of the cell connects may lie on the same side of every part of the surface in it: between the two sheets of a
//! thin wall that cuts an edge twice, or at two corners that a saddle cuts off. Then they are alike, and in one part too. On which side
//! of a part of the surface a piece lies is a number, by how much crossings with it add up on the way there: it is the same for every way, since the part
//! ends only where the cell does.
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
    /// Pairs of places that are on the same side of everything, in different regions or not.
    alike: Vec<[u32; 2]>,
    /// For each place that stands for others, its side of each hexahedron of the extension.
    sides: Vec<i16>,
    /// The place that stands for each; none if there are fewer than three.
    stands: Vec<u32>,
}

impl Frame {
    /// Makes it that of a cell of a row, the `number`-th that the surface meets.
    pub(super) fn fill(&mut self, cut: &Cut<'_>, pieces: &Pieces<'_>, [i, j, k]: [u32; 3], number: usize) {
        let ny = cut.grid.nodes()[1] as usize;
        let row_of = |corner: usize| (j as usize + (corner >> 1 & 1)) + ny * (k as usize + (corner >> 2));
        self.pieces.clear();
        self.crossings.clear();
        self.seams.clear();
        self.alike.clear();
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
        if self.seams.is_empty() {
            self.find_alike(cut.extension.hexahedra(number), &mut sets);
        } else {
            let mut joined = sets.clone();
            self.seams.iter().for_each(|seam| joined.unite(seam.parts[0], seam.parts[1]));
            self.find_alike(cut.extension.hexahedra(number), &mut joined);
        }
        for n in 0..self.alike.len() {
            let [a, b] = self.alike[n];
            let [of_a, of_b] = [a, b].map(|place| self.pieces[place as usize]);
            if !pieces.part(of_a, of_b) {
                sets.unite(a, b);
            } else if let Some(id) = pieces.wall_seam(of_a, of_b) {
                let parts = if of_a < of_b { [a, b] } else { [b, a] };
                self.seams.push(CellSeam { id, parts });
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
            let [outer, inner] = if crossing.enters { [before, behind] } else { [behind, before] };
            self.crossings.push(CellCrossing { id: (offset + q) as u32, hexahedron, outer, inner });
            before = behind;
        }
    }

    /// Finds parts that are on the same side of everything; `sets` are places that edges connect.
    fn find_alike(&mut self, hexahedra: std::ops::Range<u32>, sets: &mut UnionFind) {
        let places = self.pieces.len() as u32;
        self.stands.clear();
        let parts: Vec<u32> = (0..places).filter(|&place| sets.root(place) == place).collect();
        if parts.len() < 3 {
            return;
        }
        self.stands.extend((0..places).map(|place| sets.root(place)));
        let count = hexahedra.len();
        self.sides.clear();
        self.sides.resize(places as usize * count, 0);
        let mut known = vec![false; places as usize];
        known[parts[0] as usize] = true;
        // The edges of a cell are connected, so each pass reaches further.
        for _ in 0..parts.len() {
            for n in 0..self.crossings.len() {
                let crossing = self.crossings[n];
                let [outer, inner] = [crossing.outer, crossing.inner].map(|place| sets.root(place) as usize);
                let (from, to, step) = match (known[outer], known[inner]) {
                    (true, false) => (outer, inner, 1),
                    (false, true) => (inner, outer, -1),
                    _ => continue,
                };
                known[to] = true;
                self.sides.copy_within(from * count..(from + 1) * count, to * count);
                self.sides[to * count + (crossing.hexahedron - hexahedra.start) as usize] += step;
            }
        }
        let sides = |place: u32| &self.sides[place as usize * count..(place as usize + 1) * count];
        let mut sorted = parts;
        sorted.sort_by(|&a, &b| sides(a).cmp(sides(b)).then(a.cmp(&b)));
        let alike = sorted.windows(2).filter(|pair| sides(pair[0]) == sides(pair[1]));
        self.alike.extend(alike.map(|pair| [pair[0], pair[1]]));
    }

    /// Pairs of places that are alike though no edge connects them.
    pub(super) fn alike(&self) -> &[[u32; 2]] {
        &self.alike
    }

    /// On which side of each hexahedron of the extension a part is, of which there are `count`; only differences have a meaning. None if
    /// there are too few parts for any two to be alike.
    pub(super) fn sides(&self, part: u32, count: usize) -> Option<&[i16]> {
        let place = *self.stands.get(part as usize)? as usize;
        Some(&self.sides[place * count..(place + 1) * count])
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
