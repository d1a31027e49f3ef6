//! Discs that overlap themselves, of which the unfolding is known: strips bent at random. In the mesh, what lies along the strip must be
//! neighbours, and what lies over each other must not.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use glam::DVec2;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::volumetric::VolumeError;
use welter_meshing::volumetric::plane::AreaMesh;

use super::{check, curves, meshed, strip};

const WIDTH: f64 = 0.6;
const SPACING: f64 = 0.1;

/// A path that bends so little that the strip along it has no fold.
fn path(seed: u64) -> Vec<[f64; 2]> {
    let bytes = stream(seed, 256);
    let mut entropy = Entropy::new(&bytes);
    let (mut at, mut angle, mut bend) = (DVec2::ZERO, 0.0, 0.0);
    let mut points = vec![at.to_array()];
    for step in 0..140 {
        if step % 12 == 0 {
            bend = f64::from(entropy.between(-20, 40)) / 40.0 * TAU / 40.0;
        }
        angle += bend;
        at += 0.12 * DVec2::from_angle(angle);
        points.push(at.to_array());
    }
    points
}

/// The number of sides between quadrilaterals from one to all others.
fn distances(area: &AreaMesh, from: u32) -> Vec<u32> {
    let mut around = vec![Vec::new(); area.mesh.nodes().len()];
    for (number, corners) in (0..).zip(area.mesh.quadrilaterals()) {
        corners.iter().for_each(|&corner| around[corner as usize].push(number));
    }
    let mut distance = vec![u32::MAX; area.mesh.len()];
    distance[from as usize] = 0;
    let mut queue = VecDeque::from([from]);
    while let Some(quadrilateral) = queue.pop_front() {
        for &corner in &area.mesh.quadrilaterals()[quadrilateral as usize] {
            for &next in &around[corner as usize] {
                if distance[next as usize] == u32::MAX {
                    distance[next as usize] = distance[quadrilateral as usize] + 1;
                    queue.push_back(next);
                }
            }
        }
    }
    distance
}

#[test]
fn bent_strips_unfold() {
    let (mut overlapping, mut refused) = (0, 0);
    for seed in 0..24 {
        let path = path(seed);
        let boundary = curves(&[strip(&path, WIDTH)]);
        assert_eq!(boundary.turning(0), [1, 1], "seed {seed}: no fold");
        let area = match meshed(&boundary, SPACING) {
            Ok(area) => area,
            Err(VolumeError::UnderResolved { .. }) => {
                refused += 1;
                continue;
            }
            Err(error) => panic!("seed {seed}: {error}"),
        };
        check(&boundary, &area);
        assert_eq!(area.mesh.components().1, [1]);
        overlapping += u32::from(area.windings.iter().any(|&w| w > 1));
        // Opposite corners of the sides are across the strip from each other, and corners far along it far in the mesh.
        let count = path.len();
        let h = area.mesh.grid().spacing();
        let host = |corner: usize| area.hosts.corners[corner].quadrilateral;
        let from_begin = distances(&area, host(0));
        for k in 0..count {
            let [right, left] =
                [k, 2 * count - 1 - k].map(|corner| f64::from(from_begin[host(corner) as usize]));
            let along = 0.12 * k as f64;
            // The shortest way within the strip is at least as long as its inner side, whose bends have a radius of more than 0.46.
            let least = along * (1.0 - 0.5 * WIDTH / (0.12 * 40.0 / TAU)) / (h * 2f64.sqrt()) - 8.0;
            let most = (along * 1.5 + 2.0 * WIDTH) * 2f64.sqrt() / h + 8.0;
            for steps in [right, left] {
                assert!(least <= steps && steps <= most, "seed {seed}, {k}: {least} {steps} {most}");
            }
        }
    }
    assert!(overlapping >= 6, "{overlapping} of the strips overlap");
    assert!(refused <= 2, "{refused} of the strips were refused");
}
