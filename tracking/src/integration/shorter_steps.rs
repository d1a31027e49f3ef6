//! The last means: shorter steps ([`shortened`], [`fraction_of_a_few_lengths`]), and vertices that stay where they are
//! ([`rest`]).
//!
//! # What it promises
//! [`rest`] always ends without a collision: on a surface that is embedded, elements that do not move do not touch, and each round
//! takes vertices out of motion.

use super::IntegrationError;
use super::step::Step;
use crate::surface::MovingSurface;
use glam::DVec3;
use welter_meshing::surface::VertexId;

/// After so many rounds all vertices rest. The part that rests grows by one ring of edges more in each round, so these reach
/// everything within some two thousand edges.
const MOST_ROUNDS: usize = 64;

/// A step that is crowded is cut to so many reference lengths: within those, a vertex meets some dozens of elements.
const FEW_LENGTHS: i32 = 4; // 2^4

/// The ends of a part of the step, which is a power of two.
pub(super) fn shortened(surface: &MovingSurface, ends: &[DVec3], fraction: f64) -> Vec<DVec3> {
    let part = |(&from, &to): (&DVec3, &DVec3)| {
        if fraction == 1.0 {
            return to;
        }
        let way = to - from;
        if way.is_finite() { from + fraction * way } else { (1.0 - fraction) * from + fraction * to }
    };
    surface.positions().iter().zip(ends).map(part).collect()
}

/// The largest power of two, not above a given one, with which no vertex goes farther than some reference lengths along an axis;
/// the given one for a length of 0.
pub(super) fn fraction_of_a_few_lengths(
    surface: &MovingSurface,
    ends: &[DVec3],
    length: f64,
    fraction: f64,
) -> f64 {
    let half_way = |v: VertexId| (0.5 * ends[v.index()] - 0.5 * surface.position(v)).abs().max_element();
    let farthest = surface.connectivity().vertices().map(half_way).fold(0.0, f64::max);
    if length == 0.0 {
        return fraction;
    }
    let exponent = |x: f64| libm::frexp(x).1;
    let halvings = exponent(farthest) + 1 - exponent(length) - FEW_LENGTHS;
    fraction.min(libm::scalbn(1.0, -halvings.clamp(0, 1000)))
}

/// Lets the vertices of what collides stay where they are, and those around them, until nothing collides.
pub(super) fn rest(step: &mut Step<'_>) -> Result<(), IntegrationError> {
    let mesh = step.surface.connectivity();
    let mut resting = vec![false; mesh.vertex_slots()];
    for round in 0.. {
        step.detect()?;
        if !step.collides() {
            break;
        }
        let mut front: Vec<VertexId> = if step.is_crowded() || round == MOST_ROUNDS {
            mesh.vertices().collect()
        } else {
            step.colliding().iter().flat_map(|pair| pair.vertices(mesh)).collect()
        };
        for ring in 0..=round {
            let mut next = Vec::new();
            for v in front {
                // Around vertices of former rounds, too.
                if !resting[v.index()] {
                    resting[v.index()] = true;
                    step.set_end(v, step.surface.position(v));
                }
                if ring < round {
                    next.extend(mesh.star(v).map(|h| mesh.head(h)));
                }
            }
            next.sort_unstable();
            next.dedup();
            front = next;
        }
        if round > MOST_ROUNDS {
            break; // The surface was not embedded: nothing moves, and pairs that do not move are not asked about.
        }
    }
    step.report.resting_vertices += resting.iter().filter(|&&is| is).count();
    Ok(())
}
