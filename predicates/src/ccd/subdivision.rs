//! The decision in rounded numbers: the step is cut into intervals until each is clear, or hopeless.
//!
//! # Method
//! Notation as in [`super::decide`]; [`super::moment`] has the bounds.
//!
//! ```text
//! Bernstein coefficients of f of one strict sign        no contact in the interval
//! two n_i of strict, opposite signs throughout          no contact in the interval
//! f changes its sign once                               the bracket of its root shrinks until two n_i differ:
//!                                                       no contact; or all agree: a contact
//! otherwise                                             cut in the middle
//! ```
//!
//! A bracket shrinks by secants, the weight of an end that stays being halved (the Illinois rule), and in the end around the
//! root by what the error of `f` leaves open. What is not clear then is a [`Bracket`]: the caller can go on with it in
//! numbers of more digits. An interval that is not clear after [`MOST_CUTS`] cuts is left to a decision of another kind.
//!
//! The time of a secant may round out of its bracket, by a unit: `f` changes by at most 36u of the product of the magnitudes there, and a certain sign
//! needs 200u, so that it is still that of a time inside.
//!
//! # Promises
//! A decision is right. The number of operations is bounded by a constant.

use super::corners::Corners;
use super::moment::{Moment, Sides, certain};
use super::number::Number;
use crate::Sign;

/// Halvings of the step before the search is given up: with so many, one uniform query in ten thousand is left to more digits, as
/// the test of the stages' shares counts.
const MOST_CUTS: usize = 8;

/// Evaluations while a bracket shrinks: the Illinois rule gains a factor of 1.44 of the digits each time, and 53
/// digits take about ten.
const MOST_EVALUATIONS: usize = 14;

/// A cubic has no more roots.
const MOST_BRACKETS: usize = 3;

/// An interval with one root of `f`, at which it is open whether the polygon holds the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    /// The root is the only one between these times, at which `f` has strict and opposite signs.
    pub(super) single: [f64; 2],
    /// The same, as narrow as the numbers allow.
    pub(super) interval: [f64; 2],
    /// The coordinates that give the sides.
    pub(super) axes: [usize; 2],
    /// What is known of them.
    pub(super) sides: Sides,
}

/// What is known of a step.
pub(super) enum Verdict {
    /// Whether there is a contact.
    Decided(bool),
    /// There is a contact if and only if there is one in one of the brackets.
    Brackets([Option<Bracket>; MOST_BRACKETS]),
    /// Nothing.
    Open,
}

impl Verdict {
    /// True when it is certain that there is no contact.
    pub(super) fn excludes_contact(&self) -> bool {
        matches!(self, Self::Decided(false))
    }
}

/// Examines a bracket or shrinks it no further.
enum Shrunk {
    Contact,
    Apart,
    Stuck(Bracket),
}

impl<T: Number, const K: usize> Corners<T, K> {
    /// Whether there is a contact at a time in `[from, to]`, as far as so many intervals tell.
    pub(super) fn examine(&self, [from, to]: [f64; 2], most_intervals: usize) -> Verdict {
        let mut low = self.at(T::of(from));
        // The right ends of the intervals that are to be examined, the next one on top.
        let mut pending = [self.at(T::of(to)); MOST_CUTS + 1];
        let mut top = 0;
        let mut brackets = [None; MOST_BRACKETS];
        let mut count = 0;
        let mut open = false;
        for _ in 0..most_intervals {
            let high = pending[top];
            let signs = self.volume_signs(&low, &high);
            let [first, second, third, last] = signs;
            let steady = !first.is_zero() && signs == [first; 4];
            let mut clear = steady;
            if !steady {
                let axes = self.dominant_axes(&low, &high);
                let single = !first.is_zero() && first == -last && (second == first || third == last);
                if single {
                    clear = true;
                    match self.shrink([low, high], axes, Sides::UNKNOWN) {
                        Shrunk::Contact => return Verdict::Decided(true),
                        Shrunk::Apart => {}
                        Shrunk::Stuck(bracket) if count < MOST_BRACKETS => {
                            brackets[count] = Some(bracket);
                            count += 1;
                        }
                        Shrunk::Stuck(_) => open = true,
                    }
                } else {
                    clear = self.sides(&low, &high, axes, Sides::UNKNOWN).differ();
                    if !clear && signs == [Sign::Zero; 4] {
                        // The volume is below its error on all parts of this interval.
                        return Verdict::Open;
                    }
                }
            }
            if clear || top == MOST_CUTS {
                open |= !clear;
                low = high;
                if top == 0 {
                    return match (open, count) {
                        (true, _) => Verdict::Open,
                        (_, 0) => Verdict::Decided(false),
                        _ => Verdict::Brackets(brackets),
                    };
                }
                top -= 1;
            } else {
                // An `f64`, for the ends of a bracket are taken on as such, and the root must stay between them.
                let middle = low.t.plus(&high.t).leading() * 0.5;
                top += 1;
                pending[top] = self.at(T::of(middle));
            }
        }
        Verdict::Open
    }

