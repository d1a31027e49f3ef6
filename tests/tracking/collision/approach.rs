//! Minimum separation against exact distances: never a miss, and false alarms only within the slack.

use super::pairs::{Family, PAIRS, Pair, Query};
use rug::Rational;
use welter_kit::exact::moving::rational;
use welter_tracking::collision::{MinimumSeparationParameters, minimum_separation};

/// Times at which the exact distance is sampled.
const SAMPLES: u32 = 16;

#[derive(Debug, Default)]
struct Counts {
    queries: u32,
    approaches: u32,
    /// Answers proven in rational numbers for all times, not only at samples.
    proven: u32,
    most_steps: u32,
    /// Approaches that gave up before they were as near as the slack.
    short: u32,
}

fn check(pair: Pair, query: &Query, distance: f64, counts: &mut Counts) {
    let context = || format!("{pair:?} {query:?} {distance:e}");
    let found = pair.approach(query, distance).unwrap();
    counts.queries += 1;
    let moving = pair.moving(query);
    let limit = rational(distance).square();
    // Never a miss: farther apart at all samples before the time (after it nothing is said).
    let until = found.as_ref().map_or(1.0, |a| a.time);
    for i in 0..=SAMPLES {
        let time = Rational::from((i, SAMPLES));
        if time < until || found.is_none() {
            assert!(moving.distance_squared(&time) > limit, "late: {until} {time} {}", context());
        }
    }
    // ... and at all times whatsoever, where a proof is found.
    if until > 0.0 {
        let proof = moving.stays_beyond(&rational(distance), &Rational::new(), &rational(until));
        assert_ne!(proof, Some(false), "late: {until} {}", context());
        counts.proven += u32::from(proof == Some(true));
    }
    if distance == 0.0 {
        assert_eq!(found.is_some(), pair.touches(query), "{}", context());
    }
    let Some(approach) = found else { return };
    counts.approaches += 1;
    counts.most_steps = counts.most_steps.max(approach.steps);
    // The bounds hold.
    let exact = moving.distance_squared(&rational(approach.time));
    let [lower, upper] = approach.distance;
    assert!(rational(lower).square() <= exact, "{approach:?} {}", context());
    if upper.is_finite() {
        assert!(exact <= rational(upper).square(), "{approach:?} {}", context());
        // upper <= distance + 2^-44 r, and two ulp for the unit of the caller.
        let allowed = rational(upper) - rational(distance);
        let ulps = rational(upper) * rational(2f64.powi(-51)) + rational(f64::from_bits(4));
        let beyond = allowed - ulps;
        let slack = moving.size_squared() * rational(2f64.powi(-88)) * rational(1.000_001);
        let within = beyond <= 0 || beyond.clone().square() <= slack;
        counts.short += u32::from(!within);
        let far = moving.size_squared() * rational(2f64.powi(-48));
        assert!(beyond <= 0 || beyond.clone().square() <= far, "{approach:?} {}", context());
        if !within {
            println!("{approach:?} {} {}", beyond.to_f64(), context());
        }
    }
}

fn run(family: Family, count: u64, distances: &[f64]) -> Counts {
    let mut counts = Counts::default();
    for seed in 0..count {
        let query = family.query(seed);
        for pair in PAIRS {
            for &distance in distances {
                check(pair, &query, distance, &mut counts);
            }
        }
    }
    println!("{family:?}: {counts:?}");
    counts
}

#[test]
fn random_approaches() {
    let counts = run(Family::Random, 60, &[0.0, 1e-6, 0.05, 0.3, 1.0]);
    assert!(counts.approaches > 300 && counts.short == 0, "{counts:?}");
    assert!(counts.most_steps < 20, "{counts:?}");
}

#[test]
fn approaches_on_small_grids() {
    let counts = run(Family::Grid, 60, &[0.0, 1e-9, 0.25, 1.0, 2.0]);
    // A vertex or edge that is met at a distance of 1e-9 may be told too early.
    assert!(counts.approaches > 500 && counts.short * 50 < counts.approaches, "{counts:?}");
}

#[test]
fn approaches_at_every_scale() {
    let distances = [0.0, f64::from_bits(1), 1e-300, 1e-150, 1e-8, 1.0, 1e8, 1e200, f64::MAX];
    let counts = run(Family::Any, 40, &distances);
    assert!(counts.approaches > 300 && counts.short == 0, "{counts:?}");
}

#[test]
fn approaches_of_fast_and_thin_primitives() {
    for family in [Family::Fast, Family::Thin] {
        let counts = run(family, 40, &[0.0, 1e-12, 1e-3, 0.1]);
        assert!(counts.approaches > 50 && counts.short == 0, "{counts:?}");
    }
}

/// A vertex that sinks from 3 to 1 above a face is at a distance of 2 in the middle of the step, whatever the
/// unit.
#[test]
fn every_unit() {
    let largest = 2f64.powi(1021);
    for unit in [1.0, 1e200, 1e-200, 1e-300, largest, f64::from_bits(1), f64::from_bits(9)] {
        let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
        let v = |z: f64| [[0.0, 0.0, z], face[0], face[1], face[2]].map(|p| p.map(|x| x * unit));
        let query = [v(3.0), v(1.0)];
        let approach = Pair::VertexFace.approach(&query, 2.0 * unit).unwrap().unwrap();
        assert!(0.499_999_999 < approach.time && approach.time <= 0.5, "{unit:e} {approach:?}");
        assert_eq!(approach.normal, [0.0, 0.0, 1.0], "{unit:e}");
        assert_eq!(
            Pair::VertexFace.approach(&query, 0.999 * unit).unwrap().is_some(),
            unit <= f64::from_bits(9)
        );
        assert_eq!(Pair::VertexFace.approach(&query, f64::MAX).unwrap().unwrap().time, 0.0);
        check(Pair::VertexFace, &query, 2.0 * unit, &mut Counts::default());
    }
}

/// Without steps to take, the answer is early but never late, and tells how near they came.
#[test]
fn steps_used_up() {
    // The face turns under the vertex, which grazes it in the middle of the step.
    let t0 = [[-1.0, 0.0, 0.0], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, 0.0], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    let moving = Pair::VertexFace.moving(&[t0, t1]);
    let mut before = 0.0;
    for most_steps in [0, 1, 2, 4, 8, 16, 32] {
        let parameters = MinimumSeparationParameters { distance: 1e-9, most_steps };
        let found = minimum_separation::vertex_face(t0, t1, &parameters).unwrap().unwrap();
        assert!(found.steps <= most_steps && before <= found.time && found.time < 0.5, "{found:?}");
        let exact = moving.distance_squared(&rational(found.time));
        assert!(rational(found.distance[0]).square() <= exact, "{found:?}");
        assert!(exact <= rational(found.distance[1]).square(), "{found:?}");
        assert!(found.distance[0] > 1e-9, "{found:?}");
        before = found.time;
    }
    assert!(before > 0.499, "{before}");
}
