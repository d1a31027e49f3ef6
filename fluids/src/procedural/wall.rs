//! Walls that steps do not cross: [`Wall`].
//!
//! # What it computes
//! A step that ends in a solid was put there by the error of the method that made it, by another flow, or by what has been done to
//! a surface between steps. Its end is brought out along the gradient of the distance (Newton's method, one iteration for an exact
//! distance), to 2^-40 of a width beside the wall; where that fails, back along the step until it is outside. If a step begins and ends
//! outside, but the solid is in between, it ends where it met the wall. All is seen from the solid, so that it may move.
//!
//! A chord between ends outside may cut a curved wall, for the path that it stands for goes around it. So a solid is said to be
//! in between only where, beside that, the gradients at both ends make an angle of more than 120 degrees. (At a right angle, as
//! around the edge of a box, a path may go round.)
//!
//! # What it promises
//! * The end of a step that begins outside is outside, by the sign of the distance as it is computed, of walls at rest; of walls that move
//!   within the rounding of their displacement. So is that of a step that begins inside, if the gradient leads out.
//! * An end that has nothing to be mended is given back as it is, bit for bit.
//! * An end is moved by no more than it was beyond the wall, up to the second order in that, and 2^-40 of a width, where the field is a
//!   smooth distance. So orders of convergence stay. Out of a union, whose field is no distance inside, it is moved by at most 16 times as
//!   much as by the first iteration, and twice the margin, which grows where parts lead into each other.
//!
//! # What it does not promise
//! To see solids in between that are thinner than 1/1024 of the width, or whose field changes by more than one per unit of length.

use glam::DVec3;
use welter_meshing::field::ScalarField;

/// The step for finite differences that gives none.
pub(super) const NO_STEP: f64 = f64::NAN;

/// How far beside the wall an end is put, in widths. Told at the top.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// How often an end is brought out along the gradient. The margin grows fourfold each time, to 64 widths, so that neither roundings hold it
/// up nor seams, where parts of a union lead into each other.
const ITERATIONS: u32 = 24;

/// How many times farther than by the first iteration a point is brought out: from part to part of a union. Farther, it was a field that is no
/// distance which threw it there. The most that was met in tests of unions of two was 3.6.
const FARTHEST: f64 = 16.0;

/// The least length between two places of a step where the wall is looked for, in widths; and in steps after as many places.
const LEAST_LENGTH: f64 = 1.0 / 1024.0;
const MOST_PLACES: u32 = 1024;

/// The cosine of 120 degrees.
const OPPOSITE: f64 = -0.5;

/// The wall of a solid during a step.
pub(super) struct Wall<'a, S> {
    /// Negative inside.
    pub(super) solid: &'a S,
    /// How far the solid has gone at the beginning and at the end of the step.
    pub(super) displacements: [DVec3; 2],
    /// The width of the layer in which the wall changes a flow.
    pub(super) width: f64,
}

impl<S: ScalarField> Wall<'_, S> {
    /// The end of a step that does not cross the wall, from its start and the end that it would have.
    pub(super) fn confine(&self, from: DVec3, to: DVec3) -> DVec3 {
        let [before, after] = self.displacements;
        let began = self.solid.value(from - before);
        let ended = self.value(to);
        if !(began.is_finite() && ended.is_finite()) {
            return to;
        }
        // Where the solid would have taken the point.
        let start = from - before + after;
        let (outside, length) = (began >= 0.0, start.distance(to));
        let end = match ended >= 0.0 {
            true => Some(to),
            false => self.brought_out(to, outside.then_some(length)),
        };
        match end {
            // What begins inside has passed through nothing.
            Some(end) if outside => self.met(start, end).unwrap_or(end),
            Some(end) => end,
            None if outside => self.last(start, [0.0, 1.0], to),
            None => to,
        }
    }

    /// The distance at the end of the step.
    fn value(&self, position: DVec3) -> f64 {
        self.solid.value(position - self.displacements[1])
    }

    fn gradient(&self, position: DVec3) -> DVec3 {
        self.solid.gradient(position - self.displacements[1], NO_STEP)
    }

    /// Along the gradient out of the solid, if it leads there: within `reach`, where a place outside is known at that distance,
    /// else within some multiple of the first iteration.
    fn brought_out(&self, to: DVec3, reach: Option<f64>) -> Option<DVec3> {
        let (mut end, mut margin) = (to, MARGIN * self.width);
        let mut reach = reach;
        for _ in 0..ITERATIONS {
            let gradient = self.gradient(end);
            end += (margin - self.value(end)) / gradient.length_squared() * gradient;
            let gone = end.distance(to);
            let most = *reach.get_or_insert(FARTHEST * gone);
            if self.value(end) >= 0.0 {
                return (end.is_finite() && gone <= most + 2.0 * margin).then_some(end);
            }
            margin *= 4.0;
        }
        None
    }

    /// Where a straight step with both ends outside meets the wall in between.
    fn met(&self, start: DVec3, end: DVec3) -> Option<DVec3> {
        let length = start.distance(end);
        // Two balls without the solid reach each other; the rest is for roundings.
        if self.value(start).abs() + self.value(end).abs() > (1.0 + MARGIN) * length {
            return None;
        }
        let normals = [start, end].map(|place| self.gradient(place).normalize_or_zero());
        if normals[0].dot(normals[1]) >= OPPOSITE {
            return None;
        }
        let (mut done, mut places) = (0.0, 0);
        loop {
            let free = self.value(start.lerp(end, done)).abs().max(LEAST_LENGTH * self.width) / length;
            let next =
                done + if places < MOST_PLACES { free } else { free.max(1.0 / f64::from(MOST_PLACES)) };
            if next.is_nan() || next >= 1.0 {
                return None;
            }
            if self.value(start.lerp(end, next)) < 0.0 {
                return Some(self.last(start, [done, next], end));
            }
            (done, places) = (next, places + 1);
        }
    }

    /// The last place outside, by bisection between one there and one that is not, as parts of a straight step.
    fn last(&self, start: DVec3, [mut good, mut bad]: [f64; 2], end: DVec3) -> DVec3 {
        let least = MARGIN * self.width / start.distance(end);
        loop {
            let middle = 0.5 * (good + bad);
            if !(good < middle && middle < bad && bad - good > least) {
                return start.lerp(end, good);
            }
            if self.value(start.lerp(end, middle)) >= 0.0 {
                good = middle;
            } else {
                bad = middle;
            }
        }
    }
}
