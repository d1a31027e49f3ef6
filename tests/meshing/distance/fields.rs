//! Distances of all nodes against the closest point of each, and against closed forms.

use super::{closed, mapped, on_threads, tetrahedra};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::distance::{
    DistanceError, DistanceParameters, InsideRule, signed_distance, unsigned_distance,
};
use welter_meshing::grid::Grid3;
use welter_meshing::shapes::{self, Box_, BoxPair, Sphere, Torus};
use welter_meshing::spatial::{Bvh, Winding, winding_number};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

/// Everywhere and in a band, every node has the distance and the triangle of the closest point, bit for bit.
fn compare(mesh: &TriMesh, grid: &Grid3, band: f64) {
    let bvh = Bvh::new(mesh);
    let parameters = DistanceParameters { closest_triangles: true, ..DistanceParameters::default() };
    let near = DistanceParameters { band, ..parameters };
    let field = unsigned_distance(mesh, grid, &parameters, &Monitor::none()).unwrap();
    let narrow = unsigned_distance(mesh, grid, &near, &Monitor::none()).unwrap();
    for node in 0..grid.node_count() {
        let p = grid.position(grid.node_at(node));
        let closest = bvh.closest_point(p).unwrap();
        let (distance, triangle) = (closest.distance, Some(closest.triangle));
        assert_eq!((field.distances.values()[node], field.closest[node]), (distance, triangle), "{p}");
        let expected = if distance <= band { (distance, triangle) } else { (band, None) };
        assert_eq!((narrow.distances.values()[node], narrow.closest[node]), expected, "{p} in the band");
    }
}

#[test]
fn shapes_on_grids_of_odd_and_even_size() {
    let grid = |cells| Grid3::new([-1.5, -1.25, -1.5], 0.1875, cells).unwrap();
    let edge_length = 0.25;
    let sphere = shapes::sphere(&Sphere { edge_length, ..Sphere::default() }).unwrap();
    compare(&sphere, &grid([15, 16, 17]), 0.4);
    compare(&shapes::torus(&Torus { edge_length, ..Torus::default() }).unwrap(), &grid([9, 8, 7]), 0.3);
    compare(&shapes::box_(&Box_::default()).unwrap(), &grid([16, 14, 13]), 0.5);
    compare(&shapes::box_(&Box_ { edge_length: 2.0, ..Box_::default() }).unwrap(), &grid([1, 2, 20]), 1.0);
}

#[test]
fn slivers_and_degenerate_triangles() {
    for seed in 0..30 {
        let bytes = stream(seed, 500);
        let entropy = &mut Entropy::new(&bytes);
        let lattice = tetrahedra(entropy, 8, 4);
        // Flattened until edges are parallel to a part in 10^15, or wholly.
        let flat = [1.0, 1e-3, 1e-8, 1e-15, 0.0][seed as usize % 5];
        let mesh = mapped(&lattice, |p| DVec3::new(p.x, p.x * 0.3 + flat * p.y, 0.1 * p.x + flat * p.z));
        compare(&mesh, &Grid3::new([-1.0, -1.0, -0.5], 0.5, [9, 9, 6]).unwrap(), 0.7);
    }
}

#[test]
fn needles_that_point_at_nodes() {
    // A node beyond a tip is within a rounding of all three half-planes of a needle.
    let bytes = stream(11, 12_000);
    let entropy = &mut Entropy::new(&bytes);
    let mut point = || DVec3::from_array([(); 3].map(|()| f64::from(entropy.between(-64, 64)) / 64.0));
    let grid = Grid3::new([-1.0; 3], 0.25, [8; 3]).unwrap();
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for k in 0..150_u32 {
        // The line goes on to the middle of the grid, the apex is anywhere along it.
        let (a, size) = (point(), 10_f64.powi(-((k % 15) as i32)));
        let (b, c) = (0.4 * a, a * (1.0 - 0.6 * f64::from(k % 11) / 10.0) + size * 0.1 * point());
        let corners = if k % 2 == 0 { [a, b, c] } else { [c, a, b] };
        triangles.push([0, 1, 2].map(|v| 3 * k + v));
        positions.extend(corners);
        compare(
            &TriMesh::new(TriangleSoup {
                positions: corners.to_vec(),
                triangles: vec![[0, 1, 2]],
                ..TriangleSoup::default()
            })
            .unwrap(),
            &Grid3::new([-0.5; 3], 0.5, [2; 3]).unwrap(),
            0.3,
        );
    }
    compare(
        &TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap(),
        &grid,
        0.2,
    );
}

