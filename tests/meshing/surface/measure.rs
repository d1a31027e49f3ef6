//! Measures: bounds against exact rationals, convergence to analytic surfaces, the whole exponent range.

use super::*;
use proptest::prelude::*;
use rug::{Integer, Rational};
use std::f64::consts::PI;
use welter_kit::generate::number;
use welter_meshing::shapes::{self, Box_, Dumbbell, Sphere, Torus, dumbbell, sphere, torus};
use welter_meshing::surface::measure::*;
use welter_predicates::Sign;

fn exact(p: DVec3) -> [Rational; 3] {
    p.to_array().map(|c| Rational::from_f64(c).unwrap())
}

fn cross(a: &[Rational; 3], b: &[Rational; 3]) -> [Rational; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i])
    })
}

fn dot(a: &[Rational; 3], b: &[Rational; 3]) -> Rational {
    (0..3).map(|k| Rational::from(&a[k] * &b[k])).sum()
}

fn minus(a: &[Rational; 3], b: &[Rational; 3]) -> [Rational; 3] {
    [0, 1, 2].map(|k| Rational::from(&a[k] - &b[k]))
}

/// Six times the signed volume, without rounding, relative to the origin.
fn exact_six_fold_volume(mesh: &TriMesh) -> Rational {
    let corners = |t| mesh.corners(TriId::from_index(t)).map(exact);
    let terms = (0..mesh.triangles().len()).map(corners).map(|[a, b, c]| dot(&a, &cross(&b, &c)));
    terms.sum()
}

/// Twice the area to 2^-`bits`, rounded down once a triangle.
fn twice_area(mesh: &TriMesh, bits: u32) -> Rational {
    let roots = (0..mesh.triangles().len()).map(|t| {
        let [a, b, c] = mesh.corners(TriId::from_index(t)).map(exact);
        let normal = cross(&minus(&b, &a), &minus(&c, &a));
        let scaled = dot(&normal, &normal) << (2 * bits);
        scaled.trunc().numer().clone().sqrt()
    });
    Rational::from(roots.sum::<Integer>()) >> bits
}

/// The power of two as a rational.
fn power(exponent: i32) -> Rational {
    if exponent >= 0 {
        Rational::from(1) << exponent as u32
    } else {
        Rational::from(1) >> exponent.unsigned_abs()
    }
}

fn value(bounded: Bounded) -> [Rational; 2] {
    [bounded.significand, bounded.bound].map(|x| Rational::from_f64(x).unwrap() * power(bounded.exponent))
}

/// Closed surfaces on few vertices: tetrahedra with shared vertices.
fn closed(points: &[[f64; 3]]) -> TriMesh {
    let tetrahedra = (0..points.len() as u32 - 3).map(|i| [i, i + 1, i + 2, i + 3]);
    let triangles: Vec<_> =
        tetrahedra.flat_map(|[a, b, c, d]| [[a, c, b], [a, b, d], [b, c, d], [c, a, d]]).collect();
    mesh(points, &triangles)
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1.0..1.0,
        1e6..1e6 + 1.0,
        (-4i32..4).prop_map(f64::from),
        any::<u64>().prop_map(|seed| number::mixed(&mut Entropy::new(&stream(seed, 64)))),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn volumes_lie_within_their_bounds(points in prop::collection::vec(prop::array::uniform3(coordinate()), 4..9)) {
        let mesh = closed(&points);
        let exact: Rational = exact_six_fold_volume(&mesh) / 6;
        let volume = signed_volume_bounded(&mesh);
        let [found, bound] = value(volume);
        prop_assert!(Rational::from(&exact - &found).abs() <= bound);
        if !volume.sign().is_zero() {
            prop_assert_eq!(volume.sign() as i32, exact.cmp0() as i32);
        }
        prop_assert!(!volume.value().is_nan() && !area(&mesh).is_nan());
    }

    #[test]
    fn areas_lie_within_their_bounds(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 4..7),
        offset in prop::array::uniform3(prop_oneof![Just(0.0), 1e3..1e9]),
        exponent in -300..300i32,
    ) {
        let offset = DVec3::from_array(offset);
        let mesh = moved(&closed(&points), |p| p + offset);
        let exact: Rational = twice_area(&mesh, 200) / 2;
        let [found, bound] = value(area_bounded(&mesh));
        let rounded = power(-150);
        prop_assert!(Rational::from(&exact - &found).abs() <= bound + rounded);
        let scale = number::power_of_two(exponent);
        let [scaled, _] = value(area_bounded(&moved(&mesh, |p| p * scale)));
        prop_assert_eq!(scaled, found * power(2 * exponent));
    }
}

#[test]
fn bounds_are_tight_in_proportion_to_the_area_and_not_to_the_number_of_triangles() {
    for edge_length in [0.4, 0.1, 0.03] {
        let ball = sphere(&Sphere { edge_length, ..Sphere::default() }).unwrap();
        for offset in [0.0, 1e6] {
            let ball = moved(&ball, |p| p + offset);
            assert!(signed_volume_bounded(&ball).error_bound() < 2e-14, "{edge_length} {offset}");
            assert!(area_bounded(&ball).error_bound() < 2e-14, "{edge_length} {offset}");
        }
    }
}

