//! Counts on real meshes, as other exact programs found them.

use super::mesh_of;
use glam::DVec3;
use std::path::Path;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Bvh, Sharing};
use welter_meshing::surface::TriMesh;

/// The positions and faces of a Wavefront file of plain triangles.
fn read(path: &Path) -> TriMesh {
    let text = std::fs::read_to_string(path).expect("a readable file");
    let fields = |key: &'static str| text.lines().filter_map(move |line| line.strip_prefix(key));
    let positions = fields("v ").map(|rest| {
        let xyz: Vec<f64> = rest.split_whitespace().map(|x| x.parse().expect("a number")).collect();
        DVec3::new(xyz[0], xyz[1], xyz[2])
    });
    let faces = fields("f ").map(|rest| {
        let corner =
            |word: &str| word.split('/').next().and_then(|i| i.parse::<u32>().ok()).expect("an index") - 1;
        let corners: Vec<u32> = rest.split_whitespace().map(corner).collect();
        <[u32; 3]>::try_from(corners).expect("a triangle")
    });
    mesh_of(positions.collect(), faces.collect())
}

#[test]
#[allow(clippy::print_stdout)] // says that it skipped
fn self_intersecting_pairs_are_those_of_the_readme() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/meshes"));
    if !folder.exists() {
        println!("skipped: {} is not there", folder.display());
        return;
    }
    // (file, pairs by position, pairs by index)
    let counts = [
        ("manifold_self_intersectA.obj", 338, 338),
        ("simpleBridge_39comp.obj", 4250, 4256),
        ("openscad_nonmanifold_crash.obj", 7556, 9902),
        ("manifold_offset1.obj", 52, 194),
        ("manifold_generic_twin_right.obj", 64, 64),
        ("comb.obj", 0, 0),
        ("spot.obj", 0, 0),
    ];
    let found = counts.map(|(name, _, _)| {
        let mesh = read(&folder.join(name));
        let bvh = Bvh::new(&mesh);
        let count =
            |sharing| bvh.self_intersections(sharing, &Monitor::none()).expect("nobody cancels").len();
        (name, count(Sharing::Position), count(Sharing::Index))
    });
    assert_eq!(found, counts);
}
