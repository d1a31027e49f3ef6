//! Whole pictures.

use super::*;
use glam::DVec3;
use welter_meshing::shapes;
use welter_meshing::surface::{ClosedOrientedMesh, TriId, VertexId};

/// A background that no lit surface takes.
const MAGENTA: Rgb = Rgb::new(1.0, 0.0, 1.0);

fn layer<'a>(positions: &'a [DVec3], triangles: &'a [[VertexId; 3]]) -> Layer<'a> {
    Layer { positions, triangles, paint: Paint::Plain, highlighted: &[], style: Style::default() }
}

/// A small picture without floor on magenta, seen along -z.
fn bare(layers: Vec<Layer<'_>>) -> Scene<'_> {
    Scene {
        layers,
        camera: Camera::Orbit { azimuth: 0.0, elevation: 0.0, distance: None },
        up: Up::Y,
        size: [120, 90],
        background: Background { top: MAGENTA, bottom: MAGENTA },
        floor: false,
        ..Scene::default()
    }
}

fn drawn(scene: &Scene<'_>) -> Image {
    render(scene).expect("the scene is sound")
}

fn shape(name: &str) -> ClosedOrientedMesh {
    shapes::by_name(name, None).expect("a known shape")
}

fn is_background(p: [u8; 3]) -> bool {
    p == [255, 0, 255]
}

/// Whether a pixel holds only surface: the palette of surfaces is never far from grey.
fn is_surface([r, g, b]: [u8; 3]) -> bool {
    r.abs_diff(g) < 40 && g.abs_diff(b) < 70
}

fn rows(image: &Image) -> impl Iterator<Item = &[[u8; 3]]> {
    image.pixels.chunks_exact(image.width as usize)
}

fn cube(half: f64) -> (Vec<DVec3>, Vec<[VertexId; 3]>) {
    let positions = (0..8)
        .map(|i| DVec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { half } else { -half })))
        .collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|t| t.map(VertexId)).collect();
    (positions, triangles)
}

#[test]
fn a_square_facing_the_eye_covers_the_pixels_that_perspective_says() {
    let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let triangles = [[0, 1, 2], [0, 2, 3]].map(|t| t.map(VertexId));
    let mut scene = bare(vec![layer(&positions, &triangles)]);
    scene.camera = Camera::Orbit { azimuth: 0.0, elevation: 0.0, distance: Some(5.0) };
    scene.size = [100, 100];
    let image = drawn(&scene);
    // 50 pixels are tan 15 degrees = 0.267949...; the square's half side is seen under 1 / 5.
    let half = 50.0 * 0.2 / 0.267_949_192_431_122_7;
    for (y, row) in rows(&image).enumerate() {
        for (x, &p) in row.iter().enumerate() {
            let out = [x, y].map(|v| (v as f64 + 0.5 - 50.0).abs()).into_iter().fold(0.0, f64::max);
            if out > half + 1.0 {
                assert!(is_background(p), "{x} {y} {p:?}");
            } else if out < half - 1.0 {
                assert!(is_surface(p), "{x} {y} {p:?}");
            }
        }
    }
}

#[test]
fn a_closed_surface_shows_no_gap_inside_its_outline() {
    for name in ["sphere", "box", "dumbbell"] {
        let mesh = shape(name);
        for (azimuth, elevation) in [(0.0, 0.0), (33.0, 21.0), (-71.0, 64.0)] {
            let mut scene = bare(vec![Layer::of(mesh.as_mesh())]);
            scene.camera = Camera::Orbit { azimuth, elevation, distance: None };
            scene.samples = 2;
            let image = drawn(&scene);
            assert!(image.pixels.iter().filter(|&&p| is_surface(p)).count() > 1000, "{name}");
            assert_no_gap(&image);
        }
    }
}

/// Background is connected to the corner, and what is neither background nor surface has background near.
fn assert_no_gap(image: &Image) {
    let (width, height) = (image.width as usize, image.height as usize);
    let at = |x: usize, y: usize| image.pixels[y * width + x];
    let around = |x: usize, y: usize, r: usize| {
        let rows = y.saturating_sub(r)..(y + r + 1).min(height);
        rows.flat_map(move |v| (x.saturating_sub(r)..(x + r + 1).min(width)).map(move |u| (u, v)))
    };
    let mut reached = vec![false; width * height];
    let mut open = vec![(0, 0)];
    while let Some((x, y)) = open.pop() {
        if is_background(at(x, y)) && !std::mem::replace(&mut reached[y * width + x], true) {
            open.extend(around(x, y, 1));
        }
    }
    for y in 0..height {
        for x in 0..width {
            let p = at(x, y);
            assert!(!is_background(p) || reached[y * width + x], "a hole at {x} {y}");
            let explained = is_surface(p) || around(x, y, 2).any(|(u, v)| is_background(at(u, v)));
            assert!(explained, "a gap at {x} {y}: {p:?}");
        }
    }
}

