//! Tests of `welter_meshing::surface`: each defect by a mesh that has it, topology against a slow obvious
//! twin, measures against rationals and analytic surfaces, and the laws that renumbering, reversing, moving
//! and scaling obey.

mod defects;
mod laws;
mod measure;
mod topology;

use welter_kit::entropy::{Entropy, stream};
use welter_meshing::DVec3;
use welter_meshing::io::{self, Format, Limits};
use welter_meshing::surface::*;

/// A mesh from coordinates and indices.
fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriMesh {
    TriMesh::new(TriangleSoup {
        positions: positions.iter().copied().map(DVec3::from_array).collect(),
        triangles: triangles.to_vec(),
        ..TriangleSoup::default()
    })
    .unwrap()
}

/// As many positions as the triangles need, no two on a line with a third.
fn placed(triangles: &[[u32; 3]]) -> TriMesh {
    let count = triangles.iter().flatten().max().map_or(0, |&v| v + 1);
    let positions: Vec<_> = (0..count).map(f64::from).map(|i| [i, i * i, i * i * i]).collect();
    mesh(&positions, triangles)
}

/// A real mesh, where the data is there.
fn data(name: &str) -> Option<TriMesh> {
    let path = format!("{}/../../shared/data/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    let Ok(file) = std::fs::read(&path) else {
        println!("skipped: no {path}");
        return None;
    };
    Some(TriMesh::new(io::read(Format::Obj, &file[..], &Limits::default()).unwrap()).unwrap())
}

/// `0..count` in some order.
fn shuffled(count: usize, seed: u64) -> Vec<u32> {
    let bytes = stream(seed, 8 * count);
    let mut entropy = Entropy::new(&bytes);
    let mut order: Vec<u32> = (0..count as u32).collect();
    for i in (1..count).rev() {
        order.swap(i, (entropy.word() % (i as u64 + 1)) as usize);
    }
    order
}

/// The same surface with its vertices numbered and its triangles listed in another order, corners turned.
fn renumbered(mesh: &TriMesh, seed: u64) -> TriMesh {
    let new_id = shuffled(mesh.positions().len(), seed);
    let mut positions = vec![DVec3::ZERO; new_id.len()];
    for (old, &new) in new_id.iter().enumerate() {
        positions[new as usize] = mesh.positions()[old];
    }
    let order = shuffled(mesh.triangles().len(), seed + 1);
    let triangles = order.iter().map(|&t| {
        let mut triangle = mesh.triangles()[t as usize].map(|v| new_id[v.index()]);
        triangle.rotate_left(t as usize % 3);
        triangle
    });
    TriMesh::new(TriangleSoup { positions, triangles: triangles.collect(), ..TriangleSoup::default() })
        .unwrap()
}

/// The same connectivity at other positions.
fn moved(mesh: &TriMesh, f: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let mut soup = mesh.to_soup();
    for position in &mut soup.positions {
        *position = f(*position);
    }
    TriMesh::new(soup).unwrap()
}

/// Runs on a given number of threads.
fn with_threads<T: Send>(threads: usize, f: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(f)
}
