//! Elements that a mesh has twice or that have no extent: [`duplicate_vertices`], [`duplicate_triangles`],
//! [`degenerate_triangles`].
//!
//! Promises: exact. Equality of positions is equality of numbers (zero and minus zero are equal); the area of a
//! triangle is zero exactly if its corners lie on one line, which is decided by predicates. The same result for any
//! number of threads.
//!
//! Complexity: O(n log n) for vertices, linear for triangles.

use super::edges;
use super::{Topology, TriId, TriMesh, VertexId};
use glam::DVec3;
use rayon::prelude::*;
use welter_predicates::orient2d;

/// Classes of two or more vertices at exactly the same position, each ascending, ordered by their first vertex.
///
/// ```
/// use welter_meshing::{DVec3, surface::{TriMesh, TriangleSoup, VertexId, duplicate_vertices}};
/// let positions = vec![DVec3::X, DVec3::Y, DVec3::X];
/// let mesh = TriMesh::new(TriangleSoup { positions, ..TriangleSoup::default() })?;
/// assert_eq!(duplicate_vertices(&mesh), [[VertexId(0), VertexId(2)]]);
/// # Ok::<(), welter_meshing::surface::TriMeshError>(())
/// ```
#[must_use]
pub fn duplicate_vertices(mesh: &TriMesh) -> Vec<Vec<VertexId>> {
    // Adding zero turns minus zero into zero; then equal numbers have equal bits.
    let key = |p: DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
    let mut order: Vec<(u64, u32)> =
        mesh.positions().par_iter().enumerate().map(|(i, &p)| (mix(key(p)), i as u32)).collect();
    order.par_sort_unstable();

    let mut classes = Vec::new();
    for same_hash in order.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1) {
        let mut run: Vec<_> =
            same_hash.iter().map(|&(_, i)| (key(mesh.positions()[i as usize]), i)).collect();
        run.sort_unstable();
        for class in run.chunk_by(|a, b| a.0 == b.0).filter(|class| class.len() > 1) {
            classes.push(class.iter().map(|&(_, i)| VertexId(i)).collect::<Vec<_>>());
        }
    }
    classes.sort_unstable();
    classes
}

/// A hash of three words: multiply and fold, with odd constants from the binary digits of the golden ratio and pi.
fn mix(words: [u64; 3]) -> u64 {
    let mut hash = 0x9e37_79b9_7f4a_7c15_u64;
    for word in words {
        let product = u128::from(hash ^ word) * 0x243f_6a88_85a3_08d3_u128;
        hash = (product ^ (product >> 64)) as u64;
    }
    hash
}

/// Classes of two or more triangles with the same three vertices, whatever their orientation, each ascending,
/// ordered by their first triangle.
///
/// ```
/// use welter_meshing::{DVec3, surface::*};
/// let soup = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2], [1, 0, 2]],
///     ..TriangleSoup::default()
/// };
/// let mesh = TriMesh::new(soup)?;
/// assert_eq!(duplicate_triangles(&mesh, &Topology::of(&mesh)), [[TriId(0), TriId(1)]]);
/// # Ok::<(), TriMeshError>(())
/// ```
#[must_use]
pub fn duplicate_triangles(mesh: &TriMesh, topology: &Topology) -> Vec<Vec<TriId>> {
    let table = topology.table();
    let mut classes = Vec::new();
    let mut thirds = Vec::new();
    for edge in table.ids() {
        // Each triangle is looked at once, from the edge of its two smaller vertices.
        let [_, high] = table.edges[edge.index()];
        thirds.clear();
        thirds.extend(table.half_edges(edge).iter().filter_map(|&h| {
            let third = edges::opposite(mesh, h);
            (third > high).then_some((third, edges::triangle(h)))
        }));
        if thirds.len() > 1 {
            thirds.sort_unstable();
            for class in thirds.chunk_by(|a, b| a.0 == b.0).filter(|class| class.len() > 1) {
                classes.push(class.iter().map(|&(_, t)| t).collect::<Vec<_>>());
            }
        }
    }
    classes.sort_unstable();
    classes
}

/// Triangles of exactly zero area: their corners lie on one line (or agree). Ascending.
///
/// ```
/// use welter_meshing::{DVec3, surface::*};
/// let soup = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::splat(0.1), DVec3::splat(0.2), DVec3::X],
///     triangles: vec![[0, 1, 2], [0, 1, 3]],
///     ..TriangleSoup::default()
/// };
/// assert_eq!(degenerate_triangles(&TriMesh::new(soup)?), [TriId(0)]);
/// # Ok::<(), TriMeshError>(())
/// ```
#[must_use]
pub fn degenerate_triangles(mesh: &TriMesh) -> Vec<TriId> {
    (0..mesh.triangles().len())
        .into_par_iter()
        .map(TriId::from_index)
        .filter(|&t| collinear(mesh.corners(t)))
        .collect()
}

/// Collinear in space exactly if the projections along all three axes are.
fn collinear(corners: [DVec3; 3]) -> bool {
    (0..3).all(|axis| {
        let [a, b, c] = corners.map(|p| [p[(axis + 1) % 3], p[(axis + 2) % 3]]);
        orient2d(a, b, c).is_zero()
    })
}