#[test]
fn inside_a_closed_surface_no_background_is_seen() {
    let mesh = shape("sphere");
    for distance in [1e-300, 1e-3, 0.3, 0.9] {
        let mut scene = bare(vec![Layer::of(mesh.as_mesh())]);
        scene.camera = Camera::Orbit { azimuth: 12.0, elevation: 34.0, distance: Some(distance) };
        let image = drawn(&scene);
        for &[r, g, _] in &image.pixels {
            assert!(g >= r, "the back colour is blue: {r} {g}");
        }
    }
}

/// Everything at once.
fn rich<'a>(layers: Vec<Layer<'a>>) -> Scene<'a> {
    let mut scene = Scene { layers, size: [203, 157], ..Scene::default() };
    scene.caption.title = "ring".into();
    scene.caption.lines = vec![(Some(Style::default().accent), "216 pairs".into())];
    scene.caption.scale = Some((ColorMap::Sequential, ["0".into(), "1".into()]));
    scene.cut = Some(Cut { axis: 1, value: -0.2 });
    for l in &mut scene.layers {
        l.style.edges = Some(Edges::default());
        l.style.opacity = 0.6;
    }
    scene
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let mesh = shapes::by_name("ring-overlap", Some(0.2)).expect("a known shape");
    let values: Vec<f64> = mesh.as_mesh().positions().iter().map(|p| p.x * p.y).collect();
    let highlighted: Vec<TriId> = (0..40).map(|i| TriId(7 * i)).collect();
    let mut l = Layer::of(mesh.as_mesh());
    l.highlighted = &highlighted;
    l.paint = Paint::VertexField(Field { values: &values, range: None, map: ColorMap::Diverging });
    let scene = rich(vec![l]);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| drawn(&scene))
    };
    let one = with(1);
    assert!(one.pixels.iter().any(|&p| p != one.pixels[0]));
    for threads in [2, 3, 5] {
        assert!(with(threads) == one, "{threads} threads");
    }
}

#[test]
fn scaling_by_powers_of_two_changes_nothing_from_subnormal_to_huge() {
    let (positions, triangles) = cube(3.0);
    let image = |exponent: i32| {
        let scaled: Vec<DVec3> =
            positions.iter().map(|p| p.to_array().map(|x| libm::scalbn(x, exponent)).into()).collect();
        assert!(scaled.iter().all(|p| p.is_finite() && p.x != 0.0));
        let mut scene = bare(vec![layer(&scaled, &triangles)]);
        scene.camera = Camera::Automatic;
        scene.floor = true;
        scene.cut = Some(Cut { axis: 0, value: libm::scalbn(1.0, exponent) });
        drawn(&scene)
    };
    let unit = image(0);
    for exponent in [-1074, -1022, -500, 1, 700, 1021, 1022] {
        assert!(image(exponent) == unit, "{exponent}");
    }
}

#[test]
fn a_mirrored_surface_has_a_mirrored_outline() {
    let mesh = shape("sphere");
    let mesh = mesh.as_mesh();
    // Asymmetric, so that its mirror image is another surface.
    let bent: Vec<DVec3> =
        mesh.positions().iter().map(|p| DVec3::new(p.x + 0.3 * p.y * p.y, p.y, p.z)).collect();
    let mirrored: Vec<DVec3> = bent.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
    let outline = |positions: &[DVec3]| {
        let image = drawn(&bare(vec![layer(positions, mesh.triangles())]));
        rows(&image).map(|r| r.iter().map(|&p| is_background(p)).collect()).collect::<Vec<Vec<bool>>>()
    };
    let (left, mut right) = (outline(&bent), outline(&mirrored));
    assert_ne!(left, right);
    right.iter_mut().for_each(|row| row.reverse());
    assert_eq!(left, right);
}

