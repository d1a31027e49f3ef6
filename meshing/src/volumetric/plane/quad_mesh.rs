//! [`QuadMesh`]: quadrilaterals that are copies of cells of a grid, and how they hang together.

use thiserror::Error;

use crate::DVec2;
use crate::grid::Grid2;
use crate::surface::topology::union_find::UnionFind;

/// Quadrilaterals on cells of a grid; several may lie on one cell, and several vertices on one node.
///
/// Corner `c` of a quadrilateral, `c` of 0 to 3, lies at the node of its cell with index `cell + (c & 1, c >> 1)`. Two quadrilaterals hang
/// together where they have vertices in common, never by lying at the same place.
///
/// ```
/// use welter_meshing::{grid::Grid2, volumetric::plane::QuadMesh};
/// let grid = Grid2::new([0.0; 2], 0.5, [1; 2])?;
/// // Two quadrilaterals on the only cell, with one side in common.
/// let mesh = QuadMesh::new(grid, vec![0, 1, 2, 3, 1, 3], vec![[0, 1, 2, 3], [0, 4, 2, 5]], vec![0, 0])?;
/// assert_eq!(mesh.position(4), mesh.position(1));
/// assert_eq!(mesh.components().1, [1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct QuadMesh {
    grid: Grid2,
    nodes: Vec<u64>,
    quadrilaterals: Vec<[u32; 4]>,
    cells: Vec<u64>,
}

/// The sides of a quadrilateral as corners, counterclockwise. Side `2 a` is the lower one along axis `a`, side `2 a + 1` the upper.
pub(super) const SIDES: [[usize; 2]; 4] = [[2, 0], [1, 3], [0, 1], [3, 2]];

/// Why there is no such [`QuadMesh`].
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum QuadMeshError {
    /// There must be a cell for each quadrilateral.
    #[error("{quadrilaterals} quadrilaterals on {cells} cells")]
    Lengths {
        /// How many quadrilaterals.
        quadrilaterals: usize,
        /// How many cells.
        cells: usize,
    },
    /// Cells must ascend.
    #[error("quadrilateral {quadrilateral} lies on a cell before that of the one before it")]
    Order {
        /// The second of the two.
        quadrilateral: usize,
    },
    /// The grid has no such cell.
    #[error("quadrilateral {quadrilateral} lies on cell {cell}, which the grid does not have")]
    Cell {
        /// The quadrilateral.
        quadrilateral: usize,
        /// Its cell.
        cell: u64,
    },
    /// A corner is no vertex, or a vertex at another node.
    #[error("corner {corner} of quadrilateral {quadrilateral} is vertex {vertex}, which is not at that node")]
    Corner {
        /// The quadrilateral.
        quadrilateral: usize,
        /// Its corner.
        corner: usize,
        /// The vertex.
        vertex: u32,
    },
}

impl QuadMesh {
    /// The mesh of vertices at nodes of a grid, by number, and quadrilaterals on cells, by number, ascending.
    ///
    /// # Errors
    /// [`QuadMeshError`], the first fault.
    pub fn new(
        grid: Grid2,
        nodes: Vec<u64>,
        quadrilaterals: Vec<[u32; 4]>,
        cells: Vec<u64>,
    ) -> Result<Self, QuadMeshError> {
        let mesh = Self { grid, nodes, quadrilaterals, cells };
        mesh.check()?;
        Ok(mesh)
    }

    /// Takes over arrays of which the promises are known by their construction.
    pub(super) fn by_construction(
        grid: Grid2,
        nodes: Vec<u64>,
        quadrilaterals: Vec<[u32; 4]>,
        cells: Vec<u64>,
    ) -> Self {
        let mesh = Self { grid, nodes, quadrilaterals, cells };
        debug_assert_eq!(mesh.check(), Ok(()), "a construction that promises quadrilaterals on their cells");
        mesh
    }

