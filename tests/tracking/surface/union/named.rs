//! Cases with names: closed forms, faces in one plane, shapes within others, edges of four triangles.

use super::{ball, check, check_windings, cuboid, moved, ring, together, unite};
use glam::DVec3;
use std::f64::consts::PI;
use welter_kit::mesher::Random;
use welter_meshing::Monitor;
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::surface::{ClosedOrientedMesh, Topology, TriMesh, TriangleSoup};
use welter_tracking::surface::{MovingSurface, UnionOutcome, UnionParameters};

fn volume(surface: &MovingSurface) -> f64 {
    signed_volume(&surface.to_mesh())
}

/// Boxes whose corners overlap: volumes to rounding.
#[test]
fn boxes_have_the_volume_of_the_closed_form() {
    let mut surface = MovingSurface::new(&cuboid([-1.0; 3], [1.0; 3], 0.5)).unwrap();
    let low = [0.3, 0.21, 0.17];
    let report = unite(&mut surface, &cuboid(low, [1.73, 1.9, 2.3], 0.4)).unwrap();
    let both = (0.7 * 0.79) * 0.83;
    let other = (1.43 * 1.69) * 2.13;
    assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
    assert!((volume(&surface) - (8.0 + other - both)).abs() < 1e-13, "{}", volume(&surface));
    assert!((report.added_volume - (other - both)).abs() < 1e-13, "{report:?}");
    check(&surface);
    assert_eq!(surface.connectivity().euler_characteristic(), 2);
}

/// Balls of radius 1 at a distance of 1: 27/12 pi, less what polyhedra lack of balls. As three quarters of each remain, that is 3/2 of what one
/// ball lacks, with an error that falls with the length of edges.
#[test]
fn balls_have_the_volume_of_the_closed_form_less_that_of_polyhedra() {
    let ratios = [0.2, 0.1, 0.05].map(|edge_length| {
        let mesh = ball(DVec3::ZERO, 1.0, edge_length);
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let report = unite(&mut surface, &ball(DVec3::new(0.6, 0.64, 0.48), 1.0, edge_length)).unwrap();
        assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
        (27.0 / 12.0 * PI - volume(&surface)) / (4.0 / 3.0 * PI - signed_volume(&mesh))
    });
    println!("what the union lacks over what a ball lacks, at edges of 0.2, 0.1, 0.05: {ratios:?}");
    assert!(
        ratios.iter().zip([0.2, 0.1, 0.05]).all(|(ratio, bound)| (ratio / 1.5 - 1.0).abs() < 0.1 * bound),
        "{ratios:?}"
    );
}

/// Half of a torus lies in a box: the hole is closed, or another one made.
#[test]
fn genus_is_that_of_the_union() {
    for (low, characteristic) in [([-2.0, -2.0, -0.9], 2), ([0.013, -2.0, -0.9], 0)] {
        let mut surface = MovingSurface::new(&ring(0.3)).unwrap();
        let shape = cuboid(low, [2.1, 2.2, 0.07], 0.6);
        let report = unite(&mut surface, &shape).unwrap();
        assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
        assert_eq!(surface.connectivity().euler_characteristic(), characteristic);
        check(&surface);
        let mut random = Random::new(1);
        check_windings(&ring(0.3), &shape, &surface.to_mesh(), &mut random, 30);
    }
}

/// Both meet in faces in one plane, along edges, in vertices, or everywhere: shifted, then united.
#[test]
fn what_is_in_no_general_position_is_shifted() {
    let unit = cuboid([0.0; 3], [1.0; 3], 0.5);
    let half = ball(DVec3::ZERO, 1.0, 0.5);
    let at = |x: f64, y: f64, z: f64| moved(&unit, move |p| p + DVec3::new(x, y, z));
    let apex = half.positions().iter().copied().reduce(|a, b| if b.z > a.z { b } else { a }).unwrap();
    let cases: [(&str, &ClosedOrientedMesh, ClosedOrientedMesh, f64); 9] = [
        ("the same", &unit, unit.clone(), 1.0),
        ("the same ball", &half, half.clone(), signed_volume(&half)),
        ("a face", &unit, at(1.0, 0.0, 0.0), 2.0),
        ("a part of a face", &unit, at(1.0, 0.25, 0.125), 2.0),
        ("sides in one plane", &unit, at(0.75, 0.0, 0.0), 1.75),
        ("an edge", &unit, at(1.0, 1.0, 0.0), 2.0),
        ("a corner", &unit, at(1.0, 1.0, 1.0), 2.0),
        (
            "a corner in a face",
            &unit,
            moved(&unit, |p| DVec3::new(p.x + 1.0, p.y - p.x * 0.5, p.z + p.x)),
            2.0,
        ),
        ("a vertex", &half, moved(&half, |p| 2.0 * apex - p).reversed(), 2.0 * signed_volume(&half)),
    ];
    for (name, mesh, shape, expected) in cases {
        let mut surface = MovingSurface::new(mesh).unwrap();
        let report = unite(&mut surface, &shape).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name}: {} shifts, {:?}, {} segments", report.shifts, report.outcome, report.segments);
        assert!((1..=2).contains(&report.shifts), "{name}: {report:?}");
        check(&surface);
        // The shift moves the surface of the shape, whose area is at most 13, by less than 1/256 of an edge.
        assert!((volume(&surface) - expected).abs() < 13.0 * report.shift.length(), "{name}");
    }
}

