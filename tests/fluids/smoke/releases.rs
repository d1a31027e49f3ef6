//! What is released, merged and refused, and faults of emissions.

use super::{ball, every, once, rising, run, sheet, step};
use glam::DVec3;
use welter_fluids::smoke::{
    Emission, Joining, Refusal, Schedule, SmokeError, SmokeParameters, SmokeSimulation,
};
use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::Topology;
use welter_tracking::improvement::TopologyParameters;
use welter_tracking::integration::IntegrationParameters;

fn colliding() -> SmokeParameters {
    SmokeParameters { collisions: Some(IntegrationParameters::default()), ..SmokeParameters::default() }
}

fn merging() -> SmokeParameters {
    SmokeParameters { topology: Some(TopologyParameters::default()), ..colliding() }
}

fn components(smoke: &SmokeSimulation) -> usize {
    Topology::of(&smoke.mesh()).components().len()
}

/// The smoke moves by half a diameter from release to release: every second one would cross what is there.
#[test]
fn with_collisions_a_release_in_smoke_is_refused_without_it_is_added() {
    let up = |_: DVec3, _: f64| 0.8 * DVec3::Y;
    let emissions = || vec![every(ball(DVec3::ZERO, 0.4, 0.2), 0.0, 0.6)];
    let mut apart = run(emissions(), colliding());
    let mut through = run(emissions(), SmokeParameters::default());
    let mut refused = Vec::new();
    for k in 1..=4 {
        let end = 0.6 * f64::from(k);
        let report = step(&mut apart, &up, end);
        refused.extend(report.releases.iter().map(|r| r.refusal.is_some()));
        if let Some(Refusal::Intersection { pairs }) = report.releases[0].refusal {
            assert!(pairs > 10, "{pairs}");
        }
        assert!(self_intersections(&apart.mesh(), &Monitor::none()).unwrap().is_empty());
        let report = step(&mut through, &up, end);
        assert_eq!(report.releases[0].refusal, None);
    }
    assert_eq!(refused, [true, false, true, false]);
    assert_eq!((components(&apart), components(&through)), (3, 5));
    assert!(!self_intersections(&through.mesh(), &Monitor::none()).unwrap().is_empty());
}

/// Two balls that come together: one where they may merge, two where they may not.
#[test]
fn merged_releases_join_on_contact() {
    let together = |p: DVec3, _: f64| DVec3::new(-0.2 * p.x.signum(), 0.0, 0.0);
    let balls = |joining| {
        [-0.5, 0.5].map(|x| Emission { joining, ..once(ball(DVec3::new(x, 0.0, 0.0), 0.4, 0.15)) }).to_vec()
    };
    let mut ends = Vec::new();
    for (joining, parameters) in [(Joining::Merged, merging()), (Joining::Separate, colliding())] {
        let mut smoke = run(balls(joining), parameters);
        assert_eq!(components(&smoke), 2);
        let mut merges = 0;
        for k in 1..=16 {
            merges += step(&mut smoke, &together, 0.05 * f64::from(k)).improvement.merges;
            assert!(self_intersections(&smoke.mesh(), &Monitor::none()).unwrap().is_empty());
        }
        ends.push((components(&smoke), merges > 0));
    }
    assert_eq!(ends, [(1, true), (2, false)]);
}

/// Balls, sheets and a moving emitter at once; what is due at the end of a step is there then, and once.
#[test]
fn every_release_comes_once_at_its_time() {
    use welter_fluids::procedural::{Interpolation, Path};
    let path = Path::new(vec![(0.0, DVec3::ZERO), (1.0, 4.0 * DVec3::X)], Interpolation::Linear).unwrap();
    let shifted = Emission { path: Some(path), ..every(ball(DVec3::ZERO, 0.2, 0.15), 0.0, 0.25) };
    let sheets =
        Emission { schedule: Schedule { start: 0.1, interval: 0.2, count: Some(3) }, ..once(sheet(3)) };
    for times in [vec![1.0], vec![0.25, 0.5, 0.75, 1.0], (1..=64).map(|k| f64::from(k) / 64.0).collect()] {
        let parameters = SmokeParameters { remeshing: None, ..SmokeParameters::default() };
        let mut smoke = run(vec![shifted.clone(), sheets.clone()], parameters);
        let mut releases: Vec<_> = smoke.at_start().to_vec();
        let still = |_: DVec3, _: f64| DVec3::ZERO;
        for &end in &times {
            releases.extend(step(&mut smoke, &still, end).releases);
            assert!(releases.last().is_some_and(|r| r.release.time <= end));
        }
        let told: Vec<_> = releases.iter().map(|r| (r.emission, r.release.index)).collect();
        assert_eq!(told, [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2), (0, 3), (0, 4)]);
        assert_eq!(components(&smoke), 8);
        assert!(releases.windows(2).all(|pair| pair[0].release.time <= pair[1].release.time));
    }
}

