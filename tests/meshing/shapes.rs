//! Tests of `welter_meshing::shapes`: what the table of the module promises, at several resolutions;
//! refusals; bits.

use proptest::prelude::*;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::generate::number;
use welter_meshing::shapes::*;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::measure::{
    angle_statistics, component_volumes, edge_length_statistics, signed_volume,
};
use welter_meshing::surface::{
    Topology, TriMesh, degenerate_triangles, duplicate_triangles, duplicate_vertices,
};
use welter_meshing::{DVec2, DVec3, Monitor};

fn intersecting_pairs(mesh: &TriMesh) -> usize {
    self_intersections(mesh, &Monitor::default()).unwrap().len()
}

#[test]
fn every_named_shape_is_what_the_table_says_at_any_resolution() {
    for shape in NAMES {
        for size in [None, Some(0.15), Some(0.09)] {
            let mesh = by_name(shape.name, size).unwrap();
            let name = format!("{} at {size:?}", shape.name);
            let topology = Topology::of(&mesh);
            let (count, genus) = (shape.components as i64, shape.genus as i64);
            assert_eq!(topology.components().len(), shape.components, "{name}");
            assert!(topology.components().iter().all(|c| c.genus == Some(shape.genus as u64)), "{name}");
            assert_eq!(topology.euler_characteristic(), count * (2 - 2 * genus), "{name}");
            assert!(topology.is_closed() && topology.is_oriented(), "{name}");
            assert!(topology.is_edge_manifold() && topology.is_vertex_manifold(), "{name}");
            assert!(topology.unreferenced_vertices().is_empty(), "{name}");
            assert!(duplicate_triangles(&mesh, &topology).is_empty(), "{name}");
            assert!(degenerate_triangles(&mesh).is_empty(), "{name}");
            assert_eq!(duplicate_vertices(&mesh).is_empty(), shape.name != "coincident-boxes", "{name}");
            assert_eq!(intersecting_pairs(&mesh) > 0, shape.self_intersecting, "{name}");
            for (i, volume) in component_volumes(&mesh, &topology).iter().enumerate() {
                let void = shape.name == "box-with-void" && i == 1;
                assert_eq!(volume.value() > 0.0, !void, "{name}");
            }
            if size.is_none() {
                let triangles = mesh.triangles().len();
                assert!((5_000..=20_000).contains(&triangles), "{name} has {triangles} triangles");
            }
        }
    }
}

#[test]
fn sizes_are_edge_lengths() {
    for shape in NAMES {
        for size in [0.08, 0.04] {
            let mesh = by_name(shape.name, Some(size)).unwrap();
            let lengths = edge_length_statistics(&mesh, &Topology::of(&mesh)).unwrap();
            let (name, ratio) = (shape.name, lengths.mean / size);
            assert!((0.6..=1.25).contains(&ratio), "{name}: mean edge {} for {size}", lengths.mean);
            // The diagonals outside the tightest bend, of the figure eight: sqrt(1 + (1 + 0.25 / 0.313)^2) = 2.06.
            assert!(lengths.max <= 2.1 * size, "{name}: longest edge {} for {size}", lengths.max);
            // Marching cubes make angles of any size, where the surface passes by a node: a millionth of a cell at least.
            let least = if ["gyroid", "text"].contains(&name) { 1e-6 } else { 5.0 };
            let smallest = angle_statistics(&mesh).unwrap().min.to_degrees();
            assert!(smallest > least, "{name}: smallest angle {smallest}");
        }
    }
}

#[test]
fn halving_the_size_quadruples_the_triangles() {
    for shape in NAMES {
        let count = |size| by_name(shape.name, Some(size)).unwrap().triangles().len() as f64;
        let ratio = count(0.02) / count(0.04);
        assert!((3.5..=4.5).contains(&ratio), "{}: {ratio}", shape.name);
    }
}

/// Volume by Pappus: area of the inscribed polygon times the length of its centre's path.
#[test]
fn tubes_have_the_volume_of_pappus() {
    let pi = std::f64::consts::PI;
    let ring = RingOverlap { drift: 0.0, edge_length: 0.02, ..RingOverlap::default() };
    let expected = pi * ring.tube_radius * ring.tube_radius * ring.radius * (2.0 * pi + ring.overlap);
    assert!((signed_volume(&ring_overlap(&ring).unwrap()) / expected - 1.0).abs() < 2e-3);
    let band = Moebius { edge_length: 0.02, ..Moebius::default() };
    let expected = 2.0 * pi * band.radius * band.width * band.thickness;
    assert!((signed_volume(&moebius(&band).unwrap()) / expected - 1.0).abs() < 2e-3);
    assert!((signed_volume(&double_moebius(&band).unwrap()) / (2.0 * expected) - 1.0).abs() < 2e-3);
}

