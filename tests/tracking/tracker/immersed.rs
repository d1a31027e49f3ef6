//! The tracker without collisions, against the one with them where nothing meets; and surfaces that are added.

use super::{check, mapped};
use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::flows::fields::Enright;
use welter_tracking::flows::{Advection, Flow, FlowError, Prediction};
use welter_tracking::improvement::{ImprovementParameters, TopologyParameters};
use welter_tracking::integration::{IntegrationError, IntegrationParameters};
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{ImmersedTracker, SurfaceTracker, TrackerError, TrackerParameters};

const EDGE: f64 = 0.03;

fn ball() -> TriMesh {
    let center = DVec3::splat(0.35);
    sphere(&Sphere { center, radius: 0.15, edge_length: EDGE }).unwrap().into_mesh()
}

fn immersed(mesh: &TriMesh, improvement: ImprovementParameters) -> ImmersedTracker {
    ImmersedTracker::new(MovingSurface::new(mesh).unwrap(), improvement, EDGE, 0.0).unwrap()
}

/// Splits that begin at once.
fn fine() -> ImprovementParameters {
    ImprovementParameters { max_edge_rel: 1.15, ..ImprovementParameters::default() }
}

fn embedded(mesh: &TriMesh, improvement: ImprovementParameters) -> SurfaceTracker {
    let parameters = TrackerParameters {
        reference_length: Some(EDGE),
        improvement,
        topology: TopologyParameters { enabled: false, ..TopologyParameters::default() },
        integration: IntegrationParameters { proximity_rel: 0.0, ..IntegrationParameters::default() },
    };
    SurfaceTracker::new(MovingSurface::new(mesh).unwrap(), parameters).unwrap()
}

#[test]
fn where_nothing_meets_both_trackers_give_the_same_bits() {
    let flow = Advection::new(Enright::default());
    let mut free = immersed(&ball(), fine());
    let mut safe = embedded(&ball(), fine());
    let mut operations = 0;
    for _ in 0..25 {
        let (a, b) = (
            free.step(&flow, 0.02, &Monitor::none()).unwrap(),
            safe.step(&flow, 0.02, &Monitor::none()).unwrap(),
        );
        assert_eq!(
            b.improvement.refused.intersection, 0,
            "the comparison needs a surface that meets nothing"
        );
        assert_eq!((a.dt, a.improvement, &a.log), (b.dt, b.improvement, &b.log));
        assert_eq!(free.surface().to_mesh(), safe.surface().to_mesh());
        operations += a.improvement.splits + a.improvement.flips + a.improvement.collapses;
        assert_eq!(free.surface().check(), Ok(()));
    }
    assert_eq!(free.time(), safe.time());
    assert!(operations > 100, "{operations}");
}

/// Folded through itself and drawn out: sound as a list of triangles, with the topology that it had.
#[test]
fn what_passes_through_itself_keeps_its_topology() {
    let folding = Advection::new(|p: DVec3, _: f64| {
        let q = p - DVec3::splat(0.35);
        DVec3::new(-2.0 * q.x.signum() * 0.15 + 3.0 * q.y, -3.0 * q.x + q.z, 2.0 * q.z.signum() * 0.1)
    });
    let mut tracker = immersed(&ball(), ImprovementParameters::default());
    let mut crossed = false;
    for _ in 0..40 {
        let report = tracker.step(&folding, 0.03, &Monitor::none()).unwrap();
        assert_eq!((report.improvement.refused.intersection, report.dt), (0, 0.03));
        assert_eq!(tracker.surface().check(), Ok(()));
        assert_eq!(tracker.surface().connectivity().euler_characteristic(), 2);
        let mesh = tracker.surface().to_mesh();
        crossed |= !welter_meshing::spatial::self_intersections(&mesh, &Monitor::none()).unwrap().is_empty();
    }
    assert!(crossed, "nothing was tried");
}

