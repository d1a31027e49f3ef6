//! What the crossings leave of the edges of the grid: [`Pieces`], and the regions that they make up.
//!
//! # What it computes
//! The surface cuts the network of the grid's nodes and edges into pieces: a *run* of nodes along x between two crossings (it may hold
//! no node, if both are on one edge), and a *stretch* of an edge along y or z between two crossings. Each has a winding number, exactly.
//! Pieces that hang together through edges that the surface does not cut are one region.
//!
//! A region of two or more copies may be a ring around which the copies change places, as where a band winds twice around before it
//! closes. So such regions can be *split*: each run is a region of its own, and a *seam* leads from it to each run beside it.
//!
//! # Method
//! Winding numbers are sums of crossings along rows. Runs of neighbouring rows are one region if an edge between them is not cut: the
//! lists of both rows and of the cuts between them are walked side by side; union-find \[Tarjan75\].
//! Complexity: O(rows + crossings), whatever the number of nodes.

use std::ops::Range;

use rayon::prelude::*;

use super::crossings::{Crossing, Crossings};
use super::rows::Rows;
use super::shared_union_find::SharedUnionFind;
use crate::grid::Grid3;

/// Rows that a thread takes at a time.
const ROWS: usize = 64;

/// No stretch begins behind that crossing.
const NONE: u32 = u32::MAX;

/// Pieces of the grid's edges. Runs come first by number, row after row and along each.
pub(super) struct Pieces<'a> {
    crossings: &'a Crossings,
    windings: Vec<i32>,
    /// For each crossing along y and z the stretch behind it, if another crossing of the same edge follows.
    stretches: [Vec<u32>; 2],
    sets: SharedUnionFind,
    seams: Option<Seams>,
}

/// Edges from neighbouring nodes of a row that are one seam.
#[derive(Clone, Copy, Debug)]
struct SeamEdges {
    begin: u32,
    end: u32,
    seam: u32,
}

/// Where runs of two or more copies hang together.
#[derive(Default)]
struct Seams {
    /// The seams of the edges along y and z from each row, and where those of each row begin.
    starts: [Vec<usize>; 2],
    edges: [Vec<SeamEdges>; 2],
    /// The pieces on both sides of each: first runs with an edge between, then those between which there is none, sorted.
    pieces: Vec<[u32; 2]>,
    /// How many have an edge between.
    with_edges: usize,
}

impl Seams {
    /// Adds edges between two runs.
    fn add(&mut self, runs: [u32; 2], axis: usize, nodes: Range<u32>) {
        let seam = self.pieces.len() as u32;
        self.edges[axis - 1].push(SeamEdges { begin: nodes.start, end: nodes.end, seam });
        self.pieces.push(runs);
        self.with_edges += 1;
    }

    /// The seams of the edges along an axis from a row.
    fn of_row(&self, axis: usize, row: usize) -> &[SeamEdges] {
        let (starts, all) = (&self.starts[axis - 1], &self.edges[axis - 1]);
        &all[starts[row]..starts.get(row + 1).map_or(all.len(), |&end| end)]
    }
}

impl<'a> Pieces<'a> {
    /// The pieces, with regions of two or more copies `split` or whole.
    pub(super) fn new(grid: &Grid3, crossings: &'a Crossings, split: bool) -> Self {
        let mut windings = run_windings(&crossings.axes[0]);
        let mut pieces = Self {
            crossings,
            windings: Vec::new(),
            stretches: [Vec::new(), Vec::new()],
            sets: SharedUnionFind::new(0),
            seams: split.then(Seams::default),
        };
        let mut stretches = [Vec::new(), Vec::new()];
        for axis in [1, 2] {
            stretches[axis - 1] = pieces.list_stretches(axis, &mut windings);
        }
        pieces.stretches = stretches;
        pieces.sets = SharedUnionFind::new(windings.len());
        pieces.windings = windings;
        pieces.join_rows(grid);
        pieces
    }

