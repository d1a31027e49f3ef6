//! Marching cubes on grids: against the slow twin, on samples made of zeros, at all scales, and orders of convergence.

use std::f64::consts::PI;

use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::field::ScalarField;
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{IsosurfaceError, MarchingCubes, marching_cubes, marching_cubes_open};
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::measure::{area, signed_volume};
use welter_meshing::surface::{ClosedOrientedMesh, EmbeddedMesh, Topology, TriMesh};

use super::naive;

const DEFAULT: MarchingCubes<'static> =
    MarchingCubes { level: 0.0, margin: 1.0 / (1 << 20) as f64, roots_of: None };

fn closed(samples: &Samples<3>) -> EmbeddedMesh {
    marching_cubes(samples, &DEFAULT, &Monitor::none()).expect("numbers")
}

/// Samples drawn from few values, so that zeros and ambiguous faces abound.
fn drawn(seed: u64, cells: [u32; 3], values: &[f64]) -> Samples<3> {
    let grid = Grid3::new([-1.0, 0.5, 2.0], 0.25, cells).expect("exact");
    let choices = stream(seed, grid.node_count());
    let mut entropy = Entropy::new(&choices);
    Samples::new(grid, (0..grid.node_count()).map(|_| entropy.pick(values)).collect())
}

const VALUES: &[&[f64]] = &[
    &[-1.0, 1.0],
    &[-1.0, 0.0, 1.0, -0.0],
    &[-1.0, -1.0, -1.0, 0.0],
    &[-1e-300, 5e-324, 1.0, -1.0, 0.0],
    &[f64::NEG_INFINITY, f64::INFINITY, -1.0, f64::MAX, f64::MIN, 0.0],
];

fn sorted(mut triangles: Vec<[DVec3; 3]>) -> Vec<[[u64; 3]; 3]> {
    let bits = |t: [DVec3; 3]| t.map(|p| p.to_array().map(f64::to_bits));
    let mut all: Vec<_> = triangles
        .drain(..)
        .map(bits)
        .map(|t| (0..3).map(|r| [t[r], t[(r + 1) % 3], t[(r + 2) % 3]]).min().expect("three"))
        .collect();
    all.sort_unstable();
    all
}

fn as_positions(mesh: &TriMesh) -> Vec<[DVec3; 3]> {
    mesh.triangles().iter().map(|t| t.map(|v| mesh.positions()[v.index()])).collect()
}

#[test]
fn agrees_with_the_slow_twin() {
    for (seed, values) in VALUES.iter().enumerate() {
        for cells in [[1, 1, 1], [3, 4, 5], [63, 2, 3], [64, 1, 2], [131, 2, 2]] {
            let samples = drawn(seed as u64, cells, values);
            let open = marching_cubes_open(&samples, &DEFAULT, &Monitor::none()).unwrap();
            let slow = naive::triangles(&samples, 0.0, DEFAULT.margin, false);
            assert_eq!(sorted(as_positions(&open)), sorted(slow), "{values:?} {cells:?}");
            let mesh = closed(&samples);
            let slow = naive::triangles(&samples, 0.0, DEFAULT.margin, true);
            assert_eq!(sorted(as_positions(&mesh)), sorted(slow), "{values:?} {cells:?}");
        }
    }
}

#[test]
fn whatever_the_samples_are_the_surface_is_an_embedded_manifold() {
    for (seed, values) in VALUES.iter().enumerate() {
        for round in 0..4 {
            let samples = drawn(100 * seed as u64 + round, [6, 5, 4], values);
            let mesh = closed(&samples);
            assert_eq!(ClosedOrientedMesh::check(&mesh), Ok(()));
            assert_eq!(EmbeddedMesh::check(&mesh, &Monitor::none()), Ok(()), "{values:?}");
            let topology = Topology::of(&mesh);
            assert!(topology.is_edge_manifold() && topology.is_vertex_manifold(), "{values:?}");
            assert_eq!(topology.unreferenced_vertices().len(), 0);
            encloses_the_negative_nodes(&samples, &mesh);
        }
    }
}

