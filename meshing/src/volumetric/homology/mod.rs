//! Betti numbers of volumetric meshes modulo 2: [`betti_numbers`].
//!
//! # What it computes
//! For each component of the complex of a mesh its Betti numbers, the dimensions of its homology with coefficients modulo 2: pieces, tunnels,
//! cavities, and closed hypersurfaces of sheets glued to each other all around.
//!
//! # What it promises
//! Exact, or [`BettiError::TooLarge`] if the complex, or what is left of it after reductions, is above a limit: never a wrong number.
//! The same for any number of threads.
//!
//! # What it does not promise
//! Torsion is not told apart: modulo 2 a Moebius band and its thickening are a circle, a projective plane has Betti numbers 1, 1, 1.
//!
//! # Method
//! Collapses and coreductions, which are linear \[Mrozek09, Kaczynski98\], leave a few cells of most complexes; the ranks of the
//! boundaries of the rest are found by elimination \[Edelsbrunner02, Chen11\].
//!
//! # Complexity
//! Linear in the cells but for the rest, of which it is cubic at worst. About 40 bytes a cell, of which a hexahedron has about 8.

mod cells;
mod chains;
mod elimination;
mod reduction;

use thiserror::Error;

use super::complex::{CellCounts, ComponentLabels, TetError, TetMeshError, label};
use super::{HexMesh, TetMesh, euler_characteristics, euler_characteristics_of_tetrahedra};
use crate::{Cancelled, Monitor};
use chains::Chains;
use elimination::NoRanks;
use reduction::Reduction;

/// How much Betti numbers may take. Above a limit there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BettiLimits {
    /// Most cells of all dimensions; a hexahedron has about 8, and a cell takes about 40 bytes. No more than 2^31 are ever taken.
    /// By default 2^26: 2.5 GB.
    pub most_cells: u64,
    /// Most entries of matrix columns that the elimination may read: it takes some nanoseconds for each. By default 2^32.
    pub most_entries: u64,
}

impl Default for BettiLimits {
    fn default() -> Self {
        Self { most_cells: 1 << 26, most_entries: 1 << 32 }
    }
}

/// No complex has more cells, so that numbers of cells and of their faces are of 32 bits.
const MOST_CELLS: u64 = 1 << 31;

/// Why there are no Betti numbers.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum BettiError {
    /// A limit was reached; the numbers are not known.
    #[error(
        "too large: {cells} cells of which {rest} are left to eliminate, with at most {most_cells} cells and {most_entries} entries"
    )]
    TooLarge {
        /// Cells of all dimensions.
        cells: u64,
        /// How many were left after collapses and coreductions; 0 if those were not begun.
        rest: u64,
        /// The limit on cells.
        most_cells: u64,
        /// The limit on entries.
        most_entries: u64,
    },
    /// The tetrahedra are no complex.
    #[error(transparent)]
    Mesh(#[from] TetMeshError),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The Betti numbers of the components of a volumetric mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BettiNumbers {
    of_components: Vec<[u64; 4]>,
    rest: u64,
}

impl BettiNumbers {
    /// For each component, in the order of first members: 1, and how many independent tunnels, cavities and closed hypersurfaces it has.
    #[must_use]
    pub fn of_components(&self) -> &[[u64; 4]] {
        &self.of_components
    }

    /// Of all components together.
    #[must_use]
    pub fn total(&self) -> [u64; 4] {
        let mut total = [0; 4];
        for numbers in &self.of_components {
            total.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
        }
        total
    }

    /// How many cells collapses and coreductions left to be eliminated: what the time depends on beyond the size.
    #[must_use]
    pub fn rest(&self) -> u64 {
        self.rest
    }
}

