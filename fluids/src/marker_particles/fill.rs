//! Points that fill a closed surface evenly: [`fill`].
//!
//! # What it computes
//! Points of the sequence of \[Halton60\] in the box around the surface, of which those are kept that the surface winds around at least
//! once: the digits of the numbers 0, 1, 2, ... in bases 2, 3 and 5, read backward behind the point. Each coordinate is shifted, modulo
//! the side of the box \[Cranley76\], by an amount that comes from a seed, so that one release does not have its points where another
//! has them.
//!
//! # What it promises
//! * Each point is inside, exactly: winding numbers are.
//! * The points depend on the surface, the number of them and the seed alone; a larger number has a smaller one as its beginning.
//! * All coordinates times a power of two give the points times that power, bit for bit, as long as nothing is below the smallest
//!   normal number.
//!
//! # What it does not promise
//! * Points in proportion to winding numbers where the surface overlaps itself: what counts is whether there is smoke.
//! * Points without order: a flow that stretches them makes what order they have visible.
//!
//! # Complexity
//! Box over inside times the number of points, each with a ray through the surface.

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Box3, Winding, WindingNumbers};
use welter_meshing::surface::ClosedOrientedMesh;

use super::Unfilled;

/// How many points are tried for each that is wanted before a surface counts as too thin for its box.
const MOST_TRIES: u64 = 1 << 12;

/// Points that are tried at a time, at least and at most.
const BATCH: (u64, u64) = (1 << 10, 1 << 20);

/// A number of points inside a closed surface, evenly spread; `seed` tells apart what else would be the same.
///
/// ```
/// use welter_fluids::marker_particles::fill;
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
/// let ball = sphere(&Sphere { radius: 2.0, edge_length: 0.5, ..Sphere::default() })?;
/// let points = fill(&ball, 1000, 7, &Monitor::none())?;
/// assert_eq!(points.len(), 1000);
/// assert!(points.iter().all(|p| p.length() < 2.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Unfilled`]: the surface fills so little of its box that the points are not found, or the monitor asked to stop.
pub fn fill(
    surface: &ClosedOrientedMesh,
    count: usize,
    seed: u64,
    monitor: &Monitor<'_>,
) -> Result<Vec<DVec3>, Unfilled> {
    let around = Box3::of(surface.positions().iter().copied());
    let numbers = WindingNumbers::new(surface);
    let shift = shift(seed);
    let (wanted, most) = (count as u64, MOST_TRIES.saturating_mul((count as u64).max(1)));
    let mut points = Vec::with_capacity(count);
    let mut tried = 0;
    while points.len() < count {
        if tried >= most || around.is_empty() {
            return Err(Unfilled::Thin { wanted: count, inside: points.len(), tried });
        }
        // What is missing, by the share that was inside so far; how much that is does not change the points.
        let found = points.len() as u64;
        let missing = (wanted - found) as f64 * ((tried + 1) as f64 / (found + 1) as f64);
        let batch = (missing as u64).clamp(BATCH.0, BATCH.1).min(most - tried);
        let candidates: Vec<DVec3> =
            (tried..tried + batch).map(|j| place(&around, element(j, shift))).collect();
        let windings = numbers.at_all(&candidates, monitor)?;
        let inside = candidates.iter().zip(windings).filter(|(_, w)| matches!(w, Winding::Number(1..)));
        points.extend(inside.map(|(&point, _)| point).take(count - points.len()));
        tried += batch;
    }
    Ok(points)
}

/// How far each coordinate of a sequence is shifted, a multiple of 2^-53 in [0, 1), by the mixer of \[Steele14\].
fn shift(seed: u64) -> [f64; 3] {
    [1, 2, 3].map(|axis: u64| {
        let z = seed.wrapping_mul(4).wrapping_add(axis).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    })
}

/// An element of the sequence, shifted, in [0, 1).
fn element(index: u64, shift: [f64; 3]) -> DVec3 {
    let part = |axis: usize, base: u64| {
        let sum = radical_inverse(index, base) + shift[axis];
        if sum < 1.0 { sum } else { sum - 1.0 }
    };
    DVec3::new(part(0, 2), part(1, 3), part(2, 5))
}

/// The digits of a number in a base, read backward behind the point.
fn radical_inverse(mut number: u64, base: u64) -> f64 {
    let (mut reversed, mut power) = (0.0, 1.0);
    while number > 0 {
        reversed = reversed * base as f64 + (number % base) as f64;
        power *= base as f64;
        number /= base;
    }
    reversed / power
}

/// A part of the way across a box along each axis; no difference, so nothing overflows.
fn place(around: &Box3, part: DVec3) -> DVec3 {
    around.min * (DVec3::ONE - part) + around.max * part
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::shapes::{Box_, Sphere, box_, sphere};
    use welter_meshing::surface::TriMesh;

    #[test]
    fn cubes_hold_points_in_proportion_to_their_volume() {
        let room = box_(&Box_ { min: DVec3::ZERO, max: DVec3::splat(4.0), edge_length: 1.0 }).unwrap();
        let count = 64 * 500;
        let mut cells = [0_i32; 64];
        for point in fill(&room, count, 3, &Monitor::none()).unwrap() {
            let [i, j, k] = point.to_array().map(|c| c as usize);
            cells[(i * 4 + j) * 4 + k] += 1;
        }
        // Random points would be off by 22 in the mean, and by some 60 in the worst of 64 cells.
        let worst = cells.iter().map(|n| (n - 500).abs()).max();
        assert!(worst <= Some(15), "{cells:?}");
    }

    #[test]
    fn digits_are_read_backward() {
        assert_eq!([0, 1, 2, 3, 6].map(|n| radical_inverse(n, 2)), [0.0, 0.5, 0.25, 0.75, 0.375]);
        assert_eq!([1, 2, 3, 5].map(|n| radical_inverse(n, 3)), [1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0, 7.0 / 9.0]);
    }

    #[test]
    fn more_points_begin_with_fewer_and_seeds_differ() {
        let ball = sphere(&Sphere { edge_length: 0.5, ..Sphere::default() }).unwrap();
        let few = fill(&ball, 100, 1, &Monitor::none()).unwrap();
        let many = fill(&ball, 5000, 1, &Monitor::none()).unwrap();
        assert_eq!(few, many[..100]);
        let other = fill(&ball, 100, 2, &Monitor::none()).unwrap();
        assert!(few.iter().all(|p| !other.contains(p)));
    }

    #[test]
    fn nothing_is_found_in_what_has_no_inside() {
        let mut soup = sphere(&Sphere { edge_length: 0.5, ..Sphere::default() }).unwrap().as_mesh().to_soup();
        soup.positions.iter_mut().for_each(|p| p.z = 0.5);
        let flat = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
        let unfilled = fill(&flat, 2, 0, &Monitor::none());
        assert_eq!(unfilled, Err(Unfilled::Thin { wanted: 2, inside: 0, tried: 2 * MOST_TRIES }));
        assert_eq!(fill(&flat, 0, 0, &Monitor::none()), Ok(Vec::new()));
    }
}
