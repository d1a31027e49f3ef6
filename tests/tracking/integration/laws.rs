//! What must not change a result, or only as told: the scale, the number of threads, a translation, names.

use super::Body;
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::moving::{Scene, ends, scenes, stack};
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::integration::{IntegrationParameters, Resolved};

fn mapped(mesh: &TriMesh, map: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let soup = TriangleSoup {
        positions: mesh.positions().iter().map(|&p| map(p)).collect(),
        triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        ..TriangleSoup::default()
    };
    TriMesh::new(soup).unwrap()
}

/// A power of two, also where 2^k and 2^-k are not both normal.
fn times(k: i32, p: DVec3) -> DVec3 {
    DVec3::from_array(p.to_array().map(|x| libm::scalbn(x, k)))
}

fn frictional() -> IntegrationParameters {
    IntegrationParameters { friction: 0.3, proximity_rel: 0.02, ..IntegrationParameters::default() }
}

/// Some steps of each scene that need every stage.
fn cases() -> Vec<(Scene, f64, Vec<DVec3>)> {
    let mut random = Random::new(21);
    let mut cases = Vec::new();
    for seed in 0..3 {
        for scene in scenes(&mut Random::new(seed)) {
            let body = Body::of(&scene);
            let distance = body.length * [0.1, 1.0, 3.0][seed as usize];
            let predicted = ends(&body.surface, &mut random, distance);
            cases.push((scene, body.length, predicted));
        }
    }
    cases
}

#[test]
fn everything_times_a_power_of_two_has_the_same_bits() {
    let mut stages = [0; 5];
    for (scene, length, predicted) in cases() {
        let resolved = |k: i32| {
            let mut body = Body::new(&mapped(&scene.mesh, |p| times(k, p)));
            body.length = libm::scalbn(length, k);
            body.step(predicted.iter().map(|&p| times(k, p)).collect(), &frictional())
        };
        let expected = resolved(0);
        let r = expected.report;
        for (count, used) in
            stages.iter_mut().zip([r.repulsions, r.impulses, r.impact_zones, r.rigid_zones, r.shortenings])
        {
            *count += used;
        }
        for k in [-600, -31, 1, 77, 600] {
            let Resolved { ends, fraction, report } = resolved(k);
            assert_eq!((fraction, report), (expected.fraction, expected.report), "{}, 2^{k}", scene.name);
            let scaled: Vec<DVec3> = expected.ends.iter().map(|&p| times(k, p)).collect();
            assert_eq!(ends, scaled, "{}, 2^{k}", scene.name);
        }
    }
    assert!(stages.iter().all(|&used| used > 0), "{stages:?}");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let resolved = || -> Vec<Resolved> {
        let mut all = Vec::new();
        for (scene, length, predicted) in cases() {
            let mut body = Body::new(&scene.mesh);
            body.length = length;
            all.push(body.step(predicted, &frictional()));
        }
        // Large enough for several tasks and for changes of both kinds.
        let mut body = Body::new(&stack(4, 24, 24.0, 0.05));
        let mut random = Random::new(22);
        for _ in 0..2 {
            let of = |p: &DVec3| *p - DVec3::Z * 0.8 * p.z + 0.1 * random.point();
            let predicted = body.surface.positions().iter().map(of).collect();
            all.push(body.step(predicted, &frictional()));
        }
        all
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(resolved)
    };
    let one = on(1);
    let largest = one.iter().map(|r| r.report.collisions.unwrap_or(0)).max();
    assert!(largest > Some(1000), "{largest:?}");
    for threads in [2, 7] {
        assert!(on(threads) == one, "{threads} threads");
    }
}

#[test]
fn a_translation_moves_the_result() {
    // A million sizes away, by a multiple of 2^-20; positions and ends are such multiples too, so they keep their differences.
    let rounded = |p: DVec3| (p * 2f64.powi(20)).round() / 2f64.powi(20);
    let shift = DVec3::new(4e6, -3e6, 1e6);
    let mesh = mapped(&stack(3, 6, 6.0, 0.125), rounded);
    let mut random = Random::new(23);
    let predicted: Vec<DVec3> =
        mesh.positions().iter().map(|&p| rounded(p - DVec3::Z * 0.9 * p.z + 0.02 * random.point())).collect();
    let near = Body::new(&mesh).step(predicted.clone(), &IntegrationParameters::default());
    let far = Body::new(&mapped(&mesh, |p| p + shift))
        .step(predicted.iter().map(|&p| p + shift).collect(), &IntegrationParameters::default());
    assert!(near.report.collisions > Some(10), "{:?}", near.report);
    assert_eq!((near.report.collisions, near.fraction), (far.report.collisions, far.fraction));
    // Coordinates of 4e6 are known to 2^-31; what the stages add to that is of the same kind.
    let largest =
        near.ends.iter().zip(&far.ends).map(|(&p, &q)| (q - shift - p).length()).fold(0.0, f64::max);
    println!("{largest:e}");
    assert!(largest < 1e-6, "{largest}");
}

#[test]
fn a_motion_without_contact_keeps_every_bit_wherever_it_is() {
    for shift in [DVec3::ZERO, DVec3::new(1e6, -1e6, 3e6), DVec3::splat(1e12)] {
        let mut random = Random::new(24);
        for scene in scenes(&mut Random::new(4)).into_iter().filter(|s| ["sphere", "torus"].contains(&s.name))
        {
            let mut body = Body::new(&mapped(&scene.mesh, |p| p + shift));
            let distance = 0.05 * body.length;
            let predicted: Vec<DVec3> =
                body.surface.positions().iter().map(|&p| p + distance * random.point()).collect();
            let resolved = body.step(predicted.clone(), &IntegrationParameters::default());
            assert_eq!(resolved.ends, predicted);
            assert_eq!((resolved.fraction, resolved.report.collisions), (1.0, Some(0)));
            assert_eq!(body.surface.positions(), predicted);
        }
    }
}

#[test]
fn names_of_vertices_do_not_matter_for_safety() {
    for (round, (scene, _, predicted)) in cases().into_iter().enumerate() {
        let mut random = Random::new(round as u64);
        let n = scene.mesh.positions().len();
        let mut names: Vec<usize> = (0..n).collect();
        (1..n).for_each(|i| names.swap(i, random.below(i as u64 + 1) as usize));
        let mut positions = vec![DVec3::ZERO; n];
        let mut renamed = positions.clone();
        for (old, &new) in names.iter().enumerate() {
            positions[new] = scene.mesh.positions()[old];
            renamed[new] = predicted[old];
        }
        let triangles =
            scene.mesh.triangles().iter().rev().map(|t| t.map(|v| names[v.index()] as u32)).collect();
        let mesh = TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap();
        let (mut body, mut original) = (Body::new(&mesh), Body::of(&scene));
        let unrepelled = IntegrationParameters { proximity_rel: 0.0, ..IntegrationParameters::default() };
        let collisions = body.step(renamed, &unrepelled).report.collisions;
        assert!(body.is_embedded(), "{}", scene.name);
        assert_eq!(collisions, original.step(predicted, &unrepelled).report.collisions, "{}", scene.name);
    }
}