/// The Betti numbers of the components of a mesh of hexahedra.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{BettiLimits, HexMesh, betti_numbers}};
/// let grid = Grid3::new([0.0; 3], 0.5, [1; 3])?;
/// // Two hexahedra on the only cell that have all of their sides in common: a hypersphere.
/// let corners = [0, 1, 2, 3, 4, 5, 6, 7];
/// let mesh = HexMesh::new(grid, (0..8).collect(), vec![corners; 2], vec![0, 0])?;
/// let betti = betti_numbers(&mesh, &BettiLimits::default(), &Monitor::none())?;
/// assert_eq!(betti.of_components(), [[1, 0, 0, 1]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BettiError`]: too large, or cancelled.
pub fn betti_numbers(
    mesh: &HexMesh,
    limits: &BettiLimits,
    monitor: &Monitor<'_>,
) -> Result<BettiNumbers, BettiError> {
    limits.check(euler_characteristics(mesh, monitor)?.total())?;
    let (labels, of_vertex) = label(mesh.hexahedra(), mesh.nodes().len(), monitor)?;
    let chains = cells::of_hexahedra(mesh, of_vertex, monitor)?;
    of_chains(&chains, &labels, limits, monitor)
}

/// The Betti numbers of the components of a mesh of tetrahedra.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, volumetric::{BettiLimits, TetMesh, betti_numbers_of_tetrahedra}};
/// let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(DVec3::from_array).to_vec();
/// let mesh = TetMesh { positions, tetrahedra: vec![[0, 1, 2, 3]], hexahedra: vec![0] };
/// let betti = betti_numbers_of_tetrahedra(&mesh, &BettiLimits::default(), &Monitor::none())?;
/// assert_eq!(betti.total(), [1, 0, 0, 0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BettiError`]: too large, a corner that is no vertex or is there twice, or cancelled.
pub fn betti_numbers_of_tetrahedra(
    mesh: &TetMesh,
    limits: &BettiLimits,
    monitor: &Monitor<'_>,
) -> Result<BettiNumbers, BettiError> {
    let counts = euler_characteristics_of_tetrahedra(mesh, monitor).map_err(|error| match error {
        TetError::Mesh(fault) => BettiError::Mesh(fault),
        TetError::Cancelled(cancelled) => BettiError::Cancelled(cancelled),
    })?;
    limits.check(counts.total())?;
    let (labels, of_vertex) = label(&mesh.tetrahedra, mesh.positions.len(), monitor)?;
    let chains = cells::of_tetrahedra(mesh, of_vertex, monitor)?;
    of_chains(&chains, &labels, limits, monitor)
}

impl BettiLimits {
    fn check(&self, counts: CellCounts) -> Result<(), BettiError> {
        let cells = counts.total();
        if cells > self.most_cells.min(MOST_CELLS) { Err(self.too_large(cells, 0)) } else { Ok(()) }
    }

    fn too_large(&self, cells: u64, rest: u64) -> BettiError {
        let Self { most_cells, most_entries } = *self;
        BettiError::TooLarge { cells, rest, most_cells: most_cells.min(MOST_CELLS), most_entries }
    }
}

fn of_chains(
    chains: &Chains,
    labels: &ComponentLabels,
    limits: &BettiLimits,
    monitor: &Monitor<'_>,
) -> Result<BettiNumbers, BettiError> {
    let mut reduction = Reduction::new(chains);
    reduction.run(labels.count(), monitor)?;
    let left: u64 = (0..4).map(|dimension| reduction.left(dimension).len() as u64).sum();
    let rest = elimination::ranks(chains, &reduction, labels.count(), limits.most_entries, monitor);
    let rest = rest.map_err(|reason| match reason {
        NoRanks::TooManyEntries => {
            limits.too_large(chains.counts.iter().map(|&count| count as u64).sum(), left)
        }
        NoRanks::Cancelled(cancelled) => BettiError::Cancelled(cancelled),
    })?;
    let of_component = |rest: elimination::Rest| {
        [0, 1, 2, 3].map(|k| {
            let bounding = rest.ranks.get(k + 1).copied().unwrap_or(0);
            // One vertex of each component was left out.
            rest.cells[k] - rest.ranks[k] - bounding + u64::from(k == 0)
        })
    };
    Ok(BettiNumbers { of_components: rest.into_iter().map(of_component).collect(), rest: left })
}