    /// Whether there is a contact in a bracket; `None` if these numbers cannot tell.
    pub(super) fn examine_bracket(&self, bracket: &Bracket) -> Option<bool> {
        let ends = bracket.interval.map(|t| self.at(T::of(t)));
        match self.shrink(ends, bracket.axes, bracket.sides) {
            Shrunk::Contact => Some(true),
            Shrunk::Apart => Some(false),
            Shrunk::Stuck(_) => None,
        }
    }

    /// Shrinks a bracket with one root of `f`, at whose ends `f` has strict and opposite signs.
    fn shrink(&self, [mut low, mut high]: [Moment<T, K>; 2], axes: [usize; 2], known: Sides) -> Shrunk {
        let single = [low.t.leading(), high.t.leading()];
        let error = self.volume_error();
        let sign_low = certain(low.volume.leading(), error);
        let mut sides = known;
        let mut weights = [1.0, 1.0];
        let mut replaced = None;
        for _ in 0..MOST_EVALUATIONS {
            sides = self.sides(&low, &high, axes, sides);
            if sides.differ() {
                return Shrunk::Apart;
            }
            if sides.agree::<K>() {
                return Shrunk::Contact;
            }
            if !sides.hopeful {
                break;
            }
            let middle = self.at(secant(&low, &high, weights));
            let sign = certain(middle.volume.leading(), error);
            if sign.is_zero() {
                let Some(tight) = self.around(&middle, &low, &high) else { break };
                [low, high] = tight;
                sides = self.sides(&low, &high, axes, sides);
                break;
            }
            // The end that stays for a second time counts half.
            let side = usize::from(sign != sign_low);
            weights[side] = 1.0;
            weights[1 - side] *= if replaced == Some(side) { 0.5 } else { 1.0 };
            replaced = Some(side);
            if side == 0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        // At last along all axes: the vector area may have turned since these were chosen.
        let [x, y] = axes;
        for other in [[x, y], [y, 3 - x - y], [3 - x - y, x]] {
            let sides = if other == axes { sides } else { self.sides(&low, &high, other, Sides::UNKNOWN) };
            if sides.differ() {
                return Shrunk::Apart;
            }
            if sides.agree::<K>() {
                return Shrunk::Contact;
            }
        }
        let interval = [low.t.leading(), high.t.leading()];
        Shrunk::Stuck(Bracket { single, interval, axes, sides })
    }

    /// A narrow bracket around a time within another, at which `f` is zero as far as these numbers can tell.
    fn around(
        &self,
        middle: &Moment<T, K>,
        low: &Moment<T, K>,
        high: &Moment<T, K>,
    ) -> Option<[Moment<T, K>; 2]> {
        let error = self.volume_error();
        let width = high.t.minus(&low.t).leading();
        let slope = (high.volume.leading() - low.volume.leading()).abs() / width;
        // Where f has passed its error bound twice, if it is straight.
        let reach = T::of(4.0 * error / slope);
        let narrowed = |t: T, end: &Moment<T, K>, inside: bool| {
            let candidate = if inside { self.at(t) } else { return *end };
            let same = certain(candidate.volume.leading(), error) == certain(end.volume.leading(), error);
            if same { candidate } else { *end }
        };
        let (before, after) = (middle.t.minus(&reach), middle.t.plus(&reach));
        let is_before = |a: T, b: T| b.minus(&a).leading() > 0.0;
        let ends = [
            narrowed(before, low, is_before(low.t, before)),
            narrowed(after, high, is_before(after, high.t)),
        ];
        is_before(ends[0].t, ends[1].t).then_some(ends)
    }
}

/// Where the line through the weighted volumes at two times is zero; the middle if that is not between them.
fn secant<T: Number, const K: usize>(
    low: &Moment<T, K>,
    high: &Moment<T, K>,
    [low_weight, high_weight]: [f64; 2],
) -> T {
    let (a, b) = (low_weight * low.volume.leading(), high_weight * high.volume.leading());
    let fraction = a / (a - b);
    let fraction = if fraction > 0.0 && fraction < 1.0 { fraction } else { 0.5 };
    low.t.plus(&high.t.minus(&low.t).times(&T::of(fraction)))
}