#[test]
fn grids_much_larger_much_finer_and_much_farther_than_the_mesh() {
    let mesh = shapes::sphere(&Sphere { edge_length: 0.4, ..Sphere::default() }).unwrap();
    for (origin, spacing) in [
        ([-1e4; 3], 2e3),
        ([-50.0; 3], 11.0),
        ([0.999, 0.0, 0.0], 1.0 / 1024.0),
        ([0.6, 0.6, 0.5], 2f64.powi(-30)),
        ([1e12; 3], 1.0),
        ([-1e70; 3], 3e69),
    ] {
        let ends = origin.map(|o: f64| o + 9.0 * spacing);
        let grid = Grid3::covering(origin, ends, spacing, 0).unwrap();
        compare(&mesh, &grid, 4.0 * spacing);
    }
    let grid = Grid3::new([-1.0; 3], 0.25, [8; 3]).unwrap();
    compare(&mapped(&mesh, |p| p * 1e-200), &grid, 0.7);
    compare(&mapped(&mesh, |p| p * 1e200), &grid, f64::MAX);
    compare(&mapped(&mesh, |p| p * 1.7e308), &grid, 1e307);
}

#[test]
fn a_box_has_its_distance_in_closed_form() {
    let grid = Grid3::new([-2.0, -1.75, -2.25], 0.125, [32, 29, 34]).unwrap();
    let exact = |p: DVec3| {
        let q = p.abs() - 1.0;
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
    };
    for edge_length in [2.0, 0.3] {
        let mesh = shapes::box_(&Box_ { edge_length, ..Box_::default() }).unwrap();
        let field = signed_distance(&mesh, &grid, &DistanceParameters::default(), &Monitor::none()).unwrap();
        for (node, &found) in field.distances.values().iter().enumerate() {
            let exact = exact(grid.position(grid.node_at(node)));
            assert!((found - exact).abs() <= 1e-15 * 4.0, "node {node}: {found}, not {exact}");
            assert!((found == 0.0) == (exact == 0.0) && (found < 0.0) == (exact < 0.0));
        }
    }
}

#[test]
fn signs_follow_the_rule() {
    let pair = BoxPair { edge_length: 0.5, ..BoxPair::overlapping() };
    let two = shapes::two_boxes(&pair).unwrap();
    let turned = shapes::two_boxes(&BoxPair { second_reversed: true, ..pair }).unwrap();
    let grid = Grid3::covering([-1.2; 3], [2.3; 3], 0.23, 0).unwrap();
    let mut inside = Vec::new();
    for mesh in [&two, &turned] {
        for rule in [InsideRule::NonZero, InsideRule::Positive, InsideRule::Odd] {
            let parameters = DistanceParameters {
                inside: rule,
                band: 0.6,
                winding_numbers: true,
                ..DistanceParameters::default()
            };
            let field = signed_distance(mesh, &grid, &parameters, &Monitor::none()).unwrap();
            let mut count = 0;
            for (node, &value) in field.distances.values().iter().enumerate() {
                let Winding::Number(number) = winding_number(mesh, grid.position(grid.node_at(node))) else {
                    assert_eq!(value, 0.0);
                    continue;
                };
                assert_eq!(value < 0.0, rule.holds(number));
                assert!(value.abs() <= 0.6);
                assert_eq!(field.winding.as_ref().unwrap().at(node), Winding::Number(number));
                count += u32::from(value < 0.0);
            }
            inside.push(count);
        }
    }
    // Union, union, without the overlap; less the second box.
    let [union, positive, odd, _, difference, _] = inside[..] else { panic!("six counts") };
    assert!(union == positive && odd < union && difference < odd, "{inside:?}");
}

