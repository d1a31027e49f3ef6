//! Where the surface is in the mesh: [`Hosts`].

use rayon::prelude::*;

use super::extension::Extension;
use super::precursors::cell_of;
use crate::DVec3;
use crate::grid::Grid3;
use crate::surface::TriMesh;

/// Cells that a thread takes at a time.
const CELLS: usize = 1 << 12;

/// A vertex of the surface in a hexahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Host {
    /// The hexahedron; `u32::MAX` for a vertex that no triangle uses.
    pub hexahedron: u32,
    /// Coordinates within its cell, each from 0 to 1: weights of the corners are products of these and their complements.
    pub at: [f64; 3],
}

impl Host {
    /// The weights of the eight corners of the hexahedron; trilinear, so the position of the vertex is the weighted sum of theirs.
    ///
    /// ```
    /// use welter_meshing::volumetric::Host;
    /// let host = Host { hexahedron: 0, at: [0.25, 0.0, 1.0] };
    /// assert_eq!(host.weights(), [0.0, 0.0, 0.0, 0.0, 0.75, 0.25, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn weights(&self) -> [f64; 8] {
        std::array::from_fn(|corner| {
            let along = |axis: usize| {
                if corner >> axis & 1 == 1 { self.at[axis] } else { 1.0 - self.at[axis] }
            };
            along(0) * along(1) * along(2)
        })
    }
}

/// Where the surface is in the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Hosts {
    /// The host of each vertex of the surface.
    pub vertices: Vec<Host>,
    /// Each hexahedron and triangle where a triangle passes through a hexahedron, sorted.
    pub triangles: Vec<[u32; 2]>,
    /// Number of vertices whose triangles do not all lie in one hexahedron where the vertex is; 0 for a sound mesh.
    pub disagreements: usize,
}

impl Hosts {
    /// The triangles in a hexahedron, ascending, each after its number.
    #[must_use]
    pub fn in_hexahedron(&self, hexahedron: u32) -> &[[u32; 2]] {
        let begin = self.triangles.partition_point(|pair| pair[0] < hexahedron);
        let end = begin + self.triangles[begin..].partition_point(|pair| pair[0] == hexahedron);
        &self.triangles[begin..end]
    }

    /// From the hexahedra of the extension and what became of each.
    pub(super) fn new(
        mesh: &TriMesh,
        grid: &Grid3,
        extension: &Extension,
        became: impl Fn(u32) -> u32 + Sync,
    ) -> Self {
        let ny = grid.nodes()[1] as usize;
        let none = Host { hexahedron: u32::MAX, at: [0.0; 3] };
        let mut hosts =
            Self { vertices: vec![none; mesh.positions().len()], triangles: Vec::new(), disagreements: 0 };
        let mut disagrees = vec![false; mesh.positions().len()];
        let of_corners: Vec<[u32; 3]> = (0..mesh.triangles().len() as u32)
            .into_par_iter()
            .with_min_len(1024)
            .map(|t| {
                mesh.triangles()[t as usize].map(|corner| {
                    let cell = cell_with(grid, mesh.positions()[corner.index()]);
                    let row = cell[1] as usize + ny * cell[2] as usize;
                    let number =
                        extension.cell_at(row, cell[0]).expect("a triangle meets the cell of its vertex");
                    became(extension.hexahedron_of(number, t).expect("the triangle is in its list"))
                })
            })
            .collect();
        for (corners, of_corners) in mesh.triangles().iter().zip(of_corners) {
            for (corner, hexahedron) in corners.iter().zip(of_corners) {
                let host = &mut hosts.vertices[corner.index()];
                if host.hexahedron == u32::MAX {
                    let p = mesh.positions()[corner.index()];
                    *host = Host { hexahedron, at: within(grid, cell_with(grid, p), p) };
                } else if host.hexahedron != hexahedron {
                    disagrees[corner.index()] = true;
                }
            }
        }
        hosts.disagreements = disagrees.iter().filter(|&&disagrees| disagrees).count();
        // Hexahedra are numbered cell by cell, so that lists sorted within cells are sorted.
        let cells = extension.cells().items().len();
        let lists: Vec<Vec<[u32; 2]>> = (0..cells.div_ceil(CELLS))
            .into_par_iter()
            .map(|chunk| {
                let mut list = Vec::new();
                for number in chunk * CELLS..cells.min((chunk + 1) * CELLS) {
                    let begin = list.len();
                    let (triangles, hexahedra) = extension.triangles(number);
                    let pairs = triangles.iter().zip(hexahedra);
                    list.extend(pairs.map(|(precursor, &h)| [became(h), precursor.triangle]));
                    list[begin..].sort_unstable();
                }
                list.dedup();
                list
            })
            .collect();
        hosts.triangles = lists.concat();
        debug_assert!(hosts.triangles.is_sorted());
        hosts
    }
}

/// The cell that holds a point.
fn cell_with(grid: &Grid3, p: DVec3) -> [u32; 3] {
    std::array::from_fn(|axis| cell_of(grid, axis, p[axis]))
}

/// The coordinates of a point within a cell, from 0 to 1.
pub(super) fn within(grid: &Grid3, cell: [u32; 3], p: DVec3) -> [f64; 3] {
    std::array::from_fn(|axis| {
        ((p[axis] - grid.coordinate(axis, cell[axis])) / grid.spacing()).clamp(0.0, 1.0)
    })
}
