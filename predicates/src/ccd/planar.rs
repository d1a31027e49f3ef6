//! Motion within a coordinate plane through the origin, in rounded numbers.
//!
//! # Method
//! All corners have a zero as one coordinate throughout, so that `f` is zero and the question is one of the plane: is
//! there a time at which the polygon holds the origin? Notation as in [`super::decide`]; [`super::moment`] has the bounds.
//!
//! ```text
//! all corners on one side of an axis            no contact in the interval
//! two n_i of strict, opposite signs             no contact in the interval
//! all n_i of one strict sign at one end         contact there
//! otherwise                                     cut in the middle
//! ```
//!
//! Of motion along a line, where two coordinates are zero throughout, the comparison of boxes is the whole truth: the
//! segment from the least to the greatest corner holds the origin at some time unless all corners are on one side of it
//! at both ends of the step (the least of linear functions is concave).

use super::corners::Corners;
use super::moment::{Moment, Sides};
use super::number::Number;

/// Halvings before the search is given up: with so many, one uniform query in ten thousand is left to integers, as the test of
/// the stages' shares counts.
const MOST_CUTS: usize = 10;

/// Intervals examined before the search is given up: around each of a few times at which an `n_i` changes its sign the ten halvings leave
/// twenty.
const MOST_INTERVALS: usize = 80;

impl<T: Number, const K: usize> Corners<T, K> {
    /// Whether there is a contact at a time in `[from, to]` of a motion in the plane of two axes; `None` if these numbers cannot
    /// tell.
    pub(super) fn examine_planar(&self, axes: [usize; 2], [from, to]: [f64; 2]) -> Option<bool> {
        let holds = |moment: &Moment<T, K>| self.sides(moment, moment, axes, Sides::UNKNOWN).agree::<K>();
        let mut low = self.at(T::of(from));
        // The right ends of the intervals that are to be examined, the next one on top.
        let mut pending = [self.at(T::of(to)); MOST_CUTS + 1];
        let mut top = 0;
        let mut open = false;
        for _ in 0..MOST_INTERVALS {
            let high = pending[top];
            if holds(&low) || holds(&high) {
                return Some(true);
            }
            let sides = self.sides(&low, &high, axes, Sides::UNKNOWN);
            let clear = sides.differ() || self.apart_between(&low, &high);
            if !clear && !sides.hopeful {
                break;
            }
            if clear || top == MOST_CUTS {
                open |= !clear;
                low = high;
                if top == 0 {
                    return (!open).then_some(false);
                }
                top -= 1;
            } else {
                top += 1;
                pending[top] = self.at(low.t.plus(&high.t).times(&T::of(0.5)));
            }
        }
        None
    }
}
