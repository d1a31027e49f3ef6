//! Tests of `welter_meshing::spatial` and of the type that rests on it, `EmbeddedMesh`.

mod boxes;
mod closest;
mod embedded;
mod oracle;
mod rays;
mod real_meshes;
mod self_intersections;
mod winding;

use glam::DVec3;
use welter_kit::entropy::Entropy;
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// A mesh of points and triples of indices that are known to be in range.
fn mesh_of(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(TriangleSoup { positions, triangles, ..Default::default() }).expect("a valid mesh")
}

/// The same triangles with every position mapped.
fn mapped(mesh: &TriMesh, map: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let mut soup = mesh.to_soup();
    soup.positions.iter_mut().for_each(|p| *p = map(*p));
    TriMesh::new(soup).expect("a valid mesh")
}

/// Triangles on few points of a small grid, so that every way of touching and every degeneracy is common.
fn crowded(entropy: &mut Entropy<'_>, points: u8, triangles: usize, grid: u8) -> TriMesh {
    let positions = (0..points)
        .map(|_| DVec3::from_array(std::array::from_fn(|_| f64::from(entropy.below(grid)))))
        .collect();
    mesh_of(positions, distinct_triples(entropy, points, triangles))
}

/// Small triangles in the cube [0, 1]^3, no two with a common vertex.
fn scattered(entropy: &mut Entropy<'_>, triangles: usize, size: f64) -> TriMesh {
    let unit = |entropy: &mut Entropy<'_>| f64::from(entropy.word() as u32) / f64::from(u32::MAX);
    let point = |entropy: &mut Entropy<'_>| DVec3::from_array(std::array::from_fn(|_| unit(entropy)));
    let mut positions = Vec::new();
    for _ in 0..triangles {
        let corner = point(entropy);
        positions.extend((0..3).map(|_| corner + size * point(entropy)));
    }
    mesh_of(positions, (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
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

/// Powers of two that take coordinates of moderate size to the ends of the exponent range, and back to the middle.
const SCALES: [[f64; 2]; 5] = [
    [1.0, 1.0],
    [1.0 / 8.0, 1.0],
    [f64::MIN_POSITIVE, 1.0 / 1024.0],
    [5e-324, 1.0],
    [8.98846567431158e307 / 1024.0, 8.0],
];

/// Runs on a pool of so many threads.
fn on_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool").install(run)
}