/// Asserts that errors fall as the square of the edge length, from one size to half of it.
fn assert_second_order(what: &str, edge_lengths: &[f64], error: impl Fn(f64) -> f64) {
    let errors: Vec<f64> = edge_lengths.iter().map(|&h| error(h)).collect();
    for (h, e) in edge_lengths.windows(2).zip(errors.windows(2)) {
        let order = (e[0] / e[1]).ln() / (h[0] / h[1]).ln();
        assert!((1.8..2.2).contains(&order), "{what}: order {order}, errors {errors:?}");
    }
}

#[test]
fn volume_and_area_converge_with_order_two() {
    // Frequencies 6, 12, 24, 48 exactly: 1.176 * 1.1071487 / h.
    let sizes = [6.0, 12.0, 24.0, 48.0].map(|n| 1.302 * 1.000_1 / n);
    let ball = |h| sphere(&Sphere { edge_length: h, radius: 1.5, ..Sphere::default() }).unwrap();
    let sizes_ball = sizes.map(|h| 1.5 * h);
    let exact = 4.0 / 3.0 * PI * 1.5_f64.powi(3);
    assert_second_order("sphere volume", &sizes_ball, |h| exact - signed_volume(&ball(h)));
    assert_second_order("sphere area", &sizes_ball, |h| 4.0 * PI * 2.25 - area(&ball(h)));

    let ring = |h| torus(&Torus { edge_length: h, ..Torus::default() }).unwrap();
    let sizes = [20.0, 40.0, 80.0].map(|n| 2.0 * PI * 0.4 / n);
    assert_second_order("torus volume", &sizes, |h| 2.0 * PI * PI * 0.16 - signed_volume(&ring(h)));
    assert_second_order("torus area", &sizes, |h| 4.0 * PI * PI * 0.4 - area(&ring(h)));
}

#[test]
fn mean_curvature_converges_on_sphere_and_torus() {
    // Root mean square over the area, so that the twelve irregular vertices weigh what they cover.
    let error = |mesh: &TriMesh, exact: &dyn Fn(DVec3) -> DVec3| {
        let curvature = mean_curvature_normals(mesh);
        let pairs = mesh.positions().iter().zip(&curvature.normals).zip(&curvature.areas);
        let square: f64 = pairs.map(|((&p, &n), &a)| a * n.distance_squared(exact(p))).sum();
        (square / curvature.areas.iter().sum::<f64>()).sqrt()
    };
    let ring = |h| torus(&Torus { edge_length: h, ..Torus::default() }).unwrap();
    let on_torus = |p: DVec3| {
        let outward = DVec3::new(p.x, p.y, 0.0).normalize();
        let normal = (p - outward) / 0.4;
        // 1/r along the tube's circle, cos(angle) / (distance from the axis) along the other.
        let distance = DVec3::new(p.x, p.y, 0.0).length();
        0.5 * (1.0 / 0.4 + normal.dot(outward) / distance) * normal
    };
    let sizes = [20.0, 40.0, 80.0].map(|n| 2.0 * PI * 0.4 / n);
    assert_second_order("torus curvature", &sizes, |h| error(&ring(h), &on_torus));

    let radius = 2.0;
    let ball = |h| sphere(&Sphere { radius, edge_length: h, ..Sphere::default() }).unwrap();
    let on_sphere = |p: DVec3| p / (radius * radius);
    let errors = [0.4, 0.2, 0.1].map(|h| error(&ball(h), &on_sphere));
    for e in errors.windows(2) {
        let order = (e[0] / e[1]).log2();
        assert!((1.6..2.0).contains(&order), "sphere curvature: order {order}, errors {errors:?}");
    }
}

#[test]
fn areas_of_vertices_add_up_and_curvature_is_the_gradient_of_area() {
    let body = dumbbell(&Dumbbell { edge_length: 0.15, ..Dumbbell::default() }).unwrap();
    let curvature = mean_curvature_normals(&body);
    let sum: f64 = curvature.areas.iter().sum();
    assert!((sum - area(&body)).abs() < 1e-12);
    for v in (0..body.positions().len()).step_by(7) {
        let area_at = |offset: DVec3| {
            let mut soup = body.to_soup();
            soup.positions[v] += offset;
            area(&TriMesh::new(soup).unwrap())
        };
        let step = 1e-4;
        let gradient = DVec3::from_array(
            DVec3::AXES.map(|axis| (area_at(step * axis) - area_at(-step * axis)) / (2.0 * step)),
        );
        let expected = 2.0 * curvature.areas[v] * curvature.normals[v];
        // Central differences: the third derivative of area is of order 1 / length.
        assert!(gradient.distance(expected) < 1e-5, "vertex {v}: {gradient} and {expected}");
    }
}

