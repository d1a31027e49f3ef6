//! The exact decision of a query, in integers on the stack as large as the coordinates ask for: [`decide`].

use super::decide::{Ask, Motion};
use super::subdivision::Bracket;
use super::{ContactTimes, at_root, trajectory};
use crate::arithmetic::arena::Arena;
use crate::arithmetic::fixed_point::COORDINATE_LIMBS;

/// Limbs of an arena for one decision, per limb of a coordinate: twice the largest use, which is that of three roots or of
/// a motion in a plane, as a test measures it with coordinates of 33 limbs.
const LIMBS_PER_LIMB: usize = 2300;

/// Limbs of a time in [0, 1], in units of at least 2^-1074.
const TIME_LIMBS: usize = 17;

/// Coordinates of up to this many bits, that is most, are decided with a small arena.
const FEW_LIMBS: usize = 3;

/// The decision of [`super::decide`] within an interval, in an arena of the size that the coordinates ask for. All are finite.
#[cold]
pub(super) fn decide<const N: usize>(
    points: [&[[f64; N]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    ask: Ask,
) -> ContactTimes {
    let limbs = trajectory::limbs(points, interval);
    if limbs <= FEW_LIMBS {
        decide_within::<N, { FEW_LIMBS * LIMBS_PER_LIMB }>(points, corners, interval, ask)
    } else if limbs <= COORDINATE_LIMBS {
        decide_within::<N, { COORDINATE_LIMBS * LIMBS_PER_LIMB }>(points, corners, interval, ask)
    } else {
        decide_within::<N, { (COORDINATE_LIMBS + TIME_LIMBS) * LIMBS_PER_LIMB }>(
            points, corners, interval, ask,
        )
    }
}

#[inline(never)]
fn decide_within<const N: usize, const LIMBS: usize>(
    points: [&[[f64; N]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    ask: Ask,
) -> ContactTimes {
    let mut limbs = [0; LIMBS];
    let mut arena = Arena::new(&mut limbs);
    Motion::new(points, corners, interval, &mut arena).contact_times(ask, &mut arena)
}

/// Limbs of an arena for a decision at one root, per limb of a coordinate: twice the largest use, as a test measures it.
const LIMBS_AT_ROOT: usize = 600;

/// The decision of [`super::at_root`], in an arena of the size that the coordinates ask for. All are finite.
#[cold]
pub(super) fn holds_at_root(points: [&[[f64; 3]]; 2], corners: &[(usize, usize)], bracket: &Bracket) -> bool {
    let limbs = trajectory::limbs(points, bracket.single);
    if limbs <= FEW_LIMBS {
        holds_within::<{ FEW_LIMBS * LIMBS_AT_ROOT }>(points, corners, bracket)
    } else {
        holds_within::<{ (COORDINATE_LIMBS + TIME_LIMBS) * LIMBS_AT_ROOT }>(points, corners, bracket)
    }
}

#[inline(never)]
fn holds_within<const LIMBS: usize>(
    points: [&[[f64; 3]]; 2],
    corners: &[(usize, usize)],
    bracket: &Bracket,
) -> bool {
    let mut limbs = [0; LIMBS];
    let Bracket { single, axes, sides, .. } = *bracket;
    at_root::holds_at_root(points, corners, single, axes, sides, &mut Arena::new(&mut limbs))
}

#[cfg(test)]
mod tests {
    use super::super::moment::Sides;
    use super::super::settle::Step;
    use super::super::{EDGE_EDGE, STEP, VERTEX_FACE};
    use super::*;

    /// Pseudorandom bits.
    struct Bits(u64);

    impl Bits {
        fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            self.0 >> 33
        }

        /// As wide as coordinates can be: the largest magnitudes, some of them sharing a set with the smallest.
        fn wide(&mut self) -> f64 {
            let value = match self.next() % 8 {
                0 => f64::from_bits(self.next()),
                1 => f64::from_bits(1),
                n => f64::MAX / n as f64,
            };
            if self.next().is_multiple_of(2) { value } else { -value }
        }

        /// Grid coordinates with all degeneracies, near the largest magnitude.
        fn coarse(&mut self) -> f64 {
            (self.next() % 9) as f64 * 2f64.powi(1019) - 2f64.powi(1021)
        }
    }

    fn high_water(
        t0: &[[f64; 3]; 4],
        t1: &[[f64; 3]; 4],
        corners: &[(usize, usize)],
        limbs: &mut [u64],
    ) -> usize {
        let mut arena = Arena::new(limbs);
        Motion::new([t0, t1], corners, STEP, &mut arena).contact_times(Ask::Count, &mut arena);
        arena.high_water
    }

    #[test]
    fn arenas_are_large_enough() {
        let mut bits = Bits(11);
        let mut limbs = [0; COORDINATE_LIMBS * LIMBS_PER_LIMB];
        let mut most = 0;
        for round in 0..16 {
            let mut points: [[[f64; 3]; 4]; 2] = core::array::from_fn(|_| {
                core::array::from_fn(|_| {
                    core::array::from_fn(|_| if round % 3 == 0 { bits.wide() } else { bits.coarse() })
                })
            });
            // One coordinate of the smallest unit makes all integers as long as they can be.
            points[0][0][0] = f64::from_bits(1);
            if round % 2 == 0 {
                points.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[1]);
            }
            let corners: &[(usize, usize)] = if round % 4 < 2 { &VERTEX_FACE } else { &EDGE_EDGE };
            most = most.max(high_water(&points[0], &points[1], corners, &mut limbs));
        }
        // Half is left for what these did not reach.
        assert!(most > limbs.len() / 8 && most < limbs.len() / 2, "{most} of {}", limbs.len());
    }

    #[test]
    fn arenas_of_few_limbs_and_of_parts_are_large_enough() {
        let mut bits = Bits(5);
        let mut most = [[0; 2]; 2];
        let mut limbs = [0; (COORDINATE_LIMBS + TIME_LIMBS) * LIMBS_PER_LIMB];
        for round in 0..400 {
            let wide = round % 20 == 0 || round % 20 == 7;
            let exponents = if wide { [1019, 1021] } else { [183, 185] };
            let [step, offset] = exponents.map(|e| 2f64.powi(e));
            let mut points: Step = [[[0.0; 3]; 4]; 2];
            for x in points.as_flattened_mut().as_flattened_mut() {
                *x = (bits.next() % 9) as f64 * step - offset
                    + if wide { 0.0 } else { (bits.next() % 99) as f64 };
            }
            points[0][0] = if wide { [f64::from_bits(1); 3] } else { [1.0; 3] };
            if round % 40 < 20 {
                points.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[1]);
            }
            let interval = if wide { [f64::from_bits(1), 1.0 - f64::EPSILON / 2.0] } else { STEP };
            let corners: &[(usize, usize)] = if round % 3 == 0 { &VERTEX_FACE } else { &EDGE_EDGE };
            let ends = [&points[0][..], &points[1][..]];
            let size = trajectory::limbs([&points[0], &points[1]], interval);
            assert!(if wide { size > COORDINATE_LIMBS } else { size == FEW_LIMBS });
            for ask in [Ask::Any, Ask::Count] {
                let mut arena = Arena::new(&mut limbs);
                Motion::new([&points[0], &points[1]], corners, interval, &mut arena)
                    .contact_times(ask, &mut arena);
                most[usize::from(wide)][0] = most[usize::from(wide)][0].max(arena.high_water);
            }
            if round % 40 < 20 {
                // The volume is zero, and has no single root.
                continue;
            }
            let mut arena = Arena::new(&mut limbs);
            at_root::holds_at_root(ends, corners, interval, [0, 1], Sides::UNKNOWN, &mut arena);
            most[usize::from(wide)][1] = most[usize::from(wide)][1].max(arena.high_water);
        }
        for (most, capacity) in most.into_iter().zip([FEW_LIMBS, COORDINATE_LIMBS + TIME_LIMBS]) {
            assert!(most[0] < capacity * LIMBS_PER_LIMB / 2, "{most:?} for {capacity}");
            assert!(most[1] < capacity * LIMBS_AT_ROOT / 2, "{most:?} for {capacity}");
        }
    }
}
