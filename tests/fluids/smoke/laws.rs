//! The same bits: resumed, by any number of threads, scaled.

use super::{ball, bits, every, once, rising, run, sheet, step};
use glam::DVec3;
use welter_fluids::smoke::{Emission, OverBudget, SmokeParameters, SmokeSimulation};
use welter_meshing::Monitor;
use welter_tracking::improvement::TopologyParameters;
use welter_tracking::integration::IntegrationParameters;

/// Of every kind of run one, each with a small budget that is met.
fn kinds() -> [(Vec<Emission>, SmokeParameters); 3] {
    let emissions =
        |factor: f64| vec![every(ball(DVec3::ZERO, 0.35 * factor, 0.15 * factor), 0.0, 0.15), once(sheet(5))];
    let low = |factor| emissions(factor)[..1].to_vec();
    let free = SmokeParameters { most_triangles: 900, ..SmokeParameters::default() };
    let colliding = SmokeParameters { collisions: Some(IntegrationParameters::default()), ..free };
    let merging = SmokeParameters {
        topology: Some(TopologyParameters::default()),
        over_budget: OverBudget::StopSplitting,
        ..colliding
    };
    [(emissions(1.0), free), (low(1.0), colliding), (low(1.0), merging)]
}

const STEPS: u32 = 12;

fn end(k: u32) -> f64 {
    0.04 * f64::from(k)
}

#[test]
fn a_resumed_run_goes_on_with_the_same_bits() {
    let flow = rising(1.0);
    for (emissions, parameters) in kinds() {
        let mut whole = run(emissions.clone(), parameters);
        let mut resumed = whole.clone();
        let mut met = false;
        for k in 1..=STEPS {
            let state = resumed.state();
            resumed =
                SmokeSimulation::resume(emissions.clone(), parameters, state, &Monitor::none()).unwrap();
            let (mut a, mut b) = (step(&mut whole, &flow, end(k)), step(&mut resumed, &flow, end(k)));
            (a.seconds, b.seconds) = Default::default();
            assert_eq!(a, b, "step {k}");
            assert!(bits(&whole) == bits(&resumed), "step {k}");
            met |= a.improvement.refused.budget > 0
                || a.releases.iter().any(|release| release.refusal.is_some());
        }
        assert!(met, "no budget was met");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let flow = rising(1.0);
    for (emissions, parameters) in kinds() {
        let by = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut smoke = run(emissions.clone(), parameters);
                for k in 1..=STEPS {
                    let _ = step(&mut smoke, &flow, end(k));
                }
                bits(&smoke)
            })
        };
        assert!(by(1) == by(4));
    }
}

/// All lengths times a power of two: all positions times it, and the same ages.
#[test]
fn scaled_runs_are_the_same_scaled() {
    let scaled = |factor: f64| {
        let shape = ball(factor * DVec3::new(0.1, 0.0, 0.0), 0.35 * factor, 0.12 * factor);
        let parameters = SmokeParameters { most_triangles: 1500, ..SmokeParameters::default() };
        let mut smoke = run(vec![every(shape, 0.0, 0.15)], parameters);
        for k in 1..=STEPS {
            let _ = step(&mut smoke, &rising(factor), end(k));
        }
        let mesh = smoke.mesh();
        let positions: Vec<DVec3> = mesh.positions().iter().map(|&p| p / factor).collect();
        (positions, mesh.triangles().to_vec(), smoke.ages().to_vec())
    };
    let one = scaled(1.0);
    for factor in [2.0_f64.powi(-60), 2.0_f64.powi(40)] {
        assert!(scaled(factor) == one, "{factor}");
    }
}