#[test]
fn total_angle_defect_is_two_pi_times_the_euler_characteristic() {
    for shape in shapes::NAMES {
        let mesh = shapes::by_name(shape.name, Some(0.15)).unwrap();
        let mut defect = vec![2.0 * PI; mesh.positions().len()];
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            let x = mesh.corners(TriId::from_index(t));
            for k in 0..3 {
                let (p, q) = (x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]);
                defect[triangle[k].index()] -= p.cross(q).length().atan2(p.dot(q));
            }
        }
        let total: f64 = defect.iter().sum();
        let expected = 2.0 * PI * Topology::of(&mesh).euler_characteristic() as f64;
        assert!((total - expected).abs() < 1e-9, "{}: {total}", shape.name);
    }
}

#[test]
fn no_overflow_at_the_ends_of_the_exponent_range() {
    let cube = shapes::box_(&Box_ { edge_length: 2.0, ..Box_::default() }).unwrap();
    for exponent in [-1074, -1022, -500, 0, 500, 1023] {
        let scale = number::power_of_two(exponent);
        let scaled = moved(&cube, |p| p * scale);
        let volume = signed_volume_bounded(&scaled);
        assert_eq!(value(volume)[0], Rational::from(8) * power(3 * exponent), "2^{exponent}");
        assert_eq!(volume.sign(), Sign::Positive);
        assert_eq!(value(area_bounded(&scaled))[0], Rational::from(24) * power(2 * exponent));
        let angles = angle_statistics(&scaled).unwrap();
        assert_eq!(angles, angle_statistics(&cube).unwrap());
        let lengths = edge_length_statistics(&scaled, &Topology::of(&scaled)).unwrap();
        assert_eq!(lengths.min, libm_scaled(2.0, exponent));
        let curvature = mean_curvature_normals(&scaled);
        let plain = mean_curvature_normals(&cube);
        for (n, m) in curvature.normals.iter().zip(&plain.normals) {
            assert_eq!(n.x, libm_scaled(m.x, -exponent));
        }
    }
    let full = moved(&cube, |p| p * f64::MAX);
    assert_eq!(signed_volume_bounded(&full).sign(), Sign::Positive);
    assert_eq!(signed_volume(&full), f64::INFINITY);
    assert!(edge_length_statistics(&full, &Topology::of(&full)).unwrap().min.is_infinite());
    assert_eq!(bounding_box(&full).unwrap().max, DVec3::splat(f64::MAX));
}

/// `x * 2^exponent` in two exact steps (unless the result is subnormal or infinite).
fn libm_scaled(x: f64, exponent: i32) -> f64 {
    x * number::power_of_two(exponent / 2) * number::power_of_two(exponent - exponent / 2)
}

#[test]
fn angle_and_edge_statistics_of_known_triangles() {
    let mesh =
        mesh(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 0.0, 0.0]], &[[0, 1, 2], [0, 3, 1]]);
    let angles = angle_statistics(&mesh).unwrap();
    assert_eq!((angles.min, angles.min_at), (0.0, TriId(1)));
    assert_eq!((angles.max, angles.max_at), (PI, TriId(1)));
    let mut histogram = [0; ANGLE_BINS];
    (histogram[3], histogram[5], histogram[9], histogram[0], histogram[17]) = (1, 1, 1, 2, 1);
    assert_eq!(angles.histogram, histogram);
    let topology = Topology::of(&mesh);
    let lengths = edge_length_statistics(&mesh, &topology).unwrap();
    assert_eq!((lengths.min, lengths.max, lengths.mean), (2.0, 5.0, (4.0 + 3.0 + 2.0 + 5.0 + 2.0) / 5.0));
    assert_eq!(topology.edges()[lengths.max_at.index()], [VertexId(1), VertexId(2)]);
}

#[test]
fn an_empty_mesh_measures_zero() {
    let empty = mesh(&[[1.0; 3]], &[]);
    assert_eq!((area(&empty), signed_volume(&empty), bounding_box(&empty)), (0.0, 0.0, None));
    assert_eq!(angle_statistics(&empty), None);
    assert_eq!(edge_length_statistics(&empty, &Topology::of(&empty)), None);
    assert_eq!(mean_curvature_normals(&empty).normals, [DVec3::ZERO]);
}

#[test]
fn inside_out_components_are_those_of_negative_volume() {
    let boxes = shapes::by_name("two-boxes", Some(0.5)).unwrap();
    let inside_out = |mesh: &TriMesh| inside_out_components(mesh, &Topology::of(mesh));
    assert!(inside_out(&boxes).is_empty());
    assert_eq!(inside_out(&boxes.clone().reversed()), [0, 1]);
    // A flat pocket has no volume, so it is not inside out; an open sheet has no inside.
    assert!(inside_out(&placed(&[[0, 2, 1], [0, 1, 2]])).is_empty());
    assert!(inside_out(&placed(&[[0, 2, 1]])).is_empty());
}
