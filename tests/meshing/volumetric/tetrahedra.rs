//! Tetrahedra in place of hexahedra.

use super::*;
use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;
use welter_kit::volumetric::homology_of_tetrahedra;
use welter_meshing::DVec3;

fn of(mesh: &HexMesh) -> Tetrahedra {
    tetrahedra(mesh, &Monitor::none()).unwrap()
}

/// Six times the volume of each; whole numbers of eighths for unit cells, so exact.
fn volumes(mesh: &TetMesh) -> impl Iterator<Item = f64> + '_ {
    mesh.tetrahedra.iter().map(|corners| {
        let [a, b, c, d] = corners.map(|v| mesh.positions[v as usize]);
        (b - a).cross(c - a).dot(d - a)
    })
}

fn betti(mesh: &HexMesh) -> BettiNumbers {
    betti_numbers(mesh, &BettiLimits::default(), &Monitor::none()).unwrap()
}

fn tet_betti(mesh: &TetMesh) -> BettiNumbers {
    betti_numbers_of_tetrahedra(mesh, &BettiLimits::default(), &Monitor::none()).unwrap()
}

/// Whether a face has coincident hexahedra on one side and one on the other, so that pyramids lie on each other.
fn branches(mesh: &HexMesh) -> bool {
    let sorted = |h: usize, side: usize| {
        let mut vertices = QUADRILATERALS[side].map(|corner| mesh.hexahedra()[h][corner]);
        vertices.sort_unstable();
        vertices
    };
    let mut sides: Vec<_> = (0..mesh.len()).flat_map(|h| (0..6).map(move |s| (h, s))).collect();
    sides.sort_by_key(|&(h, s)| sorted(h, s));
    sides.chunk_by(|a, b| sorted(a.0, a.1) == sorted(b.0, b.1)).any(|group| {
        let lower = group.iter().filter(|(_, side)| side % 2 == 0).count();
        let upper = group.len() - lower;
        lower.min(upper) == 1 && lower.max(upper) > 1
    })
}

#[test]
fn random_complexes_keep_their_homology() {
    let (mut branched, mut plain) = (0, 0);
    for (seed, mesh) in random_meshes(200).enumerate() {
        let tets = of(&mesh);
        let tets = tets.mesh();
        assert_eq!(tet_betti(tets).of_components(), betti(&mesh).of_components(), "{seed}");
        let [hexahedral, tetrahedral] = [
            euler_characteristics(&mesh, &Monitor::none()).unwrap(),
            euler_characteristics_of_tetrahedra(tets, &Monitor::none()).unwrap(),
        ];
        let characteristics = |components: &Components| -> Vec<i64> {
            components.counts().iter().map(CellCounts::euler_characteristic).collect()
        };
        assert_eq!(characteristics(&hexahedral), characteristics(&tetrahedral), "{seed}");
        for (tet, &parent) in tets.hexahedra.iter().enumerate() {
            assert_eq!(tetrahedral.labels().of()[tet], hexahedral.labels().of()[parent as usize], "{seed}");
        }
        assert!(volumes(tets).all(|volume| volume > 0.0), "{seed}");
        if branches(&mesh) {
            branched += 1;
        } else {
            plain += 1;
            assert_eq!(volumes(tets).sum::<f64>(), 6.0 * mesh.len() as f64, "{seed}");
        }
    }
    assert!(branched > 20 && plain > 20, "{branched} {plain}");
}

#[test]
fn tetrahedra_are_counted_as_by_sets() {
    for (seed, mesh) in random_meshes(200).enumerate().filter(|(_, mesh)| mesh.len() < 8) {
        let tets = of(&mesh).into_mesh();
        let twin = homology_of_tetrahedra(&tets);
        let components = euler_characteristics_of_tetrahedra(&tets, &Monitor::none()).unwrap();
        let counts: Vec<_> =
            components.counts().iter().map(|c| [c.vertices, c.edges, c.faces, c.cells]).collect();
        assert_eq!(components.labels().of(), twin.labels, "{seed}");
        assert_eq!(counts, twin.counts, "{seed}");
        assert_eq!(tet_betti(&tets).of_components(), twin.betti, "{seed}");
    }
}