#[test]
fn what_is_no_run_is_refused() {
    let new = |emissions, parameters| SmokeSimulation::new(emissions, parameters, &Monitor::none());
    let shape = || ball(DVec3::ZERO, 0.4, 0.2);
    let default = SmokeParameters::default;
    let late = SmokeParameters { start: 1.0, ..default() };
    let refused = [
        new(vec![], default()).unwrap_err(),
        new(vec![once(shape())], late).unwrap_err(),
        new(vec![Emission { joining: Joining::Merged, ..once(shape()) }], colliding()).unwrap_err(),
        new(vec![], SmokeParameters { collisions: None, ..merging() }).unwrap_err(),
        new(vec![every(shape(), 0.0, 0.0)], default()).unwrap_err(),
        new(vec![once(shape())], SmokeParameters { most_triangles: 0, ..default() }).unwrap_err(),
        new(vec![once(shape())], SmokeParameters { reference_length: Some(-1.0), ..default() }).unwrap_err(),
    ];
    assert!(
        matches!(
            refused,
            [
                SmokeError::NoEmission,
                SmokeError::BeginsBefore { emission: 0, .. },
                SmokeError::MergedWithoutTopology { emission: 0 },
                SmokeError::TopologyWithoutCollisions,
                SmokeError::Emission { emission: 0, .. },
                SmokeError::Parameter(_),
                SmokeError::Parameter(_),
            ]
        ),
        "{refused:?}"
    );
    // Two balls in one shape that cross.
    let mut soup = shape().mesh().to_soup();
    let count = soup.positions.len() as u32;
    soup.positions.extend(shape().mesh().positions().iter().map(|&p| p + 0.3 * DVec3::X));
    soup.triangles.extend(soup.triangles.clone().iter().map(|t| t.map(|v| v + count)));
    let crossing = welter_meshing::surface::ClosedOrientedMesh::new(
        welter_meshing::surface::TriMesh::new(soup).unwrap(),
    );
    let crossing = once(welter_fluids::smoke::EmittedShape::Closed(crossing.unwrap()));
    assert!(new(vec![crossing.clone()], default()).is_ok());
    let refused = new(vec![crossing], colliding());
    assert!(matches!(refused, Err(SmokeError::ShapeIntersectsItself { emission: 0, .. })), "{refused:?}");
}

/// A flow that ends amid a step, after a release: nothing of it has happened.
#[test]
fn a_step_that_fails_leaves_everything_as_it_was() {
    for parameters in [SmokeParameters::default(), colliding()] {
        let mut smoke = run(vec![every(ball(DVec3::ZERO, 0.2, 0.1), 0.0, 0.3)], parameters);
        let whole = rising(1.0);
        let _ = step(&mut smoke, &whole, 0.2);
        let before = (super::bits(&smoke), smoke.time());
        let ends = |p: DVec3, time: f64| if time < 0.4 { DVec3::X + 0.0 * p } else { DVec3::NAN };
        let failed = smoke.step_to(&ends, 0.7, &Monitor::none());
        assert!(matches!(failed, Err(SmokeError::Tracker { time: 0.3, .. })), "{failed:?}");
        assert!(before == (super::bits(&smoke), smoke.time()));
        for end in [0.2, 0.1, f64::NAN, f64::INFINITY] {
            let failed = smoke.step_to(&whole, end, &Monitor::none());
            assert!(matches!(failed, Err(SmokeError::Step { .. })), "{failed:?}");
        }
        let stop = std::sync::atomic::AtomicBool::new(true);
        let stopped = smoke.step_to(&whole, 0.4, &Monitor::new(None, Some(&stop)));
        assert!(matches!(stopped, Err(SmokeError::Cancelled(_))), "{stopped:?}");
        assert!(before == (super::bits(&smoke), smoke.time()));
    }
}
