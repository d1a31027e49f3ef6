//! Counts on real meshes, as other exact programs found them.

use super::{mesh_of, oracle};
use glam::DVec3;
use std::path::Path;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Bvh, Sharing};
use welter_meshing::surface::{TriId, TriMesh};

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

/// The folder of real meshes, if it is there.
#[allow(clippy::print_stdout)] // says that it skipped
fn folder() -> Option<&'static Path> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/meshes"));
    if !folder.exists() {
        println!("skipped: {} is not there", folder.display());
        return None;
    }
    Some(folder)
}

fn found(mesh: &TriMesh, sharing: Sharing) -> Vec<[TriId; 2]> {
    Bvh::new(mesh).self_intersections(sharing, &Monitor::none()).expect("nobody cancels")
}

/// The readme of the meshes counts pairs by position, and says 7522 and 46 for the two meshes in which triangles are
/// folded back onto a neighbour in one plane (58 and 6 pairs that share an edge). In the second it leaves out just these. They
/// have an area in common, which [`rationals_confirm_the_pairs`] checks, and so they are listed.
#[test]
fn self_intersecting_pairs_of_real_meshes() {
    let Some(folder) = folder() else { return };
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
        (name, found(&mesh, Sharing::Position).len(), found(&mesh, Sharing::Index).len())
    });
    assert_eq!(found, counts);
}

/// One of so many pairs of meeting boxes is intersected in integers, besides all that share an edge and are reported.
const EVERY: usize = 40;

#[test]
fn rationals_confirm_the_pairs() {
    let Some(folder) = folder() else { return };
    for (name, folds) in [("openscad_nonmanifold_crash.obj", 58), ("manifold_offset1.obj", 6)] {
        let mesh = read(&folder.join(name));
        let candidates = Bvh::new(&mesh).self_pairs(&Monitor::none()).expect("nobody cancels");
        let by_index = found(&mesh, Sharing::Index);
        let by_position = found(&mesh, Sharing::Position);
        let common = |[i, j]: [TriId; 2]| {
            let (s, t) = (mesh.corners(i), mesh.corners(j));
            s.iter().filter(|p| t.contains(p)).count()
        };
        let folded: Vec<_> = by_position.iter().copied().filter(|&pair| common(pair) >= 2).collect();
        assert_eq!(folded.len(), folds, "{name}");
        let sample = candidates.into_iter().step_by(EVERY);
        for pair in folded.into_iter().chain(sample) {
            for (sharing, pairs) in [(Sharing::Index, &by_index), (Sharing::Position, &by_position)] {
                let listed = pairs.binary_search(&pair).is_ok();
                assert_eq!(listed, oracle::meet_in_more(&mesh, pair, sharing), "{name} {pair:?} {sharing:?}");
            }
        }
    }
}
