//! Laws: bodies together on one grid, moved, turned, scaled, renumbered.

use glam::DVec3;
use welter_kit::mesher::bodies::body;
use welter_kit::mesher::{Complex, Motion, Random, check, isomorphic};
use welter_meshing::Monitor;
use welter_meshing::grid::Grid3;
use welter_meshing::shapes::{Box_, box_};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use welter_meshing::volumetric::{Resolution, VolumeMesh, VolumeParameters, mesh_volume};

const SPACING: f64 = 0.25;

fn parameters(spacing: f64) -> VolumeParameters {
    VolumeParameters {
        resolution: Resolution::Spacing(spacing),
        max_refinements: 0,
        ..VolumeParameters::default()
    }
}

fn surface(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> ClosedOrientedMesh {
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
}

fn indices(mesh: &TriMesh) -> Vec<[u32; 3]> {
    mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect()
}

/// Both surfaces as one.
fn together(a: &TriMesh, b: &TriMesh) -> ClosedOrientedMesh {
    let shift = a.positions().len() as u32;
    let mut triangles = indices(a);
    triangles.extend(indices(b).iter().map(|t| t.map(|v| v + shift)));
    surface([a.positions(), b.positions()].concat(), triangles)
}

fn moved(mesh: &TriMesh, place: impl Fn(DVec3) -> DVec3, turned: bool) -> ClosedOrientedMesh {
    let order = |[a, b, c]: [u32; 3]| if turned { [a, c, b] } else { [a, b, c] };
    surface(
        mesh.positions().iter().map(|&p| place(p)).collect(),
        indices(mesh).into_iter().map(order).collect(),
    )
}

/// The complexes of several meshes as one, on the cells of a grid that holds them all.
fn beside(meshes: &[&VolumeMesh], grid: &Grid3) -> Complex {
    let mut all: Vec<(u64, [u32; 8])> = Vec::new();
    let mut vertices = 0;
    for volume in meshes {
        let own = volume.mesh.grid();
        let shift: [u32; 3] =
            std::array::from_fn(|axis| ((own.origin()[axis] - grid.origin()[axis]) / grid.spacing()) as u32);
        for (&cell, corners) in volume.mesh.cells().iter().zip(volume.mesh.hexahedra()) {
            let at = own.cell_at(cell as usize);
            let cell = grid.cell_index(std::array::from_fn(|axis| at[axis] + shift[axis])) as u64;
            all.push((cell, corners.map(|v| v + vertices)));
        }
        vertices += volume.mesh.nodes().len() as u32;
    }
    all.sort_by_key(|&(cell, _)| cell);
    Complex::new(all.iter().map(|x| x.0).collect(), all.iter().map(|x| x.1).collect())
}

/// A surface of a random body with cells of size 1/4 to suit it.
fn random_surface(seed: u64) -> ClosedOrientedMesh {
    let body = body(seed);
    let scale = 2.0 * SPACING / body.radius;
    // No vertex on a plane of the grid, as those of flat bodies would be.
    moved(&body.solid.surface(), |p| p * scale + DVec3::new(0.0123, 0.0217, 0.0331), false)
}

fn mesh(surface: &ClosedOrientedMesh) -> Option<VolumeMesh> {
    let volume = mesh_volume(surface, &parameters(SPACING), &Monitor::none()).ok()?;
    check(surface, &volume).unwrap();
    Some(volume)
}

fn count(otherwise: u64) -> u64 {
    std::env::var("WELTER_MESHER_LAWS").ok().map_or(otherwise, |text| text.parse().unwrap())
}

/// Seeds of bodies that are not too large for debug builds, with their meshes.
fn some_bodies(most: u64) -> Vec<(u64, ClosedOrientedMesh, VolumeMesh)> {
    (0..)
        .map(|seed| (seed, random_surface(seed)))
        .filter(|(_, s)| {
            let [low, high] =
                [DVec3::min, DVec3::max].map(|f| s.positions().iter().copied().reduce(f).unwrap());
            ((high - low) / SPACING).element_product() < 60_000.0
        })
        .filter_map(|(seed, s)| mesh(&s).filter(|volume| !volume.ambiguous).map(|volume| (seed, s, volume)))
        .take(most as usize)
        .collect()
}

#[test]
fn bodies_together_are_bodies_beside_each_other() {
    let bodies = some_bodies(count(6));
    for pair in bodies.windows(2) {
        for shift in [DVec3::ZERO, DVec3::splat(3.0 * SPACING), DVec3::new(0.5, -1.5, 2.5) * SPACING] {
            let second = moved(&pair[1].1, |p| p + shift, false);
            union_law(&pair[0].1, &second, &format!("seeds {} and {}, {shift}", pair[0].0, pair[1].0));
        }
        let copy = pair[0].1.clone();
        union_law(&pair[0].1, &copy, &format!("seed {}, twice", pair[0].0));
        let shifted = moved(&copy, |p| p + DVec3::X * SPACING, false);
        union_law(&pair[0].1, &shifted, &format!("seed {}, one cell on", pair[0].0));
        let half = moved(&copy, |p| p + DVec3::Y * (SPACING / 2.0), false);
        union_law(&pair[0].1, &half, &format!("seed {}, half a cell on", pair[0].0));
    }
}

#[test]
fn boxes_together_are_boxes_beside_each_other() {
    let cube = |min: DVec3, max: DVec3| box_(&Box_ { min, max, edge_length: 0.6 }).unwrap();
    let first = cube(DVec3::ZERO, DVec3::ONE);
    for shift in [
        DVec3::ZERO,
        DVec3::new(0.5, 0.0, 0.0),
        DVec3::new(1.0, 0.0, 0.0),
        DVec3::new(0.0, 1.0, 0.0),
        DVec3::new(0.0, 0.0, 1.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, 1.0, 1.0),
        DVec3::new(0.125, 0.0, 0.0),
        DVec3::new(0.25, 0.25, 0.125),
        DVec3::new(0.3, 0.4, 0.2),
    ] {
        union_law(&first, &cube(shift, shift + 1.0), &format!("boxes, {shift}"));
        // A smaller one within it, with one face, an edge or a corner in common.
        union_law(&first, &cube(shift * 0.5, shift * 0.5 + 0.5), &format!("box in box, {shift}"));
    }
}

fn union_law(a: &ClosedOrientedMesh, b: &ClosedOrientedMesh, name: &str) {
    let Some((of_a, of_b)) = mesh(a).zip(mesh(b)) else { return };
    let both = together(a, b);
    let volume =
        mesh_volume(&both, &parameters(SPACING), &Monitor::none()).unwrap_or_else(|e| panic!("{name}: {e}"));
    check(&both, &volume).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    let apart = beside(&[&of_a, &of_b], volume.mesh.grid());
    if let Err(fault) = isomorphic(&apart, &Complex::of_mesh(&volume.mesh), &Motion::none()) {
        assert!(volume.ambiguous, "{name}: {fault}");
        println!("{name}: ambiguous, {fault}");
    }
}

#[test]
fn motions_of_the_grid_change_nothing() {
    for (seed, surface, volume) in some_bodies(count(4)) {
        let grid = volume.mesh.grid();
        let complex = Complex::of_mesh(&volume.mesh);
        for order in [[0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0]] {
            for signs in [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, -1.0]] {
                let place =
                    |p: DVec3| DVec3::from_array(std::array::from_fn(|axis| signs[axis] * p[order[axis]]));
                let odd = matches!(order, [1, 0, 2] | [2, 1, 0]) != (signs[0] * signs[1] * signs[2] < 0.0);
                let turned = moved(&surface, place, odd);
                let other = mesh_volume(&turned, &parameters(SPACING), &Monitor::none()).unwrap();
                let own = other.mesh.grid();
                let node = |p: DVec3| -> [i64; 3] {
                    std::array::from_fn(|axis| {
                        ((p[axis] - own.origin()[axis]) / own.spacing()).round() as i64
                    })
                };
                let low_corner = |cell: u64| {
                    let at = grid.cell_at(cell as usize);
                    let [a, b] = [at, at.map(|i| i + 1)].map(|n| node(place(grid.position(n))));
                    let low = std::array::from_fn(|axis| a[axis].min(b[axis]) as u32);
                    own.cell_index(low) as u64
                };
                let corners = std::array::from_fn(|c| {
                    (0..3)
                        .map(|axis| {
                            let bit = c >> order[axis] & 1;
                            (if signs[axis] < 0.0 { 1 - bit } else { bit }) << axis
                        })
                        .sum()
                });
                let motion = Motion { cell: &low_corner, corners };
                isomorphic(&complex, &Complex::of_mesh(&other.mesh), &motion)
                    .unwrap_or_else(|fault| panic!("seed {seed}, axes {order:?}, {signs:?}: {fault}"));
            }
        }
    }
}

