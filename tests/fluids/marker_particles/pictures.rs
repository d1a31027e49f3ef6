//! Pictures of particles.

use super::{advanced, ball};
use glam::DVec3;
use welter_fluids::marker_particles::fill;
use welter_fluids::volume_rendering::{
    AgeBlur, Camera, Image, Light, Medium, ParticleReport, ParticleScene, Picture, RenderParameters, Scene,
    render, render_particles,
};
use welter_kit::marker_particles::marched;
use welter_meshing::Monitor;
use welter_meshing::surface::measure::signed_volume;

/// White smoke alone, lit and seen from directions that no shape has as an axis.
fn scene<'a>(positions: &'a [DVec3], ages: &'a [f64], particle_volume: f64) -> ParticleScene<'a> {
    ParticleScene {
        positions,
        ages,
        particle_volume,
        radius_rel: 2.0,
        camera: Camera::toward(DVec3::new(1.3, 1.1, 4.2), DVec3::new(0.03, 0.02, 0.01)),
        light: Light { direction: DVec3::new(0.9, -1.2, -0.7), ..Light::default() },
        medium: Medium::white(2.0),
        background: [0.2, 0.3, 0.5],
    }
}

fn parameters(width: u32, height: u32, shadow_resolution: u32) -> RenderParameters {
    RenderParameters { width, height, shadow_resolution, ..RenderParameters::default() }
}

fn drawn(scene: &ParticleScene<'_>, parameters: &RenderParameters) -> (Picture, ParticleReport) {
    render_particles(scene, parameters, &Monitor::none()).unwrap()
}

/// A few particles of all places and ages, some of which overlap.
fn few() -> (Vec<DVec3>, Vec<f64>) {
    let positions = fill(&ball(DVec3::ZERO, 1.0, 0.3), 40, 11, &Monitor::none()).unwrap();
    let ages = positions.iter().map(|p| 3.0 + p.x + 0.5 * p.y).collect();
    (positions, ages)
}

#[test]
fn alpha_age_and_scatter_are_those_of_marched_rays() {
    let (positions, ages) = few();
    let scene = scene(&positions, &ages, 0.1);
    let size = [41, 31];
    let (picture, report) = drawn(&scene, &parameters(size[0], size[1], 96));
    let (mut alpha, mut age, mut covered) = (0.0_f64, 0.0_f64, 0);
    let (mut scatter, mut lit) = (0.0_f64, 0);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let light = (x + 3 * y).is_multiple_of(23);
            let twin = marched::seen(&scene, size, [x, y], if light { 120 } else { 400 }, light);
            let (x, y) = (x as usize, y as usize);
            let at = f64::from(*picture.alpha.at(x, y));
            alpha = alpha.max((at - twin.alpha).abs());
            if twin.alpha > 1e-3 {
                age = age.max((f64::from(*picture.age.at(x, y)) - twin.age).abs());
                covered += 1;
            }
            if light && twin.alpha > 0.0 {
                scatter = scatter.max((f64::from(*picture.scatter.at(x, y)) - twin.scatter).abs());
                lit += 1;
            }
        }
    }
    println!("alpha {alpha:.1e} age {age:.1e} over {covered}, scatter {scatter:.1e} over {lit}");
    assert!(covered > 300 && lit > 15 && report.most_met > 5, "{covered} {lit} {report:?}");
    // Alpha and age to the march's own error, of 400 steps; scatter to that of the slices, which hold an optical depth of 1/4.
    assert!(alpha < 5e-6, "alpha {alpha}");
    assert!(age < 1e-5, "age {age}");
    assert!(scatter < 4e-3, "scatter {scatter}");
}

/// Through the middle of one particle the optical depth is 7 / (2 pi h^2) of its volume, seen from outside, and half of it from its
/// middle.
#[test]
fn one_particle_has_the_column_of_its_kernel() {
    let volume: f64 = 0.3;
    let h = 2.0 * volume.cbrt();
    let column = 7.0 / (2.0 * std::f64::consts::PI * h * h) * volume;
    for (distance, part) in [(9.0, 1.0), (0.0, 0.5)] {
        let eye = DVec3::new(0.0, 0.0, distance);
        let camera = Camera::toward(eye, eye - DVec3::Z);
        let one = ParticleScene { camera, ..scene(&[DVec3::ZERO], &[2.5], volume) };
        let (picture, report) = drawn(&one, &parameters(33, 33, 16));
        let expected = 1.0 - (-2.0 * column * part).exp();
        let alpha = f64::from(*picture.alpha.at(16, 16));
        assert!((alpha - expected).abs() < 1e-6, "{distance}: {alpha} {expected}");
        assert_eq!(*picture.age.at(16, 16), 2.5);
        // Rays that pass the middle by less than the radius.
        let meets = |pixel: u32| {
            let ray = marched::direction(&one, [33, 33], [pixel % 33, pixel / 33]);
            eye.cross(ray).length() < h
        };
        assert_eq!(report.covered_pixels as usize, (0..33 * 33).filter(|&pixel| meets(pixel)).count());
    }
    // Behind the eye there is nothing.
    let camera = Camera::toward(DVec3::new(0.0, 0.0, 9.0), DVec3::new(0.0, 0.0, 20.0));
    let (_, report) =
        drawn(&ParticleScene { camera, ..scene(&[DVec3::ZERO], &[], volume) }, &parameters(9, 9, 4));
    assert_eq!((report.in_view, report.covered_pixels), (0, 0));
}