    fn check(&self) -> Result<(), QuadMeshError> {
        let (quadrilaterals, cells) = (self.quadrilaterals.len(), self.cells.len());
        if quadrilaterals != cells {
            return Err(QuadMeshError::Lengths { quadrilaterals, cells });
        }
        if let Some(before) = self.cells.windows(2).position(|pair| pair[0] > pair[1]) {
            return Err(QuadMeshError::Order { quadrilateral: before + 1 });
        }
        for (quadrilateral, (corners, &cell)) in self.quadrilaterals.iter().zip(&self.cells).enumerate() {
            if cell >= self.grid.cell_count() as u64 {
                return Err(QuadMeshError::Cell { quadrilateral, cell });
            }
            let [i, j] = self.grid.cell_at(cell as usize);
            for (corner, &vertex) in corners.iter().enumerate() {
                let node = self.grid.node_index([i + (corner as u32 & 1), j + (corner as u32 >> 1)]) as u64;
                if self.nodes.get(vertex as usize) != Some(&node) {
                    return Err(QuadMeshError::Corner { quadrilateral, corner, vertex });
                }
            }
        }
        Ok(())
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid2 {
        &self.grid
    }

    /// Number of the grid's node at which each vertex lies.
    #[must_use]
    pub fn nodes(&self) -> &[u64] {
        &self.nodes
    }

    /// The corners of each quadrilateral.
    #[must_use]
    pub fn quadrilaterals(&self) -> &[[u32; 4]] {
        &self.quadrilaterals
    }

    /// Number of the grid's cell on which each quadrilateral lies, ascending.
    #[must_use]
    pub fn cells(&self) -> &[u64] {
        &self.cells
    }

    /// Number of quadrilaterals.
    #[must_use]
    pub fn len(&self) -> usize {
        self.quadrilaterals.len()
    }

    /// Whether there is no quadrilateral.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.quadrilaterals.is_empty()
    }

    /// Where a vertex lies. Exact.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn position(&self, vertex: u32) -> DVec2 {
        self.grid.position(self.grid.node_at(self.nodes[vertex as usize] as usize))
    }

    /// The component of each quadrilateral, and the Euler characteristic of each component. Components are numbered in the order of their
    /// first quadrilaterals.
    #[must_use]
    pub fn components(&self) -> (Vec<u32>, Vec<i64>) {
        let mut sets = UnionFind::new(self.nodes.len());
        for corners in &self.quadrilaterals {
            corners[1..].iter().for_each(|&corner| sets.unite(corners[0], corner));
        }
        let mut of_root = vec![u32::MAX; self.nodes.len()];
        let (mut of, mut characteristics) = (Vec::with_capacity(self.len()), Vec::new());
        for corners in &self.quadrilaterals {
            let component = &mut of_root[sets.root(corners[0]) as usize];
            if *component == u32::MAX {
                *component = characteristics.len() as u32;
                characteristics.push(0);
            }
            characteristics[*component as usize] += 1;
            of.push(*component);
        }
        for vertex in 0..self.nodes.len() as u32 {
            // A vertex of no quadrilateral is of no component.
            if let Some(count) = characteristics.get_mut(of_root[sets.root(vertex) as usize] as usize) {
                *count += 1;
            }
        }
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(4 * self.len());
        for corners in &self.quadrilaterals {
            edges.extend(SIDES.map(|side| {
                let [a, b] = side.map(|c| corners[c]);
                [a.min(b), a.max(b)]
            }));
        }
        edges.sort_unstable();
        edges.dedup();
        for [a, _] in edges {
            characteristics[of_root[sets.root(a) as usize] as usize] -= 1;
        }
        (of, characteristics)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_named() {
        let grid = Grid2::new([0.0; 2], 1.0, [2, 1]).unwrap();
        let nodes: Vec<u64> = (0..6).collect();
        let square = [0, 1, 3, 4];
        assert!(QuadMesh::new(grid, nodes.clone(), vec![square], vec![0]).is_ok());
        let refused = |quads, cells| QuadMesh::new(grid, nodes.clone(), quads, cells).unwrap_err();
        assert_eq!(refused(vec![square], vec![]), QuadMeshError::Lengths { quadrilaterals: 1, cells: 0 });
        assert_eq!(refused(vec![square], vec![2]), QuadMeshError::Cell { quadrilateral: 0, cell: 2 });
        let fault = QuadMeshError::Corner { quadrilateral: 0, corner: 0, vertex: 0 };
        assert_eq!(refused(vec![square], vec![1]), fault);
        assert_eq!(refused(vec![square, square], vec![1, 0]), QuadMeshError::Order { quadrilateral: 1 });
    }

    #[test]
    fn sides_run_counterclockwise() {
        for (side, [a, b]) in SIDES.into_iter().enumerate() {
            let (axis, upper) = (side / 2, side % 2);
            assert_eq!([a, b].map(|c| c >> axis & 1), [upper; 2]);
            let step = [0, 1].map(|k| (b >> k & 1) as i32 - (a >> k & 1) as i32);
            let forward = if axis == 0 { step[1] } else { -step[0] };
            assert_eq!(forward, if upper == 1 { 1 } else { -1 });
        }
    }
}
