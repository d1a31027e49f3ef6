//! What is no run of particles, and no picture of them.

use super::{ball, every, run};
use glam::DVec3;
use welter_fluids::marker_particles::{MarkerError, MarkerParameters, MarkerSimulation, MarkerState};
use welter_fluids::smoke::{Emission, EmittedShape};
use welter_fluids::volume_rendering::{
    Camera, Light, Medium, ParticleScene, RenderError, RenderParameters, render_particles,
};
use welter_meshing::Monitor;
use welter_meshing::surface::{TriMesh, TriangleSoup};

fn emission() -> Emission {
    every(ball(DVec3::ZERO, 1.0, 0.5), 0.0, 1.0)
}

fn refused(emission: Emission, parameters: MarkerParameters) -> MarkerError {
    MarkerSimulation::new(vec![emission], parameters, &Monitor::none()).unwrap_err()
}

#[test]
fn parameters_out_of_range() {
    let good = MarkerParameters::of_volume(0.01);
    for volume in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(emission(), MarkerParameters { particle_volume: volume, ..good });
        assert!(matches!(error, MarkerError::Parameter { name: "particle_volume", .. }), "{error}");
    }
    let error = refused(emission(), MarkerParameters { start: f64::NAN, ..good });
    assert!(matches!(error, MarkerError::Parameter { name: "start", .. }));
    let error = refused(emission(), MarkerParameters { start: 0.5, ..good });
    assert!(matches!(error, MarkerError::BeginsBefore { emission: 0, .. }));
    let error = refused(emission(), MarkerParameters { most_particles: 100, ..good });
    assert!(matches!(error, MarkerError::TooMany { emission: 0, most: 100, .. }), "{error}");
    let error = refused(emission(), MarkerParameters { particle_volume: 1e-300, ..good });
    assert!(matches!(error, MarkerError::Volume { emission: 0, .. }), "{error}");
    let soup = TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        ..TriangleSoup::default()
    };
    let sheet = Emission { shape: EmittedShape::Open(TriMesh::new(soup).unwrap()), ..emission() };
    assert!(matches!(refused(sheet, good), MarkerError::Open { emission: 0 }));
    assert!(MarkerParameters::within(&[], 10, 1.0).is_err());
    assert!(MarkerParameters::within(&[emission()], 0, 1.0).is_err());
    assert!(MarkerParameters::within(&[emission()], 10, f64::NAN).is_err());
}

#[test]
fn a_step_that_fails_changes_nothing() {
    let mut smoke = run(vec![emission()], MarkerParameters::of_volume(0.01));
    let before = smoke.state().clone();
    let nowhere = |p: DVec3, _: f64| if p.x > 0.5 { DVec3::NAN } else { DVec3::Y };
    let first = before.positions.iter().position(|p| p.x > 0.5);
    match smoke.step_to(&nowhere, 2.5, &Monitor::none()) {
        Err(MarkerError::Velocity { particle, .. }) => assert_eq!(Some(particle), first),
        other => panic!("{other:?}"),
    }
    let far = |_: DVec3, _: f64| DVec3::splat(f64::MAX);
    let end = smoke.step_to(&far, 4.0, &Monitor::none());
    assert!(
        matches!(end, Err(MarkerError::End { particle: 0, .. } | MarkerError::Velocity { .. })),
        "{end:?}"
    );
    for end in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let step = smoke.step_to(&|_: DVec3, _: f64| DVec3::ZERO, end, &Monitor::none());
        assert!(matches!(step, Err(MarkerError::Step { .. })));
    }
    assert_eq!(smoke.state(), &before);
}

#[test]
fn states_that_are_none() {
    let resume = |state| MarkerSimulation::resume(vec![emission()], MarkerParameters::of_volume(0.01), state);
    let state = MarkerState { positions: vec![DVec3::ZERO], ages: vec![0.0], time: 1.0 };
    assert!(resume(state.clone()).is_ok());
    let error = resume(MarkerState { ages: vec![], ..state.clone() }).unwrap_err();
    assert!(matches!(error, MarkerError::StateAges { ages: 0, particles: 1 }));
    let error = resume(MarkerState { ages: vec![f64::NAN], ..state.clone() }).unwrap_err();
    assert!(matches!(error, MarkerError::StateParticle { particle: 0 }));
    let error = resume(MarkerState { time: f64::NAN, ..state }).unwrap_err();
    assert!(matches!(error, MarkerError::Parameter { .. }));
}

#[test]
fn scenes_that_are_none() {
    let positions = [DVec3::ZERO, DVec3::X];
    let good = ParticleScene {
        positions: &positions,
        ages: &[],
        particle_volume: 1.0,
        radius_rel: 2.0,
        camera: Camera::toward(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO),
        light: Light::default(),
        medium: Medium::white(1.0),
        background: [0.0; 3],
    };
    let parameters =
        RenderParameters { width: 8, height: 8, shadow_resolution: 4, ..RenderParameters::default() };
    let drawn = |scene: &ParticleScene<'_>| render_particles(scene, &parameters, &Monitor::none());
    assert!(drawn(&good).is_ok());
    let error = drawn(&ParticleScene { ages: &[1.0], ..good }).unwrap_err();
    assert_eq!(error, RenderError::ParticleAges { particles: 2, ages: 1 });
    let error = drawn(&ParticleScene { ages: &[1.0, -1.0], ..good }).unwrap_err();
    assert_eq!(error, RenderError::ParticleAge { particle: 1, age: -1.0 });
    let lost = [DVec3::ZERO, DVec3::NAN];
    assert!(matches!(
        drawn(&ParticleScene { positions: &lost, ..good }),
        Err(RenderError::Particle { particle: 1, .. })
    ));
    for volume in [0.0, f64::NAN, f64::INFINITY] {
        assert!(drawn(&ParticleScene { particle_volume: volume, ..good }).is_err());
    }
    for radius in [0.1, 65.0, f64::NAN] {
        assert!(drawn(&ParticleScene { radius_rel: radius, ..good }).is_err());
    }
    // The extremes of what is in range, and nothing at all.
    for volume in [f64::MIN_POSITIVE, f64::MAX] {
        let (picture, _) = drawn(&ParticleScene { particle_volume: volume, ..good }).unwrap();
        assert!(picture.alpha.pixels().iter().all(|a| (0.0..=1.0).contains(a)));
    }
    let far = [DVec3::splat(f64::MAX), DVec3::splat(-f64::MAX)];
    assert!(drawn(&ParticleScene { positions: &far, ..good }).is_ok());
    let (picture, report) = drawn(&ParticleScene { positions: &[], ..good }).unwrap();
    assert_eq!((report.in_view, report.covered_pixels), (0, 0));
    assert!(picture.alpha.pixels().iter().all(|&a| a == 0.0));
}
