//! Where a curve in the plane meets the cells of a layer and cuts its edges: [`Front`], the beginning of the method.
//!
//! # What it promises
//! Exactly the cells of the moved grid (see `welter_predicates::moved_grid`) that each segment meets, and exactly the crossings with the
//! edges along x and y, in their order along each edge; the same in the lower and in the upper nodes of the layer. No edge along z is cut. Two
//! segments that follow each other hang together in the cell that holds their common end.
//!
//! # Method
//! A segment stands for the plane upright through it. Its cells are found row by row: clipped in rounded numbers with a slack, and the
//! ends of each row put right by the exact test, since between them all cells are met. Complexity: O(segments + cells that they meet).

use std::cmp::Ordering;

use welter_predicates::moved_grid::{compare_crossings, crossing_precedes, moved_box_meets_segment};

use super::ClosedPolylines;
use crate::grid::{Grid3, first_where, nodes_between};
use crate::surface::topology::union_find::UnionFind;
use crate::volumetric::crossings::{Crossing, Crossings};
use crate::volumetric::extension::Extension;
use crate::volumetric::precursors::{Precursor, cell_box, cell_of};
use crate::volumetric::rows::Rows;
use crate::{Cancelled, DVec2, Monitor};

/// Segments between two looks at the monitor.
const CHUNK: u32 = 4096;

/// Rounding of clipped coordinates, relative to the largest: a clipping errs by less than 16 units of 2^-53.
const SLACK: f64 = 1.0 / (1u64 << 46) as f64;

/// A curve and the layer of cells that it is cut with.
pub(super) struct Front<'a> {
    curves: &'a ClosedPolylines,
    grid: &'a Grid3,
}

impl<'a> Front<'a> {
    pub(super) fn new(curves: &'a ClosedPolylines, grid: &'a Grid3) -> Self {
        Self { curves, grid }
    }

    /// The cells that the curve meets, and what hangs together in them.
    pub(super) fn extension(&self, monitor: &Monitor<'_>) -> Result<Extension, Cancelled> {
        let mut list = Vec::new();
        self.for_each_segment("cells that segments meet", monitor, |s| {
            self.for_each_cell(s, |[i, j]| list.push((j as usize, Precursor { i, triangle: s })));
        })?;
        let rows = Rows::sorted(self.rows(), &[list], |_, a, b| (a.i, a.triangle).cmp(&(b.i, b.triangle)));
        let unite = |[i, j, _]: [u32; 3], segments: &[Precursor], sets: &mut UnionFind| {
            for (place, precursor) in segments.iter().enumerate() {
                let segment = precursor.triangle;
                if self.cell_at(self.curves.segment(segment)[0]) != [i, j] {
                    continue;
                }
                let before = self.curves.before(segment);
                let other = segments
                    .binary_search_by_key(&before, |p| p.triangle)
                    .expect("a segment meets the cell of its end");
                sets.unite(place as u32, other as u32);
            }
        };
        Extension::from_parts(self.grid, rows, unite, monitor)
    }

    /// The crossings of the edges along x and y.
    pub(super) fn crossings(&self, monitor: &Monitor<'_>) -> Result<Crossings, Cancelled> {
        let ny = self.grid.nodes()[1] as usize;
        let mut axes = Vec::with_capacity(2);
        for axis in [0, 1] {
            let mut list = Vec::new();
            self.for_each_segment("edges that segments cut", monitor, |s| self.cross(s, axis, &mut list))?;
            let upper: Vec<_> = list.iter().map(|&(row, crossing)| (row + ny, crossing)).collect();
            axes.push(Rows::sorted(self.rows(), &[list, upper], |row, a: &Crossing, b| {
                a.i.cmp(&b.i).then_with(|| self.along_edge(axis, row % ny, a, b))
            }));
        }
        let none = Rows::new(vec![0; self.rows() + 1], Vec::new());
        let [x, y]: [Rows<Crossing>; 2] =
            axes.try_into().unwrap_or_else(|_| unreachable!("there are two axes"));
        Ok(Crossings::from_parts([x, y, none]))
    }

    fn rows(&self) -> usize {
        let [_, ny, nz] = self.grid.nodes().map(|n| n as usize);
        ny * nz
    }

    fn for_each_segment(
        &self,
        name: &'static str,
        monitor: &Monitor<'_>,
        mut f: impl FnMut(u32),
    ) -> Result<(), Cancelled> {
        let count = self.curves.len() as u32;
        let stage = monitor.stage(name, u64::from(count));
        for begin in (0..count).step_by(CHUNK as usize) {
            stage.check()?;
            let end = count.min(begin + CHUNK);
            (begin..end).for_each(&mut f);
            stage.advance(u64::from(end - begin));
        }
        Ok(())
    }

