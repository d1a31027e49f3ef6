//! What is released, how it is carried, and the same bits.

use super::{advanced, ball, bits, emissions, every, rising, run};
use glam::DVec3;
use welter_fluids::marker_particles::{MarkerParameters, MarkerSimulation};
use welter_fluids::procedural::{Interpolation, Path};
use welter_fluids::smoke::{SmokeParameters, SmokeSimulation};
use welter_meshing::Monitor;
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::measure::signed_volume;

#[test]
fn particles_carry_the_volume_of_what_was_released() {
    let (emissions, particles) = (emissions(1.0), 5000);
    let parameters = MarkerParameters::within(&emissions, particles, 0.5).unwrap();
    let mut smoke = run(emissions.clone(), parameters);
    let mut released = vec![0.0; emissions.len()];
    let mut counted = vec![0; emissions.len()];
    let mut releases = smoke.at_start().to_vec();
    for k in 1..=10 {
        let step = smoke.step_to(&rising(1.0), 0.05 * f64::from(k), &Monitor::none()).unwrap();
        releases.extend(&step.releases);
        assert_eq!(step.particles, releases.iter().map(|r| r.particles).sum::<usize>());
    }
    // At 0, 0.15, 0.3, 0.45, and at 0.1, 0.3 and 0.5.
    assert_eq!(releases.len(), 7);
    for release in &releases {
        released[release.emission] += signed_volume(emissions[release.emission].shape.mesh());
        counted[release.emission] += release.particles;
        let there = counted[release.emission] as f64 * smoke.particle_volume();
        let missing = (there - released[release.emission]).abs() / smoke.particle_volume();
        assert!(missing < 0.5 + 1e-9, "{missing} particles");
    }
    assert!(smoke.state().positions.len().abs_diff(particles) <= 1);
}

/// Particles of one release stay where the surface is that was released with them: both follow the same flow.
#[test]
fn particles_stay_inside_the_surface_that_is_carried_with_them() {
    let emissions = vec![every(ball(DVec3::ZERO, 0.35, 0.03), 0.0, 9.0)];
    let parameters = MarkerParameters::within(&emissions, 2000, 0.0).unwrap();
    let mut particles = run(emissions.clone(), parameters);
    let unchanged = SmokeParameters { remeshing: None, ..SmokeParameters::default() };
    let mut surface = SmokeSimulation::new(emissions, unchanged, &Monitor::none()).unwrap();
    for k in 1..=12 {
        let end = 0.05 * f64::from(k);
        let _ = particles.step_to(&rising(1.0), end, &Monitor::none()).unwrap();
        let _ = surface.step_to(&rising(1.0), end, &Monitor::none()).unwrap();
    }
    let mesh = welter_meshing::surface::ClosedOrientedMesh::new(surface.mesh()).unwrap();
    let numbers = WindingNumbers::new(&mesh);
    let outside = particles.state().positions.iter().filter(|p| numbers.at(**p) != Winding::Number(1));
    let share = outside.count() as f64 / 2000.0;
    println!("outside of the carried surface: {share}");
    // Those within the distance of a flat triangle from its carried arc.
    assert!(share < 0.01, "{share}");
}

#[test]
fn a_particle_follows_the_flow_with_order_four() {
    let ends = [4, 8, 16, 64].map(|steps| {
        let emissions = vec![every(ball(DVec3::ZERO, 0.35, 0.15), 0.0, 9.0)];
        let parameters = MarkerParameters::within(&emissions, 50, 0.0).unwrap();
        let mut smoke = run(emissions, parameters);
        for k in 1..=steps {
            let _ = smoke.step_to(&rising(1.0), f64::from(k) / f64::from(steps), &Monitor::none()).unwrap();
        }
        smoke.state().positions.clone()
    });
    let error = |k: usize| ends[k].iter().zip(&ends[3]).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    let order = (error(1) / error(2)).log2();
    println!("errors {:.1e} {:.1e} {:.1e}, order {order:.2}", error(0), error(1), error(2));
    assert!(order > 3.5 && error(2) < 1e-3, "{order}");
}

#[test]
fn a_resumed_run_goes_on_with_the_same_bits() {
    let emissions = emissions(1.0);
    let parameters = MarkerParameters::within(&emissions, 1000, 0.5).unwrap();
    let mut whole = run(emissions.clone(), parameters);
    let mut resumed = whole.clone();
    for k in 1..=10 {
        let state = resumed.state().clone();
        resumed = MarkerSimulation::resume(emissions.clone(), parameters, state).unwrap();
        let end = 0.05 * f64::from(k);
        let a = whole.step_to(&rising(1.0), end, &Monitor::none()).unwrap();
        let b = resumed.step_to(&rising(1.0), end, &Monitor::none()).unwrap();
        assert_eq!(a, b);
        assert!(bits(&whole) == bits(&resumed), "step {k}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bits(&advanced(1.0, 3000, 10)))
    };
    assert!(by(1) == by(4));
}

#[test]
fn scaled_runs_are_the_same_scaled() {
    let whole = advanced(1.0, 1000, 10);
    for factor in [1.0 / 1024.0, 8.0] {
        let scaled = advanced(factor, 1000, 10);
        assert_eq!(scaled.particle_volume(), whole.particle_volume() * factor * factor * factor);
        assert_eq!(scaled.state().ages, whole.state().ages);
        let back: Vec<DVec3> = scaled.state().positions.iter().map(|&p| p / factor).collect();
        assert!(back == whole.state().positions, "{factor}");
    }
}

#[test]
fn a_moving_emitter_releases_where_it_is() {
    let path = Path::new(vec![(0.0, DVec3::ZERO), (1.0, 4.0 * DVec3::X)], Interpolation::Linear).unwrap();
    let mut emission = every(ball(DVec3::ZERO, 0.25, 0.1), 0.0, 0.5);
    emission.path = Some(path);
    let parameters = MarkerParameters::within(std::slice::from_ref(&emission), 300, 1.0).unwrap();
    let mut smoke = run(vec![emission], parameters);
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let _ = smoke.step_to(&still, 1.0, &Monitor::none()).unwrap();
    for (k, third) in smoke.state().positions.chunks(100).enumerate() {
        let center = 2.0 * k as f64 * DVec3::X;
        assert!(third.iter().all(|p| p.distance(center) < 0.25), "release {k}");
    }
    assert_eq!(smoke.state().ages[..100], [1.0; 100]);
    assert_eq!(smoke.state().ages[200..], [0.0; 100]);
}
