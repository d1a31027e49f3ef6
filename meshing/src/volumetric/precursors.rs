//! Which cells of the grid each triangle meets, exactly: [`precursors`], the precursor meshes of \[Gagniere22\] 3.5.1.
//!
//! # What it promises
//! Exactly the cells of the moved grid (see `welter_predicates::moved_grid`) that the closed triangle meets. A point lies in one cell.
//!
//! # Method
//! A triangle whose box lies in one cell meets that cell. A larger one is clipped in rounded numbers, with a slack, by layers and rows of
//! cells, which leaves a range of each row; the ends of the range are put right by the exact test, and between them all cells
//! are met, since triangle and row are convex. Complexity: O(n + pairs).

use std::ops::RangeInclusive;

use rayon::prelude::*;
use welter_predicates::moved_grid::moved_box_meets_triangle;

use super::rows::Rows;
use crate::grid::{Grid3, first_at};
use crate::spatial::Box3;
use crate::surface::{TriId, TriMesh};
use crate::{Cancelled, DVec3, Monitor};

/// Triangles that a thread takes at a time.
const CHUNK: usize = 1024;

/// Rounding of clipped coordinates, relative to the largest: each of two clippings errs by less than 16 units of 2^-53.
const SLACK: f64 = 1.0 / (1u64 << 46) as f64;

/// A triangle in a cell of a row.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Precursor {
    /// First coordinate of the index of the cell.
    pub(super) i: u32,
    /// The triangle that meets it.
    pub(super) triangle: u32,
}

/// For each row, that of its cells' first nodes, the triangles in its cells, sorted by cell and number.
pub(super) fn precursors(
    mesh: &TriMesh,
    grid: &Grid3,
    monitor: &Monitor<'_>,
) -> Result<Rows<Precursor>, Cancelled> {
    let count = mesh.triangles().len();
    let stage = monitor.stage("cells that triangles meet", count as u64);
    let [_, ny, nz] = grid.nodes().map(|n| n as usize);
    let lists: Vec<Vec<(usize, Precursor)>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            stage.check()?;
            let mut list = Vec::new();
            let triangles = chunk * CHUNK..count.min((chunk + 1) * CHUNK);
            let done = triangles.len() as u64;
            for t in triangles {
                for_each_cell(mesh.corners(TriId::from_index(t)), grid, |[i, j, k]| {
                    list.push((j as usize + ny * k as usize, Precursor { i, triangle: t as u32 }));
                });
            }
            stage.advance(done);
            Ok(list)
        })
        .collect::<Result<_, Cancelled>>()?;
    Ok(Rows::sorted(ny * nz, &lists, |_, a, b| (a.i, a.triangle).cmp(&(b.i, b.triangle))))
}

/// The cell along an axis that holds a coordinate: cells are open below and closed above, since the grid is moved upward.
pub(super) fn cell_of(grid: &Grid3, axis: usize, x: f64) -> u32 {
    first_at(grid, axis, |node| node >= x, x).saturating_sub(1).min(grid.cells()[axis] - 1)
}

/// The box of a cell, its lower and upper corner.
pub(super) fn cell_box(grid: &Grid3, cell: [u32; 3]) -> [[f64; 3]; 2] {
    [grid.node(cell), grid.node(cell.map(|i| i + 1))]
}

fn for_each_cell(corners: [DVec3; 3], grid: &Grid3, mut met: impl FnMut([u32; 3])) {
    let around = Box3::of(corners);
    let [xs, ys, zs] = [0, 1, 2].map(|axis| cells_between(grid, axis, around.min[axis], around.max[axis]));
    let first = [*xs.start(), *ys.start(), *zs.start()];
    if first == [*xs.end(), *ys.end(), *zs.end()] {
        met(first);
        return;
    }
    let triangle = corners.map(|p| p.to_array());
    let meets = |cell: [u32; 3]| {
        let [min, max] = cell_box(grid, cell);
        moved_box_meets_triangle(min, max, triangle)
    };
    let slack = SLACK * around.min.abs().max(around.max.abs()).max_element() + f64::MIN_POSITIVE;
    let narrow = xs.end() - xs.start() < 2;
    for k in zs.clone() {
        let layer = if narrow && zs.end() - zs.start() < 2 {
            Polygon::of(corners)
        } else {
            Polygon::of(corners).between(2, grid.coordinate(2, k) - slack, grid.coordinate(2, k + 1) + slack)
        };
        let Some([low, high]) = layer.extent(1) else { continue };
        for j in within(cells_between(grid, 1, low - slack, high + slack), &ys) {
            let mut range = xs.clone();
            if !narrow {
                let row = layer.between(1, grid.coordinate(1, j) - slack, grid.coordinate(1, j + 1) + slack);
                let Some([low, high]) = row.extent(0) else { continue };
                range = within(cells_between(grid, 0, low - slack, high + slack), &xs);
            }
            let Some(first) = range.clone().find(|&i| meets([i, j, k])) else { continue };
            let last = range.rev().find(|&i| i == first || meets([i, j, k])).unwrap_or(first);
            (first..=last).for_each(|i| met([i, j, k]));
        }
    }
}

fn cells_between(grid: &Grid3, axis: usize, low: f64, high: f64) -> RangeInclusive<u32> {
    cell_of(grid, axis, low)..=cell_of(grid, axis, high)
}

fn within(range: RangeInclusive<u32>, outer: &RangeInclusive<u32>) -> RangeInclusive<u32> {
    *range.start().max(outer.start())..=*range.end().min(outer.end())
}

/// A convex polygon that is left of a triangle.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec3; 7],
    count: usize,
}

impl Polygon {
    fn of([a, b, c]: [DVec3; 3]) -> Self {
        let mut corners = [a; 7];
        (corners[1], corners[2]) = (b, c);
        Self { corners, count: 3 }
    }

    /// The part between two planes across an axis.
    fn between(&self, axis: usize, low: f64, high: f64) -> Self {
        self.above(axis, low, 1.0).above(axis, high, -1.0)
    }

    /// The part where `sign` times the coordinate is at least `sign` times the bound.
    fn above(&self, axis: usize, bound: f64, sign: f64) -> Self {
        let mut part = Self { corners: self.corners, count: 0 };
        let depth = |p: DVec3| sign * (p[axis] - bound);
        for at in 0..self.count {
            let (p, q) = (self.corners[at], self.corners[(at + 1) % self.count]);
            let (at_p, at_q) = (depth(p), depth(q));
            if at_p >= 0.0 {
                part.push(p);
            }
            if (at_p < 0.0) != (at_q < 0.0) {
                part.push(p + (q - p) * (at_p / (at_p - at_q)).clamp(0.0, 1.0));
            }
        }
        part
    }

    /// A clipped triangle has at most seven corners: each of four planes adds one. Rounding adds none beyond.
    fn push(&mut self, p: DVec3) {
        if self.count < self.corners.len() {
            self.corners[self.count] = p;
            self.count += 1;
        }
    }

    fn extent(&self, axis: usize) -> Option<[f64; 2]> {
        let values = self.corners[..self.count].iter().map(|p| p[axis]);
        values.fold(None, |extent, x| match extent {
            None => Some([x, x]),
            Some([low, high]) => Some([low.min(x), high.max(x)]),
        })
    }
}