#[test]
fn the_fitted_view_fills_the_frame_and_keeps_the_margin() {
    for name in ["torus", "helix-overlap", "two-boxes"] {
        let mesh = shape(name);
        for size in [[150, 60], [60, 150], [100, 100]] {
            for camera in
                [Camera::Automatic, Camera::Orbit { azimuth: 250.0, elevation: -40.0, distance: None }]
            {
                let mut scene = bare(vec![Layer::of(mesh.as_mesh())]);
                (scene.size, scene.camera, scene.samples) = (size, camera, 2);
                let image = drawn(&scene);
                let (mut low, mut high) = ([u32::MAX; 2], [0; 2]);
                for y in 0..size[1] {
                    for x in 0..size[0] {
                        if !is_background(image.pixel(x, y)) {
                            low = [low[0].min(x), low[1].min(y)];
                            high = [high[0].max(x), high[1].max(y)];
                        }
                    }
                }
                let extent = [0, 1].map(|a| f64::from(high[a] - low[a]) / f64::from(size[a]));
                assert!(extent.into_iter().all(|e| e < 0.9), "{name} {size:?}: {extent:?}");
                assert!(extent.into_iter().any(|e| e > 0.8), "{name} {size:?}: {extent:?}");
                assert!(low.iter().all(|&v| v > 1));
            }
        }
    }
}

#[test]
fn a_hidden_highlighted_triangle_shows_through() {
    let (mut positions, mut triangles) = cube(1.0);
    let first = positions.len() as u32;
    positions.extend([DVec3::new(-0.4, -0.4, 0.0), DVec3::new(0.4, -0.4, 0.0), DVec3::new(0.0, 0.5, 0.0)]);
    triangles.push([first, first + 1, first + 2].map(VertexId));
    let highlighted = [TriId(triangles.len() as u32 - 1)];
    let plain = drawn(&bare(vec![layer(&positions, &triangles)])).pixel(60, 45);
    let mut l = layer(&positions, &triangles);
    l.highlighted = &highlighted;
    let seen = drawn(&bare(vec![l])).pixel(60, 45);
    let redness = |[r, g, _]: [u8; 3]| i32::from(r) - i32::from(g);
    assert!(redness(plain) < 20 && redness(seen) > 60, "{plain:?} {seen:?}");
}

#[test]
fn a_highlighted_triangle_wins_over_its_twin_in_the_same_place() {
    let positions = [DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, -1.0, 0.0), DVec3::new(0.0, 1.0, 0.0)];
    let twins = [[0, 1, 2], [0, 1, 2]].map(|t| t.map(VertexId));
    for id in [0, 1] {
        let highlighted = [TriId(id)];
        let mut l = layer(&positions, &twins);
        l.highlighted = &highlighted;
        let [r, g, _] = drawn(&bare(vec![l])).pixel(60, 45);
        assert!(r > g + 60, "{r} {g}");
    }
}

#[test]
fn a_cut_opens_the_near_side_and_shows_the_inside_in_the_back_colour() {
    let (positions, triangles) = cube(1.0);
    for (azimuth, axis) in [(0.0, 2), (180.0, 2), (90.0, 0), (-90.0, 0)] {
        let mut scene = bare(vec![layer(&positions, &triangles)]);
        scene.camera = Camera::Orbit { azimuth, elevation: 0.0, distance: None };
        let [r, _, b] = drawn(&scene).pixel(60, 45);
        assert!(r > b, "front: {r} {b}");
        scene.cut = Some(Cut { axis, value: 0.1 });
        let [r, _, b] = drawn(&scene).pixel(60, 45);
        assert!(b > r, "back: {r} {b}");
    }
}

#[test]
fn scenes_without_area_are_backdrops() {
    let point = [DVec3::new(1e300, -5.0, 1e-310); 3];
    let line = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
    let triangle = [[0, 1, 2].map(VertexId)];
    for layers in [
        vec![],
        vec![layer(&[], &[])],
        vec![layer(&point, &triangle)],
        vec![layer(&line, &triangle)],
        vec![layer(&line, &[])],
    ] {
        let mut scene = bare(layers);
        scene.floor = true;
        assert!(drawn(&scene).pixels.into_iter().all(is_background));
    }
}