#[test]
fn spheres_of_any_frequency_have_all_vertices_on_the_sphere() {
    for edge_length in [3.0, 1.0, 0.7, 0.5, 0.3, 0.21] {
        let ball = Sphere { edge_length, radius: 1.25, center: DVec3::new(0.5, -1.0, 2.0) };
        let mesh = sphere(&ball).unwrap();
        let frequency = ((mesh.triangles().len() / 20) as f64).sqrt();
        assert_eq!(frequency.fract(), 0.0);
        let off = |p: &DVec3| (p.distance(ball.center) - ball.radius).abs();
        assert!(mesh.positions().iter().all(|p| off(p) < 1e-15 * 4.0));
        assert_eq!(intersecting_pairs(&mesh), 0);
    }
}

#[test]
fn boxes_have_exact_corners() {
    let corners =
        Box_ { min: DVec3::new(0.1, -0.3, 1e-9), max: DVec3::new(0.7, 0.1, 3.3), edge_length: 0.17 };
    let mesh = box_(&corners).unwrap();
    for p in mesh.positions() {
        assert!((0..3).any(|k| p[k] == corners.min[k] || p[k] == corners.max[k]), "{p} is on no face");
        assert!(p.cmpge(corners.min).all() && p.cmple(corners.max).all());
    }
    assert!(mesh.positions().contains(&corners.max) && mesh.positions().contains(&corners.min));
}

#[test]
fn sweeps_follow_their_curve_and_twist() {
    let square = vec![DVec2::new(1.0, -1.0), DVec2::ONE, DVec2::new(-1.0, 1.0), DVec2::NEG_ONE];
    let ring: Vec<DVec3> = (0..60)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 60.0)
        .map(|t| DVec3::new(5.0 * t.cos(), 5.0 * t.sin(), (2.0 * t).sin()))
        .collect();
    for twist in [-5, -1, 0, 1, 2, 3, 4, 7] {
        let mesh =
            sweep(&Sweep { centers: ring.clone(), closed: true, profile: square.clone(), twist }).unwrap();
        let topology = Topology::of(&mesh);
        assert_eq!((topology.genus(), topology.components().len()), (Some(1), 1));
        assert_eq!(intersecting_pairs(&mesh), 0, "twist {twist}");
        assert!(signed_volume(&mesh) > 100.0);
    }
    let centers = ring[..40].to_vec();
    let open = sweep(&Sweep { centers, closed: false, profile: square, twist: 3 }).unwrap();
    assert_eq!(Topology::of(&open).genus(), Some(0));
    assert_eq!(intersecting_pairs(&open), 0);
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let bad = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-320, 1e300];
    for shape in NAMES {
        for size in bad {
            match by_name(shape.name, Some(size)) {
                Err(ShapeError::Parameter { parameter, value, .. }) => {
                    assert_eq!(
                        (parameter, value.to_bits()),
                        ("edge_length", size.to_bits()),
                        "{}",
                        shape.name
                    );
                }
                other => panic!("{} at {size}: {:?}", shape.name, other.map(|m| m.triangles().len())),
            }
        }
        for size in [1e-9, 1e-75] {
            let refused = by_name(shape.name, Some(size));
            assert!(
                matches!(
                    refused,
                    Err(ShapeError::TooManyTriangles { .. } | ShapeError::TooManySamples { .. })
                ),
                "{} at {size}",
                shape.name
            );
        }
    }
    for value in bad {
        let named = |result: Result<_, ShapeError>, name: &str| match result {
            Err(ShapeError::Parameter { parameter, .. }) => assert_eq!(parameter, name),
            other => panic!("{name} = {value}: {:?}", other.is_ok()),
        };
        named(sphere(&Sphere { radius: value, ..Sphere::default() }).map(drop), "radius");
        named(torus(&Torus { tube_radius: value, ..Torus::default() }).map(drop), "tube_radius");
        named(dumbbell(&Dumbbell { neck_radius: value, ..Dumbbell::default() }).map(drop), "neck_radius");
        named(dumbbell(&Dumbbell { distance: value, ..Dumbbell::default() }).map(drop), "distance");
        named(ring_overlap(&RingOverlap { radius: value, ..RingOverlap::default() }).map(drop), "radius");
        named(helix_overlap(&HelixOverlap { turns: value, ..HelixOverlap::default() }).map(drop), "turns");
        named(trefoil_overlap(&TrefoilOverlap { height: value, ..Default::default() }).map(drop), "height");
        named(figure_eight(&FigureEight { radius: value, ..FigureEight::default() }).map(drop), "radius");
        named(moebius(&Moebius { width: value, ..Moebius::default() }).map(drop), "width");
    }
    let twice = vec![DVec3::ZERO, DVec3::ZERO];
    let profile = vec![DVec2::X, DVec2::Y, DVec2::NEG_ONE];
    let sweep_of = |centers, profile| sweep(&Sweep { centers, closed: false, profile, twist: 0 }).map(drop);
    assert!(matches!(
        sweep_of(twice, profile.clone()),
        Err(ShapeError::Parameter { parameter: "centers", .. })
    ));
    let clockwise = profile.into_iter().rev().collect();
    assert!(matches!(
        sweep_of(vec![DVec3::ZERO, DVec3::X], clockwise),
        Err(ShapeError::Parameter { parameter: "profile", .. })
    ));
}