fn encloses_the_negative_nodes(samples: &Samples<3>, mesh: &ClosedOrientedMesh) {
    let numbers = WindingNumbers::new(mesh);
    let grid = samples.grid();
    for number in 0..grid.node_count() {
        let node = grid.node_at(number);
        let on_wall = (0..3).any(|axis| node[axis] == 0 || node[axis] == grid.cells()[axis]);
        match numbers.at(grid.position(node)) {
            Winding::Number(number) => assert_eq!(number, i32::from(samples.at(node) < 0.0), "{node:?}"),
            on => assert!(on_wall && samples.at(node) < 0.0, "{node:?} {on:?}"),
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let samples = drawn(5, [70, 20, 30], VALUES[1]);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| closed(&samples))
    };
    let one = run(1);
    assert!([2, 3, 8].into_iter().all(|threads| run(threads) == one));
}

#[test]
fn moving_and_scaling_the_grid_moves_and_scales_the_surface_bit_for_bit() {
    let samples = drawn(11, [9, 8, 7], &[-0.75, 0.3, 1.1, -0.2, 0.0]);
    let mesh = closed(&samples);
    let with = |grid: Grid3, factor: f64| {
        closed(&Samples::new(grid, samples.values().iter().map(|v| v * factor).collect()))
    };
    let cells = samples.grid().cells();
    for (scale, factor) in [(2f64.powi(-40), 1.0), (2f64.powi(200), 0.125), (1.0, 2f64.powi(-900))] {
        let origin = samples.grid().origin().map(|c| c * scale);
        let scaled = with(Grid3::new(origin, 0.25 * scale, cells).unwrap(), factor);
        assert_eq!(scaled.triangles(), mesh.triangles());
        assert!(scaled.positions().iter().zip(mesh.positions()).all(|(p, q)| *p == *q * scale));
    }
}

#[test]
fn the_opposite_samples_have_the_same_vertices() {
    let samples = drawn(3, [8, 8, 8], &[-0.75, 0.3, 1.1, -0.2]);
    let negated = Samples::new(*samples.grid(), samples.values().iter().map(|v| -v).collect());
    let [a, b] = [&samples, &negated].map(|s| marching_cubes_open(s, &DEFAULT, &Monitor::none()).unwrap());
    assert_eq!(a.positions(), b.positions());
}

#[test]
fn an_infinite_sample_pushes_the_surface_to_its_finite_neighbour_from_either_side() {
    let grid = Grid3::new([0.0; 3], 1.0, [1, 1, 1]).unwrap();
    for (low, high, expected) in [
        (f64::INFINITY, -1.0, 1.0 - DEFAULT.margin),
        (f64::NEG_INFINITY, 1.0, 1.0 - DEFAULT.margin),
        (-1.0, f64::INFINITY, DEFAULT.margin),
        (1.0, f64::NEG_INFINITY, DEFAULT.margin),
        (f64::NEG_INFINITY, f64::INFINITY, 0.5),
    ] {
        let ends = Samples::of(&grid, &|p: DVec3| if p.y == 0.0 { low } else { high }, &Monitor::none());
        let mesh = marching_cubes_open(&ends.unwrap(), &DEFAULT, &Monitor::none()).unwrap();
        assert_eq!(mesh.positions().len(), 4);
        assert!(mesh.positions().iter().all(|p| p.y == expected), "{low} {high}: {:?}", mesh.positions());
    }
}

#[test]
fn bad_input_is_named() {
    let mut samples = drawn(3, [4, 4, 4], &[-1.0, 1.0]);
    let node = [3, 2, 1];
    let number = samples.grid().node_index(node);
    samples.values_mut()[number] = f64::NAN;
    let Err(IsosurfaceError::NotANumber(found)) = marching_cubes(&samples, &DEFAULT, &Monitor::none()) else {
        panic!("a NaN has no side")
    };
    assert_eq!(found.node, node);
    assert_eq!(
        found.to_string(),
        "the sample at node [3, 2, 1], position [-0.25, 1.0, 2.25], is not a number"
    );
    samples.values_mut()[number] = 1.0;
    for parameters in [
        MarchingCubes { level: f64::INFINITY, ..DEFAULT },
        MarchingCubes { margin: 0.0, ..DEFAULT },
        MarchingCubes { margin: f64::NAN, ..DEFAULT },
    ] {
        let error = marching_cubes(&samples, &parameters, &Monitor::none());
        assert!(matches!(error, Err(IsosurfaceError::Parameter { .. })), "{error:?}");
    }
    let far = Grid3::new([2f64.powi(40), 0.0, 0.0], 2f64.powi(-6), [2, 2, 2]).unwrap();
    let error = marching_cubes(&Samples::new(far, vec![1.0; 27]), &DEFAULT, &Monitor::none());
    assert!(matches!(error, Err(IsosurfaceError::TooFine { axis: 0, .. })), "{error:?}");
    let stop = std::sync::atomic::AtomicBool::new(true);
    let stopped = marching_cubes(&samples, &DEFAULT, &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(IsosurfaceError::Cancelled(_))));
}