#[test]
fn laws_of_scale_turn_thread_and_translation() {
    let mesh = shapes::torus(&Torus { edge_length: 0.3, ..Torus::default() }).unwrap();
    let rounded = mapped(&mesh, |p| (p * 4096.0).round() / 4096.0);
    let cells = [14, 12, 10];
    let grid = Grid3::new([-1.75, -1.5, -1.25], 0.25, cells).unwrap();
    let parameters =
        DistanceParameters { band: 0.8, closest_triangles: true, ..DistanceParameters::default() };
    let of = |mesh: &ClosedOrientedMesh, grid: &Grid3, band| {
        let parameters = DistanceParameters { band, ..parameters };
        signed_distance(mesh, grid, &parameters, &Monitor::none()).unwrap()
    };
    let expected = of(&rounded, &grid, 0.8);
    for threads in [1, 3] {
        assert_eq!(on_threads(threads, || of(&rounded, &grid, 0.8)), expected);
    }
    let scale = 2f64.powi(-40);
    let scaled = of(
        &mapped(&rounded, |p| p * scale),
        &Grid3::new(grid.origin().map(|o| o * scale), 0.25 * scale, cells).unwrap(),
        0.8 * scale,
    );
    assert!(
        scaled.distances.values().iter().eq(&expected
            .distances
            .values()
            .iter()
            .map(|d| d * scale)
            .collect::<Vec<_>>())
    );
    assert_eq!(scaled.closest, expected.closest);
    // Differences of these numbers are exact, so a translation changes nothing.
    let shift = DVec3::new(64.0, -32.0, 16.0);
    let moved = of(
        &mapped(&rounded, |p| p + shift),
        &Grid3::new((DVec3::from_array(grid.origin()) + shift).to_array(), 0.25, cells).unwrap(),
        0.8,
    );
    assert_eq!((moved.distances.values(), &moved.closest), (expected.distances.values(), &expected.closest));
    // Axes exchanged: sums of three squares are taken in another order.
    let turned = of(
        &mapped(&rounded, |p| DVec3::new(p.z, p.x, p.y)),
        &Grid3::new([-1.25, -1.75, -1.5], 0.25, [10, 14, 12]).unwrap(),
        0.8,
    );
    for (node, value) in expected.distances.values().iter().enumerate() {
        let [i, j, k] = grid.node_at(node);
        assert!((turned.distances.at([k, i, j]) - value).abs() < 1e-15);
    }
    // Turned inside out, a surface has the same distances, with the sign of the rule.
    let reversed = rounded.clone().reversed();
    let reversed = of(&reversed, &grid, 0.8).distances;
    let pairs = reversed.values().iter().zip(expected.distances.values());
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-15));
}

#[test]
fn empty_meshes_bad_bands_and_cancellation() {
    let grid = Grid3::new([0.0; 3], 1.0, [3; 3]).unwrap();
    let none = closed(Vec::new(), Vec::new());
    let parameters = DistanceParameters { closest_triangles: true, ..DistanceParameters::default() };
    let field = signed_distance(&none, &grid, &parameters, &Monitor::none()).unwrap();
    assert!(field.distances.values().iter().all(|&d| d == f64::INFINITY));
    assert!(field.closest.iter().all(Option::is_none));
    for band in [-1.0, f64::NAN, f64::NEG_INFINITY] {
        let parameters = DistanceParameters { band, ..DistanceParameters::default() };
        let refused = unsigned_distance(&none, &grid, &parameters, &Monitor::none());
        assert!(matches!(refused, Err(DistanceError::Band { .. })));
    }
    let mesh = shapes::box_(&Box_::default()).unwrap();
    let on_it = DistanceParameters { band: 0.0, ..DistanceParameters::default() };
    let field = signed_distance(&mesh, &grid, &on_it, &Monitor::none()).unwrap();
    assert!(field.distances.values().iter().all(|&d| d == 0.0));
    let stop = std::sync::atomic::AtomicBool::new(true);
    let stopped = signed_distance(&mesh, &grid, &parameters, &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(DistanceError::Cancelled(_))));
    let triangle = TriangleSoup {
        positions: vec![DVec3::ZERO; 3],
        triangles: vec![[0, 1, 2]],
        ..TriangleSoup::default()
    };
    compare(&TriMesh::new(triangle).unwrap(), &grid, 1.5);
}
