//! Volume in flows without divergence, and the orders of its drift and of the motion.

use super::{ball, once, rising, run, setting, step, stirred};
use glam::DVec3;
use welter_fluids::smoke::SmokeParameters;
use welter_meshing::surface::measure::{area, signed_volume};

/// `WELTER_SMOKE_STEPS` steps of 0.01 instead of a few: 500 are told of in `docs/accuracy.md`.
#[test]
fn smoke_keeps_its_volume_within_half_a_percent() {
    let steps = setting("WELTER_SMOKE_STEPS", 40);
    let mut smoke = run(vec![once(ball(DVec3::ZERO, 0.4, 0.05))], SmokeParameters::default());
    let flow = stirred(1.0, 1.0);
    let [volume, start] = [signed_volume, area].map(|of| of(&smoke.mesh()));
    let (mut worst, mut most, mut operations) = (0.0_f64, 0, 0);
    for k in 1..=steps {
        let report = step(&mut smoke, &flow, 0.01 * f64::from(k));
        operations += report.improvement.splits + report.improvement.flips + report.improvement.collapses;
        worst = worst.max((signed_volume(&smoke.mesh()) / volume - 1.0).abs());
        most = most.max(report.triangles);
    }
    println!("{steps} steps: volume within {worst:.2e}, up to {most} triangles, {operations} operations");
    println!("area times {:.1}", area(&smoke.mesh()) / start);
    assert!(worst < 0.005, "{worst}");
    assert!(operations > 200, "a surface that is not remeshed says little: {operations}");
}

/// The volume between flat triangles and the surface that they stand for goes with the square of the edges.
#[test]
fn the_drift_of_volume_is_of_order_two_in_the_edges() {
    let flow = rising(1.0);
    for remeshing in [None, SmokeParameters::default().remeshing] {
        let drift = |edge: f64| {
            let parameters = SmokeParameters { remeshing, ..SmokeParameters::default() };
            let mut smoke = run(vec![once(ball(DVec3::ZERO, 0.4, edge))], parameters);
            let volume = signed_volume(&smoke.mesh());
            for k in 1..=10 {
                let _ = step(&mut smoke, &flow, 0.04 * f64::from(k));
            }
            (signed_volume(&smoke.mesh()) / volume - 1.0).abs()
        };
        let drifts = [0.12, 0.06, 0.03].map(drift);
        let orders = [(drifts[0] / drifts[1]).log2(), (drifts[1] / drifts[2]).log2()];
        println!("remeshing {}: drifts {drifts:?}, orders {orders:.2?}", remeshing.is_some());
        assert!(orders[1] > 1.5, "{drifts:?}, {orders:?}");
    }
}

#[test]
fn vertices_follow_the_flow_with_order_four() {
    let flow = rising(1.0);
    let ends = |steps: u32| {
        let parameters = SmokeParameters { remeshing: None, ..SmokeParameters::default() };
        let mut smoke = run(vec![once(ball(DVec3::ZERO, 0.4, 0.2))], parameters);
        for k in 1..=steps {
            let _ = step(&mut smoke, &flow, 0.5 * f64::from(k) / f64::from(steps));
        }
        smoke.mesh().positions().to_vec()
    };
    let exact = ends(256);
    let error = |steps| ends(steps).iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    let errors: [f64; 3] = [8, 16, 32].map(error);
    let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    println!("errors {errors:?}, orders {orders:.2?}");
    assert!(orders[1] > 3.7 && errors[2] < 1e-5, "{errors:?}, {orders:?}");
}
