//! Every channel within 1 % of its maximum of a ray tracer that meets every triangle and marches toward the
//! light.

use super::{ball, drawn, moved, parameters, scene, together};
use glam::DVec3;
use rayon::prelude::*;
use welter_fluids::volume_rendering::{AgeBlur, InteriorRule, RenderParameters, Scene, Solid};
use welter_kit::volume_rendering::rays::winding_at;
use welter_kit::volume_rendering::tracer::{Seen, Tracer};
use welter_meshing::shapes::{Box_, Torus, box_, torus};
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::ClosedOrientedMesh;

const SIZE: [u32; 2] = [96, 72];

/// Steps of the twin in each stretch. With four times as many, the largest differences change by 2e-3 where the
/// shadow of a solid ends within a step, and by less than 1e-5 without solids.
const STEPS: u32 = 400;

/// The same for smoke in which a step of those has an optical depth of 0.15: light that grazes a surface falls
/// off several times as fast, and with 400 steps the twin itself is off by 1.3e-2.
const MANY_STEPS: u32 = 1600;

/// One pixel in so many is compared; `WELTER_RENDERED_STRIDE` sets another number.
const STRIDE: usize = 23;

/// Differences of the channels, in parts of the largest value of each.
#[derive(Debug)]
struct Errors {
    worst: [f64; 5],
    /// Root mean square.
    mean: [f64; 5],
}

const CHANNELS: [&str; 5] = ["alpha", "scatter", "age", "backdrop", "composite"];

fn green(seen: &Seen) -> [f64; 5] {
    [seen.alpha, seen.scatter, seen.age, seen.backdrop[1], seen.composite[1]]
}

fn errors(scene: &Scene<'_>, parameters: &RenderParameters, steps: u32) -> Errors {
    let (picture, report) = drawn(scene, parameters);
    assert_eq!(report.pixels_from_inside, 0);
    let tracer = Tracer::new(scene);
    let stride = std::env::var("WELTER_RENDERED_STRIDE").map_or(STRIDE, |text| text.parse().unwrap());
    let pixels: Vec<u32> = (0..SIZE[0] * SIZE[1]).step_by(stride).collect();
    let rows: Vec<([f64; 5], [f64; 5])> = pixels
        .into_par_iter()
        .map(|pixel| {
            let (x, y) = (pixel % SIZE[0], pixel / SIZE[0]);
            let at = |plane: &welter_fluids::volume_rendering::Image<f32>| {
                f64::from(*plane.at(x as usize, y as usize))
            };
            let color = |plane: &welter_fluids::volume_rendering::Image<[f32; 3]>| {
                f64::from(plane.at(x as usize, y as usize)[1])
            };
            let drawn = [
                at(&picture.alpha),
                at(&picture.scatter),
                at(&picture.age),
                color(&picture.backdrop),
                color(&picture.composite),
            ];
            (drawn, green(&tracer.pixel(SIZE, [x, y], steps)))
        })
        .collect();
    let mut errors = Errors { worst: [0.0; 5], mean: [0.0; 5] };
    for (k, channel) in CHANNELS.into_iter().enumerate() {
        let most = rows.iter().fold(0.0_f64, |most, row| most.max(row.1[k]));
        let of = |row: &([f64; 5], [f64; 5])| (row.0[k] - row.1[k]).abs();
        let worst = rows.iter().map(of).fold(0.0, f64::max);
        let squares = rows.iter().map(|row| of(row) * of(row)).sum::<f64>() / rows.len() as f64;
        if most > 0.0 {
            (errors.worst[k], errors.mean[k]) = (worst / most, squares.sqrt() / most);
        } else {
            assert_eq!(worst, 0.0, "{} is 0 in the twin", channel);
        }
    }
    errors
}

/// Ages that vary along an oblique direction.
fn ages(mesh: &ClosedOrientedMesh) -> Vec<f64> {
    mesh.positions().iter().map(|p| 3.0 + p.dot(DVec3::new(0.5, 0.7, -0.4))).collect()
}

/// Every channel is within 1 % of the twin's at every pixel.
fn agrees(name: &str, scene: &Scene<'_>, resolution: u32) {
    agrees_with(name, scene, &parameters(SIZE[0], SIZE[1], resolution), STEPS);
}

