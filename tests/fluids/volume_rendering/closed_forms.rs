//! Pictures known by a formula.

use super::{ball, drawn, parameters, scene};
use glam::DVec3;
use welter_fluids::volume_rendering::{Camera, Light, Scene};
use welter_meshing::shapes::{Box_, box_};

/// The alpha of a ball is that of its chord. The surface lies within `edge^2 / 6` of the sphere, at the
/// middle of its triangles, so the chord is that of a sphere whose radius is less by up to that.
#[test]
fn the_alpha_of_a_ball_is_that_of_its_chords() {
    let (edge, extinction) = (0.02, 1.5);
    let ball = ball(DVec3::new(0.3, -0.2, 0.1), 1.0, edge);
    let scene = scene(&ball, extinction);
    let size = [80_u32, 60_u32];
    let (picture, report) = drawn(&scene, &parameters(size[0], size[1], 16));
    assert_eq!((report.most_crossings, report.pixels_from_inside), (2, 0));
    let tracer = welter_kit::volume_rendering::tracer::Tracer::new(&scene);
    let (mut count, mut worst) = (0, 0.0_f64);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let ray = tracer.ray(size, [x, y]);
            let to_middle = DVec3::new(0.3, -0.2, 0.1) - scene.camera.eye;
            let square = (to_middle - to_middle.dot(ray) * ray).length_squared();
            let alpha_of =
                |radius: f64| 1.0 - (-extinction * 2.0 * (radius * radius - square).max(0.0).sqrt()).exp();
            let alpha = f64::from(*picture.alpha.at(x as usize, y as usize));
            let (least, most) = (alpha_of(1.0 - edge * edge / 6.0), alpha_of(1.0));
            assert!(least - 1e-6 <= alpha && alpha <= most + 1e-6, "{x} {y}: {least} {alpha} {most}");
            if most > 0.1 {
                worst = worst.max(most - alpha);
                count += 1;
            }
        }
    }
    println!("alpha of a ball of edges {edge}: {worst:.2e} below that of the sphere at most, {count} pixels");
    assert!(count > 500);
}

/// A slab lit from the front: light and sight go the same way `s` through the smoke, so scatter is the
/// integral of `e^-t e^-t`.
#[test]
fn a_slab_lit_along_the_sight() {
    let extinction = 0.8;
    let slab =
        box_(&Box_ { min: DVec3::new(-2.0, -2.0, -1.0), max: DVec3::new(2.0, 2.0, 0.5), edge_length: 1.0 })
            .unwrap();
    let eye = DVec3::new(0.0, 0.0, 400.0);
    let scene = Scene {
        camera: Camera { vertical_field_of_view: 0.008, ..Camera::toward(eye, DVec3::ZERO) },
        light: Light { direction: DVec3::NEG_Z, ..Light::default() },
        ..scene(&slab, extinction)
    };
    let (picture, _) = drawn(&scene, &parameters(64, 64, 64));
    let depth = extinction * 1.5;
    let (alpha, scatter) = (1.0 - f64::exp(-depth), 0.5 * (1.0 - f64::exp(-2.0 * depth)));
    let at = |plane: &welter_fluids::volume_rendering::Image<f32>| f64::from(*plane.at(31, 33));
    let (alpha_error, scatter_error) = (at(&picture.alpha) - alpha, at(&picture.scatter) - scatter);
    println!("slab: alpha off by {alpha_error:.1e}, scatter by {scatter_error:.1e}");
    assert!(alpha_error.abs() < 1e-5 && scatter_error.abs() < 1e-3 * scatter);
    // Lit from the side, light that enters where the ray does is not shadowed there, and far inside it is
    // dark.
    let side = Light { direction: DVec3::X, ..Light::default() };
    let (picture, _) = drawn(&Scene { light: side, ..scene }, &parameters(64, 64, 64));
    for x in [5_usize, 20, 40] {
        let place = (x as f64 + 0.5 - 32.0) / 32.0 * 400.0 * f64::tan(0.004);
        let lit = (-extinction * (place + 2.0)).exp() * alpha;
        assert!((f64::from(*picture.scatter.at(x, 32)) - lit).abs() < 4e-3 * alpha, "{x} {lit}");
    }
}

/// Light that nothing shadows: thin smoke scatters as much as it hides.
#[test]
fn thin_smoke_scatters_what_it_hides() {
    let ball = ball(DVec3::ZERO, 1.0, 0.2);
    let (picture, _) = drawn(&scene(&ball, 1e-6), &parameters(40, 30, 16));
    for (alpha, scatter) in picture.alpha.pixels().iter().zip(picture.scatter.pixels()) {
        assert!(scatter <= alpha && (alpha - scatter).abs() <= 1e-5 * alpha, "{alpha} {scatter}");
    }
}

/// The age of a ray is the mean of the ages where it enters and leaves.
#[test]
fn ages_are_linear_along_a_ray() {
    let slab =
        box_(&Box_ { min: DVec3::new(-2.0, -2.0, -1.0), max: DVec3::new(2.0, 2.0, 0.5), edge_length: 0.5 })
            .unwrap();
    let ages: Vec<f64> = slab.positions().iter().map(|p| 10.0 + 2.0 * p.x - p.z).collect();
    let eye = DVec3::new(0.0, 0.0, 6.0);
    let scene = Scene { ages: &ages, camera: Camera::toward(eye, DVec3::ZERO), ..scene(&slab, 1.0) };
    let (picture, _) = drawn(&scene, &parameters(32, 24, 8));
    let half = f64::tan(20.0_f64.to_radians());
    for (x, y) in [(16_usize, 12_usize), (12, 10), (20, 14)] {
        // The middle of the way through is at z = -1/4, where x is in proportion to the distance from the
        // eye.
        let across = (x as f64 + 0.5 - 16.0) / 12.0 * half;
        let expected = 10.0 + 2.0 * across * 6.25 + 0.25;
        let age = f64::from(*picture.age.at(x, y));
        assert!((age - expected).abs() < 2e-3, "{x} {y}: {age} {expected}");
    }
}
