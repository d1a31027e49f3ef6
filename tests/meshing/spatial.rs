//! Tests of `welter_meshing::spatial`.

mod oracle;
mod real_meshes;
mod self_intersections;

use glam::DVec3;
use welter_kit::entropy::Entropy;
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// A mesh of points and triples of indices that are known to be in range.
fn mesh_of(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(TriangleSoup { positions, triangles, ..Default::default() }).expect("a valid mesh")
}

/// Triangles on few points of a small grid, so that every way of touching and every degeneracy is common.
fn crowded(entropy: &mut Entropy<'_>, points: u8, triangles: usize, grid: u8) -> TriMesh {
    let positions = (0..points)
        .map(|_| DVec3::from_array(std::array::from_fn(|_| f64::from(entropy.below(grid)))))
        .collect();
    mesh_of(positions, distinct_triples(entropy, points, triangles))
}

/// Triples of different indices below `points`.
fn distinct_triples(entropy: &mut Entropy<'_>, points: u8, count: usize) -> Vec<[u32; 3]> {
    let triple = |entropy: &mut Entropy<'_>| {
        let a = entropy.below(points);
        let b = (a + 1 + entropy.below(points - 1)) % points;
        let c = (0..points).cycle().skip(entropy.below(points).into()).find(|&c| c != a && c != b);
        [a, b, c.expect("three points at least")].map(u32::from)
    };
    (0..count).map(|_| triple(entropy)).collect()
}
