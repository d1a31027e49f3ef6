//! Where the surface crosses the edges of the grid, exactly: [`Crossings`].
//!
//! # What it promises
//! * Each crossing of an edge of the moved grid (see `welter_predicates::moved_grid`) with a triangle, once, with its direction. No edge
//!   ends on the surface, and none meets an edge or a vertex of a triangle: there the move decides.
//! * The order of the crossings along each edge. Where two triangles lie in one plane the one that enters comes first, then the lower
//!   number: bodies that touch overlap by nothing, and none is of negative depth.
//!
//! # Method
//! For each triangle and axis the lines through its box in the other two coordinates, trimmed to its chord.
//! Complexity: O(n + crossings), beside the lines between chord and triangle.

use std::cmp::Ordering;

use rayon::prelude::*;
use welter_predicates::Sign;
use welter_predicates::moved_grid::{axis_line_crossing, compare_crossings, crossing_precedes};

use super::rows::Rows;
use crate::grid::{Grid3, first_where, nodes_between};
use crate::spatial::{Box3, chord};
use crate::surface::{TriId, TriMesh};
use crate::{Cancelled, DVec3, Monitor};

/// Triangles that a thread takes at a time.
const CHUNK: usize = 1024;

/// A crossing of an edge from node `i` of a row.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Crossing {
    /// First coordinate of the index of the node where the edge begins.
    pub(super) i: u32,
    /// The triangle that crosses.
    pub(super) triangle: u32,
    /// Whether the edge enters the surface there, in its own direction.
    pub(super) enters: bool,
}

/// All crossings of the edges along x, y and z, each in the row of the node where its edge begins, and in the order along x of that
/// node and then along the edge.
#[derive(Clone, Debug)]
pub(super) struct Crossings {
    pub(super) axes: [Rows<Crossing>; 3],
}

impl Crossings {
    pub(super) fn new(mesh: &TriMesh, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Self, Cancelled> {
        let stage = monitor.stage("edges that the surface cuts", 3 * mesh.triangles().len() as u64);
        let [_, ny, nz] = grid.nodes().map(|n| n as usize);
        let of_axis = |axis: usize| -> Result<Rows<Crossing>, Cancelled> {
            let lists: Vec<Vec<(usize, Crossing)>> = (0..mesh.triangles().len().div_ceil(CHUNK))
                .into_par_iter()
                .map(|chunk| {
                    stage.check()?;
                    let mut list = Vec::new();
                    let triangles = chunk * CHUNK..mesh.triangles().len().min((chunk + 1) * CHUNK);
                    let count = triangles.len() as u64;
                    for t in triangles {
                        cross(mesh.corners(TriId::from_index(t)), t as u32, axis, grid, &mut list);
                    }
                    stage.advance(count);
                    Ok(list)
                })
                .collect::<Result<_, Cancelled>>()?;
            Ok(Rows::sorted(ny * nz, &lists, |row, a, b| {
                a.i.cmp(&b.i).then_with(|| along_edge(mesh, grid, axis, row, a, b))
            }))
        };
        Ok(Self::from_parts([of_axis(0)?, of_axis(1)?, of_axis(2)?]))
    }

    /// From the crossings along each axis, sorted as they must be.
    pub(super) fn from_parts(axes: [Rows<Crossing>; 3]) -> Self {
        Self { axes }
    }

    /// The crossings of the edge along an axis that begins at node `i` of a row, as a range among all of the axis.
    pub(super) fn on_edge(&self, axis: usize, row: usize, i: u32) -> std::ops::Range<usize> {
        let range = self.axes[axis].range(row);
        if range.is_empty() {
            return range;
        }
        let items = &self.axes[axis].items()[range.clone()];
        let first = items.partition_point(|crossing| crossing.i < i);
        let count = items[first..].iter().take_while(|crossing| crossing.i == i).count();
        range.start + first..range.start + first + count
    }
}

/// The order of two crossings of one edge.
fn along_edge(mesh: &TriMesh, grid: &Grid3, axis: usize, row: usize, a: &Crossing, b: &Crossing) -> Ordering {
    let ny = grid.nodes()[1] as usize;
    let node = grid.node([a.i, (row % ny) as u32, (row / ny) as u32]);
    let line = [node[(axis + 1) % 3], node[(axis + 2) % 3]];
    let [s, t] = [a, b].map(|crossing| mesh.corners(TriId(crossing.triangle)).map(|p| p.to_array()));
    // Of triangles in one plane the lowest lies outermost, whichever way the edge passes them.
    let outermost_first = a.triangle.cmp(&b.triangle);
    let by_number = if a.enters { outermost_first } else { outermost_first.reverse() };
    compare_crossings(axis, line, s, t).then(b.enters.cmp(&a.enters)).then(by_number)
}

/// Lists the crossings of one triangle with all edges along an axis.
fn cross(corners: [DVec3; 3], t: u32, axis: usize, grid: &Grid3, list: &mut Vec<(usize, Crossing)>) {
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let around = Box3::of(corners);
    let lines = nodes_between(grid, v, around.min[v], around.max[v]);
    if lines.is_empty() || nodes_between(grid, u, around.min[u], around.max[u]).is_empty() {
        return;
    }
    let triangle = corners.map(|p| p.to_array());
    let ny = grid.nodes()[1] as usize;
    for at_v in lines {
        let height = grid.coordinate(v, at_v);
        let [low, high] = chord(corners, &around, [u, v], height);
        for at_u in nodes_between(grid, u, low, high) {
            let line = [grid.coordinate(u, at_u), height];
            let direction = axis_line_crossing(axis, line, triangle);
            if direction == Sign::Zero {
                continue;
            }
            let precedes = |n: u32| crossing_precedes(axis, line, triangle, grid.coordinate(axis, n));
            let guess = plane_crossing(grid, corners, axis, line);
            let behind = first_where(0, grid.nodes()[axis], guess, precedes);
            let mut index = [0; 3];
            index[axis] = behind.saturating_sub(1);
            (index[u], index[v]) = (at_u, at_v);
            let row = index[1] as usize + ny * index[2] as usize;
            list.push((row, Crossing { i: index[0], triangle: t, enters: direction == Sign::Negative }));
        }
    }
}

/// About where a line meets the plane of a triangle, as the number of the node behind.
fn plane_crossing(grid: &Grid3, [a, b, c]: [DVec3; 3], axis: usize, line: [f64; 2]) -> u32 {
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let normal = (b - a).cross(c - a);
    let at = a[axis] - (normal[u] * (line[0] - a[u]) + normal[v] * (line[1] - a[v])) / normal[axis];
    // NaN becomes 0: any guess will do.
    ((at - grid.origin()[axis]) / grid.spacing()).ceil().clamp(0.0, f64::from(grid.cells()[axis])) as u32
}
