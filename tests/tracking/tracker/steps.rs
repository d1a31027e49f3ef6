//! Steps as wholes: what fails leaves the surface as it was, what goes on goes on with the same bits, what is scaled or
//! moved stays safe.

use super::{check, mapped, together, tracker};
use glam::DVec3;
use std::sync::atomic::AtomicBool;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Box_, Sphere, box_, sphere};
use welter_meshing::surface::TriMesh;
use welter_tracking::flows::fields::Enright;
use welter_tracking::flows::{Advection, Jitter, Scheme};
use welter_tracking::integration::IntegrationError;
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{SurfaceTracker, TrackerError, TrackerParameters};

fn ball(edge_length: f64) -> TriMesh {
    let center = DVec3::splat(0.35);
    sphere(&Sphere { center, radius: 0.15, edge_length }).unwrap().into_mesh()
}

fn enright(size: f64) -> Advection<Enright> {
    Advection { field: Enright { size, ..Enright::default() }, scheme: Scheme::Rk4 }
}

#[test]
fn a_step_that_fails_leaves_the_surface_as_it_was() {
    let mut tracker = tracker(&ball(0.03), TrackerParameters::default());
    let _ = tracker.step(&enright(1.0), 0.05, &Monitor::none()).unwrap();
    let (before, time) = (tracker.surface().to_mesh(), tracker.time());
    let bad = Advection {
        field: |p: DVec3, _: f64| DVec3::new(1.0 / (p.x - p.x), 0.0, 0.0),
        scheme: Scheme::Euler,
    };
    assert!(matches!(tracker.step(&bad, 0.05, &Monitor::none()), Err(TrackerError::Flow(_))));
    let stop = AtomicBool::new(true);
    let stopped = tracker.step(&enright(1.0), 0.05, &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(TrackerError::Cancelled(_))), "{stopped:?}");
    assert!(matches!(tracker.step(&enright(1.0), -1.0, &Monitor::none()), Err(TrackerError::Flow(_))));
    let too_few = vec![DVec3::ZERO; 3];
    assert!(tracker.move_to(too_few, &Monitor::none()).is_err());
    assert_eq!((tracker.surface().to_mesh(), tracker.time()), (before, time));
    let _ = tracker.step(&enright(1.0), 0.05, &Monitor::none()).unwrap();
    check(&tracker);
}

#[test]
fn surfaces_that_intersect_themselves_are_refused_with_the_pairs() {
    let cube = box_(&Box_ { edge_length: 0.5, ..Box_::default() }).unwrap();
    for (shift, what) in [(1.5, "crossing"), (2.0, "touching")] {
        let both = together(&cube, &mapped(&cube, |p| p + DVec3::new(shift, 0.01, 0.02)));
        let made = SurfaceTracker::new(MovingSurface::new(&both).unwrap(), TrackerParameters::default());
        let Err(TrackerError::Integration(
            IntegrationError::NotEmbedded { pairs, .. } | IntegrationError::Intersection { pairs, .. },
        )) = made
        else {
            panic!("{what}: {made:?}");
        };
        assert!(!pairs.is_empty(), "{what}");
    }
}

/// A tracker made of another one's surface goes on with the same bits.
#[test]
fn a_run_goes_on_with_the_same_bits() {
    let flow = enright(1.0);
    let mut whole = tracker(&ball(0.03), TrackerParameters::default());
    for _ in 0..12 {
        let _ = whole.step(&flow, 0.04, &Monitor::none()).unwrap();
    }
    let again = SurfaceTracker::resume(
        whole.surface().clone(),
        *whole.parameters(),
        whole.reference_length(),
        whole.time(),
        whole.steps(),
    );
    let mut again = again.unwrap();
    for _ in 0..12 {
        let reports =
            [&mut whole, &mut again].map(|tracker| tracker.step(&flow, 0.04, &Monitor::none()).unwrap());
        assert_eq!(reports[0].log, reports[1].log);
    }
    assert_eq!(whole.surface().to_mesh(), again.surface().to_mesh());
    assert_eq!(whole.time(), again.time());
}

#[test]
fn powers_of_two_and_threads_change_no_bit() {
    let result = |scale: f64, threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut tracker = tracker(&mapped(&ball(0.03), |p| scale * p), TrackerParameters::default());
            for _ in 0..10 {
                let _ = tracker.step(&enright(scale), 0.05, &Monitor::none()).unwrap();
            }
            for seed in 0..4 {
                let jitter = Jitter { amplitude_rel: 0.5, seed };
                let _ = tracker.step(&jitter, 1.0, &Monitor::none()).unwrap();
            }
            tracker.surface().to_mesh()
        })
    };
    let one = result(1.0, 1);
    assert_eq!(one, result(1.0, 3));
    for exponent in [-490, -200, -1, 5, 200, 490] {
        let scale = 2f64.powi(exponent);
        let other = result(scale, 2);
        assert_eq!(one.triangles(), other.triangles(), "{exponent}");
        let scaled: Vec<DVec3> = one.positions().iter().map(|&p| scale * p).collect();
        assert_eq!(scaled, other.positions(), "{exponent}");
    }
}

/// A million times its size from the origin, coordinates have ten digits less, and everything is as safe.
#[test]
fn far_from_the_origin_it_is_as_safe() {
    let far = DVec3::new(1e6, -1e6, 1e6);
    let mut tracker = tracker(&mapped(&ball(0.03), |p| p + far), TrackerParameters::default());
    let flow = Advection {
        field: move |p: DVec3, t: f64| {
            welter_tracking::flows::VelocityField::velocity(&Enright::default(), p - far, t)
        },
        scheme: Scheme::Rk4,
    };
    for step in 0..30 {
        let report = tracker.step(&flow, 0.05, &Monitor::none()).unwrap();
        check(&tracker);
        assert!(report.dt == 0.05 || step > 15, "{step}: {report:?}");
    }
}

/// Noise of half an edge length a step.
#[test]
fn noise_does_not_tangle_a_sphere() {
    let mut tracker = tracker(&ball(0.03), TrackerParameters::default());
    for seed in 0..20 {
        let jitter = Jitter { amplitude_rel: 0.5, seed };
        let _ = tracker.step(&jitter, 1.0, &Monitor::none()).unwrap();
        check(&tracker);
    }
    assert!(tracker.surface().connectivity().triangle_count() > 100);
}