#[test]
fn known_shapes_keep_their_homology() {
    for (name, mesh, expected) in shapes() {
        assert_eq!(tet_betti(of(&mesh).mesh()).of_components(), expected, "{name}");
    }
}

#[test]
fn all_pairs_of_two_by_two_hexahedra_would_make_a_hypersphere() {
    // The rule of the text at a face with two hexahedra on each side, spelled out: why such a face gets a centre.
    let (_, mesh, _) = shapes().into_iter().find(|(name, ..)| *name == "two by two at a face").unwrap();
    let tets = of(&mesh);
    let [corners, count] = [mesh.nodes().len() as u32, mesh.len() as u32];
    assert_eq!((count, tets.mesh().positions.len() as u32), (4, corners + count + 4 * 5 + 1));
    let mut pairs = tets.mesh().clone();
    let centre_of_face =
        pairs.positions.iter().rposition(|&p| p == DVec3::new(1.0, 0.5, 0.5)).unwrap() as u32;
    let (at_face, rest): (Vec<_>, Vec<_>) =
        pairs.tetrahedra.iter().partition(|t| t.contains(&centre_of_face));
    assert_eq!(at_face.len(), 16);
    pairs.tetrahedra = rest;
    let edges: BTreeSet<[u32; 2]> = at_face.iter().map(|t| [t[0].min(t[1]), t[0].max(t[1])]).collect();
    for [a, b] in edges {
        for (below, above) in [(0, 2), (0, 3), (1, 2), (1, 3)] {
            pairs.tetrahedra.push([a, b, corners + below, corners + above]);
        }
    }
    assert_eq!(tet_betti(&pairs).of_components(), [[1, 0, 0, 1]]);
}

#[test]
fn points_are_located() {
    for mesh in random_meshes(40).chain([sheet([3; 3], |_| true)]) {
        let tets = of(&mesh);
        for hexahedron in 0..mesh.len() {
            let centre = (mesh.nodes().len() + hexahedron) as u32;
            let low = mesh.position(mesh.hexahedra()[hexahedron][0]);
            let steps = [0.0, 0.125, 0.3, 0.5, 0.75, 1.0];
            for at in steps.iter().flat_map(|&u| steps.iter().flat_map(move |&v| steps.map(|w| [u, v, w]))) {
                let found = tets.locate(hexahedron, at).unwrap();
                let corners = tets.mesh().tetrahedra[found.tetrahedron];
                assert!(corners.contains(&centre));
                let place: DVec3 = corners
                    .iter()
                    .zip(found.weights)
                    .map(|(&v, w)| tets.mesh().positions[v as usize] * w)
                    .sum();
                assert!((place - low).abs_diff_eq(DVec3::from_array(at), 1e-14), "{at:?} {found:?}");
                assert!((found.weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                assert!(found.weights.iter().all(|&w| w >= 0.0));
            }
        }
        assert_eq!(tets.locate(mesh.len(), [0.5; 3]), None);
        for outside in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
            assert_eq!(tets.locate(0, [0.5, outside, 0.5]), None);
        }
    }
}

#[test]
fn threads_and_pieces_do_not_show() {
    let mesh = blocks([29, 28, 27], 2);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            (of(&mesh), coarsen(&mesh, &Monitor::none()).unwrap(), boundary_sides(&mesh, &Monitor::none()))
        })
    };
    let one = run(1);
    assert_eq!(one, run(4));
    assert_eq!(volumes(one.0.mesh()).sum::<f64>(), 6.0 * mesh.len() as f64);
    assert_eq!(one.1.mesh.len(), 2 * 15 * 14 * 14);
}

#[test]
fn centres_that_are_no_numbers_are_refused() {
    let far = 2.0_f64.powi(53) - 4.0;
    let grid = Grid3::new([0.0, far, 0.0], 1.0, [1; 3]).unwrap();
    let mesh = HexMesh::new(grid, (0..8).collect(), vec![[0, 1, 2, 3, 4, 5, 6, 7]], vec![0]).unwrap();
    let refused = TetrahedraError::Inexact { axis: 1, origin: far, spacing: 1.0 };
    assert_eq!(tetrahedra(&mesh, &Monitor::none()), Err(refused));
    let stop = AtomicBool::new(true);
    let stopped = tetrahedra(&sheet([2; 3], |_| true), &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(TetrahedraError::Cancelled(_))));
}
