//! Weights and displacements over time.

use super::{mixture, points, potentials};
use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, Interpolation, Keyframes, Moving, Path, Pulse, VectorPotential, Weighted, WeightedSum,
};
use welter_tracking::flows::VelocityField;

#[test]
fn keyframes_meet_their_values_and_go_straight_or_smoothly() {
    let keys = vec![(-1.0, 2.0), (1.0, -3.0), (4.0, 1.0)];
    for interpolation in [Interpolation::Linear, Interpolation::Smooth] {
        let frames = Keyframes::new(keys.clone(), interpolation).unwrap();
        for &(time, value) in &keys {
            assert_eq!(frames.at(time), value);
        }
        assert_eq!((frames.at(-9.0), frames.at(9.0)), (2.0, 1.0));
        assert_eq!((frames.rate(-9.0), frames.rate(9.0)), (0.0, 0.0));
        assert_eq!(frames.at(2.5), -1.0, "half of the time is half of the way");
        // The way is the integral of the rate: Gauss on each piece is exact for polynomials.
        let rule = welter_meshing::quadrature::SegmentRule::of_degree(15).unwrap();
        for pair in keys.windows(2) {
            let (start, duration) = (pair[0].0, pair[1].0 - pair[0].0);
            let sum: f64 =
                rule.points().iter().map(|&([_, s], w)| w * frames.rate(start + s * duration)).sum();
            assert!((sum * duration - (pair[1].1 - pair[0].1)).abs() < 1e-13);
        }
    }
    let linear = Keyframes::new(keys, Interpolation::Linear).unwrap();
    assert_eq!((linear.at(0.0), linear.rate(0.0)), (-0.5, -2.5));
}

/// In a rotation that speeds up: at keyframes by the error of Runge and Kutta, between them by that of cubic polynomials.
#[test]
fn points_are_carried_with_order_four() {
    let axis = DVec3::new(1.0, -2.0, 2.0) / 3.0;
    let start = DVec3::new(0.7, 0.1, -0.3);
    let flow = move |p: DVec3, t: f64| (1.0 + t) * axis.cross(p);
    let exact = |t: f64| glam::DQuat::from_axis_angle(axis, t + 0.5 * t * t) * start;
    let errors = [16, 32, 64].map(|steps| {
        let path = Path::carried(&flow, start, [0.0, 2.0], steps).unwrap();
        let times = (0..=300).map(|i| f64::from(i) / 150.0);
        let (mut position, mut velocity): (f64, f64) = (0.0, 0.0);
        for time in times {
            let (displacement, rate) = path.value_and_rate(time);
            position = position.max((start + displacement - exact(time)).length());
            if time < 2.0 {
                velocity = velocity.max((rate - flow(exact(time), time)).length());
            }
        }
        [position, velocity]
    });
    let order = |k: usize| f64::log2(errors[1][k] / errors[2][k]);
    println!("errors of positions and velocities {errors:?}: orders {}, {}", order(0), order(1));
    assert!(order(0) > 3.9 && order(1) > 2.9);
    let path = Path::carried(&flow, start, [0.0, 2.0], 16).unwrap();
    assert_eq!((path.at(-1.0), path.rate(-1.0), path.rate(3.0)), (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO));
    assert_eq!(path.at(5.0), path.at(2.0));
}

#[test]
fn pulses_rise_stay_fall_and_come_again() {
    let pulse = Pulse::new(2.0, 1.0, [1.0, 0.5, 0.25], 3.0).unwrap();
    for k in 0..5 {
        let at = |since: f64| pulse.at(1.0 + 3.0 * f64::from(k) + since);
        assert_eq!(
            [0.0, 0.5, 1.0, 1.25, 1.5, 1.625, 1.75, 2.5].map(at),
            [0.0, 1.0, 2.0, 2.0, 2.0, 1.0, 0.0, 0.0]
        );
    }
    assert_eq!([-100.0, 0.0, 0.99].map(|t| pulse.at(t)), [0.0; 3]);
    let once = Pulse::new(2.0, 1.0, [1.0, 0.0, 1.0], f64::INFINITY).unwrap();
    assert_eq!([1.5, 2.0, 2.5, 3.0, 1e9].map(|t| once.at(t)), [1.0, 2.0, 1.0, 0.0, 0.0]);
}

#[test]
fn sums_are_linear_in_their_parts() {
    let weights = [1.0, 0.5, -0.75, 0.25, 0.5];
    for point in points(100, 1.5, 81) {
        let sum = mixture(1.0).potential_and_curl(point, 0.6);
        let (mut potential, mut curl) = (DVec3::ZERO, DVec3::ZERO);
        for ((_, part), weight) in potentials(1.0).into_iter().zip(weights) {
            potential += weight * part.potential_and_curl(point, 0.6).potential;
            curl += weight * part.velocity(point, 0.6);
        }
        assert_eq!((sum.potential, sum.curl), (potential, curl));
        assert_eq!(mixture(1.0).velocity(point, 0.6), curl);
    }
}

#[test]
fn weights_follow_the_time() {
    let keys = Keyframes::new(vec![(0.0, 0.0), (1.0, 4.0)], Interpolation::Linear).unwrap();
    let (_, wind) = potentials(1.0).pop().unwrap();
    let sum = WeightedSum::new(vec![Weighted { part: wind.clone(), amplitude: Amplitude::Keyed(keys) }]);
    for (time, weight) in [(-1.0, 0.0), (0.25, 1.0), (0.5, 2.0), (2.0, 4.0)] {
        assert_eq!(sum.velocity(DVec3::ZERO, time), weight * wind.velocity(DVec3::ZERO, time));
    }
}

#[test]
fn moving_parts_are_where_their_path_is() {
    let path = Path::new(vec![(0.0, DVec3::ZERO), (2.0, DVec3::new(2.0, -4.0, 1.0))], Interpolation::Linear);
    let moving = Moving { part: mixture(1.0), path: path.unwrap() };
    for point in points(50, 1.0, 82) {
        let displaced = point + DVec3::new(1.0, -2.0, 0.5);
        // The displacement is exact, the sum is rounded.
        let back = displaced - DVec3::new(1.0, -2.0, 0.5);
        let (here, there) =
            (mixture(1.0).potential_and_curl(back, 1.0), moving.potential_and_curl(displaced, 1.0));
        assert_eq!((here, here.curl), (there, moving.velocity(displaced, 1.0)));
    }
}
