//! The decision at a single root of the volume, in exact integers: [`holds_at_root`].
//!
//! # Method
//! Notation as in [`super::decide`]. Rounded arithmetic has shown that `f` changes its sign once in an interval, so that it has one
//! root there, and it has found strict signs, at that root, of one coordinate of some of the `n_i`. At the root all
//! `n_i` are multiples of one vector or the polygon is a segment on a line that misses the origin, and in both cases that coordinate,
//! not zero for all `i`, tells whether the polygon holds the origin: if and only if it has not opposite signs for two `i`.
//!
//! What is missing is its sign for the others: that of a quadratic at the root of a cubic, one Cauchy index each, in smaller numbers than
//! the complete decision needs.

use super::moment::Sides;
use super::trajectory::{MOST_CORNERS, Place, minor, trajectories, volume};
use crate::Sign;
use crate::arithmetic::arena::Arena;
use crate::arithmetic::univariate::sign_at_root;

/// Whether the polygon holds the origin at the root of `f` in the interval, at whose ends `f` has strict and opposite
/// signs. Some of the `sides`, which are of the coordinate that the `axes` give, are known.
pub(super) fn holds_at_root(
    points: [&[[f64; 3]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    [x, y]: [usize; 2],
    sides: Sides,
    arena: &mut Arena<'_>,
) -> bool {
    let places: [Place; MOST_CORNERS] = trajectories(points, corners, interval, arena);
    let first = [0, 1, 2].map(|k| minor(&places[0], &places[1], (k + 1) % 3, (k + 2) % 3, arena));
    let volume = volume(&first, &places[corners.len() - 1], arena);
    let outer = if sides.positive != 0 { Sign::Negative } else { Sign::Positive };
    (0..corners.len()).filter(|i| (sides.positive | sides.negative) >> i & 1 == 0).all(|i| {
        let mark = arena.mark();
        let normal = minor(&places[i], &places[(i + 1) % corners.len()], x, y, arena);
        let sign = sign_at_root(&volume, &normal, arena);
        arena.keep(mark, []);
        sign != outer
    })
}
