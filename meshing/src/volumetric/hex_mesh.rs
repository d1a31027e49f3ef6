//! [`HexMesh`]: hexahedra that are copies of cells of a grid, and how they hang together.

use thiserror::Error;

use rayon::prelude::*;

use crate::DVec3;
use crate::grid::Grid3;

/// Hexahedra on cells of a grid; several may lie on one cell, and several vertices on one node.
///
/// Corner `c` of a hexahedron, `c` of 0 to 7, lies at the node of its cell with index `cell + (c & 1, c >> 1 & 1, c >> 2)`. Two
/// hexahedra hang together where they have vertices in common, never by lying at the same place.
///
/// ```
/// use welter_meshing::{grid::Grid3, volumetric::HexMesh};
/// let grid = Grid3::new([0.0; 3], 0.5, [1; 3])?;
/// // Two hexahedra on the only cell, with one side in common.
/// let nodes = vec![0, 1, 2, 3, 4, 5, 6, 7, 1, 3, 5, 7];
/// let mesh = HexMesh::new(grid, nodes, vec![[0, 1, 2, 3, 4, 5, 6, 7], [0, 8, 2, 9, 4, 10, 6, 11]], vec![0, 0])?;
/// assert_eq!(mesh.len(), 2);
/// assert_eq!(mesh.position(8), mesh.position(1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HexMesh {
    grid: Grid3,
    nodes: Vec<u64>,
    hexahedra: Vec<[u32; 8]>,
    cells: Vec<u64>,
}

/// The sides of a hexahedron as corners: quadrilaterals whose corners turn counterclockwise seen from outside. Side `2 a` is the lower one along
/// axis `a`, side `2 a + 1` the upper.
pub const QUADRILATERALS: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Why there is no such [`HexMesh`].
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum HexMeshError {
    /// There must be a cell for each hexahedron.
    #[error("{hexahedra} hexahedra on {cells} cells")]
    Lengths {
        /// How many hexahedra.
        hexahedra: usize,
        /// How many cells.
        cells: usize,
    },
    /// Cells must ascend.
    #[error("hexahedron {hexahedron} lies on a cell before that of the one before it")]
    Order {
        /// The second of the two.
        hexahedron: usize,
    },
    /// The grid has no such cell.
    #[error("hexahedron {hexahedron} lies on cell {cell}, which the grid does not have")]
    Cell {
        /// The hexahedron.
        hexahedron: usize,
        /// Its cell.
        cell: u64,
    },
    /// A corner is no vertex, or a vertex at another node.
    #[error("corner {corner} of hexahedron {hexahedron} is vertex {vertex}, which is not at that node")]
    Corner {
        /// The hexahedron.
        hexahedron: usize,
        /// Its corner.
        corner: usize,
        /// The vertex.
        vertex: u32,
    },
}

impl HexMesh {
    /// The mesh of vertices at nodes of a grid, by number, and hexahedra on cells, by number, ascending.
    ///
    /// # Errors
    /// [`HexMeshError`], the first fault.
    pub fn new(
        grid: Grid3,
        nodes: Vec<u64>,
        hexahedra: Vec<[u32; 8]>,
        cells: Vec<u64>,
    ) -> Result<Self, HexMeshError> {
        let mesh = Self { grid, nodes, hexahedra, cells };
        mesh.check()?;
        Ok(mesh)
    }

    /// Takes over arrays of which the promises are known by their construction.
    pub(crate) fn by_construction(
        grid: Grid3,
        nodes: Vec<u64>,
        hexahedra: Vec<[u32; 8]>,
        cells: Vec<u64>,
    ) -> Self {
        let mesh = Self { grid, nodes, hexahedra, cells };
        debug_assert_eq!(mesh.check(), Ok(()), "a construction that promises hexahedra on their cells");
        mesh
    }