#[test]
fn a_shape_within_changes_nothing_and_one_around_takes_all_in() {
    let mut surface = MovingSurface::new(&ball(DVec3::ZERO, 1.0, 0.4)).unwrap();
    let before = surface.to_mesh();
    let report = unite(&mut surface, &ball(DVec3::X * 0.3, 0.5, 0.4)).unwrap();
    assert_eq!((report.outcome, report.added_volume, report.new_triangles), (UnionOutcome::Within, 0.0, 0));
    assert_eq!(surface.to_mesh(), before);
    assert!(surface.log().is_empty(), "nothing has happened");

    let around = ball(DVec3::Y * 0.1, 2.0, 0.8);
    let report = unite(&mut surface, &around).unwrap();
    assert_eq!((report.outcome, report.segments), (UnionOutcome::Joined, 0));
    assert_eq!(report.removed_triangles, before.triangles().len());
    assert_eq!(surface.to_mesh(), *around.as_mesh());
    assert!((report.added_volume - (signed_volume(&around) - signed_volume(&before))).abs() < 1e-12);

    let beside = ball(DVec3::X * 5.0, 1.0, 0.4);
    let report = unite(&mut surface, &beside).unwrap();
    assert_eq!((report.outcome, report.removed_triangles), (UnionOutcome::Beside, 0));
    assert_eq!(surface.to_mesh(), together(&[&around, &beside]));
    assert_eq!(surface.check(), Ok(()));

    // Into nothing, and of nothing.
    let nothing = TriMesh::new(TriangleSoup::default()).unwrap();
    let mut empty = MovingSurface::new(&nothing).unwrap();
    assert_eq!(unite(&mut empty, &beside).unwrap().outcome, UnionOutcome::Beside);
    assert_eq!(empty.to_mesh(), *beside.as_mesh());
    let nothing = ClosedOrientedMesh::new(nothing).unwrap();
    assert_eq!(unite(&mut empty, &nothing).unwrap().outcome, UnionOutcome::Within);
}

/// Of several parts of a shape some lie within, some take in what is there, some cross, some do nothing.
#[test]
fn parts_of_a_shape_fare_each_in_its_own_way() {
    let there = [ball(DVec3::ZERO, 1.0, 0.4), ball(DVec3::X * 4.0, 0.5, 0.3), ball(DVec3::X * 8.0, 0.5, 0.3)];
    let come = [
        ball(DVec3::X * 0.2, 0.4, 0.3),
        ball(DVec3::X * 4.1, 1.0, 0.4),
        ball(DVec3::new(8.3, 0.11, 0.07), 0.5, 0.3),
        ball(DVec3::X * 12.0, 0.5, 0.3),
    ];
    let before = together(&[&there[0], &there[1], &there[2]]);
    let shape = ClosedOrientedMesh::new(together(&[&come[0], &come[1], &come[2], &come[3]])).unwrap();
    let mut surface = MovingSurface::new(&before).unwrap();
    let report = unite(&mut surface, &shape).unwrap();
    assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
    let after = surface.to_mesh();
    assert_eq!(Topology::of(&after).components().len(), 4);
    check(&surface);
    let mut random = Random::new(5);
    for (a, b) in there.iter().zip(&come) {
        check_windings(a, b, &after, &mut random, 30);
    }
}