#[test]
fn powers_of_two_whole_cells_and_threads_change_no_bit() {
    for (seed, surface, volume) in some_bodies(count(4)) {
        for scale in [0.25, 8.0, 2f64.powi(40)] {
            let scaled = moved(&surface, |p| p * scale, false);
            let other = mesh_volume(&scaled, &parameters(SPACING * scale), &Monitor::none()).unwrap();
            assert_same_bits(&volume, &other, &format!("seed {seed}, times {scale}"));
            assert_eq!(other.mesh.grid().origin().map(|x| x / scale), volume.mesh.grid().origin());
        }
        // Coordinates with few bits, so that the shift is exact.
        let coarse = |p: DVec3| (p * 4096.0).round() / 4096.0;
        let (here, there) = (
            moved(&surface, coarse, false),
            moved(&surface, |p| coarse(p) + DVec3::new(3.0, -7.0, 11.0) * SPACING, false),
        );
        let run = |s| mesh_volume(s, &parameters(SPACING), &Monitor::none());
        match (run(&here), run(&there)) {
            (Ok(a), Ok(b)) => assert_same_bits(&a, &b, &format!("seed {seed}, shifted")),
            (a, b) => assert_eq!(a.is_ok(), b.is_ok(), "seed {seed}: {:?} and {:?}", a.err(), b.err()),
        }
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| run(&surface)).unwrap(), volume, "seed {seed}, {threads} threads");
        }
    }
}

