//! Vortex filaments, against quadrature, the straight segment of textbooks, and rings.

use super::{compare, points, ring};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use welter_fluids::procedural::{
    VectorPotential, VortexFilament, VortexFilamentParameters, VortexRingParameters,
};
use welter_kit::mesher::Random;
use welter_kit::procedural::LineVortex;
use welter_tracking::flows::VelocityField;

fn filament(vertices: &[DVec3], closed: bool, core: f64, circulation: f64) -> VortexFilament {
    let parameters = VortexFilamentParameters { vertices: vertices.to_vec(), closed, core, circulation };
    VortexFilament::new(&parameters).unwrap()
}

fn bent() -> Vec<DVec3> {
    let line = [[0.5, -1.0, 0.2], [0.1, 0.3, -0.4], [0.1, 0.3, -0.4], [-0.6, 0.4, 0.5], [0.2, 1.0, 0.7]];
    line.map(DVec3::from_array).to_vec()
}

#[test]
fn potential_and_velocity_are_the_integrals() {
    for (core, panels) in [(1.0, 2), (0.2, 4), (0.02, 30)] {
        for closed in [false, true] {
            let mut line = bent();
            // Three roundings of the distance from the line, relative to the length of a segment, are on it `3 u length / (pi core)`
            // of the integral of the magnitudes; the rest is that of sums.
            let longest = line.windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max);
            let tolerance = 2e-15 + 1.1e-16 * longest / core;
            let filament = filament(&line, closed, core, -2.0);
            if closed {
                line.push(line[0]);
            }
            let twin = LineVortex::polyline(&line, core, -2.0, panels);
            for point in points(60, 2.0, 11) {
                compare(&filament, &twin, point, tolerance);
            }
            let mut random = Random::new(12);
            for pair in line.windows(2) {
                for _ in 0..15 {
                    // On the segment, near it, in line with it, at its ends.
                    let along = pair[0].lerp(pair[1], random.between(-0.5, 1.5));
                    compare(&filament, &twin, along, tolerance);
                    compare(&filament, &twin, along + core * random.point(), tolerance);
                }
                compare(&filament, &twin, pair[0], tolerance);
                compare(&filament, &twin, pair[1], tolerance);
            }
            for point in points(20, 1e5, 13) {
                compare(&filament, &twin, point, tolerance);
            }
        }
    }
}

/// `circulation / (4 pi s) (cos of one angle - cos of the other)`, with a core of next to nothing.
#[test]
fn a_thin_segment_is_that_of_textbooks() {
    let [p, q] = [DVec3::new(0.5, 0.25, -1.0), DVec3::new(-0.5, 1.25, 0.5)];
    let segment = filament(&[p, q], false, 1e-12, 3.0);
    let along = (q - p).normalize();
    for point in points(500, 2.0, 14) {
        let across = along.cross(point - p);
        let s = across.length();
        if s < 0.05 {
            continue;
        }
        let cosine = |from: DVec3| (point - from).normalize().dot(along);
        let expected = 3.0 / (4.0 * PI * s) * (cosine(p) - cosine(q)) * across / s;
        let gap = (segment.velocity(point, 0.0) - expected).length();
        assert!(gap < 1e-15 / (s * s), "{point}: {gap:e}");
    }
}

#[test]
fn a_long_line_turns_as_an_infinite_one() {
    let mut random = Random::new(15);
    for core in [1e-3, 0.1, 1.0] {
        let ends = [-1e7, 1e7].map(|z| DVec3::new(0.3, 0.2, z));
        let line = filament(&ends, false, core, 2.0);
        for _ in 0..100 {
            let (s, angle) = (core * 10f64.powf(random.between(-3.0, 2.0)), random.between(0.0, TAU));
            let (sin, cos) = angle.sin_cos();
            let point = DVec3::new(0.3, 0.2, 0.0) + s * DVec3::new(cos, sin, random.between(-1.0, 1.0));
            let exact = (point - DVec3::new(0.3, 0.2, point.z)).length();
            let expected = 2.0 * exact / (TAU * (exact * exact + core * core));
            let velocity = line.velocity(point, 0.0);
            // Of ends at a distance L a part of (s / L)^2 is missing.
            let ends = (s * s + core * core) / 1e14;
            assert!((velocity.length() / expected - 1.0).abs() < 1e-12 + ends, "{core} {s}");
            assert!((velocity.normalize() - DVec3::new(-sin, cos, 0.0)).length() < 1e-15 / s + 1e-12);
        }
    }
}

#[test]
fn the_circulation_around_a_line_is_its_strength() {
    let ends = [-1e7, 1e7].map(|z| DVec3::new(0.0, 0.0, z));
    for core in [1e-9, 0.3] {
        let line = filament(&ends, false, core, 2.0);
        // An ellipse around it, off the middle: the trapezoid rule converges exponentially.
        let count = 400;
        let sum: f64 = (0..count)
            .map(|i| {
                let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
                let point = DVec3::new(0.25 + cos, 2.0 * sin, 0.5 * cos);
                let along = DVec3::new(-sin, 2.0 * cos, -0.5 * sin);
                line.velocity(point, 0.0).dot(along) * TAU / f64::from(count)
            })
            .sum();
        if core < 1e-6 {
            assert!((sum - 2.0).abs() < 1e-12, "{sum}");
        } else {
            // The part of the core that reaches out of the ellipse is missing.
            assert!(sum < 2.0 && sum > 1.6, "{sum}");
        }
    }
}

#[test]
fn polygons_approach_the_ring() {
    let parameters = VortexRingParameters { core: 0.2, circulation: 2.0, ..Default::default() };
    let ring = ring(parameters);
    let errors = [32_u32, 64, 128].map(|count| {
        let corner = |i: u32| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
            DVec3::new(sin, 0.0, cos)
        };
        let polygon = filament(&(0..count).map(corner).collect::<Vec<_>>(), true, 0.2, 2.0);
        let gaps = points(200, 1.5, 16).into_iter().map(|point| {
            let (a, b) = (polygon.potential_and_curl(point, 0.0), ring.potential_and_curl(point, 0.0));
            (a.curl - b.curl).length() + (a.potential - b.potential).length()
        });
        gaps.fold(0.0, f64::max)
    });
    let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).log2());
    println!("polygons of 32, 64, 128 corners differ from the ring by {errors:?}: orders {orders:?}");
    assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.05), "{orders:?}");
}

/// The flow of an open line has no divergence; what closes the circuit of its vorticity is a part of its curl.
#[test]
fn an_open_line_is_the_sum_of_its_pieces() {
    let line = bent();
    let whole = filament(&line, false, 0.1, 1.0);
    for point in points(100, 1.5, 17) {
        let pieces = [0, 2, 3].map(|i| filament(&line[i..=i + 1], false, 0.1, 1.0));
        let sum: DVec3 = pieces.iter().map(|piece| piece.velocity(point, 0.0)).sum();
        assert!((whole.velocity(point, 0.0) - sum).length() < 1e-14);
    }
}
