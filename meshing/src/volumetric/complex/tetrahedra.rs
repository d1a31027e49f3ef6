//! The complex of tetrahedra: [`euler_characteristics_of_tetrahedra`].

use rayon::prelude::*;
use thiserror::Error;

use super::super::TetMesh;
use super::{Components, Tallies, Tally, count_vertices, label};
use crate::{Cancelled, Monitor};

/// The edges of a tetrahedron as corners.
pub(in crate::volumetric) const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// The sides of a tetrahedron as corners, each opposite to the corner of its number.
pub(in crate::volumetric) const TRIANGLES: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// Tetrahedra whose sides a thread sorts at a time.
const TETRAHEDRA: usize = 1 << 14;

/// About how many sides of tetrahedra are sorted together, each counted as often as it is met: at most 200 MB.
const SIDES_AT_A_TIME: usize = 1 << 24;

/// What is wrong with a [`TetMesh`].
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum TetMeshError {
    /// A corner is no vertex.
    #[error("corner {corner} of tetrahedron {tetrahedron} is vertex {vertex}, of {vertices}")]
    Vertex {
        /// The tetrahedron.
        tetrahedron: usize,
        /// Its corner.
        corner: usize,
        /// The vertex.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Two corners are the same vertex.
    #[error("vertex {vertex} is two corners of tetrahedron {tetrahedron}")]
    Repeated {
        /// The tetrahedron.
        tetrahedron: usize,
        /// The vertex.
        vertex: u32,
    },
}

/// Why something of tetrahedra was not computed.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum TetError {
    /// The tetrahedra are no complex.
    #[error(transparent)]
    Mesh(#[from] TetMeshError),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Whether every tetrahedron has four different vertices of the mesh; the first fault.
pub(in crate::volumetric) fn check(mesh: &TetMesh) -> Result<(), TetMeshError> {
    let vertices = mesh.positions.len();
    let fault = |(tetrahedron, corners): (usize, &[u32; 4])| {
        if let Some(corner) = corners.iter().position(|&v| v as usize >= vertices) {
            return Some(TetMeshError::Vertex { tetrahedron, corner, vertex: corners[corner], vertices });
        }
        let repeated = EDGES.iter().find(|&&[a, b]| corners[a] == corners[b])?;
        Some(TetMeshError::Repeated { tetrahedron, vertex: corners[repeated[0]] })
    };
    match mesh.tetrahedra.par_iter().enumerate().find_map_first(fault) {
        Some(fault) => Err(fault),
        None => Ok(()),
    }
}

/// The components of a mesh of tetrahedra with their counts and so their Euler characteristics; in parallel. Two tetrahedra of the same
/// four vertices are two cells.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, volumetric::{TetMesh, euler_characteristics_of_tetrahedra}};
/// let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(DVec3::from_array).to_vec();
/// let mesh = TetMesh { positions, tetrahedra: vec![[0, 1, 2, 3]], hexahedra: vec![0] };
/// let counts = euler_characteristics_of_tetrahedra(&mesh, &Monitor::none())?.total();
/// assert_eq!([counts.vertices, counts.edges, counts.faces, counts.cells], [4, 6, 4, 1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TetError`]: a corner that is no vertex or is there twice, or cancelled.
pub fn euler_characteristics_of_tetrahedra(
    mesh: &TetMesh,
    monitor: &Monitor<'_>,
) -> Result<Components, TetError> {
    check(mesh)?;
    let (labels, of_vertex) = label(&mesh.tetrahedra, mesh.positions.len(), monitor)?;
    let tallies = Tallies::new(labels.count());
    count_vertices(&tallies, &of_vertex);
    let mut tally = Tally::new(&tallies);
    labels.of().iter().for_each(|&component| tally.add(component, 3));
    let vertices = mesh.positions.len();
    for_each_distinct(&mesh.tetrahedra, &EDGES, vertices, monitor, |[a, ..]| {
        tally.add(of_vertex[a as usize], 1);
    })?;
    for_each_distinct(&mesh.tetrahedra, &TRIANGLES, vertices, monitor, |[a, ..]| {
        tally.add(of_vertex[a as usize], 2);
    })?;
    drop(tally);
    Ok(Components { counts: tallies.into_counts(), labels })
}

/// Calls `f` with the different sides of all tetrahedra, by their vertices, ascending. Sides whose first vertices are in one range are sorted
/// together, so that few are held at a time.
fn for_each_distinct<const N: usize>(
    tetrahedra: &[[u32; 4]],
    sides: &[[usize; N]],
    vertices: usize,
    monitor: &Monitor<'_>,
    mut f: impl FnMut([u32; N]),
) -> Result<(), Cancelled> {
    let ranges = (tetrahedra.len() * sides.len()).div_ceil(SIDES_AT_A_TIME).max(1);
    for range in 0..ranges {
        monitor.check()?;
        let [begin, end] = [range, range + 1].map(|n| (n * vertices / ranges) as u32);
        let lists: Vec<Vec<[u32; N]>> = tetrahedra
            .par_chunks(TETRAHEDRA)
            .map(|chunk| {
                let all = chunk.iter().flat_map(|corners| {
                    sides.iter().map(|side| ascending(side.map(|corner| corners[corner])))
                });
                let mut list: Vec<[u32; N]> = all.filter(|side| (begin..end).contains(&side[0])).collect();
                list.sort_unstable();
                list.dedup();
                list
            })
            .collect();
        monitor.check()?;
        let mut all = lists.concat();
        drop(lists);
        all.par_sort_unstable();
        monitor.check()?;
        all.dedup();
        all.into_iter().for_each(&mut f);
    }
    Ok(())
}

/// The same numbers, ascending.
pub(in crate::volumetric) fn ascending<const N: usize>(mut numbers: [u32; N]) -> [u32; N] {
    numbers.sort_unstable();
    numbers
}