#[test]
fn long_thin_shapes_are_refused_before_anything_is_allocated() {
    let refused = |result: Result<_, ShapeError>| {
        assert!(matches!(result.map(drop), Err(ShapeError::TooManyTriangles { .. })));
    };
    let edge_length = 1e-70;
    refused(box_(&Box_ { min: DVec3::ZERO, max: DVec3::new(1e70, 1e-300, 1e-300), edge_length }));
    refused(torus(&Torus { tube_radius: 1e-75, edge_length, ..Torus::default() }));
    refused(ring_overlap(&RingOverlap { tube_radius: 1e-75, edge_length, ..RingOverlap::default() }));
    refused(moebius(&Moebius { width: 1e-75, thickness: 1e-75, edge_length, ..Moebius::default() }));
    let neck = Dumbbell { radius: 1e-74, neck_radius: 1e-75, fillet_radius: 1e-75, ..Dumbbell::default() };
    refused(dumbbell(&Dumbbell { edge_length, ..neck }));
}

/// Lengths of every size, so that their ratios are extreme.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 0.01..3.0,
        1 => (-80.0..80.0).prop_map(|exponent: f64| 10.0_f64.powf(exponent)),
        1 => any::<u64>().prop_map(|seed| number::mixed(&mut Entropy::new(&stream(seed, 64)))),
    ]
}

proptest! {
    #[test]
    fn any_parameters_give_a_surface_or_a_refusal(
        [a, b, c, d] in prop::array::uniform4(length()),
        fineness in -1.3..2.0,
        half_turns in -200..200i32,
    ) {
        let longest = [a, b, c, d].into_iter().fold(0.0_f64, |x, y| x.max(y.abs()));
        let edge_length = longest * 10.0_f64.powf(fineness);
        let center = DVec3::new(a, -b, c);
        // Each generator asserts that what it made is closed and oriented.
        let _ = sphere(&Sphere { center, radius: d, edge_length });
        let _ = torus(&Torus { center, radius: d, tube_radius: c, edge_length });
        let _ = box_(&Box_ { min: DVec3::new(a, b, c), max: DVec3::new(b, c, d), edge_length });
        let _ = two_boxes(&BoxPair { first: [center, center + d], edge_length, ..BoxPair::nested() });
        let _ = dumbbell(&Dumbbell { radius: a, distance: b, neck_radius: c, fillet_radius: d, edge_length });
        let _ = ring_overlap(&RingOverlap { radius: a, tube_radius: b, overlap: c, drift: d, edge_length });
        let _ = helix_overlap(&HelixOverlap { radius: a, tube_radius: b, pitch: c, turns: d, edge_length });
        let _ = trefoil_overlap(&TrefoilOverlap { radius: a, height: b, tube_radius: c, edge_length });
        let _ = figure_eight(&FigureEight { radius: a, tube_radius: b, edge_length });
        let band = Moebius { radius: a, width: b, thickness: c, half_turns, edge_length };
        let _ = (moebius(&band), double_moebius(&band));
    }

    #[test]
    fn any_sweep_gives_a_surface_or_a_refusal(
        centers in prop::collection::vec(prop::array::uniform3(length()), 0..8),
        profile in prop::collection::vec(prop::array::uniform2(length()), 0..8),
        closed in any::<bool>(),
        twist in any::<i32>(),
    ) {
        let centers = centers.into_iter().map(DVec3::from_array).collect();
        let profile: Vec<_> = profile.into_iter().map(DVec2::from_array).collect();
        let reversed = profile.iter().rev().copied().collect();
        for profile in [profile, reversed] {
            let _ = sweep(&Sweep { centers: Vec::clone(&centers), closed, profile, twist });
        }
    }
}

#[test]
fn unknown_names_suggest_the_nearest() {
    let message = |name| by_name(name, None).unwrap_err().to_string();
    assert_eq!(
        message("ring_overlap"),
        "no shape is called \"ring_overlap\"; did you mean \"ring-overlap\"?"
    );
    assert_eq!(message("Sphere"), "no shape is called \"Sphere\"; did you mean \"sphere\"?");
    assert_eq!(message("hexagonal prism"), "no shape is called \"hexagonal prism\"");
    assert!(message(&"x".repeat(1_000_000)).len() < 1_000_100);
}

/// The very bits, so that a change of any vertex shows: FNV-1a over coordinates and indices.
#[test]
fn the_bits_of_every_shape_are_those_recorded() {
    let hash = |mesh: &TriMesh| {
        let coordinates = mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits));
        let indices = mesh.triangles().iter().flatten().map(|v| u64::from(v.0));
        coordinates
            .chain(indices)
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3))
    };
    let found: String = NAMES
        .iter()
        .map(|shape| {
            let mesh = by_name(shape.name, None).unwrap();
            let pairs = intersecting_pairs(&mesh);
            let (v, t) = (mesh.positions().len(), mesh.triangles().len());
            format!("{}: {v} vertices, {t} triangles, {pairs} pairs, {:016x}\n", shape.name, hash(&mesh))
        })
        .collect();
    assert_eq!(found, include_str!("shapes.snapshot"), "if meant, this is the new record:\n{found}");
}