fn agrees_with(name: &str, scene: &Scene<'_>, parameters: &RenderParameters, steps: u32) {
    let ages = ages(scene.smoke);
    let scene = Scene { ages: &ages, ..*scene };
    let errors = errors(&scene, parameters, steps);
    let resolution = parameters.shadow_resolution;
    for (k, channel) in CHANNELS.into_iter().enumerate() {
        println!(
            "{name}, {resolution} voxels: {channel} differs by {:.1e} at most, root mean square {:.1e}",
            errors.worst[k], errors.mean[k]
        );
    }
    for (k, channel) in CHANNELS.into_iter().enumerate() {
        assert!(errors.worst[k] <= 0.01, "{name}, {resolution} voxels: {channel} {errors:?}");
    }
    // Neither depends on the light.
    assert!(errors.worst[0] < 1e-3 && errors.worst[2] < 1e-3, "{name}: {errors:?}");
}

#[test]
fn a_ball() {
    let ball = ball(DVec3::ZERO, 1.0, 0.25);
    for resolution in [128, 256] {
        agrees("ball", &scene(&ball, 2.0), resolution);
    }
}

/// Light comes no farther than a voxel.
#[test]
fn dense_smoke() {
    let ball = ball(DVec3::ZERO, 1.0, 0.25);
    for resolution in [64, 128] {
        let parameters = parameters(SIZE[0], SIZE[1], resolution);
        agrees_with("dense ball", &scene(&ball, 30.0), &parameters, MANY_STEPS);
    }
}

/// Of few and large voxels, with many triangles in each column, if that is asked for.
#[test]
fn crowded_columns() {
    let smoke = ball(DVec3::ZERO, 1.0, 0.25);
    let solid = ball(DVec3::new(-1.0, 1.1, 0.9), 0.35, 0.15).into_mesh();
    let solids = [Solid { mesh: &solid, albedo: [0.5, 0.6, 0.7] }];
    let traced = RenderParameters { traced_triangles: u32::MAX, ..parameters(SIZE[0], SIZE[1], 16) };
    for extinction in [1.0, 30.0] {
        let scene = Scene { solids: &solids, ..scene(&smoke, extinction) };
        let name = format!("crowded ball of extinction {extinction}");
        agrees_with(&name, &scene, &traced, if extinction > 1.0 { MANY_STEPS } else { STEPS });
    }
}

#[test]
fn a_ball_inside_out() {
    let ball = ball(DVec3::ZERO, 1.0, 0.25).reversed();
    agrees("ball inside out", &scene(&ball, 2.0), 128);
}

#[test]
fn overlapping_balls_by_every_rule() {
    let balls =
        || vec![ball(DVec3::new(-0.45, 0.1, 0.0), 0.8, 0.3), ball(DVec3::new(0.5, -0.1, 0.2), 0.7, 0.3)];
    let smoke = together(balls());
    for interior in
        [InteriorRule::NonZero, InteriorRule::Positive, InteriorRule::Odd, InteriorRule::Multiplicity]
    {
        let mut scene = scene(&smoke, 1.5);
        scene.medium.interior = interior;
        for resolution in [128, 256] {
            agrees(&format!("overlapping balls, {interior:?}"), &scene, resolution);
        }
    }
}

#[test]
fn a_torus() {
    let torus = torus(&Torus { edge_length: 0.2, ..Torus::default() }).unwrap();
    for resolution in [128, 256] {
        agrees("torus", &scene(&torus, 2.0), resolution);
    }
}

/// A bent sheet of some voxels across, or of a part of one. By the texture alone, thin ones are off by more.
#[test]
fn sheets() {
    for resolution in [128, 256] {
        for voxels in [0.25, 1.0, 2.0, 4.0, 8.0] {
            // 2.75 is the longest side of the sheet, seen from the light.
            let thickness = voxels * 2.75 / f64::from(resolution);
            let (name, smoke) = (format!("sheet of {voxels} voxels"), sheet(thickness));
            let scene = scene(&smoke, 0.6 / thickness);
            agrees(&name, &scene, resolution);
            let textured =
                RenderParameters { traced_triangles: 0, ..parameters(SIZE[0], SIZE[1], resolution) };
            let textured = errors(&scene, &textured, STEPS);
            println!(
                "{name}, {resolution} voxels: scatter of the texture alone differs by {:.1e} at most, root mean square {:.1e}",
                textured.worst[1], textured.mean[1]
            );
            assert!(textured.worst[1] > 0.03 || voxels > 2.0, "{name}: {textured:?}");
        }
    }
}

/// Two sheets, one in the shadow of the edge of the other, far from it.
#[test]
fn a_sheet_in_the_shadow_of_a_sheet() {
    let low = sheet(0.05);
    // Toward the light, so that its shadow covers a half.
    let high = moved(&low, |p| p - 2.0 * DVec3::new(0.9, -1.2, -0.7) + DVec3::X);
    let smoke = together(vec![low, high]);
    let mut scene = scene(&smoke, 12.0);
    scene.camera.eye = DVec3::new(2.6, 2.2, 8.4);
    for resolution in [64, 128] {
        agrees("sheets in a row", &scene, resolution);
    }
}

