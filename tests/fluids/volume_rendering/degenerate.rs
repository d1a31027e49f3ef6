//! Scenes at the edge of sense: each has a picture or a typed error.

use super::{ball, drawn, moved, parameters, scene, together};
use glam::DVec3;
use std::sync::atomic::AtomicBool;
use welter_fluids::volume_rendering::{
    AgeBlur, Camera, InteriorRule, Light, MAX_SIDE, Medium, RenderError, RenderParameters, Scene, Solid,
    render, voxel_volumes,
};
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

fn refused(scene: &Scene<'_>, parameters: &RenderParameters) -> RenderError {
    render(scene, parameters, &Monitor::none()).map(|_| ()).unwrap_err()
}

#[test]
fn no_smoke_shows_what_is_behind() {
    let nothing = ClosedOrientedMesh::new(TriMesh::new(TriangleSoup::default()).unwrap()).unwrap();
    let solid = ball(DVec3::ZERO, 1.0, 0.2);
    let solids = [Solid { mesh: &solid, albedo: [1.0; 3] }];
    let scene = Scene { solids: &solids, ..scene(&nothing, 1.0) };
    let (picture, report) = drawn(&scene, &parameters(40, 30, 16));
    assert_eq!((report.crossings, report.shadow_size), (0, [0; 3]));
    assert!(picture.composite == picture.backdrop);
    assert_eq!(*picture.backdrop.at(0, 0), [0.2, 0.3, 0.5]);
    // The lit side of a white ball is brighter than its ambient light, the other side shows that alone.
    let bright = picture.backdrop.pixels().iter().filter(|p| p[0] > 0.5).count();
    let dark = picture.backdrop.pixels().iter().filter(|p| (p[0] - 0.1).abs() < 1e-6).count();
    assert!(bright > 50 && dark > 5, "{bright} {dark}");
}

#[test]
fn an_eye_in_the_smoke_sees_from_there() {
    let extinction = 0.7;
    let ball = ball(DVec3::ZERO, 1.0, 0.1);
    let eye = DVec3::new(0.2, -0.1, 0.3);
    let camera = Camera { vertical_field_of_view: 2.5, ..Camera::toward(eye, DVec3::new(1.0, 2.0, -5.0)) };
    let scene = Scene { camera, ..scene(&ball, extinction) };
    let (picture, report) = drawn(&scene, &parameters(40, 30, 16));
    assert_eq!((report.pixels_from_inside, report.covered_pixels, report.most_crossings), (1200, 1200, 1));
    let tracer = welter_kit::volume_rendering::tracer::Tracer::new(&scene);
    for (x, y) in [(0_u32, 0_u32), (20, 15), (39, 29), (3, 22)] {
        let ray = tracer.ray([40, 30], [x, y]);
        let along = eye.dot(ray);
        let way = -along + (along * along + 1.0 - eye.length_squared()).sqrt();
        let alpha = f64::from(*picture.alpha.at(x as usize, y as usize));
        assert!((alpha - (1.0 - (-extinction * way).exp())).abs() < 2e-3, "{x} {y} {alpha}");
    }
}

#[test]
fn surfaces_around_behind_and_through_the_eye() {
    let shell = together(vec![ball(DVec3::ZERO, 3.0, 0.5), ball(DVec3::ZERO, 2.0, 0.5).reversed()]);
    // In the hollow: each ray goes through the shell once.
    let camera =
        Camera { vertical_field_of_view: 3.0, ..Camera::toward(DVec3::ZERO, DVec3::new(0.3, 0.1, -1.0)) };
    let (picture, report) = drawn(&Scene { camera, ..scene(&shell, 1.0) }, &parameters(31, 31, 16));
    assert_eq!((report.pixels_from_inside, report.most_crossings), (0, 2));
    let through = 1.0 - (-1.0_f32).exp();
    assert!(picture.alpha.pixels().iter().all(|a| (a - through).abs() < 0.05));
    // In a vertex, an edge and a triangle of the surface: some rays start inside, others outside, none
    // anywhere else.
    let ball = ball(DVec3::ZERO, 1.0, 0.5);
    let [a, b, c] = ball.triangles()[0].map(|v| ball.positions()[v.index()]);
    for eye in [a, 0.5 * (a + b), (a + b + c) / 3.0] {
        for target in [DVec3::ZERO, 2.0 * eye, eye + DVec3::new(0.1, 0.2, 0.3)] {
            let camera = Camera { up: DVec3::new(0.3, 0.5, 0.9), ..Camera::toward(eye, target) };
            let (picture, report) = drawn(&Scene { camera, ..scene(&ball, 1.0) }, &parameters(32, 24, 8));
            assert!(report.most_crossings <= 2, "{eye}: {report:?}");
            assert!(picture.alpha.pixels().iter().all(|a| (0.0..0.9).contains(a)));
        }
    }
    let camera = Camera::toward(DVec3::new(0.0, 0.0, 5.0), DVec3::new(0.0, 0.0, 9.0));
    let (_, report) = drawn(&Scene { camera, ..scene(&ball, 1.0) }, &parameters(32, 24, 8));
    assert_eq!(report.covered_pixels, 0, "all is behind the eye");
}

