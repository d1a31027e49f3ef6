//! Vortex rings, against quadrature and the textbook formula.

use super::{compare, points, ring};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use welter_fluids::procedural::{VectorPotential, VortexRing, VortexRingParameters};
use welter_kit::mesher::Random;
use welter_kit::procedural::LineVortex;
use welter_tracking::flows::VelocityField;

fn tilted(core: f64) -> VortexRingParameters {
    VortexRingParameters {
        center: DVec3::new(0.3, -0.2, 0.1),
        axis: DVec3::new(1.0, 2.0, -2.0),
        radius: 0.75,
        core,
        circulation: 3.0,
    }
}

fn twin(parameters: &VortexRingParameters, points: u32) -> LineVortex {
    let &VortexRingParameters { center, axis, radius, core, circulation } = parameters;
    LineVortex::circle([center, axis], radius, core, circulation, points)
}

/// A point at a distance from the axis and a height above the plane.
fn at(parameters: &VortexRingParameters, angle: f64, distance: f64, height: f64) -> DVec3 {
    let axis = parameters.axis.normalize();
    let (u, v) = axis.any_orthonormal_pair();
    parameters.center + distance * (angle.cos() * u + angle.sin() * v) + height * axis
}

#[test]
fn potential_and_velocity_are_the_integrals() {
    for (core, count) in [(2.0, 200), (0.3, 400), (0.05, 1200)] {
        let parameters = tilted(core);
        let (ring, twin) = (ring(parameters), twin(&parameters, count));
        for point in points(150, 2.0, 1) {
            compare(&ring, &twin, point, 2e-15);
        }
        let mut random = Random::new(2);
        for _ in 0..150 {
            let angle = random.between(0.0, TAU);
            // Near the circle, on it, near the axis, on it, and at the centre.
            let (near, high) = (core * random.between(-1.0, 1.0), core * random.between(-1.0, 1.0));
            compare(&ring, &twin, at(&parameters, angle, 0.75 + near, high), 2e-15);
            compare(&ring, &twin, at(&parameters, angle, 0.75, 0.0), 2e-15);
            compare(&ring, &twin, at(&parameters, angle, 1e-9 * near, high), 2e-15);
            compare(&ring, &twin, at(&parameters, angle, 1e-200, high), 2e-15);
        }
        compare(&ring, &twin, parameters.center, 2e-15);
        // Far away.
        for point in points(50, 1e5, 3) {
            compare(&ring, &twin, point, 2e-15);
        }
    }
}

/// Complete elliptic integrals by the arithmetic-geometric mean, for the modulus k.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut c, mut power, mut sum) = (1.0, (1.0 - k * k).sqrt(), k, 0.5, 0.0);
    while f64::abs(c) > 1e-16 {
        sum += power * c * c;
        (a, b, c) = (0.5 * (a + b), f64::sqrt(a * b), 0.5 * (a - b));
        power *= 2.0;
    }
    let first = PI / (2.0 * a);
    (first, first * (1.0 - sum))
}

/// The flow of an infinitely thin ring, as in textbooks: along the axis and away from it.
fn thin_ring(radius: f64, circulation: f64, r: f64, z: f64) -> [f64; 2] {
    let far = (radius + r).powi(2) + z * z;
    let near = (radius - r).powi(2) + z * z;
    let (first, second) = elliptic((4.0 * radius * r / far).sqrt());
    let factor = circulation / (TAU * far.sqrt());
    let axial = factor * (first + (radius * radius - r * r - z * z) / near * second);
    let radial = factor * z / r * (-first + (radius * radius + r * r + z * z) / near * second);
    [axial, radial]
}

#[test]
fn a_thin_core_is_the_ring_of_textbooks() {
    let parameters = tilted(1e-9);
    let (ring, axis) = (ring(parameters), parameters.axis.normalize());
    let mut random = Random::new(4);
    for _ in 0..2000 {
        let (r, z) = (random.between(0.05, 2.0), random.between(-1.0, 1.0));
        let from_circle = (r - 0.75).hypot(z);
        if from_circle < 0.01 {
            continue;
        }
        let angle = random.between(0.0, TAU);
        let velocity = ring.velocity(at(&parameters, angle, r, z), 0.0);
        let outward = (at(&parameters, angle, 1.0, 0.0) - parameters.center).normalize();
        let [axial, radial] = thin_ring(0.75, 3.0, r, z);
        let expected = axial * axis + radial * outward;
        // Of the core (1e-7)^2; the rest is the textbook's differences of K and E, divided by r, and the position's rounding.
        let bound = 1e-13 * expected.length() * (1.0 + 0.1 / from_circle) + 1e-14 / r;
        let gap = (velocity - expected).length();
        assert!(gap <= bound, "r = {r}, z = {z}: {velocity}, not {expected}: {gap:e}");
    }
}

/// The circulation along a circle around the core, by the trapezoid rule.
fn circulation(ring: &VortexRing, parameters: &VortexRingParameters, distance: f64) -> f64 {
    let count = 400;
    let mut sum = 0.0;
    for i in 0..count {
        // Out of the plane on the inside: as the fluid goes.
        let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
        let point = at(parameters, 0.4, parameters.radius - distance * cos, distance * sin);
        let outward = (at(parameters, 0.4, 1.0, 0.0) - parameters.center).normalize();
        let along = sin * outward + cos * parameters.axis.normalize();
        sum += ring.velocity(point, 0.0).dot(along) * TAU * distance / f64::from(count);
    }
    sum
}

