//! What coarsening did to the topology: [`coarsen_checked`], [`TopologyReport`].

use super::super::{BettiError, BettiLimits, HexMesh, betti_numbers, euler_characteristics};
use super::{CoarsenError, Coarsening, coarsen};
use crate::Monitor;

/// What of the topology changed.
#[derive(Clone, Debug, PartialEq, Eq)]
#[must_use]
pub struct TopologyReport {
    /// Every change, in the order of the components of the fine mesh.
    pub changes: Vec<TopologyChange>,
    /// Whether Betti numbers were compared: they are if both meshes are within the limits and no component came apart.
    pub betti_compared: bool,
}

impl TopologyReport {
    /// Whether nothing is known to have changed.
    #[must_use]
    pub fn kept(&self) -> bool {
        self.changes.is_empty()
    }
}

/// A change of topology.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TopologyChange {
    /// A component came apart.
    Pieces {
        /// The component of the fine mesh.
        component: u32,
        /// How many components it became.
        pieces: u64,
    },
    /// The Euler characteristic is another.
    EulerCharacteristic {
        /// The component of the fine mesh.
        component: u32,
        /// What it was.
        fine: i64,
        /// What it is.
        coarse: i64,
    },
    /// The Betti numbers are others.
    BettiNumbers {
        /// The component of the fine mesh.
        component: u32,
        /// What they were.
        fine: [u64; 4],
        /// What they are.
        coarse: [u64; 4],
    },
}

/// Coarsens, and compares the topology of both meshes.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{BettiLimits, HexMesh, TopologyChange, coarsen_checked}};
/// // Two hexahedra of one coarse cell that hang together by an edge only: they come apart.
/// let grid = Grid3::new([0.0; 3], 0.5, [2, 2, 1])?;
/// let nodes = vec![0, 1, 3, 4, 9, 10, 12, 13, 5, 7, 8, 14, 16, 17];
/// let hexahedra = vec![[0, 1, 2, 3, 4, 5, 6, 7], [3, 8, 9, 10, 7, 11, 12, 13]];
/// let mesh = HexMesh::new(grid, nodes, hexahedra, vec![0, 3])?;
/// let (_, report) = coarsen_checked(&mesh, &BettiLimits::default(), &Monitor::none())?;
/// assert_eq!(report.changes, [TopologyChange::Pieces { component: 0, pieces: 2 }]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CoarsenError`]: no such grid, too many hexahedra, or cancelled.
pub fn coarsen_checked(
    mesh: &HexMesh,
    limits: &BettiLimits,
    monitor: &Monitor<'_>,
) -> Result<(Coarsening, TopologyReport), CoarsenError> {
    let coarsening = coarsen(mesh, monitor)?;
    let fine = euler_characteristics(mesh, monitor)?;
    let coarse = euler_characteristics(&coarsening.mesh, monitor)?;
    let pairs = pairs(fine.labels().of(), coarse.labels().of(), &coarsening.coarse_of);
    let mut report = TopologyReport { changes: Vec::new(), betti_compared: false };
    let one_to_one = pairs.len() == fine.labels().count() && pairs.len() == coarse.labels().count();
    let betti = if one_to_one { both_betti_numbers(mesh, &coarsening.mesh, limits, monitor)? } else { None };
    report.betti_compared = betti.is_some();
    for group in pairs.chunk_by(|a, b| a.0 == b.0) {
        let (component, [of_fine, of_coarse]) = (group[0].0, [group[0].0 as usize, group[0].1 as usize]);
        if group.len() > 1 {
            report.changes.push(TopologyChange::Pieces { component, pieces: group.len() as u64 });
            continue;
        }
        let [before, after] =
            [fine.counts()[of_fine], coarse.counts()[of_coarse]].map(|counts| counts.euler_characteristic());
        if before != after {
            report.changes.push(TopologyChange::EulerCharacteristic {
                component,
                fine: before,
                coarse: after,
            });
        }
        if let Some([before, after]) = &betti {
            let (before, after) = (before[of_fine], after[of_coarse]);
            if before != after {
                report.changes.push(TopologyChange::BettiNumbers { component, fine: before, coarse: after });
            }
        }
    }
    Ok((coarsening, report))
}

/// The components of the fine mesh with those that they became, ascending.
fn pairs(fine: &[u32], coarse: &[u32], coarse_of: &[u32]) -> Vec<(u32, u32)> {
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for (&component, &hexahedron) in fine.iter().zip(coarse_of) {
        let pair = (component, coarse[hexahedron as usize]);
        if pairs.last() != Some(&pair) {
            pairs.push(pair);
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The Betti numbers of the components of both meshes, unless one is too large.
fn both_betti_numbers(
    fine: &HexMesh,
    coarse: &HexMesh,
    limits: &BettiLimits,
    monitor: &Monitor<'_>,
) -> Result<Option<[Vec<[u64; 4]>; 2]>, CoarsenError> {
    let of = |mesh| match betti_numbers(mesh, limits, monitor) {
        Ok(numbers) => Ok(Some(numbers.of_components().to_vec())),
        Err(BettiError::Cancelled(cancelled)) => Err(CoarsenError::Cancelled(cancelled)),
        Err(BettiError::TooLarge { .. } | BettiError::Mesh(_)) => Ok(None),
    };
    let Some(coarse) = of(coarse)? else { return Ok(None) };
    Ok(of(fine)?.map(|fine| [fine, coarse]))
}
