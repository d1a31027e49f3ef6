//! What a change of the scene does to the picture, and what it must not do.

use super::{ball, difference, drawn, moved, parameters, scene, together};
use glam::DVec3;
use rayon::ThreadPoolBuilder;
use welter_fluids::volume_rendering::{
    AgeBlur, Camera, Image, InteriorRule, Light, RenderParameters, Scene, Solid,
};
use welter_meshing::shapes::{Torus, torus, trefoil_overlap};
use welter_meshing::surface::ClosedOrientedMesh;

fn ages(mesh: &ClosedOrientedMesh) -> Vec<f64> {
    mesh.positions().iter().map(|p| 3.0 + p.x).collect()
}

/// Closed surfaces in general and in special position: no ray is left inside.
#[test]
fn every_ray_enters_as_often_as_it_leaves() {
    let lattice = |p: DVec3| (p * 4.0).round() / 4.0;
    let shapes = [
        ball(DVec3::ZERO, 1.0, 0.05),
        moved(&ball(DVec3::ZERO, 1.0, 0.1), lattice),
        torus(&Torus { edge_length: 0.1, ..Torus::default() }).unwrap(),
        trefoil_overlap(&Default::default()).unwrap(),
        together((0..8).map(|k| ball(DVec3::new(0.3 * f64::from(k) - 1.0, 0.0, 0.0), 0.5, 0.2)).collect()),
    ];
    let eyes = [DVec3::new(0.0, 0.0, 8.0), DVec3::new(5.0, 5.0, 5.0), DVec3::new(7.0, 0.3, -0.2)];
    for (index, shape) in shapes.iter().enumerate() {
        for eye in eyes {
            let scene = Scene { camera: Camera::toward(eye, DVec3::ZERO), ..scene(shape, 1.0) };
            // An odd and an even number of pixels: axes of the shapes through the middle of pixels and
            // between them.
            for size in [64, 65] {
                let (picture, report) = drawn(&scene, &parameters(size, size, 8));
                assert_eq!(report.pixels_from_inside, 0, "shape {index} from {eye}");
                assert!(report.covered_pixels > 100 && report.crossings.is_multiple_of(2));
                assert!(picture.alpha.pixels().iter().all(|a| (0.0..=1.0).contains(a)));
                let pairs = picture.alpha.pixels().iter().zip(picture.scatter.pixels());
                assert!(pairs.into_iter().all(|(a, s)| (0.0..=a + 1e-6).contains(s)));
            }
        }
    }
}

/// The scene with all lengths times a power of two.
#[test]
fn lengths_times_a_power_of_two_give_the_same_bits() {
    let smoke = together(vec![ball(DVec3::ZERO, 1.0, 0.2), ball(DVec3::new(0.6, 0.3, 0.1), 0.7, 0.2)]);
    let solid = ball(DVec3::new(-0.9, 1.1, 0.8), 0.3, 0.2);
    let ages = ages(&smoke);
    let parameters = RenderParameters { age_blur: Some(AgeBlur::new(0.01)), ..parameters(60, 44, 24) };
    let at = |factor: f64| {
        let (smoke, solid) = (moved(&smoke, |p| p * factor), moved(&solid, |p| p * factor));
        let solids = [Solid { mesh: &solid, albedo: [0.5; 3] }];
        let mut scene = Scene { ages: &ages, solids: &solids, ..scene(&smoke, 2.0 / factor) };
        scene.camera.eye *= factor;
        scene.camera.target *= factor;
        drawn(&scene, &parameters).0
    };
    let picture = at(1.0);
    for power in [-900, -60, 1, 40, 900] {
        assert!(at(2.0_f64.powi(power)) == picture, "2^{power}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let smoke = together(vec![ball(DVec3::ZERO, 1.0, 0.1), ball(DVec3::new(0.6, 0.3, 0.1), 0.7, 0.1)]);
    let solid = ball(DVec3::new(-0.9, 1.1, 0.8), 0.3, 0.2);
    let solids = [Solid { mesh: &solid, albedo: [0.5; 3] }];
    let ages = ages(&smoke);
    let scene = Scene { ages: &ages, solids: &solids, ..scene(&smoke, 2.0) };
    let parameters = RenderParameters { age_blur: Some(AgeBlur::new(0.01)), ..parameters(160, 120, 48) };
    let with = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(&scene, &parameters).0)
    };
    let one = with(1);
    assert!([2, 3, 7].into_iter().all(|threads| with(threads) == one));
}