    fn check(&self) -> Result<(), HexMeshError> {
        let (hexahedra, cells) = (self.hexahedra.len(), self.cells.len());
        if hexahedra != cells {
            return Err(HexMeshError::Lengths { hexahedra, cells });
        }
        if let Some(before) = self.cells.windows(2).position(|pair| pair[0] > pair[1]) {
            return Err(HexMeshError::Order { hexahedron: before + 1 });
        }
        for (hexahedron, (corners, &cell)) in self.hexahedra.iter().zip(&self.cells).enumerate() {
            if cell >= self.grid.cell_count() as u64 {
                return Err(HexMeshError::Cell { hexahedron, cell });
            }
            let first = self.grid.cell_at(cell as usize);
            for (corner, &vertex) in corners.iter().enumerate() {
                let node = self.grid.node_index(corner_node(first, corner)) as u64;
                if self.nodes.get(vertex as usize) != Some(&node) {
                    return Err(HexMeshError::Corner { hexahedron, corner, vertex });
                }
            }
        }
        Ok(())
    }

    /// Calls `f` with the mesh of some of the hexahedra, ascending, and all vertices.
    pub(crate) fn with_some<T>(&mut self, some: &[u32], f: impl FnOnce(&Self) -> T) -> T {
        let part = Self {
            grid: self.grid,
            nodes: std::mem::take(&mut self.nodes),
            hexahedra: some.par_iter().with_min_len(1 << 14).map(|&h| self.hexahedra[h as usize]).collect(),
            cells: some.par_iter().with_min_len(1 << 14).map(|&h| self.cells[h as usize]).collect(),
        };
        let result = f(&part);
        self.nodes = part.nodes;
        result
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid3 {
        &self.grid
    }

    /// Number of the grid's node at which each vertex lies.
    #[must_use]
    pub fn nodes(&self) -> &[u64] {
        &self.nodes
    }

    /// The corners of each hexahedron.
    #[must_use]
    pub fn hexahedra(&self) -> &[[u32; 8]] {
        &self.hexahedra
    }

    /// Number of the grid's cell on which each hexahedron lies, ascending.
    #[must_use]
    pub fn cells(&self) -> &[u64] {
        &self.cells
    }

    /// Number of hexahedra.
    #[must_use]
    pub fn len(&self) -> usize {
        self.hexahedra.len()
    }

    /// Whether there is no hexahedron.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.hexahedra.is_empty()
    }

    /// Where a vertex lies. Exact.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn position(&self, vertex: u32) -> DVec3 {
        DVec3::from_array(self.grid.node(self.grid.node_at(self.nodes[vertex as usize] as usize)))
    }
}

/// The node at a corner of a cell.
pub(crate) fn corner_node(cell: [u32; 3], corner: usize) -> [u32; 3] {
    std::array::from_fn(|axis| cell[axis] + (corner >> axis & 1) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_face_outward() {
        let at = |c: usize| DVec3::from_array([0, 1, 2].map(|axis| (c >> axis & 1) as f64));
        for (side, corners) in QUADRILATERALS.iter().enumerate() {
            let [a, b, c, _] = corners.map(at);
            let mut outward = [0.0; 3];
            outward[side / 2] = if side % 2 == 0 { -1.0 } else { 1.0 };
            assert_eq!((b - a).cross(c - b).to_array(), outward, "side {side}");
        }
    }

    #[test]
    fn faults_are_named() {
        let grid = Grid3::new([0.0; 3], 1.0, [2, 1, 1]).unwrap();
        let nodes: Vec<u64> = (0..12).collect();
        let cube = [0, 1, 3, 4, 6, 7, 9, 10];
        assert!(HexMesh::new(grid, nodes.clone(), vec![cube], vec![0]).is_ok());
        let refused = |hexahedra, cells| HexMesh::new(grid, nodes.clone(), hexahedra, cells).unwrap_err();
        assert_eq!(refused(vec![cube], vec![]), HexMeshError::Lengths { hexahedra: 1, cells: 0 });
        assert_eq!(refused(vec![cube], vec![2]), HexMeshError::Cell { hexahedron: 0, cell: 2 });
        assert_eq!(
            refused(vec![cube], vec![1]),
            HexMeshError::Corner { hexahedron: 0, corner: 0, vertex: 0 }
        );
        assert_eq!(refused(vec![cube, cube], vec![1, 0]), HexMeshError::Order { hexahedron: 1 });
    }
}