fn sheet(thickness: f64) -> ClosedOrientedMesh {
    let high = DVec3::new(1.0, 1.0, thickness);
    let flat = box_(&Box_ { min: DVec3::new(-1.0, -1.0, 0.0), max: high, edge_length: 0.5 }).unwrap();
    moved(&flat, |p| p + DVec3::Z * 0.2 * p.x * p.x)
}

/// Shadows of a ball and of its smoke on a plate and on each other.
#[test]
fn a_solid_that_casts_a_shadow() {
    let (smoke, solid) =
        (ball(DVec3::ZERO, 1.0, 0.25), ball(DVec3::new(-1.0, 1.1, 0.9), 0.35, 0.15).into_mesh());
    let plate = Box_ { min: DVec3::new(-2.0, -1.6, -2.0), max: DVec3::new(2.0, -1.5, 2.0), edge_length: 4.0 };
    let plate = box_(&plate).unwrap().into_mesh();
    let solids =
        [Solid { mesh: &solid, albedo: [0.5, 0.6, 0.7] }, Solid { mesh: &plate, albedo: [0.9, 0.5, 0.3] }];
    let scene = Scene { solids: &solids, ..scene(&smoke, 1.0) };
    for resolution in [128, 256] {
        agrees("ball with solids", &scene, resolution);
    }
}

/// By the texture alone.
#[test]
fn the_shadow_texture_converges() {
    let ball = ball(DVec3::ZERO, 1.0, 0.25);
    let ages = ages(&ball);
    let scene = Scene { ages: &ages, ..scene(&ball, 3.0) };
    let resolutions = [16, 32, 64, 128];
    let errors = resolutions.map(|resolution| {
        let textured = RenderParameters { traced_triangles: 0, ..parameters(SIZE[0], SIZE[1], resolution) };
        let errors = errors(&scene, &textured, STEPS);
        println!(
            "{resolution} voxels: scatter off by {:.5} at most, {:.5} root mean square",
            errors.worst[1], errors.mean[1]
        );
        errors.mean[1]
    });
    let orders = [0, 1, 2].map(|k| (errors[k] / errors[k + 1]).log2());
    println!("orders {orders:.2?}");
    assert!(orders.iter().all(|&order| order > 0.9) && orders[2] > 1.3, "{orders:?}");
}

/// The twin counts what is inside as the exact winding numbers do.
#[test]
fn the_twin_knows_what_is_inside() {
    let balls = vec![ball(DVec3::ZERO, 1.0, 0.4), ball(DVec3::new(0.7, 0.2, 0.1), 0.6, 0.3).reversed()];
    let smoke = together(balls);
    let scene = scene(&smoke, 1.0);
    let (tracer, exact) = (Tracer::new(&scene), WindingNumbers::new(&smoke));
    let mut seen = [0; 3];
    for y in (3..72).step_by(5) {
        for x in (2..96).step_by(7) {
            let hits = tracer.crossings(SIZE, [x, y]);
            let ray = tracer.ray(SIZE, [x, y]);
            for pair in hits.windows(2) {
                let t = 0.5 * (pair[0].t + pair[1].t);
                let winding = winding_at(&hits, t);
                assert_eq!(exact.at(scene.camera.eye + t * ray), Winding::Number(winding));
                seen[(winding + 1) as usize] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 5), "{seen:?}");
}

/// The composite is the formula of the other channels, and a blur leaves the planes it starts from alone.
#[test]
fn a_blur_changes_the_composite_only() {
    let ball = ball(DVec3::ZERO, 1.0, 0.25);
    let ages = ages(&ball);
    let scene = Scene { ages: &ages, background: [0.0; 3], ..scene(&ball, 2.0) };
    let sharp = parameters(SIZE[0], SIZE[1], 32);
    let blurred = RenderParameters { age_blur: Some(AgeBlur::new(0.02)), ..sharp };
    let ((a, _), (b, _)) = (drawn(&scene, &sharp), drawn(&scene, &blurred));
    assert!(a.alpha == b.alpha && a.scatter == b.scatter && a.age == b.age && a.backdrop == b.backdrop);
    // Before nothing, the composite is linear in what the blur preserves.
    let sum = |picture: &welter_fluids::volume_rendering::Picture| {
        picture.composite.pixels().iter().map(|p| f64::from(p[0])).sum::<f64>()
    };
    assert!((sum(&a) - sum(&b)).abs() < 1e-5 * sum(&a), "{} {}", sum(&a), sum(&b));
    assert!(a.composite != b.composite);
}
