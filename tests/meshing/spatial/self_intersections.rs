//! The list of self-intersections against all pairs decided exactly, and its laws.

use super::{crowded, oracle};
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::{TriId, TriMesh};

fn found(mesh: &TriMesh) -> Vec<[TriId; 2]> {
    self_intersections(mesh, &Monitor::none()).expect("nobody cancels")
}

#[test]
fn crowded_meshes_agree_with_all_pairs() {
    for seed in 0..60 {
        let bytes = stream(seed, 400);
        let entropy = &mut Entropy::new(&bytes);
        let mesh = crowded(entropy, 4 + (seed % 8) as u8, 12, 2 + (seed % 4) as u8);
        assert_eq!(found(&mesh), oracle::self_intersections(&mesh), "seed {seed}: {mesh:?}");
    }
}
