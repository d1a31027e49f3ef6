//! [`Crossings`]: where the surface crosses an edge of the grid.
//!
//! # What it promises
//! A sample lies on its edge exactly and strictly between the ends: one coordinate is changed from that of a node, and the nodes are exact. It is at least the
//! margin away from both ends, but for its rounding, which takes no more than a quarter of the margin. Three samples on different edges of a cell are
//! never on one line: a line that meets the cell's boundary thrice lies in the plane of a face, and meets the face's rim twice or runs along an edge.
//!
//! # Method
//! The zero of the linear interpolant; with a field at hand, then the root of the field on the edge by the Illinois variant of the false position
//! \[Dowell71\], with a bisection at every third step. Both are symmetric in sign: the negative field has the same samples.
//! Where the field is NaN on an edge the linear interpolant decides.

use super::{IsosurfaceError, MarchingCubes};
use crate::DVec3;
use crate::grid::{Grid, Samples};

/// Length of the part of an edge to which a root is narrowed down, in edges: a few gaps of numbers for a grid of moderate size about the origin.
const ROOT_TOLERANCE: f64 = 1.0 / (1_u64 << 44) as f64;

/// Most steps of root finding on an edge: by bisections alone, which are every third step, 44 of them reach the tolerance.
const MAX_STEPS: usize = 3 * 44 + 3;

/// Finds samples.
pub(super) struct Crossings<'a> {
    pub(super) samples: &'a Samples<3>,
    pub(super) parameters: &'a MarchingCubes<'a>,
}

impl Crossings<'_> {
    /// The sample on the edge along `axis` from a node; its ends have different signs.
    pub(super) fn at(&self, axis: usize, node: [u32; 3]) -> DVec3 {
        let grid = self.samples.grid();
        let mut end = node;
        end[axis] += 1;
        let values = [node, end].map(|n| self.samples.at(n));
        let at = level_between(values, self.parameters.level);
        let start = grid.position(node);
        let place = |t: f64| {
            let mut point = start;
            point[axis] += t * grid.spacing();
            point
        };
        let at = match self.parameters.roots_of {
            Some(field) => self.root(values, at, |t| field.value(place(t)) - self.parameters.level),
            None => at,
        };
        // The margin is many gaps of numbers wide (see `require_room`), so rounding does not reach a node.
        place(at.clamp(self.parameters.margin, 1.0 - self.parameters.margin))
    }

    /// The root of `f` on an edge, between whose ends it has other signs.
    fn root(&self, values: [f64; 2], guess: f64, f: impl Fn(f64) -> f64) -> f64 {
        let is_negative = |v: f64| v < 0.0;
        let [mut fa, mut fb] = values.map(|v| v - self.parameters.level);
        let (mut a, mut b) = (0.0, 1.0);
        let first_is_negative = is_negative(fa);
        let mut at = guess;
        for step in 0..MAX_STEPS {
            let value = f(at);
            if value == 0.0 || value.is_nan() {
                return if value == 0.0 { at } else { guess };
            }
            let kept_a = is_negative(value) != first_is_negative;
            if kept_a {
                (b, fb) = (at, value);
            } else {
                (a, fa) = (at, value);
            }
            if b - a <= ROOT_TOLERANCE {
                break;
            }
            // Illinois: the end that stays counts half, so that it does not stay for good.
            if kept_a {
                fa *= 0.5;
            } else {
                fb *= 0.5;
            }
            let secant = a + (b - a) * (fa / (fa - fb));
            let inside = secant > a && secant < b;
            let next = if inside && step % 3 != 2 { secant } else { 0.5 * (a + b) };
            at = next;
        }
        0.5 * (a + b)
    }
}

/// Where on an edge, from 0 to 1, the linear interpolant of its ends has a level: in the limit, at the finite end if the other is infinite.
pub(super) fn level_between(values: [f64; 2], level: f64) -> f64 {
    // Halves, so that no difference overflows.
    let [a, b] = values.map(|v| 0.5 * v - 0.5 * level);
    if a.is_infinite() && b.is_finite() {
        return 1.0;
    }
    let at = 0.5 * a / (0.5 * a - 0.5 * b);
    // Both infinite, or a difference below the smallest number.
    if at.is_nan() { 0.5 } else { at }
}

/// Refuses a grid on which the margin is not at least two gaps of numbers wide.
pub(super) fn require_room<const D: usize>(grid: &Grid<D>, margin: f64) -> Result<(), IsosurfaceError> {
    let spacing = grid.spacing();
    for axis in 0..D {
        let coordinate = grid.origin()[axis].abs().max(grid.max()[axis].abs());
        let gap = coordinate.next_up() - coordinate;
        if 2.0 * gap > margin * spacing {
            return Err(IsosurfaceError::TooFine { axis, coordinate, gap, spacing });
        }
    }
    Ok(())
}