    /// The cell that holds a point.
    pub(super) fn cell_at(&self, p: DVec2) -> [u32; 2] {
        [0, 1].map(|axis| cell_of(self.grid, axis, p[axis]))
    }

    /// Calls `met` with the cells that a segment meets.
    fn for_each_cell(&self, segment: u32, mut met: impl FnMut([u32; 2])) {
        let grid = self.grid;
        let [p, q] = self.curves.segment(segment);
        let (low, high) = (self.cell_at(p.min(q)), self.cell_at(p.max(q)));
        let height = 0.5 * grid.spacing();
        let wall = [[p.x, p.y, height], [q.x, q.y, height]];
        let meets = |i: u32, j: u32| {
            let [min, max] = cell_box(grid, [i, j, 0]);
            moved_box_meets_segment(min, max, wall)
        };
        let slack = SLACK * p.abs().max(q.abs()).max_element() + f64::MIN_POSITIVE;
        for j in low[1]..=high[1] {
            let (mut first, mut last) = (low[0], high[0]);
            if low[1] < high[1] && first < last {
                let ends = [j, j + 1].map(|j| {
                    let along = (grid.coordinate(1, j) - p.y) / (q.y - p.y);
                    p.x + (q.x - p.x) * along.clamp(0.0, 1.0)
                });
                first = first.max(cell_of(grid, 0, ends[0].min(ends[1]) - slack));
                last = last.min(cell_of(grid, 0, ends[0].max(ends[1]) + slack));
            }
            let Some(first) = (first..=last).find(|&i| meets(i, j)) else { continue };
            let last = (first..=last).rev().find(|&i| i == first || meets(i, j)).unwrap_or(first);
            (first..=last).for_each(|i| met([i, j]));
        }
    }

    /// The plane upright through a segment. Its normal points to the right of the segment, that is outward.
    fn wall(&self, segment: u32) -> [[f64; 3]; 3] {
        let [p, q] = self.curves.segment(segment);
        [[p.x, p.y, 0.0], [q.x, q.y, 0.0], [q.x, q.y, self.grid.spacing()]]
    }

    /// The line of edges along an axis that begin at a node, by its other two coordinates as the predicates take them.
    fn line(axis: usize, across: f64) -> [f64; 2] {
        if axis == 0 { [across, 0.0] } else { [0.0, across] }
    }

    /// Lists the crossings of a segment with the edges along an axis in the lower nodes.
    fn cross(&self, segment: u32, axis: usize, list: &mut Vec<(usize, Crossing)>) {
        let (grid, across) = (self.grid, 1 - axis);
        let [p, q] = self.curves.segment(segment);
        let (low, high) = (p[across].min(q[across]), p[across].max(q[across]));
        let wall = self.wall(segment);
        // To the left is inside: an edge along x enters through a segment that goes down, one along y through one that goes to the right.
        let enters = if axis == 0 { q.y < p.y } else { q.x > p.x };
        for n in nodes_between(grid, across, low, high) {
            let at = grid.coordinate(across, n);
            // The line is moved upward: it passes below the upper end.
            if at >= high {
                continue;
            }
            let line = Self::line(axis, at);
            let precedes = |n: u32| crossing_precedes(axis, line, wall, grid.coordinate(axis, n));
            let along = p[axis] + (q[axis] - p[axis]) * ((at - p[across]) / (q[across] - p[across]));
            let guess = ((along - grid.origin()[axis]) / grid.spacing()).ceil();
            let guess = guess.clamp(0.0, f64::from(grid.cells()[axis])) as u32;
            let before = first_where(0, grid.nodes()[axis], guess, precedes).saturating_sub(1);
            let (i, row) = if axis == 0 { (before, n) } else { (n, before) };
            list.push((row as usize, Crossing { i, triangle: segment, enters }));
        }
    }

    /// The order of two crossings of one edge. Where they are at one place it is as if each segment were moved outward, those of lower
    /// numbers by more: so bodies that touch overlap by nothing, and of loops that coincide each lies within the one before.
    fn along_edge(&self, axis: usize, j: usize, a: &Crossing, b: &Crossing) -> Ordering {
        let across = if axis == 0 { self.grid.coordinate(1, j as u32) } else { self.grid.coordinate(0, a.i) };
        let [s, t] = [a, b].map(|crossing| self.wall(crossing.triangle));
        let outermost = a.triangle.cmp(&b.triangle);
        let tied = if a.enters { outermost } else { outermost.reverse() };
        compare_crossings(axis, Self::line(axis, across), s, t).then(b.enters.cmp(&a.enters)).then(tied)
    }
}
