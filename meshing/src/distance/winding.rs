//! How often a closed oriented surface winds around each node of a grid, exactly: [`grid_winding_numbers`].
//!
//! # What it computes
//! [`WindingNumbers::at`](crate::spatial::WindingNumbers::at) of every node, all at once.
//!
//! # What it promises
//! * The exact integer at each node; of nodes on the surface, that they are, and the lowest triangle that contains them.
//! * For a node on the surface there is a number too, that of a point beside it: the node moved by symbolic
//!   amounts `(c, e, d)`, `0 < d << e << c << 1`, lies on no triangle \[Edelsbrunner90\], and that point's number is given.
//! * The same for any number of threads.
//!
//! # Method
//! A row of nodes along x is a line. The triangles that it crosses, and in which direction, are decided as in
//! `spatial::winding`, by exact orientations and with the same symbolic move along y and z, so that an edge or a vertex that
//! meets the line is counted for exactly one of its triangles. A crossing adds +-1 to the numbers of all nodes of the row before
//! it: where that ends is guessed from the rounded plane of the triangle and put right by exact orientations of nodes, whose
//! coordinates are exact. The sums along the row, from its far end, are the numbers.
//!
//! # Complexity
//! O(n + nodes + crossings) for n triangles: a triangle costs a few orientations for each row through its
//! box in the plane (y, z), trimmed to the rows near the triangle.

use rayon::prelude::*;
use welter_predicates::intersection::triangle_contains_3d;
use welter_predicates::{Sign, orient2d, orient3d};

use super::slabs::Slabs;
use crate::grid::{Grid3, first_at, first_where};
use crate::spatial::{Box3, Winding, chord};
use crate::surface::{ClosedOrientedMesh, TriId, TriMesh};
use crate::{Cancelled, DVec3, Monitor};

/// Layers of nodes that one thread takes at a time.
const LAYERS: usize = 4;

/// Winding numbers of a surface about all nodes of a grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GridWindingNumbers {
    numbers: Vec<i32>,
    on_surface: Vec<(usize, TriId)>,
}

impl GridWindingNumbers {
    /// A number for each node, in the order of node numbers; for nodes on the surface that of a point beside it.
    #[must_use]
    pub fn numbers(&self) -> &[i32] {
        &self.numbers
    }

    /// The nodes on the surface by number, ascending, each with the lowest triangle that contains it.
    #[must_use]
    pub fn on_surface(&self) -> &[(usize, TriId)] {
        &self.on_surface
    }

    /// Where the node with a number lies relative to the surface.
    ///
    /// # Panics
    /// If the grid has no such node.
    #[must_use]
    pub fn at(&self, node: usize) -> Winding {
        match self.on_surface.binary_search_by_key(&node, |&(on, _)| on) {
            Ok(place) => Winding::OnSurface { triangle: self.on_surface[place].1 },
            Err(_) => Winding::Number(self.numbers[node]),
        }
    }
}

/// The winding numbers of a surface about all nodes of a grid; in parallel.
///
/// ```
/// use welter_meshing::{Monitor, distance::grid_winding_numbers, grid::Grid3, shapes::{BoxPair, two_boxes}};
/// let mesh = two_boxes(&BoxPair::overlapping())?; // [-1, 1]^3 and [0.2, 2.2]^3, or so
/// let grid = Grid3::new([-1.5; 3], 0.5, [8; 3])?;
/// let winding = grid_winding_numbers(&mesh, &grid, &Monitor::none())?;
/// assert_eq!(winding.numbers()[grid.node_index([0, 0, 0])], 0); // at (-1.5, -1.5, -1.5)
/// assert_eq!(winding.numbers()[grid.node_index([2, 2, 2])], 1); // at (-0.5, -0.5, -0.5)
/// assert_eq!(winding.numbers()[grid.node_index([4, 4, 4])], 2); // at (0.5, 0.5, 0.5), in both
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn grid_winding_numbers(
    mesh: &ClosedOrientedMesh,
    grid: &Grid3,
    monitor: &Monitor<'_>,
) -> Result<GridWindingNumbers, Cancelled> {
    let [nx, ny, nz] = grid.nodes().map(|n| n as usize);
    let slabs = Slabs::of(mesh, grid, LAYERS);
    let stage = monitor.stage("winding numbers", nz as u64);
    let mut numbers = vec![0; grid.node_count()];
    let found: Vec<Vec<(usize, TriId)>> = numbers
        .par_chunks_mut(nx * ny * LAYERS)
        .enumerate()
        .map(|(slab, numbers)| {
            let layers = numbers.len() / (nx * ny);
            let first = slab * LAYERS;
            let mut part = Slab { mesh, grid, first, layers, numbers, on_surface: Vec::new() };
            for &triangle in slabs.triangles(slab) {
                stage.check()?;
                part.count(triangle);
            }
            let on_surface = part.finish();
            stage.advance(layers as u64);
            Ok(on_surface)
        })
        .collect::<Result<_, Cancelled>>()?;
    Ok(GridWindingNumbers { numbers, on_surface: found.concat() })
}

/// Some layers of nodes. While triangles are counted, `numbers` holds at each node the crossings just before the next one.
struct Slab<'a> {
    mesh: &'a TriMesh,
    grid: &'a Grid3,
    first: usize,
    layers: usize,
    numbers: &'a mut [i32],
    on_surface: Vec<(usize, TriId)>,
}