/// Balls in balls, all outward: the numbers inside are 1, 2, 3. Walls of the same number cut each other, others do not.
#[test]
fn nested_sheets_take_the_larger_number() {
    let at = |x: f64, radii: &[f64]| {
        let balls: Vec<_> =
            radii.iter().map(|&r| ball(DVec3::new(x, 0.1 * x, 0.07 * x), r, 0.4 * r)).collect();
        together(&balls.iter().map(|ball| ball.as_mesh()).collect::<Vec<_>>())
    };
    for (x, radii, others) in [
        (0.9, vec![1.0, 0.5], vec![1.0]),
        (0.9, vec![1.0], vec![1.0, 0.5]),
        (0.6, vec![1.0, 0.7, 0.4], vec![0.95, 0.6]),
        (0.0, vec![1.0, 0.8], vec![0.9, 0.7, 0.5]),
        (0.8, vec![2.0, 0.5], vec![0.6]),
    ] {
        let (before, shape) = (at(0.0, &radii), at(x, &others));
        let mut surface = MovingSurface::new(&before).unwrap();
        let report = unite(&mut surface, &ClosedOrientedMesh::new(shape.clone()).unwrap()).unwrap();
        assert_eq!(report.shifts, 0, "{radii:?} and {others:?}");
        check(&surface);
        let mut random = Random::new(2);
        let counts = check_windings(&before, &shape, &surface.to_mesh(), &mut random, 60);
        println!("{radii:?} and {others:?}: {:?}, points by number: {counts:?}", report.outcome);
    }
}

/// A hole in the surface is filled as far as the shape reaches into it.
#[test]
fn cavities_are_filled_where_the_shape_is() {
    let outer = ball(DVec3::ZERO, 1.0, 0.3);
    let hole = ball(DVec3::ZERO, 0.6, 0.3).reversed();
    let before = together(&[&outer, &hole]);
    for (center, radius) in
        [(DVec3::new(0.5, 0.05, 0.02), 0.3), (DVec3::X * 0.1, 0.2), (DVec3::Y * 0.01, 0.8)]
    {
        let shape = ball(center, radius, 0.15);
        let mut surface = MovingSurface::new(&before).unwrap();
        let report = unite(&mut surface, &shape).unwrap();
        assert_eq!((report.outcome == UnionOutcome::Beside, report.shifts), (radius == 0.2, 0));
        check(&surface);
        let mut random = Random::new(3);
        let counts = check_windings(&before, &shape, &surface.to_mesh(), &mut random, 60);
        assert!(counts[1] > 10 && counts[2] == 0, "{counts:?}");
    }
}

/// Two boxes along an edge, which has four triangles; the shape crosses that edge, or takes in a part of it, or all.
#[test]
fn edges_of_four_triangles_are_cut() {
    let [one, other] = [cuboid([0.0; 3], [1.0; 3], 0.5), cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], 0.5)];
    let mut soup = together(&[&one, &other]).to_soup();
    let first = |p: DVec3| soup.positions.iter().position(|&q| q == p).unwrap() as u32;
    let welded: Vec<u32> = soup.positions.iter().map(|&p| first(p)).collect();
    soup.triangles.iter_mut().for_each(|t| *t = t.map(|v| welded[v as usize]));
    let before = TriMesh::new(soup).unwrap();
    assert!(!Topology::of(&before).is_edge_manifold());
    for (center, radius) in [
        ([1.03, 1.02, 0.51], 0.3),
        ([1.03, 1.02, 0.9], 0.4),
        ([1.1, 0.93, 0.48], 0.9),
        ([0.4, 0.41, 0.5], 0.7),
    ] {
        let shape = ball(center.into(), radius, 0.3);
        let mut surface = MovingSurface::new(&before).unwrap();
        let report = unite(&mut surface, &shape).unwrap();
        assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
        check(&surface);
        let mut random = Random::new(4);
        check_windings(&before, &shape, &surface.to_mesh(), &mut random, 40);
    }
}

/// Much finer than the surface: whole curves within one triangle.
#[test]
fn fine_shapes_pierce_coarse_triangles() {
    let before = cuboid([0.0; 3], [1.0; 3], 1.0);
    for (radius, edge_length) in [(0.1, 0.02), (1e-3, 4e-4), (1e-9, 4e-10)] {
        let mut surface = MovingSurface::new(&before).unwrap();
        let balls = [[0.7, 0.2, 1.0], [0.3, 0.6, 1.0], [1.0, 0.3, 0.8]].map(|at| {
            ball(DVec3::from_array(at) + DVec3::new(0.013, 0.007, 0.011) * radius, radius, edge_length)
        });
        let shape = together(&[&balls[0], &balls[1], &balls[2]]);
        let shape = ClosedOrientedMesh::new(shape).unwrap();
        let unshifted = UnionParameters { shifts: 0, ..UnionParameters::default() };
        let report = surface
            .unite(&shape, &unshifted, &Monitor::none())
            .unwrap_or_else(|error| panic!("{radius}: {error}"));
        assert_eq!(report.outcome, UnionOutcome::Joined, "{radius}");
        let half = 0.5 * signed_volume(&balls[0]);
        // The volumes that come and go are those of coarse triangles, too.
        let error = report.added_volume - 3.0 * half;
        assert!(error.abs() < 0.1 * half + f64::EPSILON, "{radius}: {error} of {half}");
        assert_eq!(surface.connectivity().euler_characteristic(), 2);
        check(&surface);
    }
}
