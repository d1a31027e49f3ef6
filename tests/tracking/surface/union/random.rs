//! Random shapes, one after the other.

use super::{ball, check, check_windings, cuboid, moved, ring, unite};
use glam::{DQuat, DVec3};
use welter_kit::mesher::Random;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_tracking::surface::{MovingSurface, UnionOutcome};

/// How many surfaces are made, and of how many shapes each.
fn runs() -> (u64, usize) {
    match std::env::var("WELTER_UNIONS") {
        Ok(text) => (text.parse().unwrap_or_else(|_| panic!("WELTER_UNIONS is {text:?}, no number")), 8),
        Err(_) => (4, 3),
    }
}

/// A ball, a torus or a box, turned, stretched, and displaced by some of its size.
fn shape(random: &mut Random) -> ClosedOrientedMesh {
    let edge_length = random.between(0.35, 0.6);
    let mesh = match random.below(3) {
        0 => ball(DVec3::ZERO, 1.0, edge_length),
        1 => ring(edge_length),
        _ => cuboid([-0.8; 3], [0.8; 3], edge_length),
    };
    let turn = DQuat::from_axis_angle(random.point().normalize(), random.between(0.0, 6.0));
    let size = DVec3::new(random.between(0.3, 1.2), random.between(0.3, 1.2), random.between(0.3, 1.2));
    let center = 0.9 * random.point();
    moved(&mesh, |p| center + turn * (size * p))
}

#[test]
fn random_shapes_are_united_and_wind_as_they_should() {
    let (seeds, shapes) = runs();
    let (mut asked, mut refused, mut shifted, mut segments) = (0, 0, 0, 0);
    let mut counts = [0; 3];
    for seed in 0..seeds {
        let mut random = Random::new(seed);
        let mut surface = MovingSurface::new(&shape(&mut random)).unwrap();
        for _ in 0..shapes {
            let shape = shape(&mut random);
            let before = surface.to_mesh();
            asked += 1;
            match unite(&mut surface, &shape) {
                Err(error) => {
                    println!("seed {seed}: {error}");
                    refused += 1;
                }
                Ok(report) => {
                    shifted += u32::from(report.shifts > 0);
                    segments += report.segments;
                    check(&surface);
                    let after = surface.to_mesh();
                    let found = check_windings(&before, &shape, &after, &mut random, 25);
                    counts.iter_mut().zip(found).for_each(|(sum, count)| *sum += count);
                    let unchanged = before == after;
                    assert_eq!(unchanged, report.outcome == UnionOutcome::Within);
                }
            }
        }
    }
    println!("{refused} of {asked} random unions refused, {shifted} shifted, {segments} segments of curves");
    println!("points by winding number: {counts:?}");
    assert_eq!((refused, shifted), (0, 0));
    assert!(counts[0] > 20 && counts[1] > 20 && segments > 100, "{counts:?}, {segments}");
}
