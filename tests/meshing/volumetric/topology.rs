//! Counts, components and Betti numbers.

use super::*;
use std::sync::atomic::AtomicBool;
use welter_kit::volumetric::homology_of_hexahedra;

fn counts(components: &Components) -> Vec<[u64; 4]> {
    components.counts().iter().map(|c| [c.vertices, c.edges, c.faces, c.cells]).collect()
}

fn betti(mesh: &HexMesh) -> BettiNumbers {
    betti_numbers(mesh, &BettiLimits::default(), &Monitor::none()).unwrap()
}

#[test]
fn random_complexes_are_counted_as_by_sets() {
    let (mut several, mut tunnels, mut cavities, mut hyperspheres) = (0, 0, 0, 0);
    for (seed, mesh) in random_meshes(200).enumerate() {
        let twin = homology_of_hexahedra(&mesh);
        let components = euler_characteristics(&mesh, &Monitor::none()).unwrap();
        assert_eq!(components.labels().of(), twin.labels, "{seed}");
        assert_eq!(components.labels().count(), twin.counts.len(), "{seed}");
        assert_eq!(counts(&components), twin.counts, "{seed}");
        let betti = betti(&mesh);
        assert_eq!(betti.of_components(), twin.betti, "{seed}");
        several += usize::from(twin.counts.len() > 1);
        let [_, b1, b2, b3] = betti.total();
        tunnels += usize::from(b1 > 0);
        cavities += usize::from(b2 > 0);
        hyperspheres += usize::from(b3 > 0);
    }
    // The random complexes are of all kinds.
    assert!(
        several > 20 && tunnels > 10 && cavities > 2 && hyperspheres > 2,
        "{several} {tunnels} {cavities} {hyperspheres}"
    );
}

#[test]
fn known_shapes_have_their_betti_numbers() {
    for (name, mesh, expected) in shapes() {
        assert_eq!(betti(&mesh).of_components(), expected, "{name}");
        let components = euler_characteristics(&mesh, &Monitor::none()).unwrap();
        for (counts, [b0, b1, b2, b3]) in components.counts().iter().zip(expected) {
            let alternating = b0 as i64 - b1 as i64 + b2 as i64 - b3 as i64;
            assert_eq!(counts.euler_characteristic(), alternating, "{name}");
        }
    }
}

#[test]
fn many_hexahedra_on_a_cell_are_no_trouble() {
    // 3000 hexahedra with one side in common: a book, and one face with all of its edges for them all.
    let mut sheets = Sheets::new([1; 3]);
    let first = sheets.add([0; 3]);
    for _ in 1..3000 {
        let page = sheets.add([0; 3]);
        sheets.join_side(first, page, 0);
    }
    let mesh = sheets.build();
    let components = euler_characteristics(&mesh, &Monitor::none()).unwrap();
    assert_eq!(counts(&components), [[4 + 4 * 3000, 4 + 8 * 3000, 1 + 5 * 3000, 3000]]);
    assert_eq!(betti(&mesh).of_components(), [[1, 0, 0, 0]]);
}

#[test]
fn pieces_do_not_show() {
    // More hexahedra than one thread takes at a time, in several sheets on each cell.
    let n = [30, 31, 32];
    let mesh = blocks(n, 3);
    let [nx, ny, nz] = n.map(u64::from);
    let edges = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz;
    let faces = (nx + 1) * ny * nz + nx * (ny + 1) * nz + nx * ny * (nz + 1);
    let expected = [[(nx + 1) * (ny + 1) * (nz + 1), edges, faces, nx * ny * nz]; 3];
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| euler_characteristics(&mesh, &Monitor::none()).unwrap())
    };
    let components = of(4);
    assert_eq!(counts(&components), expected);
    assert_eq!(components, of(1));
    assert_eq!(betti(&mesh).of_components(), [[1, 0, 0, 0]; 3]);
}

#[test]
fn what_is_too_large_is_said_to_be() {
    let (_, mesh, _) = shapes().swap_remove(5);
    let cells = euler_characteristics(&mesh, &Monitor::none()).unwrap().total().total();
    let with = |most_cells, most_entries| {
        betti_numbers(&mesh, &BettiLimits { most_cells, most_entries }, &Monitor::none())
    };
    assert!(with(cells, 1 << 20).is_ok());
    let refused =
        |rest, most_cells, most_entries| BettiError::TooLarge { cells, rest, most_cells, most_entries };
    assert_eq!(with(cells - 1, 1 << 20).unwrap_err(), refused(0, cells - 1, 1 << 20));
    let rest = betti(&mesh).rest();
    assert!(rest > 3, "the two tunnels and the cavity at least");
    assert_eq!(with(cells, 1).unwrap_err(), refused(rest, cells, 1));
}

#[test]
fn whoever_asks_is_heard() {
    let mesh = sheet([4; 3], |_| true);
    let stop = AtomicBool::new(true);
    let monitor = Monitor::new(None, Some(&stop));
    assert!(euler_characteristics(&mesh, &monitor).is_err());
    assert!(matches!(betti_numbers(&mesh, &BettiLimits::default(), &monitor), Err(BettiError::Cancelled(_))));
}

#[test]
fn tetrahedra_that_are_no_complex_are_refused() {
    let positions = vec![welter_meshing::DVec3::ZERO; 4];
    let refused = |corners| {
        let mesh = TetMesh {
            positions: positions.clone(),
            tetrahedra: vec![[0, 1, 2, 3], corners],
            hexahedra: vec![],
        };
        euler_characteristics_of_tetrahedra(&mesh, &Monitor::none()).unwrap_err()
    };
    let vertex = TetMeshError::Vertex { tetrahedron: 1, corner: 2, vertex: 4, vertices: 4 };
    assert_eq!(refused([0, 1, 4, 5]), TetError::Mesh(vertex));
    let repeated = TetMeshError::Repeated { tetrahedron: 1, vertex: 3 };
    assert_eq!(refused([0, 3, 1, 3]), TetError::Mesh(repeated));
}