#[test]
fn samples_without_a_change_of_sign_have_no_surface_or_the_whole_wall() {
    let grid = Grid3::new([0.0; 3], 0.5, [4, 3, 2]).unwrap();
    let of = |value: f64| Samples::new(grid, vec![value; grid.node_count()]);
    assert_eq!(closed(&of(1.0)).triangles().len(), 0);
    assert_eq!(closed(&of(0.0)).triangles().len(), 0);
    let whole = closed(&of(-1.0));
    assert_eq!(signed_volume(&whole), 2.0 * 1.5 * 1.0);
    assert_eq!(whole.triangles().len(), 2 * 2 * (4 * 3 + 3 * 2 + 2 * 4));
}

/// `log2` of the ratio of errors from one resolution to twice that.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

#[test]
fn volume_and_area_of_a_sphere_are_of_second_order() {
    let center = DVec3::new(0.013, -0.021, 0.034);
    let ball = move |p: DVec3| p.distance(center) - 0.8;
    let (volume, whole_area) = (4.0 / 3.0 * PI * 0.8_f64.powi(3), 4.0 * PI * 0.64);
    for roots in [None, Some(&ball as &dyn ScalarField)] {
        let (mut volumes, mut areas) = (Vec::new(), Vec::new());
        for n in [16, 32, 64] {
            let grid = Grid3::covering([-1.0; 3], [1.0; 3], 2.0 / f64::from(n), 0).unwrap();
            let samples = Samples::of(&grid, &ball, &Monitor::none()).unwrap();
            let parameters = MarchingCubes { roots_of: roots, ..DEFAULT };
            let mesh = marching_cubes(&samples, &parameters, &Monitor::none()).unwrap();
            volumes.push((signed_volume(&mesh) - volume).abs() / volume);
            areas.push((area(&mesh) - whole_area).abs() / whole_area);
            if roots.is_some() {
                assert!(mesh.positions().iter().all(|p| ball(*p).abs() < 1e-12));
            }
        }
        for order in orders(&volumes).into_iter().chain(orders(&areas)) {
            assert!((1.8..2.2).contains(&order), "volumes {volumes:?}, areas {areas:?}");
        }
    }
}

#[test]
fn roots_that_linear_interpolation_misses_are_found() {
    // Steep, flat and with a jump: the root on each edge is at x = 0.3 all the same.
    let fields: [&dyn ScalarField; 4] = [
        &|p: DVec3| (40.0 * (p.x - 0.3)).sinh(),
        &|p: DVec3| (p.x - 0.3).powi(9),
        &|p: DVec3| if p.x < 0.3 { -1e-9 } else { 1e9 },
        &|p: DVec3| 1.0 / (p.x - 0.3),
    ];
    let grid = Grid3::new([0.0; 3], 1.0, [1, 1, 1]).unwrap();
    for (i, &field) in fields.iter().enumerate() {
        let values = (0..8).map(|n| field.value(grid.position(grid.node_at(n)))).collect();
        let parameters = MarchingCubes { roots_of: Some(field), ..DEFAULT };
        let mesh = marching_cubes_open(&Samples::new(grid, values), &parameters, &Monitor::none()).unwrap();
        assert_eq!(mesh.triangles().len(), 2);
        assert!(
            mesh.positions().iter().all(|p| (p.x - 0.3).abs() < 1e-13),
            "field {i}: {:?}",
            mesh.positions()
        );
    }
}