#[test]
fn surfaces_without_volume_are_clear() {
    let ball = ball(DVec3::ZERO, 1.0, 0.3);
    let eye = DVec3::new(1.3, 1.1, 4.2);
    let flat: [(&str, ClosedOrientedMesh); 4] = [
        ("a point", moved(&ball, |_| DVec3::ONE)),
        ("a segment", moved(&ball, |p| DVec3::new(p.x, 0.0, 0.0))),
        ("a disc", moved(&ball, |p| DVec3::new(p.x, p.y, 0.0))),
        ("a disc through the eye", moved(&ball, |p| eye + 3.0 * DVec3::new(p.x, 0.0, p.z))),
    ];
    for (name, smoke) in &flat {
        let (picture, _) = drawn(&scene(smoke, 1e3), &parameters(40, 30, 16));
        // What has no thickness has one of rounding.
        assert!(picture.alpha.pixels().iter().all(|&a| a < 1e-9), "{name}");
    }
}

#[test]
fn extreme_numbers_have_pictures() {
    let ball = ball(DVec3::ZERO, 1.0, 0.3);
    for (extinction, least, most) in [(0.0, 0.0, 0.0), (f64::MAX, 1.0, 1.0), (f64::MIN_POSITIVE, 0.0, 0.0)] {
        let (picture, _) = drawn(&scene(&ball, extinction), &parameters(21, 21, 16));
        let alpha = *picture.alpha.at(10, 10);
        assert!((least..=most).contains(&alpha), "{extinction}: {alpha}");
        assert!(picture.composite.pixels().iter().flatten().all(|c| c.is_finite()));
    }
    for size in [1e-300, 1e300] {
        let smoke = moved(&ball, |p| p * size);
        let mut scene = scene(&smoke, 1.0 / size);
        scene.camera.eye *= size;
        scene.camera.target *= size;
        let (picture, _) = drawn(&scene, &parameters(21, 21, 16));
        assert!(*picture.alpha.at(10, 10) > 0.8);
    }
    // A solid as large as numbers go before a grain of smoke.
    let solid = moved(&ball, |p| p * 1e308);
    let solids = [Solid { mesh: &solid, albedo: [1.0; 3] }];
    let (picture, _) = drawn(&Scene { solids: &solids, ..scene(&ball, 1.0) }, &parameters(8, 8, 4));
    assert!(picture.composite.pixels().iter().flatten().all(|c| c.is_finite()));
}

/// Tetrahedra with corners on a coarse lattice, or next to it, seen and lit from and along the lattice: flat ones, coincident
/// ones, eyes in corners, edges and faces, lines of sight along them. `WELTER_RENDERED_SCENES` sets how many.
#[test]
fn tetrahedra_on_a_lattice_from_anywhere() {
    let mut state = 11_u64;
    let mut random = |count: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % count
    };
    let (mut covered, mut inside) = (0, 0);
    let rounds = std::env::var("WELTER_RENDERED_SCENES").map_or(400, |text| text.parse().unwrap());
    for round in 0..rounds {
        let mut place = |spread: u64| {
            let mut coordinate = || random(spread) as f64 - (spread / 2) as f64;
            let at = DVec3::new(coordinate(), coordinate(), coordinate());
            let near = DVec3::new(coordinate(), coordinate(), coordinate()) * f64::EPSILON;
            if round % 3 == 0 { at + near } else { at }
        };
        let mut tetrahedron = || {
            let positions = (0..4).map(|_| place(3)).collect();
            let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
            let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
            ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
        };
        let smoke = together(vec![tetrahedron(), tetrahedron(), tetrahedron()]);
        let solid = tetrahedron();
        let solids = [Solid { mesh: &solid, albedo: [0.5; 3] }];
        let (mut eye, target, light) = (place(5), place(3), place(3));
        if round % 5 == 0 {
            // In the middle of one of them.
            eye = smoke.positions()[..4].iter().sum::<DVec3>() / 4.0;
        }
        let ages: Vec<f64> = (0..smoke.positions().len()).map(|v| 2.0 + (v % 3) as f64).collect();
        let mut scene = Scene {
            ages: &ages,
            solids: if round % 2 == 0 { &solids } else { &[] },
            camera: Camera { up: DVec3::new(0.3, 0.9, -0.4), ..Camera::toward(eye, target) },
            light: Light { direction: light, ..Light::default() },
            ..scene(&smoke, 1.0)
        };
        scene.medium.interior =
            [InteriorRule::NonZero, InteriorRule::Positive, InteriorRule::Odd, InteriorRule::Multiplicity]
                [round % 4];
        let (picture, report) = match render(&scene, &parameters(12, 9, 5), &Monitor::none()) {
            Ok(done) => done,
            Err(error) => {
                assert!(
                    eye.distance(target) < 1e-9 || light.length() < 1e-9,
                    "{eye} {target} {light}: {error}"
                );
                continue;
            }
        };
        covered += report.covered_pixels;
        inside += report.pixels_from_inside;
        for (at, &alpha) in picture.alpha.pixels().iter().enumerate() {
            let (scatter, age) = (picture.scatter.pixels()[at], picture.age.pixels()[at]);
            assert!((0.0..=1.0).contains(&alpha) && (0.0..=alpha + 1e-6).contains(&scatter), "{round}");
            assert!(age == 0.0 || (1.999..4.001).contains(&age), "{round}: {age}");
            assert!(picture.composite.pixels()[at].iter().all(|c| (0.0..10.0).contains(c)), "{round}");
        }
    }
    assert!(covered > 25 * rounds as u64 && inside > 5 * rounds as u64, "{covered} {inside}");
}