    /// Numbers the stretches along an axis behind the pieces so far.
    fn list_stretches(&self, axis: usize, windings: &mut Vec<i32>) -> Vec<u32> {
        let rows = &self.crossings.axes[axis];
        let mut behind = vec![NONE; rows.items().len()];
        for row in 0..rows.count() {
            let range = rows.range(row);
            for q in range.clone() {
                let here = rows.items()[q];
                if q + 1 == range.end || rows.items()[q + 1].i != here.i {
                    continue;
                }
                let before = if q > range.start && rows.items()[q - 1].i == here.i {
                    windings[behind[q - 1] as usize]
                } else {
                    windings[self.run(row, here.i) as usize]
                };
                behind[q] = windings.len() as u32;
                windings.push(before + step(here));
            }
        }
        behind
    }

    /// Unites runs of neighbouring rows, or makes seams between them.
    fn join_rows(&mut self, grid: &Grid3) {
        let [nx, ny, nz] = grid.nodes();
        let rows = ny as usize * nz as usize;
        // The next row along an axis, if there is one.
        let next = |axis: usize, row: usize| {
            let at = [row % ny as usize, row / ny as usize][axis - 1] + 1;
            (at < [ny, nz][axis - 1] as usize).then_some(row + [1, ny as usize][axis - 1])
        };
        let Some(mut seams) = self.seams.take() else {
            for axis in [1, 2] {
                (0..rows).into_par_iter().with_min_len(ROWS).for_each(|row| {
                    if let Some(other) = next(axis, row) {
                        self.for_each_join([row, other], axis, nx, |[a, b], _| self.sets.unite(a, b));
                    }
                });
            }
            return;
        };
        for axis in [1, 2] {
            for row in 0..rows {
                seams.starts[axis - 1].push(seams.edges[axis - 1].len());
                let Some(other) = next(axis, row) else { continue };
                self.for_each_join([row, other], axis, nx, |runs, nodes| {
                    if self.windings[runs[0] as usize] > 1 {
                        seams.add(runs, axis, nodes);
                    } else {
                        self.sets.unite(runs[0], runs[1]);
                    }
                });
            }
        }
        self.seams = Some(seams);
    }

    /// Calls `join` with runs of two rows and the nodes from which edges between them are not cut.
    fn for_each_join(
        &self,
        [row, other]: [usize; 2],
        axis: usize,
        nx: u32,
        mut join: impl FnMut([u32; 2], Range<u32>),
    ) {
        let mut join = |runs: [u32; 2], nodes: Range<u32>| {
            let [a, b] = runs.map(|run| self.windings[run as usize]);
            debug_assert_eq!(a, b, "the surface is closed");
            join(runs, nodes);
        };
        let crossings = self.crossings;
        let cuts = crossings.axes[axis].row(row);
        let [of_row, of_other] = [row, other].map(|row| crossings.axes[0].row(row));
        let (mut a, mut b, mut cut, mut begin) = (0, 0, 0, 0);
        while begin < nx {
            let end_of = |list: &[Crossing], run: usize| list.get(run).map_or(nx, |crossing| crossing.i + 1);
            let end = end_of(of_row, a).min(end_of(of_other, b));
            let runs = [(row, a), (other, b)].map(|(row, run)| self.first_run(row) + run as u32);
            let mut whole = begin;
            while cut < cuts.len() && cuts[cut].i < end {
                let i = cuts[cut].i;
                if whole < i {
                    join(runs, whole..i);
                }
                whole = i + 1;
                while cut < cuts.len() && cuts[cut].i == i {
                    cut += 1;
                }
            }
            if whole < end {
                join(runs, whole..end);
            }
            begin = end;
            // Past all runs that end here: those behind the first hold no node.
            while end_of(of_row, a) <= end && a < of_row.len() {
                a += 1;
            }
            while end_of(of_other, b) <= end && b < of_other.len() {
                b += 1;
            }
        }
    }

    /// Whether two pieces that hang together are of two regions with a seam between.
    pub(super) fn part(&self, a: u32, b: u32) -> bool {
        self.seams.is_some() && a != b && self.windings[a as usize] > 1
    }

