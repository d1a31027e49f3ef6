//! Tests of `welter_meshing::distance`.

mod fields;
mod level_sets;
mod winding;

use glam::DVec3;
use welter_kit::entropy::Entropy;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

/// Tetrahedra on points of a small lattice, of either orientation, degenerate ones and coincident ones included.
fn tetrahedra(entropy: &mut Entropy<'_>, count: u32, lattice: u8) -> ClosedOrientedMesh {
    let positions = (0..4 * count)
        .map(|_| DVec3::from_array(std::array::from_fn(|_| f64::from(entropy.below(lattice)))))
        .collect();
    let faces = |t: u32| [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|f| f.map(|v| 4 * t + v));
    closed(positions, (0..count).flat_map(faces).collect())
}

fn closed(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> ClosedOrientedMesh {
    let mesh = TriMesh::new(TriangleSoup { positions, triangles, ..Default::default() }).unwrap();
    ClosedOrientedMesh::new(mesh).unwrap()
}

/// The same triangles with every position mapped.
fn mapped(mesh: &TriMesh, map: impl Fn(DVec3) -> DVec3) -> ClosedOrientedMesh {
    let soup = mesh.to_soup();
    closed(soup.positions.into_iter().map(map).collect(), soup.triangles)
}

/// Runs on a pool of so many threads.
fn on_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool").install(run)
}
