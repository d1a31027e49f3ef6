//! Winding numbers at all nodes against the same numbers node by node.

use super::{mapped, on_threads, tetrahedra};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::distance::grid_winding_numbers;
use welter_meshing::grid::Grid3;
use welter_meshing::shapes::{self, Box_, BoxPair, Sphere};
use welter_meshing::spatial::{Winding, WindingNumbers, winding_number};
use welter_meshing::surface::ClosedOrientedMesh;

/// Compares every node; returns how often each number was seen, 100 for nodes on the surface.
fn compare(mesh: &ClosedOrientedMesh, grid: &Grid3) -> std::collections::BTreeMap<i32, usize> {
    let all = grid_winding_numbers(mesh, grid, &Monitor::none()).unwrap();
    let numbers = WindingNumbers::new(mesh);
    let mut seen = std::collections::BTreeMap::new();
    for node in 0..grid.node_count() {
        let p = grid.position(grid.node_at(node));
        let expected = numbers.at(p);
        assert_eq!(all.at(node), expected, "node {node} at {p}");
        let key = if let Winding::Number(number) = expected { number } else { 100 };
        *seen.entry(key).or_insert(0) += 1;
    }
    seen
}

#[test]
fn boxes_whose_corners_edges_and_sides_hold_nodes() {
    let grid = Grid3::new([-1.5; 3], 0.25, [12, 13, 11]).unwrap();
    let pair = |pair: BoxPair| BoxPair { edge_length: 0.5, ..pair };
    for mesh in [
        shapes::box_(&Box_ { edge_length: 0.5, ..Box_::default() }).unwrap(),
        shapes::box_(&Box_ { edge_length: 2.0, ..Box_::default() }).unwrap().reversed(),
        shapes::nested_boxes(&pair(BoxPair::nested())).unwrap(),
        shapes::coincident_boxes(&pair(BoxPair::coincident())).unwrap(),
    ] {
        let seen = compare(&mesh, &grid);
        assert!(seen[&0] > 100 && seen[&100] > 100, "{seen:?}");
    }
}

#[test]
fn surfaces_that_wind_twice_and_backwards() {
    let two = shapes::two_boxes(&BoxPair { edge_length: 0.4, ..BoxPair::overlapping() }).unwrap();
    let grid = Grid3::covering([-1.2; 3], [2.3; 3], 0.21, 0).unwrap();
    assert!(compare(&two, &grid)[&2] > 3);
    assert!(compare(&two.reversed(), &grid)[&-2] > 3);
    let eight = shapes::by_name("trefoil-overlap", Some(0.4)).unwrap();
    let grid = Grid3::covering([-3.0; 3], [3.0; 3], 0.31, 0).unwrap();
    assert!(compare(&eight, &grid)[&1] > 20);
}

#[test]
fn soups_of_tetrahedra_on_a_lattice() {
    let mut seen = std::collections::BTreeMap::new();
    for seed in 0..60 {
        let bytes = stream(seed, 400);
        let mesh = tetrahedra(&mut Entropy::new(&bytes), 1 + seed as u32 % 9, 5);
        // Nodes on the lattice and half-way, or beside it; grids that the soup sticks out of.
        let grid = match seed % 3 {
            0 => Grid3::new([-0.5, 0.0, -1.0], 0.5, [10, 9, 11]),
            1 => Grid3::new([1.0, 0.5, 1.5], 0.5, [3, 5, 4]),
            _ => Grid3::new([-0.3125; 3], 0.4375, [11, 10, 10]),
        };
        for (number, count) in compare(&mesh, &grid.unwrap()) {
            *seen.entry(number).or_insert(0) += count;
        }
    }
    assert!(
        [-2, -1, 0, 1, 2, 100].iter().all(|number| seen.get(number).is_some_and(|&n| n > 20)),
        "{seen:?}"
    );
}

#[test]
fn long_thin_triangles_and_grids_finer_than_triangles() {
    // A needle askew, seen along all three axes, on a grid much finer than its length.
    let mesh = shapes::box_(&Box_ { edge_length: 2.0, ..Box_::default() }).unwrap();
    for turn in 0..3 {
        let needle = mapped(&mesh, |p| {
            let q = DVec3::new(0.9 * p.x + 0.001 * p.y, 0.8 * p.x + 0.01 * p.z, 0.7 * p.x - 0.02 * p.y)
                .to_array();
            DVec3::new(q[turn % 3], q[(turn + 1) % 3], q[(turn + 2) % 3])
        });
        compare(&needle, &Grid3::covering([-1.0; 3], [1.0; 3], 0.04, 0).unwrap());
    }
}

#[test]
fn nodes_on_the_surface_have_the_number_of_a_point_beside_them() {
    let mesh = shapes::nested_boxes(&BoxPair { edge_length: 0.5, ..BoxPair::nested() }).unwrap();
    let grid = Grid3::new([-1.25; 3], 0.25, [10; 3]).unwrap();
    let all = grid_winding_numbers(&mesh, &grid, &Monitor::none()).unwrap();
    assert!(all.on_surface().len() > 300);
    for &(node, _) in all.on_surface() {
        let beside = grid.position(grid.node_at(node)) + DVec3::new(1e-3, 1e-6, 1e-9);
        assert_eq!(Winding::Number(all.numbers()[node]), winding_number(&mesh, beside));
    }
}

#[test]
fn scales_far_meshes_and_threads() {
    let mesh = shapes::sphere(&Sphere { edge_length: 0.3, ..Sphere::default() }).unwrap();
    let grid = Grid3::new([-1.25; 3], 0.25, [10; 3]).unwrap();
    let expected = grid_winding_numbers(&mesh, &grid, &Monitor::none()).unwrap();
    for scale in [2f64.powi(-200), 2f64.powi(200)] {
        let moved = Grid3::new([-1.25 * scale; 3], 0.25 * scale, [10; 3]).unwrap();
        let scaled = mapped(&mesh, |p| p * scale);
        assert_eq!(grid_winding_numbers(&scaled, &moved, &Monitor::none()).unwrap(), expected);
    }
    for threads in [1, 3] {
        let found = on_threads(threads, || grid_winding_numbers(&mesh, &grid, &Monitor::none()).unwrap());
        assert_eq!(found, expected);
    }
    // Meshes far larger than the grid, and far away from it.
    compare(&mapped(&mesh, |p| p * 1e300), &grid);
    compare(&mapped(&mesh, |p| (p * 0.5 + DVec3::new(0.3, 0.2, 0.1)) * 1.7e308), &grid);
    compare(&mapped(&mesh, |p| p + 1e9), &grid);
    compare(&mapped(&mesh, |p| p * 1e-310), &grid);
    let stop = std::sync::atomic::AtomicBool::new(true);
    assert!(grid_winding_numbers(&mesh, &grid, &Monitor::new(None, Some(&stop))).is_err());
}