    /// The pieces on both sides of each seam.
    pub(super) fn seams(&self) -> &[[u32; 2]] {
        self.seams.as_ref().map_or(&[], |seams| &seams.pieces)
    }

    /// Seams around a face of the grid across x: through the first two is the same as through the other two.
    pub(super) fn seam_squares(&self, grid: &Grid3) -> Vec<[u32; 4]> {
        let Some(seams) = &self.seams else { return Vec::new() };
        let [_, ny, nz] = grid.nodes().map(|n| n as usize);
        let mut squares = Vec::new();
        for row in 0..ny * (nz - 1) {
            if row % ny + 1 == ny {
                continue;
            }
            for a in seams.of_row(1, row) {
                let meets = |begin: u32, end: u32, of: &SeamEdges| {
                    let (begin, end) = (begin.max(of.begin), end.min(of.end));
                    (begin < end).then_some((begin, end))
                };
                for b in seams.of_row(2, row + 1) {
                    let Some((begin, end)) = meets(a.begin, a.end, b) else { continue };
                    for c in seams.of_row(2, row) {
                        let Some((begin, end)) = meets(begin, end, c) else { continue };
                        let fourth =
                            seams.of_row(1, row + ny).iter().filter(|d| meets(begin, end, d).is_some());
                        squares.extend(fourth.map(|d| [a.seam, b.seam, c.seam, d.seam]));
                    }
                }
            }
        }
        squares
    }

    /// Unites pairs of pieces, the lower first, sorted; or makes seams of them.
    pub(super) fn add_walls(&mut self, pairs: &[[u32; 2]]) {
        match &mut self.seams {
            Some(seams) => seams.pieces.extend_from_slice(pairs),
            None => pairs.iter().for_each(|&[a, b]| self.sets.unite(a, b)),
        }
    }

    /// The seam between two pieces that no edge connects, if there is one.
    pub(super) fn wall_seam(&self, a: u32, b: u32) -> Option<u32> {
        let seams = self.seams.as_ref()?;
        let place = seams.pieces[seams.with_edges..].binary_search(&[a.min(b), a.max(b)]).ok()?;
        Some((seams.with_edges + place) as u32)
    }

    /// The seam of an edge along y or z that is not cut, if its ends are of different regions.
    pub(super) fn seam(&self, axis: usize, row: usize, i: u32) -> Option<u32> {
        let seams = self.seams.as_ref()?;
        let of_row = seams.of_row(axis, row);
        let behind = of_row.partition_point(|edges| edges.begin <= i);
        Some(of_row[behind.checked_sub(1)?].seam)
    }

    /// Number of the first run of a row.
    pub(super) fn first_run(&self, row: usize) -> u32 {
        (self.crossings.axes[0].range(row).start + row) as u32
    }

    /// The run that holds a node.
    pub(super) fn run(&self, row: usize, i: u32) -> u32 {
        let before = self.crossings.axes[0].row(row).partition_point(|crossing| crossing.i < i);
        self.first_run(row) + before as u32
    }

    /// The piece behind a crossing that is not the last of its edge.
    pub(super) fn behind(&self, axis: usize, row: usize, crossing: usize) -> u32 {
        match axis {
            0 => (crossing + row + 1) as u32,
            _ => self.stretches[axis - 1][crossing],
        }
    }

    /// How often the surface winds around a piece.
    pub(super) fn winding(&self, piece: u32) -> i32 {
        self.windings[piece as usize]
    }

    /// For each row of cells whether some piece on their edges has two or more copies.
    pub(super) fn deep_cells(&self, grid: &Grid3) -> Vec<bool> {
        let ny = grid.nodes()[1] as usize;
        let mut deep = vec![false; self.crossings.axes[0].count()];
        if self.windings.iter().all(|&winding| winding < 2) {
            return deep;
        }
        self.for_each_piece(grid, |piece, [_, j, k], _, _| {
            deep[j as usize + ny * k as usize] |= self.winding(piece) > 1;
        });
        let any = |row: usize| {
            [row, row + 1, row + ny, row + ny + 1].iter().any(|&row| deep.get(row).is_some_and(|&deep| deep))
        };
        (0..deep.len()).map(any).collect()
    }

