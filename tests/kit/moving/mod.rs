//! Surfaces that move: [`scenes`] of closed and open surfaces that are embedded, violent [`ends`], and the slow twin of
//! collision resolution's checks, [`first_collision`]; and whether solids are nested in solids, [`misplaced_components`].

mod nesting;
mod scenes;
mod twin;

pub use nesting::misplaced_components;
pub use scenes::{Scene, mean_edge_length, scenes, sheet, stack};
pub use twin::{collisions, first_collision};

use crate::mesher::Random;
use glam::DVec3;
use welter_tracking::surface::MovingSurface;

/// Predicted ends that go up to some distance, of a kind by chance: noise of all vertices or of some, one shift, a scaling
/// towards or through a point, a shear, a turn, places exchanged, all to one point.
#[must_use]
pub fn ends(surface: &MovingSurface, random: &mut Random, distance: f64) -> Vec<DVec3> {
    let positions = surface.positions();
    let (kind, centre, direction) = (random.below(9), random.point(), random.point());
    let factor = random.between(-2.0, 2.0);
    let some = random.below(20) + 1;
    let mut noise = || random.point();
    match kind {
        0 | 1 => positions.iter().map(|&p| p + distance * noise()).collect(),
        2 => {
            let moves = |(i, &p): (usize, &DVec3)| {
                let by = noise();
                if (i as u64).is_multiple_of(some) { p + distance * by } else { p }
            };
            positions.iter().enumerate().map(moves).collect()
        }
        3 => positions.iter().map(|&p| p + distance * direction).collect(),
        4 => positions.iter().map(|&p| p + distance * factor * (centre - p)).collect(),
        5 => positions.iter().map(|&p| p + distance * (p.z - centre.z) * direction).collect(),
        6 => positions.iter().map(|&p| p + distance * direction.cross(p - centre)).collect(),
        7 => {
            let n = positions.len();
            (0..n)
                .map(|i| positions[i].lerp(positions[(i + 1 + some as usize) % n], distance.min(1.0)))
                .collect()
        }
        _ => {
            // All the way only now and then: exact arithmetic decides all pairs then.
            let part = distance.min(if some == 1 { 1.0 } else { 0.98 });
            positions.iter().map(|&p| p.lerp(centre, part)).collect()
        }
    }
}