#[test]
fn every_size_and_sampling_is_drawn() {
    let (positions, triangles) = cube(1.0);
    for size in [[1, 1], [1, 41], [41, 1], [17, 16], [33, 50]] {
        for samples in 1..=4 {
            let mut scene = bare(vec![layer(&positions, &triangles)]);
            (scene.size, scene.samples) = (size, samples);
            let image = drawn(&scene);
            assert_eq!(image.pixels.len(), (size[0] * size[1]) as usize);
            assert!(image.pixels.iter().any(|&p| !is_background(p)), "{size:?} {samples}");
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let (positions, triangles) = cube(1.0);
    let refused = |change: &dyn Fn(&mut Scene<'_>)| {
        let mut scene = bare(vec![layer(&positions, &triangles)]);
        change(&mut scene);
        render(&scene).unwrap_err()
    };
    assert!(matches!(refused(&|s| s.size = [0, 5]), RenderError::Size { width: 0, .. }));
    assert!(matches!(refused(&|s| s.size = [5, MAX_SIDE + 1]), RenderError::Size { .. }));
    let large = refused(&|s| (s.size, s.max_memory) = ([MAX_SIDE; 2], 1 << 30));
    assert!(matches!(large, RenderError::Memory { needed, .. } if needed > 1 << 30));
    assert!(matches!(refused(&|s| s.samples = 5), RenderError::Parameter { name: "samples", .. }));
    assert!(matches!(refused(&|s| s.cut = Some(Cut { axis: 3, value: 0.0 })), RenderError::Parameter { .. }));
    assert!(matches!(
        refused(&|s| s.cut = Some(Cut { axis: 0, value: f64::NAN })),
        RenderError::Parameter { .. }
    ));
    assert!(matches!(refused(&|s| s.layers[0].style.opacity = 0.0), RenderError::Parameter { .. }));
    let camera = |azimuth, distance| Camera::Orbit { azimuth, elevation: 0.0, distance };
    assert!(matches!(refused(&|s| s.camera = camera(f64::NAN, None)), RenderError::Parameter { .. }));
    assert!(matches!(refused(&|s| s.camera = camera(0.0, Some(0.0))), RenderError::Parameter { .. }));
    let bad = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, f64::INFINITY, 0.0)];
    let triangle = [[0, 1, 2].map(VertexId)];
    let beyond = [[0, 1, 9].map(VertexId)];
    assert!(matches!(
        render(&bare(vec![layer(&bad, &triangle)])),
        Err(RenderError::NonFinite { vertex: 2, .. })
    ));
    assert!(matches!(
        render(&bare(vec![layer(&positions, &beyond)])),
        Err(RenderError::VertexOutOfRange { triangle: 0, .. })
    ));
    let ids = [TriId(12)];
    let mut l = layer(&positions, &triangles);
    l.highlighted = &ids;
    assert!(matches!(render(&bare(vec![l])), Err(RenderError::Mismatch { found: 12, .. })));
    let mut l = layer(&positions, &triangles);
    l.paint = Paint::Triangles(&[[0; 3]]);
    assert!(matches!(render(&bare(vec![l])), Err(RenderError::Mismatch { found: 1, expected: 12, .. })));
}

#[test]
fn fields_show_their_colours_and_nan_is_grey() {
    let (positions, triangles) = cube(1.0);
    let mut values = vec![f64::MIN; 12];
    let colour = |values: &[f64]| {
        let mut l = layer(&positions, &triangles);
        l.paint = Paint::TriangleField(Field {
            values,
            range: Some([f64::MIN, f64::MAX]),
            map: ColorMap::Sequential,
        });
        drawn(&bare(vec![l])).pixel(60, 45)
    };
    let [r, g, b] = colour(&values);
    assert!(b > g && b > r, "violet: {r} {g} {b}");
    values.fill(f64::INFINITY);
    let [r, g, b] = colour(&values);
    assert!(r > b && g > b, "yellow: {r} {g} {b}");
    values.fill(f64::NAN);
    let [r, g, b] = colour(&values);
    assert!(r.abs_diff(g) < 24 && g.abs_diff(b) < 24, "grey: {r} {g} {b}");
}

/// The picture of a cube, byte for byte: the same on every machine, since nothing in it depends on a platform's mathematics.
#[test]
fn a_picture_is_the_same_everywhere() {
    let (positions, triangles) = cube(1.0);
    let highlighted = [TriId(3)];
    let mut l = layer(&positions, &triangles);
    l.highlighted = &highlighted;
    l.style.edges = Some(Edges::default());
    let mut scene = Scene { layers: vec![l], size: [160, 160], ..Scene::default() };
    scene.caption.title = "cube".into();
    // FNV-1a of the bytes.
    let hash = drawn(&scene).pixels.as_flattened().iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    assert_eq!(hash, 0x0f0b_bea9_a804_a925, "{hash:#018x}");
}