    /// Calls `f` with each piece, the first and the last node of its edges, and how many nodes it holds.
    pub(super) fn for_each_piece(&self, grid: &Grid3, mut f: impl FnMut(u32, [u32; 3], [u32; 3], u64)) {
        let [nx, ny, _] = grid.nodes();
        for axis in 0..3 {
            let rows = &self.crossings.axes[axis];
            for row in 0..rows.count() {
                let at = |i: u32| [i.min(nx - 1), row as u32 % ny, row as u32 / ny];
                let range = rows.range(row);
                if axis > 0 {
                    for q in range.filter(|&q| self.stretches[axis - 1][q] != NONE) {
                        let first = at(rows.items()[q].i);
                        let mut last = first;
                        last[axis] += 1;
                        f(self.stretches[axis - 1][q], first, last, 0);
                    }
                    continue;
                }
                let ends = rows.row(row).iter().map(|crossing| crossing.i + 1).chain([nx]);
                let mut begin = 0;
                for (run, end) in (self.first_run(row)..).zip(ends) {
                    let last = if begin < end { end - 1 } else { end };
                    f(run, at(begin.min(last)), at(last), u64::from(end - begin));
                    begin = end;
                }
            }
        }
    }

    /// The regions, numbered in the order of their first pieces; of split regions these are parts of those of `whole`.
    pub(super) fn regions(mut self, whole: Option<&Regions<'_>>) -> Regions<'a> {
        let mut of_piece = vec![0; self.windings.len()];
        let mut windings = Vec::new();
        let roots: Vec<u32> = (0..self.windings.len() as u32)
            .into_par_iter()
            .with_min_len(ROWS * ROWS)
            .map(|piece| self.sets.root(piece))
            .collect();
        for (piece, root) in (0..).zip(roots) {
            if root == piece {
                of_piece[piece as usize] = windings.len() as u32;
                windings.push(self.windings[piece as usize]);
            } else {
                of_piece[piece as usize] = of_piece[root as usize];
            }
        }
        self.sets = SharedUnionFind::new(0);
        let names = whole.map(|whole| whole.of_piece.clone());
        Regions { pieces: self, of_piece, windings, names }
    }
}

/// The pieces, with the region of each.
pub(super) struct Regions<'a> {
    pub(super) pieces: Pieces<'a>,
    of_piece: Vec<u32>,
    windings: Vec<i32>,
    /// The whole region of each piece, where regions are split.
    names: Option<Vec<u32>>,
}

impl Regions<'_> {
    /// The region of a piece.
    pub(super) fn of(&self, piece: u32) -> u32 {
        self.of_piece[piece as usize]
    }

    /// The whole region of a piece.
    pub(super) fn name(&self, piece: u32) -> u32 {
        self.names.as_ref().unwrap_or(&self.of_piece)[piece as usize]
    }

    /// How many copies the region of a piece has.
    pub(super) fn copies(&self, piece: u32) -> u32 {
        self.pieces.winding(piece).max(0) as u32
    }

    /// How often the surface winds around each region.
    pub(super) fn windings(&self) -> &[i32] {
        &self.windings
    }
}

/// How the winding number changes at a crossing.
fn step(crossing: Crossing) -> i32 {
    if crossing.enters { 1 } else { -1 }
}

/// The winding numbers of all runs.
fn run_windings(rows: &Rows<Crossing>) -> Vec<i32> {
    let mut windings = Vec::with_capacity(rows.items().len() + rows.count());
    for row in 0..rows.count() {
        let mut winding = 0;
        windings.push(0);
        for &crossing in rows.row(row) {
            winding += step(crossing);
            windings.push(winding);
        }
    }
    windings
}