fn assert_same_bits(a: &VolumeMesh, b: &VolumeMesh, name: &str) {
    assert!(a.mesh.hexahedra() == b.mesh.hexahedra(), "{name}: hexahedra differ");
    assert!(a.mesh.cells() == b.mesh.cells() && a.mesh.nodes() == b.mesh.nodes(), "{name}: places differ");
    assert!(
        a.regions == b.regions && a.copies == b.copies && a.windings == b.windings,
        "{name}: regions differ"
    );
    assert!(a.hosts.triangles == b.hosts.triangles, "{name}: hosts differ");
    let hosts = |v: &VolumeMesh| v.hosts.vertices.iter().map(|h| h.hexahedron).collect::<Vec<_>>();
    assert_eq!(hosts(a), hosts(b), "{name}");
}

#[test]
fn numbers_of_vertices_and_triangles_change_numbers_only() {
    for (seed, surface, volume) in some_bodies(count(4)) {
        let random = &mut Random::new(seed);
        let mut shuffled = |n: usize| {
            let mut list: Vec<u32> = (0..n as u32).collect();
            for place in (1..n).rev() {
                list.swap(place, random.below(place as u64 + 1) as usize);
            }
            list
        };
        let (of_vertices, of_triangles) =
            (shuffled(surface.positions().len()), shuffled(surface.triangles().len()));
        let mut positions = vec![DVec3::ZERO; of_vertices.len()];
        for (v, &to) in of_vertices.iter().enumerate() {
            positions[to as usize] = surface.positions()[v];
        }
        let old = indices(&surface);
        let triangles = of_triangles.iter().map(|&t| {
            let [a, b, c] = old[t as usize].map(|v| of_vertices[v as usize]);
            if t % 2 == 0 { [a, b, c] } else { [b, c, a] }
        });
        let renumbered = self::surface(positions, triangles.collect());
        let other = mesh(&renumbered).unwrap();
        isomorphic(&Complex::of_mesh(&volume.mesh), &Complex::of_mesh(&other.mesh), &Motion::none())
            .unwrap_or_else(|fault| panic!("seed {seed}: {fault}"));
    }
}
