//! Merged releases that overlap the smoke that is there.

use super::{ball, bits, every, once, rising, run, setting, sheet, step};
use glam::DVec3;
use welter_fluids::smoke::{
    Emission, EmittedShape, Joining, Refusal, Released, Schedule, SmokeError, SmokeParameters,
    SmokeSimulation,
};
use welter_kit::exact::intersects_itself;
use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::Topology;
use welter_meshing::surface::measure::signed_volume;
use welter_tracking::improvement::TopologyParameters;
use welter_tracking::integration::IntegrationParameters;
use welter_tracking::surface::UnionOutcome;

fn merging() -> SmokeParameters {
    SmokeParameters {
        collisions: Some(IntegrationParameters::default()),
        topology: Some(TopologyParameters::default()),
        ..SmokeParameters::default()
    }
}

fn merged(emission: Emission) -> Emission {
    Emission { joining: Joining::Merged, ..emission }
}

/// One that releases a ball at each step, which overlaps the ones before as long as the flow is slower than that.
fn source(factor: f64, interval: f64) -> Emission {
    merged(every(ball(DVec3::new(0.05, 0.0, 0.02) * factor, 0.3 * factor, 0.15 * factor), 0.0, interval))
}

fn outcome(release: &Released) -> Option<UnionOutcome> {
    release.union.map(|union| union.outcome)
}

/// A chimney: the smoke is one body all the time, embedded, and as large as the unions have made it.
#[test]
fn a_source_that_overlaps_its_own_smoke_makes_one_body() {
    let steps = setting("WELTER_UNION_STEPS", 100);
    let flow = rising(1.0);
    let dt = 0.02;
    let mut smoke = run(vec![source(1.0, dt)], merging());
    let mut added: f64 =
        smoke.at_start().iter().filter_map(|r| r.union).map(|union| union.added_volume).sum();
    let first = added;
    let (mut joined, mut shifted, mut within, mut refused, mut most) = (0, 0, 0, 0, 0);
    for k in 1..=steps {
        let report = step(&mut smoke, &flow, dt * f64::from(k));
        for release in &report.releases {
            match (outcome(release), release.refusal) {
                (Some(UnionOutcome::Joined), None) => joined += 1,
                (Some(UnionOutcome::Within), None) => within += 1,
                (None, Some(refusal)) => {
                    println!("step {k}: {refusal:?}");
                    refused += 1;
                }
                other => panic!("step {k}: {other:?}"),
            }
            shifted += release.union.map_or(0, |union| u32::from(union.shifts > 0));
            added += release.union.map_or(0.0, |union| union.added_volume);
        }
        most = most.max(report.triangles);
        let mesh = smoke.mesh();
        assert!(self_intersections(&mesh, &Monitor::none()).unwrap().is_empty(), "step {k}");
        if k % 50 == 0 {
            let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.to_array()).collect();
            let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
            assert!(!intersects_itself(&positions, &triangles), "step {k}");
        }
        let oldest = smoke.ages().iter().copied().fold(0.0, f64::max);
        assert!(smoke.ages().iter().all(|&age| age >= 0.0) && oldest <= smoke.time() * (1.0 + 1e-12));
    }
    let mesh = smoke.mesh();
    let volume = signed_volume(&mesh);
    println!(
        "{steps} steps: {joined} joined, {within} within, {refused} refused, {shifted} shifted; volume {first} to {volume}, {added} added; \
         {} components, {most} triangles at most",
        Topology::of(&mesh).components().len()
    );
    assert_eq!((refused, joined + within), (0, steps));
    assert!(joined > steps / 2);
    assert!(volume > 2.0 * first, "{volume} after {first}");
    assert!((volume / added - 1.0).abs() < 0.05, "{volume} of {added}");
}

/// In smoke that rests: a release within adds nothing, one around takes it in, the same again stays the same but for a shift.
#[test]
fn releases_in_resting_smoke() {
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let at = |start: f64, shape: EmittedShape| {
        merged(Emission { schedule: Schedule { start, interval: 1.0, count: Some(1) }, ..once(shape) })
    };
    let parameters = SmokeParameters { remeshing: None, ..merging() };
    let parameters = SmokeParameters { topology: Some(TopologyParameters::default()), ..parameters };
    let middle = || ball(DVec3::ZERO, 0.5, 0.2);
    let emissions = vec![
        at(0.0, middle()),
        at(0.1, ball(DVec3::X * 0.1, 0.2, 0.1)),
        at(0.2, middle()),
        at(0.3, ball(DVec3::X * 0.1, 0.8, 0.3)),
        at(0.4, ball(DVec3::X * 5.0, 0.5, 0.2)),
    ];
    let mut smoke = run(emissions, parameters);
    let mut told: Vec<Released> = smoke.at_start().to_vec();
    let before = bits(&smoke);
    let report = step(&mut smoke, &still, 0.15);
    assert!(bits(&smoke).1 == before.1, "nothing has come");
    told.extend(&report.releases);
    told.extend(&step(&mut smoke, &still, 0.25).releases);
    assert!((signed_volume(&smoke.mesh()) / signed_volume(middle().mesh()) - 1.0).abs() < 1e-2);
    told.extend(&step(&mut smoke, &still, 0.35).releases);
    assert_eq!(smoke.mesh().triangles().len(), told[3].triangles, "the last one has taken in all");
    told.extend(&step(&mut smoke, &still, 0.45).releases);
    let outcomes: Vec<_> = told.iter().map(outcome).collect();
    let [beside, within, joined] =
        [UnionOutcome::Beside, UnionOutcome::Within, UnionOutcome::Joined].map(Some);
    assert_eq!(outcomes, [beside, within, joined, joined, beside]);
    let shifts: Vec<u32> = told.iter().filter_map(|r| r.union).map(|union| union.shifts).collect();
    assert_eq!(shifts, [0, 0, 1, 0, 0]);
    assert!(told.iter().all(|release| release.refusal.is_none()));
}