/// More particles come nearer to the picture of the surface that they fill, in every plane.
#[test]
fn filled_surfaces_look_like_surfaces() {
    let smoke = ball(DVec3::ZERO, 1.0, 0.08);
    let parameters = parameters(64, 64, 128);
    let errors = [2_000, 54_000].map(|count| {
        let positions = fill(&smoke, count, 1, &Monitor::none()).unwrap();
        let cloud = scene(&positions, &[], signed_volume(&smoke) / count as f64);
        let surface = Scene {
            smoke: &smoke,
            ages: &[],
            solids: &[],
            camera: cloud.camera,
            light: cloud.light,
            medium: cloud.medium,
            background: cloud.background,
        };
        let (reference, _) = render(&surface, &parameters, &Monitor::none()).unwrap();
        let (picture, _) = drawn(&cloud, &parameters);
        let error = |a: &[f32], b: &[f32]| {
            let squares: f32 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            (squares / a.len() as f32).sqrt()
        };
        let middle = |a: &Image<f32>, b: &Image<f32>| {
            let square = (26..38).flat_map(|y| (26..38).map(move |x| (x, y)));
            let squares: f32 = square.map(|(x, y)| (a.at(x, y) - b.at(x, y)).powi(2)).sum();
            (squares / (12.0 * 12.0)).sqrt()
        };
        [
            error(picture.alpha.pixels(), reference.alpha.pixels()),
            error(picture.scatter.pixels(), reference.scatter.pixels()),
            middle(&picture.alpha, &reference.alpha),
            middle(&picture.scatter, &reference.scatter),
        ]
    });
    println!("alpha and scatter, root mean square, then that in the middle: {errors:?}");
    // Spacing falls by a factor of 3. Most of the difference is at the border, which is as wide as a radius.
    for plane in 0..2 {
        assert!(errors[1][plane] < 0.5 * errors[0][plane], "{errors:?}");
        assert!(errors[1][2 + plane] < 0.01, "{errors:?}");
    }
}

#[test]
fn scatter_is_between_nothing_and_alpha() {
    let smoke = advanced(1.0, 3000, 8);
    let state = smoke.state();
    let cloud = scene(&state.positions, &state.ages, smoke.particle_volume());
    let (picture, report) = drawn(&cloud, &parameters(60, 50, 40));
    assert!(report.covered_pixels > 200 && report.shadow_size.contains(&40));
    let pairs = picture.alpha.pixels().iter().zip(picture.scatter.pixels());
    assert!(pairs.into_iter().all(|(a, s)| (0.0..=1.0).contains(a) && (0.0..=a + 1e-6).contains(s)));
    let oldest = state.ages.iter().copied().fold(0.0, f64::max) as f32;
    assert!(picture.age.pixels().iter().all(|age| (0.0..=oldest * 1.000_001).contains(age)));
}

#[test]
fn any_number_of_threads_gives_the_same_picture() {
    let smoke = advanced(1.0, 3000, 8);
    let state = smoke.state();
    let cloud = scene(&state.positions, &state.ages, smoke.particle_volume());
    let by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(&cloud, &parameters(70, 50, 40)).0)
    };
    assert!(by(1) == by(4));
}

#[test]
fn lengths_times_a_power_of_two_give_the_same_picture() {
    let (positions, ages) = few();
    let parameters = RenderParameters { age_blur: Some(AgeBlur::new(0.01)), ..parameters(60, 44, 24) };
    let at = |factor: f64| {
        let positions: Vec<DVec3> = positions.iter().map(|&p| p * factor).collect();
        let mut cloud = scene(&positions, &ages, 0.1 * factor.powi(3));
        cloud.medium.extinction /= factor;
        cloud.camera.eye *= factor;
        cloud.camera.target *= factor;
        drawn(&cloud, &parameters).0
    };
    let picture = at(1.0);
    assert!(picture.alpha.pixels().iter().any(|&a| a > 0.2));
    for exponent in [-60, -3, 1, 40] {
        assert!(at(2.0_f64.powi(exponent)) == picture, "2^{exponent}");
    }
}