impl Slab<'_> {
    /// Counts the crossings of a triangle with all rows of the slab.
    fn count(&mut self, id: TriId) {
        let corners = self.mesh.corners(id);
        let around = Box3::of(corners);
        let Some(xs) = nodes_within(self.grid, 0, around.min.x, around.max.x) else { return };
        let layers = nodes_within(self.grid, 2, around.min.z, around.max.z);
        let Some((z0, z1)) = layers.and_then(|[z0, z1]| {
            let [z0, z1] = [(z0 as usize).max(self.first), (z1 as usize).min(self.first + self.layers)];
            (z0 < z1).then_some((z0 as u32, z1 as u32))
        }) else {
            return;
        };
        let projected = orient2d(yz(corners[0]), yz(corners[1]), yz(corners[2]));
        for k in z0..z1 {
            let z = self.grid.coordinate(2, k);
            let [low, high] = chord(corners, &around, [1, 2], z);
            let Some([y0, y1]) = nodes_within(self.grid, 1, low, high) else { continue };
            for j in y0..y1 {
                let row = Row { y: self.grid.coordinate(1, j), z, j, k };
                self.cross(id, corners, projected, xs, row);
            }
        }
    }

    /// Counts the crossing of a triangle with a row, if there is one.
    fn cross(&mut self, id: TriId, corners: [DVec3; 3], projected: Sign, [x0, x1]: [u32; 2], row: Row) {
        let p = [row.y, row.z];
        let sides = [0, 1, 2].map(|e| orient2d(yz(corners[e]), yz(corners[(e + 1) % 3]), p));
        if projected == Sign::Zero {
            if sides == [Sign::Zero; 3] {
                // The row lies in the plane of the triangle.
                for i in x0..x1 {
                    if triangle_contains_3d(corners, self.grid.position([i, row.j, row.k])) {
                        self.on_surface.push((self.grid.node_index([i, row.j, row.k]), id));
                    }
                }
            }
            return;
        }
        if sides.contains(&-projected) {
            return;
        }
        // The row meets the closed triangle in one point: nodes from `behind` on are not before it.
        let [a, b, c] = corners;
        let side = |i: u32| orient3d(a, b, c, self.grid.position([i, row.j, row.k])) * projected;
        let guess = plane_crossing(self.grid, corners, &row);
        let behind = first_where(x0, x1, guess, |i| side(i) != Sign::Positive);
        if behind < x1 && side(behind) == Sign::Zero {
            self.on_surface.push((self.grid.node_index([behind, row.j, row.k]), id));
        }
        let winding: i32 =
            (0..3).map(|e| edge_passes(corners[e].z, corners[(e + 1) % 3].z, row.z, sides[e])).sum();
        if winding != 0 && behind > 0 {
            let last = self.grid.node_index([behind - 1, row.j, row.k]);
            let first_of_slab = self.grid.node_index([0, 0, self.first as u32]);
            self.numbers[last - first_of_slab] += winding;
        }
    }

    /// Sums from the far end of each row; returns the nodes on the surface.
    fn finish(mut self) -> Vec<(usize, TriId)> {
        for row in self.numbers.chunks_mut(self.grid.nodes()[0] as usize) {
            let mut sum = 0;
            for number in row.iter_mut().rev() {
                sum += *number;
                *number = sum;
            }
        }
        self.on_surface.sort_unstable();
        self.on_surface.dedup_by_key(|&mut (node, _)| node);
        self.on_surface
    }
}

/// A row of nodes along x.
struct Row {
    y: f64,
    z: f64,
    j: u32,
    k: u32,
}

fn yz(p: DVec3) -> [f64; 2] {
    [p.y, p.z]
}

/// +1 if an edge passes the height upward with the moved row on its left, -1 if downward with it on the right; `side` is
/// the orientation of the edge and the row. As in `spatial::winding`.
fn edge_passes(from: f64, to: f64, height: f64, side: Sign) -> i32 {
    if from <= height && height < to {
        i32::from(side == Sign::Positive)
    } else if to <= height && height < from {
        -i32::from(side == Sign::Negative)
    } else {
        0
    }
}

/// The nodes along an axis, `first..end`, between two coordinates; `None` if there are no nodes at or before `high` along x, or none
/// between them along another axis. (Along x a triangle between two nodes still counts for those before it.) Exact.
pub(super) fn nodes_within(grid: &Grid3, axis: usize, low: f64, high: f64) -> Option<[u32; 2]> {
    let first = first_at(grid, axis, |x| x >= low, low);
    let end = first_at(grid, axis, |x| x > high, high);
    let none = if axis == 0 { end == 0 } else { first >= end };
    (!none).then_some([first, end])
}

/// About where a row meets the plane of a triangle, as the number of a node.
fn plane_crossing(grid: &Grid3, [a, b, c]: [DVec3; 3], row: &Row) -> u32 {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let x = a.x - (normal.y * (row.y - a.y) + normal.z * (row.z - a.z)) / normal.x;
    // NaN becomes 0: any guess will do.
    ((x - grid.origin()[0]) / grid.spacing()).ceil().clamp(0.0, f64::from(grid.cells()[0])) as u32
}