/// What cannot be united is refused with its reason, and the run goes on.
#[test]
fn refusals_have_reasons() {
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let sheets = once(sheet(3));
    let through = merged(every(ball(DVec3::new(0.1, 0.05, 0.0), 0.3, 0.15), 0.1, 1.0));
    let mut smoke = run(vec![sheets, through.clone()], SmokeParameters { remeshing: None, ..merging() });
    let before = bits(&smoke);
    let report = step(&mut smoke, &still, 0.2);
    assert_eq!(report.releases[0].refusal, Some(Refusal::Sheet));
    assert!(bits(&smoke).1 == before.1);

    // As many triangles as one has, and not as the union has.
    let count = through.shape.mesh().triangles().len();
    let parameters = SmokeParameters { most_triangles: count + 20, remeshing: None, ..merging() };
    let other = merged(once(ball(DVec3::new(0.3, 0.0, 0.0), 0.3, 0.15)));
    let mut smoke = run(vec![other, through], parameters);
    let report = step(&mut smoke, &still, 0.2);
    let present = smoke.surface().connectivity().triangle_count();
    assert_eq!(report.releases[0].refusal, Some(Refusal::Budget { present }));
}

/// Stopped in the midst of a union, the first thing of a step in which there is no smoke yet.
#[test]
fn a_union_that_is_stopped_leaves_everything_as_it_was() {
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let late = merged(every(ball(DVec3::ZERO, 0.3, 0.15), 0.1, 1.0));
    let parameters = SmokeParameters { reference_length: Some(0.15), ..merging() };
    let mut smoke = run(vec![late], parameters);
    let stop = std::sync::atomic::AtomicBool::new(true);
    let stopped = smoke.step_to(&still, 0.2, &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(SmokeError::Cancelled(_))), "{stopped:?}");
    assert!(smoke.mesh().triangles().is_empty() && smoke.time() == 0.0);
    assert_eq!(step(&mut smoke, &still, 0.2).releases.len(), 1);
}

/// Ages: of the curves those of the smoke that was there, of the rest of the release zero.
#[test]
fn ages_of_unions_are_between_those_of_both() {
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let first = merged(once(ball(DVec3::ZERO, 0.5, 0.2)));
    let second = merged(every(ball(DVec3::new(0.4, 0.11, 0.07), 0.5, 0.2), 0.3, 9.0));
    let mut smoke = run(vec![first, second], SmokeParameters { remeshing: None, ..merging() });
    let report = step(&mut smoke, &still, 0.3);
    let union = report.releases[0].union.unwrap();
    assert_eq!((union.outcome, union.shifts), (UnionOutcome::Joined, 0));
    let count = |age: f64| smoke.ages().iter().filter(|&&a| (a - age).abs() < 1e-15).count();
    let (old, new) = (count(0.3), count(0.0));
    assert_eq!(old + new, smoke.ages().len());
    assert_eq!(new, union.new_vertices - union.segments, "all that is of the release alone");
}

#[test]
fn resumed_and_by_any_number_of_threads_it_is_the_same() {
    let flow = rising(1.0);
    let emissions = || vec![source(1.0, 0.05)];
    let mut whole = run(emissions(), merging());
    let mut resumed = whole.clone();
    for k in 1..=12 {
        resumed = SmokeSimulation::resume(emissions(), merging(), resumed.state(), &Monitor::none()).unwrap();
        let end = 0.04 * f64::from(k);
        let (mut a, mut b) = (step(&mut whole, &flow, end), step(&mut resumed, &flow, end));
        (a.seconds, b.seconds) = Default::default();
        assert_eq!(a, b, "step {k}");
        assert!(bits(&whole) == bits(&resumed), "step {k}");
    }
    let by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut smoke = run(emissions(), merging());
            let joined = (1..=12)
                .flat_map(|k| step(&mut smoke, &flow, 0.04 * f64::from(k)).releases)
                .filter(|release| outcome(release) == Some(UnionOutcome::Joined));
            assert!(joined.count() > 5);
            bits(&smoke)
        })
    };
    assert!(by(1) == by(4) && by(1) == bits(&whole));
}

#[test]
fn scaled_runs_are_the_same_scaled() {
    let scaled = |factor: f64| {
        let mut smoke = run(vec![source(factor, 0.05)], merging());
        for k in 1..=8 {
            let _ = step(&mut smoke, &rising(factor), 0.05 * f64::from(k));
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
