//! Random surfaces, flows, time steps and options, however violent: after each step independent code finds the surface
//! sound and embedded. `WELTER_TRACKER_STEPS` and `WELTER_TRACKER_SEED` make longer and other runs.

use super::{check, setting};
use glam::{DMat3, DVec3};
use welter_kit::mesher::Random;
use welter_kit::moving::{misplaced_components, scenes};
use welter_meshing::Monitor;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright};
use welter_tracking::flows::{Advection, FaceOffsetting, Flow, Jitter, MeanCurvature, Scheme};
use welter_tracking::improvement::{
    CurvatureAdaption, ImprovementParameters, SplitScheme, TopologyParameters,
};
use welter_tracking::integration::IntegrationParameters;
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{SurfaceTracker, TrackerError, TrackerParameters};

fn options(random: &mut Random) -> TrackerParameters {
    let mut coin = |chances: u64| random.below(chances) == 0;
    let [no_smoothing, no_split, no_flip, no_collapse, fine, topology, keeps_volume] =
        [coin(3), coin(6), coin(6), coin(6), coin(4), !coin(2), coin(2)];
    let split_scheme = [
        SplitScheme::Midpoint,
        SplitScheme::Butterfly,
        SplitScheme::ModifiedButterfly,
        SplitScheme::Quadric,
        SplitScheme::Fitted,
    ][random.below(5) as usize];
    let improvement = ImprovementParameters {
        max_edge_rel: random.between(1.1, 2.5),
        max_volume_change_rel: random.between(-4.0, 1.0).exp2(),
        max_split_volume_change_rel: random.between(-4.0, 1.0).exp2(),
        large_angle: random.between(90.0, 180.0),
        small_angle: random.between(0.0, 30.0),
        max_normal_turn: random.between(20.0, 120.0),
        split_scheme,
        keeps_volume,
        smoothing: !no_smoothing,
        split: !no_split,
        flip: !no_flip,
        collapse: !no_collapse,
        curvature: fine.then(CurvatureAdaption::default),
        // Most runs are small, so that there are many.
        most_triangles: [4000, 1000, 1000, 1000].get(random.below(16) as usize).copied().unwrap_or(300),
        ..ImprovementParameters::default()
    };
    let topology = TopologyParameters { enabled: topology, merge_distance_rel: random.between(0.0, 0.4) };
    let integration = IntegrationParameters {
        proximity_rel: if random.below(4) == 0 { 0.0 } else { random.between(-12.0, -3.0).exp2() },
        friction: [0.0, 0.3][random.below(2) as usize],
        sweeps: random.below(4) as u32,
        ..IntegrationParameters::default()
    };
    TrackerParameters { improvement, topology, integration, ..TrackerParameters::default() }
}

/// A flow, and a time step for it, given the size of the surface and its edges.
fn motion(random: &mut Random, size: f64, edge: f64) -> (Box<dyn Flow>, f64) {
    let violence = random.between(-6.0, 3.0).exp2();
    let vector = |random: &mut Random| random.point() - random.point();
    match random.below(7) {
        0 => {
            let amplitude_rel = violence.min(4.0);
            (Box::new(Jitter { amplitude_rel, seed: random.bits() }), 1.0)
        }
        1 => {
            let wavelength = size * random.between(-2.0, 1.0).exp2();
            let parameters = CurlNoiseParameters {
                seed: random.bits(),
                wavelength,
                speed: size,
                ..CurlNoiseParameters::default()
            };
            let field = CurlNoise::new(&parameters).unwrap();
            (Box::new(Advection { field, scheme: Scheme::Rk4 }), violence)
        }
        2 => {
            let columns = [(); 3].map(|()| vector(random));
            let (matrix, about) =
                (DMat3::from_cols(columns[0], columns[1], columns[2]), size * vector(random));
            let field = move |p: DVec3, _: f64| matrix * (p - about);
            (Box::new(Advection { field, scheme: Scheme::Euler }), violence)
        }
        3 => {
            let speed = size * random.between(-1.0, 1.0);
            (Box::new(FaceOffsetting::new(speed)), violence.min(1.0))
        }
        4 => (Box::new(MeanCurvature::default()), edge * edge * violence),
        5 => (
            Box::new(Advection { field: Enright { size, ..Enright::default() }, scheme: Scheme::Rk4 }),
            violence,
        ),
        // Everything towards a point, or through it.
        _ => {
            let center = size * vector(random);
            let field = move |p: DVec3, _: f64| center - p;
            (Box::new(Advection { field, scheme: Scheme::Euler }), 2.0 * violence)
        }
    }
}

#[test]
fn whatever_moves_stays_embedded() {
    let steps: usize = setting("WELTER_TRACKER_STEPS", 40);
    let mut random = Random::new(setting("WELTER_TRACKER_SEED", 1));
    let (mut done, mut refused, mut runs) = (0, 0, 0);
    let [mut changes, mut shortened, mut slowest] = [0.0_f64; 3];
    while done < steps {
        let all = scenes(&mut random);
        let scene = &all[random.below(all.len() as u64) as usize];
        let parameters = options(&mut random);
        let surface = MovingSurface::new(&scene.mesh).unwrap();
        let mut tracker = SurfaceTracker::new(surface, parameters).unwrap();
        runs += 1;
        for _ in 0..12 {
            let surface = tracker.surface();
            let positions = surface.positions();
            let [low, high] = positions
                .iter()
                .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)]);
            if positions.is_empty() {
                break;
            }
            let before = surface.connectivity().euler_characteristic();
            // Around open sheets, what closes later may be nested anyhow.
            let closed = surface.connectivity().edges().all(|e| !surface.connectivity().is_boundary(e));
            let nested = closed && misplaced_components(&surface.to_mesh()) == 0;
            let (flow, dt) = motion(&mut random, (high - low).max_element(), tracker.reference_length());
            let clock = std::time::Instant::now();
            let step = tracker.step(&*flow, dt, &Monitor::none());
            let seconds = clock.elapsed().as_secs_f64();
            slowest = slowest.max(seconds);
            done += 1;
            match step {
                Ok(report) => {
                    let improvement = report.improvement;
                    changes += (improvement.splits + improvement.flips + improvement.collapses) as f64;
                    shortened += f64::from(u8::from(report.dt < dt));
                }
                Err(TrackerError::Flow(_)) => refused += 1,
                Err(error) => panic!("run {runs}, {}: {error}", scene.name),
            }
            check(&tracker);
            if nested {
                let after = misplaced_components(&tracker.surface().to_mesh());
                assert_eq!(after, 0, "run {runs}, {}: solid within solid", scene.name);
            }
            if !parameters.topology.enabled {
                let after = tracker.surface().connectivity().euler_characteristic();
                assert_eq!(before, after, "run {runs}, {}", scene.name);
            }
        }
    }
    println!(
        "{done} steps of {runs} runs, {changes} changes, {shortened} shortened, {refused} refused by the flow, slowest {slowest:.2} s"
    );
    assert!(changes > steps as f64);
    assert!(refused < done / 4);
}