#[test]
fn a_step_that_fails_changes_nothing() {
    /// Forgets a vertex.
    struct Forgetful;
    impl Flow for Forgetful {
        fn advance(&self, surface: &MovingSurface, _: f64, dt: f64) -> Result<Prediction, FlowError> {
            Ok(Prediction { ends: surface.positions()[1..].to_vec(), dt })
        }
    }
    let mut tracker = immersed(&ball(), ImprovementParameters { max_edge_rel: 1.05, ..Default::default() });
    let nowhere = Advection::new(|_: DVec3, _: f64| DVec3::NAN);
    let before = tracker.surface().to_mesh();
    assert!(matches!(tracker.step(&nowhere, 0.1, &Monitor::none()), Err(TrackerError::Flow(_))));
    assert!(matches!(tracker.step(&Forgetful, 0.1, &Monitor::none()), Err(TrackerError::BroadPhase(_))));
    let stop = std::sync::atomic::AtomicBool::new(true);
    let up = Advection::new(|_: DVec3, _: f64| DVec3::Z);
    let stopped = tracker.step(&up, 0.1, &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(TrackerError::Cancelled(_))));
    assert_eq!((tracker.surface().to_mesh(), tracker.time()), (before, 0.0));
    assert!(tracker.set_reference_length(0.0).is_err() && tracker.set_reference_length(f64::NAN).is_err());
    assert_eq!(tracker.reference_length(), EDGE);
}

/// A second ball beside the first moves with it; one across it is refused and nothing is changed.
#[test]
fn surfaces_are_added_to_a_tracker_unless_they_meet_it() {
    let flow = Advection::new(Enright::default());
    let mut tracker = embedded(&ball(), ImprovementParameters::default());
    let _ = tracker.step(&flow, 0.02, &Monitor::none()).unwrap();
    let before = tracker.surface().to_mesh();
    let refused = tracker.insert(&mapped(&ball(), |p| p + DVec3::splat(0.1)), &Monitor::none());
    let Err(TrackerError::Integration(IntegrationError::Intersection { pairs, .. })) = refused else {
        panic!("{refused:?}");
    };
    let present = before.triangles().len();
    assert!(pairs.iter().all(|[s, t]| s.index() < present && t.index() >= present));
    assert_eq!(tracker.surface().to_mesh(), before);
    let added = tracker.insert(&mapped(&ball(), |p| p + 0.4 * DVec3::X), &Monitor::none()).unwrap();
    assert_eq!(added.start as usize, before.positions().len());
    for _ in 0..10 {
        let report = tracker.step(&flow, 0.02, &Monitor::none()).unwrap();
        assert_eq!(report.dt, 0.02);
        check(&tracker);
    }
    assert_eq!(tracker.surface().connectivity().euler_characteristic(), 4);
    // A tracker of nothing has no length of its own.
    let nothing = TriMesh::new(TriangleSoup::default()).unwrap();
    let mut empty =
        SurfaceTracker::new(MovingSurface::new(&nothing).unwrap(), TrackerParameters::default()).unwrap();
    assert!(matches!(empty.insert(&ball(), &Monitor::none()), Err(TrackerError::Parameter(_))));
    empty.set_reference_length(EDGE).unwrap();
    assert_eq!(empty.insert(&ball(), &Monitor::none()).unwrap().start, 0);
    assert!(empty.step(&flow, 0.02, &Monitor::none()).is_ok());
}

/// At most as many triangles as are allowed, to the last one.
#[test]
fn splits_keep_to_the_most_triangles() {
    let stretch = Advection::new(|p: DVec3, _: f64| DVec3::new(3.0 * p.x, 0.0, 0.0));
    let start = ball().triangles().len();
    for most_triangles in start..start + 4 {
        let improvement = ImprovementParameters { most_triangles, ..ImprovementParameters::default() };
        let mut tracker = immersed(&ball(), improvement);
        let mut refused = 0;
        for _ in 0..10 {
            refused += tracker.step(&stretch, 0.05, &Monitor::none()).unwrap().improvement.refused.budget;
            let triangles = tracker.surface().connectivity().triangle_count();
            assert!(triangles <= most_triangles, "{triangles}, {most_triangles}");
        }
        assert!(refused > 0);
    }
}
