//! Counts of the cells of a volumetric mesh and Euler characteristics of its components: [`euler_characteristics`].
//!
//! # What it computes
//! The complex of a [`HexMesh`]: its vertices that a hexahedron has, the distinct pairs of vertices that are edges of hexahedra, the
//! distinct sets of four that are sides, and the hexahedra; for each component, by common vertices. Of a [`TetMesh`] likewise.
//!
//! # What it promises
//! Exact, for any mesh, also where many sheets lie on each other; the same for any number of threads.
//!
//! # What it does not promise
//! Anything about places: what lies at the same place and has no vertex in common does not hang together.
//!
//! # Method
//! An edge or face of the complex lies on one of the grid, so it is counted among the hexahedra of the few cells around that. Cells
//! ascend, and a cursor for each neighbour walks along with them. Components by union-find, all threads in one \[Anderson91\]. The edges
//! and faces of tetrahedra are sorted.
//!
//! # Complexity
//! O(n) time while cells have few hexahedra, O(n log n) in any case; 8 bytes a vertex and 4 a hexahedron, apart from the result.
//! For tetrahedra O(n log n) and 48 bytes a tetrahedron.

mod labels;
mod tally;
mod tetrahedra;

use std::iter::Sum;
use std::ops::Add;

use rayon::prelude::*;

use super::neighbours::pieces;
use super::{HexMesh, edges, faces};
use crate::{Cancelled, Monitor};
pub use labels::ComponentLabels;
pub(super) use labels::{NONE, label};
use tally::{Tallies, Tally};
pub(super) use tetrahedra::{EDGES, TRIANGLES, ascending, check};
pub use tetrahedra::{TetError, TetMeshError, euler_characteristics_of_tetrahedra};

/// How many cells of each dimension a complex has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CellCounts {
    /// Vertices that a cell has.
    pub vertices: u64,
    /// Edges.
    pub edges: u64,
    /// Quadrilaterals or triangles.
    pub faces: u64,
    /// Hexahedra or tetrahedra.
    pub cells: u64,
}

impl CellCounts {
    /// Vertices - edges + faces - cells.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        (self.vertices as i64 - self.edges as i64) + (self.faces as i64 - self.cells as i64)
    }

    /// Cells of all dimensions.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.vertices + self.edges + self.faces + self.cells
    }
}

impl Add for CellCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            vertices: self.vertices + other.vertices,
            edges: self.edges + other.edges,
            faces: self.faces + other.faces,
            cells: self.cells + other.cells,
        }
    }
}

impl Sum for CellCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Add::add)
    }
}

/// The components of a volumetric mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    labels: ComponentLabels,
    counts: Vec<CellCounts>,
}

impl Components {
    /// The component of each hexahedron or tetrahedron.
    #[must_use]
    pub fn labels(&self) -> &ComponentLabels {
        &self.labels
    }

    /// The counts of each component.
    #[must_use]
    pub fn counts(&self) -> &[CellCounts] {
        &self.counts
    }

    /// The counts of all components together.
    #[must_use]
    pub fn total(&self) -> CellCounts {
        self.counts.iter().copied().sum()
    }
}

/// The components of a mesh of hexahedra with their counts and so their Euler characteristics; in parallel.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{HexMesh, euler_characteristics}};
/// let grid = Grid3::new([0.0; 3], 0.5, [1; 3])?;
/// // Two hexahedra on the only cell, with one side in common.
/// let nodes = vec![0, 1, 2, 3, 4, 5, 6, 7, 1, 3, 5, 7];
/// let mesh = HexMesh::new(grid, nodes, vec![[0, 1, 2, 3, 4, 5, 6, 7], [0, 8, 2, 9, 4, 10, 6, 11]], vec![0, 0])?;
/// let components = euler_characteristics(&mesh, &Monitor::none())?;
/// assert_eq!(components.labels().of(), [0, 0]);
/// let counts = components.counts()[0];
/// assert_eq!([counts.vertices, counts.edges, counts.faces, counts.cells], [12, 20, 11, 2]);
/// assert_eq!(counts.euler_characteristic(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn euler_characteristics(mesh: &HexMesh, monitor: &Monitor<'_>) -> Result<Components, Cancelled> {
    let (labels, of_vertex) = label(mesh.hexahedra(), mesh.nodes().len(), monitor)?;
    let tallies = Tallies::new(labels.count());
    count_vertices(&tallies, &of_vertex);
    drop(of_vertex);
    let of = labels.of();
    let stage = monitor.stage("counting cells", mesh.len() as u64);
    pieces(mesh).into_par_iter().try_for_each(|piece| {
        stage.check()?;
        let mut tally = Tally::new(&tallies);
        of[piece.clone()].iter().for_each(|&component| tally.add(component, 3));
        faces::visit(mesh, piece.clone(), |face| {
            let first = face.below.first().or(face.above.first()).expect("a face has a hexahedron");
            tally.add(of[*first], 2);
        });
        let hexahedra = piece.len() as u64;
        edges::visit(mesh, piece, |(hexahedron, _), earlier| {
            if earlier.is_none() {
                tally.add(of[hexahedron], 1);
            }
        });
        stage.advance(hexahedra);
        Ok(())
    })?;
    Ok(Components { counts: tallies.into_counts(), labels })
}

fn count_vertices(tallies: &Tallies, of_vertex: &[u32]) {
    of_vertex.par_chunks(1 << 16).for_each(|block| {
        let mut tally = Tally::new(tallies);
        block.iter().filter(|&&label| label != NONE).for_each(|&label| tally.add(label, 0));
    });
}