#[test]
fn the_circulation_around_the_core_is_the_strength() {
    for distance in [0.5, 0.2, 0.05] {
        let parameters = tilted(1e-9);
        let found = circulation(&ring(parameters), &parameters, distance);
        assert!((found - 3.0).abs() < 3e-13, "{distance}: {found}");
    }
    // With a core: s^2 / (s^2 + a^2) of it, where the ring is nearly straight.
    for core in [1e-4, 1e-3] {
        let parameters = tilted(core);
        let ring = ring(parameters);
        for distance in [0.5 * core, core, 4.0 * core] {
            let expected = 3.0 / (1.0 + (core / distance).powi(2));
            let found = circulation(&ring, &parameters, distance);
            let curved = (core / 0.75) * (core / 0.75) * 30.0;
            assert!((found / expected - 1.0).abs() < curved, "{core} {distance}: {found} {expected}");
        }
    }
}

/// Along the axis and back at infinity: the integral of `circulation R^2 / (2 (R^2 + z^2 + a^2)^(3/2))`.
#[test]
fn the_circulation_along_the_axis() {
    for core in [0.01, 0.4, 3.0] {
        let parameters = tilted(core);
        let (ring, axis) = (ring(parameters), parameters.axis.normalize());
        let width = (0.75_f64.powi(2) + core * core).sqrt();
        // z = width tan(angle) makes of it the integral of a cosine.
        let count = 64;
        let rule = welter_meshing::quadrature::SegmentRule::of_degree(63).unwrap();
        assert_eq!(2 * rule.points().len(), count);
        let sum: f64 = rule
            .points()
            .iter()
            .map(|&([_, s], w)| {
                let angle = PI * (s - 0.5);
                let point = parameters.center + width * angle.tan() * axis;
                ring.velocity(point, 0.0).dot(axis) * w * PI * width / angle.cos().powi(2)
            })
            .sum();
        let expected = 3.0 * 0.75_f64.powi(2) / (width * width);
        assert!((sum / expected - 1.0).abs() < 1e-14, "{core}: {sum} {expected}");
    }
}

#[test]
fn the_ring_moves_itself_by_the_flow_on_its_circle() {
    for core in [1e-3, 0.1, 1.0] {
        let parameters = tilted(core);
        let ring = ring(parameters);
        let velocity = ring.velocity(at(&parameters, 0.3, 0.75, 0.0), 0.0);
        let gap = (velocity - ring.own_speed() * parameters.axis.normalize()).length();
        assert!(gap < 1e-15 / core * ring.own_speed(), "{core}: {gap:e}");
    }
    let parameters = tilted(1e-5);
    let expected = 3.0 / (4.0 * PI * 0.75) * ((8.0 * 0.75 / 1e-5_f64).ln() - 1.0);
    assert!((ring(parameters).own_speed() / expected - 1.0).abs() < 1e-9);
}

/// At the centre, on the axis and on the circle there is no zero over zero, and no other direction than that of the axis.
#[test]
fn points_of_symmetry() {
    let parameters = VortexRingParameters { core: 1e-3, ..Default::default() };
    let ring = ring(parameters);
    let centre = ring.potential_and_curl(DVec3::ZERO, 0.0);
    assert_eq!((centre.potential, centre.curl.x, centre.curl.z), (DVec3::ZERO, 0.0, 0.0));
    assert!((centre.curl.y - (1.0_f64 + 1e-6).powf(-1.5)).abs() < 1e-15);
    let on_axis = ring.potential_and_curl(0.3 * DVec3::Y, 0.0);
    assert_eq!((on_axis.potential, on_axis.curl.x, on_axis.curl.z), (DVec3::ZERO, 0.0, 0.0));
    for angle in [0.0_f64, 0.5, 3.0] {
        let on_circle = ring.potential_and_curl(DVec3::new(angle.cos(), 0.0, angle.sin()), 0.0);
        assert!(on_circle.potential.is_finite() && on_circle.curl.y > 0.0);
        assert_eq!(
            (on_circle.curl.x, on_circle.curl.z),
            (0.0, 0.0),
            "nothing across the plane of the circle"
        );
    }
    let tiny = ring.potential_and_curl(DVec3::new(1e-310, 0.0, 0.0), 0.0);
    assert!((tiny.curl - centre.curl).length() < 1e-15);
    assert!(tiny.potential.z < 0.0, "it has a direction even there: {}", tiny.potential);
    // Far away it falls with the third power, to nothing.
    let far = [1e3, 1e6].map(|d| ring.velocity(DVec3::new(0.0, d, 0.0), 0.0).y * d * d * d);
    assert!((far[0] - 1.0).abs() < 1e-5 && (far[1] - 1.0).abs() < 1e-11, "{far:?}");
    assert_eq!(ring.velocity(DVec3::splat(1e300), 0.0), DVec3::ZERO);
}