/// A quarter turn of an image, counterclockwise.
fn turned(image: &Image<f32>) -> Image<f32> {
    let mut result = Image::filled(image.height(), image.width(), 0.0);
    for y in 0..image.height() {
        for x in 0..image.width() {
            *result.at_mut(y, image.width() - 1 - x) = *image.at(x, y);
        }
    }
    result
}

/// A camera turned about its line of sight sees the picture turned the other way.
#[test]
fn a_turned_camera_gives_a_turned_picture() {
    let smoke = together(vec![ball(DVec3::ZERO, 1.0, 0.2), ball(DVec3::new(0.6, 0.3, 0.1), 0.7, 0.2)]);
    let ages = ages(&smoke);
    let upright = Scene {
        ages: &ages,
        camera: Camera::toward(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO),
        ..scene(&smoke, 2.0)
    };
    // Clockwise, so that the picture turns counterclockwise.
    let mut rolled = upright;
    rolled.camera.up = DVec3::X;
    let ((a, _), (b, _)) =
        (drawn(&upright, &parameters(81, 81, 32)), drawn(&rolled, &parameters(81, 81, 32)));
    for (before, after) in [(&a.alpha, &b.alpha), (&a.scatter, &b.scatter), (&a.age, &b.age)] {
        let error = difference(&turned(before), after);
        assert!(error < 1e-6, "{error}");
        assert!(difference(before, after) > 0.01, "the picture is not symmetric");
    }
}

/// The whole scene turned by a quarter about the light and the sight: nothing changes but the texture's axes.
#[test]
fn a_turned_scene_gives_the_same_picture() {
    let turn = |p: DVec3| DVec3::new(p.z, p.y, -p.x);
    let smoke = together(vec![ball(DVec3::ZERO, 1.0, 0.2), ball(DVec3::new(0.6, 0.3, 0.1), 0.7, 0.2)]);
    let before = scene(&smoke, 2.0);
    let turned = moved(&smoke, turn);
    let mut after = Scene { smoke: &turned, ..before };
    after.camera.eye = turn(before.camera.eye);
    after.camera.target = turn(before.camera.target);
    after.light = Light { direction: turn(before.light.direction), ..before.light };
    let parameters = parameters(80, 60, 64);
    let ((a, _), (b, _)) = (drawn(&before, &parameters), drawn(&after, &parameters));
    let alpha = difference(&a.alpha, &b.alpha);
    let scatter = difference(&a.scatter, &b.scatter);
    println!("a turned scene: alpha differs by {alpha:.1e}, scatter by {scatter:.1e}");
    // Rounding may move a vertex to the next place on the grid of pixels.
    assert!(alpha < 1e-3 && scatter < 5e-3, "{alpha} {scatter}");
}

/// Where nothing overlaps and nothing is reversed all rules agree, and the orientation is nothing to two of
/// them.
#[test]
fn rules_agree_on_an_embedded_surface() {
    let smoke = torus(&Torus { edge_length: 0.15, ..Torus::default() }).unwrap();
    let reversed = smoke.clone().reversed();
    let with = |smoke: &ClosedOrientedMesh, interior: InteriorRule| {
        let mut scene = scene(smoke, 2.0);
        scene.medium.interior = interior;
        drawn(&scene, &parameters(60, 45, 32)).0
    };
    let picture = with(&smoke, InteriorRule::NonZero);
    for rule in [InteriorRule::Positive, InteriorRule::Odd, InteriorRule::Multiplicity] {
        let other = with(&smoke, rule);
        assert!(difference(&picture.alpha, &other.alpha) < 1e-6, "{rule:?}");
        assert!(difference(&picture.scatter, &other.scatter) < 1e-5, "{rule:?}");
    }
    let other = with(&reversed, InteriorRule::NonZero);
    assert!(difference(&picture.alpha, &other.alpha) < 1e-6);
    assert!(difference(&picture.scatter, &other.scatter) < 1e-5);
    assert!(with(&reversed, InteriorRule::Positive).alpha.pixels().iter().all(|&a| a == 0.0));
}