/// More crossings of one tile than are held at a time: it is divided, and the picture is that of fewer pixels
/// at a time.
#[test]
fn crowded_tiles_are_divided() {
    let slab = |k: usize| {
        let z = k as f64 * 1e-3;
        let [low, high] = [z, z + 5e-4]
            .map(|z| [[-9.0, -9.0, z], [9.0, -9.0, z], [9.0, 9.0, z], [-9.0, 9.0, z]].map(DVec3::from_array));
        let positions = [low, high].concat();
        let quads = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
        ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
    };
    let smoke = together((0..600).map(slab).collect());
    let camera = Camera::toward(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO);
    let scene = Scene { camera, ..scene(&smoke, 1.0) };
    let (picture, report) = drawn(&scene, &parameters(64, 16, 4));
    assert_eq!((report.most_crossings, report.crossings), (1200, 1200 * 64 * 16));
    let alpha = 1.0 - (-0.3_f32 * 1.0).exp();
    assert!((picture.alpha.at(31, 7) - alpha).abs() < 1e-2, "{}", picture.alpha.at(31, 7));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let ball = ball(DVec3::ZERO, 1.0, 0.5);
    let good = scene(&ball, 1.0);
    let fits = parameters(8, 8, 4);
    let parameter = |error: RenderError| match error {
        RenderError::Parameter { name, .. } => name,
        other => panic!("{other}"),
    };
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        let name = |scene: Scene<'_>| parameter(refused(&scene, &fits));
        assert_eq!(name(Scene { medium: Medium::white(bad), ..good }), "extinction");
        assert_eq!(name(Scene { background: [0.0, bad, 0.0], ..good }), "background");
        let light = Light { radiance: [bad; 3], ..Light::default() };
        assert_eq!(name(Scene { light, ..good }), "the radiance of the light");
        let solids = [Solid { mesh: &ball, albedo: [bad; 3] }];
        let error = refused(&Scene { solids: &solids, ..good }, &fits);
        assert_eq!(parameter(error), "the albedo of a solid");
        let blurred = RenderParameters { age_blur: Some(AgeBlur::new(bad)), ..fits };
        assert_eq!(parameter(refused(&good, &blurred)), "spread_rel");
        assert_eq!(
            parameter(refused(&good, &RenderParameters { optical_step: bad, ..fits })),
            "optical_step"
        );
        assert_eq!(parameter(refused(&good, &RenderParameters { dark: bad, ..fits })), "dark");
        let mut ages = vec![0.0; ball.positions().len()];
        ages[7] = bad;
        let error = refused(&Scene { ages: &ages, ..good }, &fits);
        assert!(matches!(error, RenderError::Age { vertex: 7, .. }), "{error}");
    }
    let error = refused(&Scene { ages: &[1.0, 2.0], ..good }, &fits);
    assert_eq!(error, RenderError::AgeCount { vertices: ball.positions().len(), ages: 2 });
    let light = Light { direction: DVec3::ZERO, ..Light::default() };
    assert!(matches!(refused(&Scene { light, ..good }, &fits), RenderError::Direction { .. }));
    let camera = Camera { eye: DVec3::new(f64::NAN, 0.0, 0.0), ..good.camera };
    assert_eq!(parameter(refused(&Scene { camera, ..good }, &fits)), "the eye of the camera");
    for (width, height) in [(0, 8), (8, MAX_SIDE + 1), (MAX_SIDE, MAX_SIDE)] {
        let error = refused(&good, &RenderParameters { width, height, ..fits });
        assert_eq!(error, RenderError::ImageSize { width, height });
    }
    let error = refused(&good, &RenderParameters { shadow_resolution: 4096, ..fits });
    assert!(matches!(error, RenderError::ShadowTexture { .. }), "{error}");
    assert!(voxel_volumes(&ball, DVec3::X, 0).is_err() && voxel_volumes(&ball, DVec3::NAN, 4).is_err());
    let stop = AtomicBool::new(true);
    let error = render(&good, &fits, &Monitor::new(None, Some(&stop))).map(|_| ()).unwrap_err();
    assert!(matches!(error, RenderError::Cancelled(_)));
}
