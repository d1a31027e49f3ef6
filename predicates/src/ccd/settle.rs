//! The stages of a collision query, in order: [`Query`].

use super::corners::Corners;
use super::decide::Ask;
use super::moment::{LEAST, MOST};
use super::number::Number;
use super::stage::Stage;
use super::subdivision::{Bracket, Verdict};
use super::{ContactTimes, STEP, exact};
use crate::arithmetic::double_double::DoubleDouble;
use crate::arithmetic::scaled::power_of_two;

/// The places of four points at the beginning and at the end of a step.
pub(super) type Step = [[[f64; 3]; 4]; 2];

/// What no copy of the coordinates is needed for: boxes and the likeliest directions. The stage that tells that there is no contact.
#[inline(always)]
pub(super) fn culled<const K: usize>(
    t0: &[[f64; 3]; 4],
    t1: &[[f64; 3]; 4],
    corners: &[(usize, usize); K],
) -> Option<Stage> {
    if boxes_apart::<K>(t0, t1) {
        return Some(Stage::Boxes);
    }
    let corners = Corners::new([t0, t1], corners, None);
    (corners.separated_by_first_normal() || corners.separated_by_centre()).then_some(Stage::Direction)
}

/// True when, along some axis, all corners are strictly on one side of the origin at both ends of the step, and so
/// throughout. Compares coordinates; nothing is rounded.
#[inline(always)]
pub(super) fn boxes_apart<const K: usize>(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4]) -> bool {
    let mut apart = false;
    for k in 0..3 {
        // The corners are all differences of one of the first points and one of the others.
        let [a, b] = [t0, t1].map(|p| Spread::of::<K>([p[0][k], p[1][k], p[2][k], p[3][k]]));
        apart |= (a.low > a.other_high) & (b.low > b.other_high);
        apart |= (a.high < a.other_low) & (b.high < b.other_low);
    }
    apart
}

/// The extents of two primitives along an axis.
struct Spread {
    low: f64,
    high: f64,
    other_low: f64,
    other_high: f64,
}

impl Spread {
    /// Of a vertex and a face for three corners, of two edges for four.
    #[inline(always)]
    fn of<const K: usize>([p, q, r, s]: [f64; 4]) -> Self {
        let least = |a: f64, b: f64| if a < b { a } else { b };
        let most = |a: f64, b: f64| if a > b { a } else { b };
        let (low, high) = (least(r, s), most(r, s));
        if K == 3 {
            Self { low: least(low, q), high: most(high, q), other_low: p, other_high: p }
        } else {
            Self { low, high, other_low: least(p, q), other_high: most(p, q) }
        }
    }
}

/// Two moving primitives: whether and when they touch is whether and when a polygon of `K` corners holds the origin.
pub(super) struct Query<'s, const K: usize, E> {
    pub(super) step: &'s Step,
    /// The corners: `(i, j)` stands for point `i` less point `j`.
    pub(super) corners: &'static [(usize, usize); K],
    /// Whether the primitives touch when they are at rest.
    pub(super) touch: fn([[f64; 3]; 4]) -> bool,
    /// The exact decision within an interval of the step; of motion in the plane of two axes, if they are given.
    pub(super) exact: E,
}

/// Intervals that `f64` may take: eight halvings towards one time leave 17.
const MOST_INTERVALS: usize = 24;

/// The same for double-double numbers, whose intervals cost a microsecond each: what is left to these has mostly one root, which the
/// first interval brackets, and the integers after them cost as much as eight.
const MOST_FINE_INTERVALS: usize = 8;

impl<const K: usize, E: Fn([f64; 2], Ask, Option<[usize; 2]>) -> ContactTimes> Query<'_, K, E> {
    /// Whether there is a contact in the closed interval, which is a part of the step, after [`culled`] has said nothing.
    pub(super) fn settle(&self, interval: [f64; 2]) -> (bool, Stage) {
        let corners = self.rounded(None);
        if corners.separated_otherwise() {
            return (false, Stage::Direction);
        }
        if corners.in_range() {
            return self.settle_in_space(&corners, None, interval);
        }
        if !self.is_finite() {
            return (false, Stage::NonFinite);
        }
        self.settle_out_of_range(&corners, interval)
    }

    /// The contact times, after [`culled`] has said nothing.
    pub(super) fn contact_times(&self) -> ContactTimes {
        let corners = self.rounded::<f64>(None);
        let clear = || corners.in_range() && corners.examine(STEP, MOST_INTERVALS).excludes_contact();
        if corners.separated_otherwise() || !self.is_finite() || clear() {
            return ContactTimes::Finite(0);
        }
        (self.exact)(STEP, Ask::Count, plane_of(corners.maxima.map(|m| m == 0.0)))
    }

    #[inline(always)]
    fn rounded<T: Number>(&self, scale: Option<[f64; 3]>) -> Corners<T, K> {
        Corners::new([&self.step[0], &self.step[1]], self.corners, scale)
    }

    fn is_finite(&self) -> bool {
        all_finite(&self.step[0], &self.step[1])
    }

    /// For coordinates that are zero throughout, or near the ends of the exponent range.
    fn settle_out_of_range(&self, corners: &Corners<f64, K>, interval: [f64; 2]) -> (bool, Stage) {
        let scale = self.scale();
        let scaled = self.rounded(Some(scale));
        let axes = match corners.maxima.map(|m| m == 0.0) {
            [false, false, false] if scaled.separated_otherwise() => return (false, Stage::Direction),
            [false, false, false] if scaled.in_range() => {
                return self.settle_in_space(&scaled, Some(scale), interval);
            }
            // Along a line the boxes, which are not apart, are the whole truth: see `planar`.
            zeros if interval == STEP && zeros.into_iter().filter(|&zero| zero).count() > 1 => {
                return (true, Stage::Boxes);
            }
            zeros => match plane_of(zeros) {
                Some(axes) => axes,
                None => return (self.decide(interval, None), Stage::Exact),
            },
        };
        // Coordinates that differ much less at one end than they measure at the other are lost by scaling.
        let in_range = axes.iter().all(|&k| (LEAST..=MOST).contains(&scaled.maxima[k]));
        if in_range && let Some(contact) = scaled.examine_planar(axes, interval) {
            return (contact, Stage::Subdivision);
        }
        self.settle_ends(interval).unwrap_or_else(|| (self.decide(interval, Some(axes)), Stage::Exact))
    }

    /// Rounded numbers, then contact at the ends, then more digits, then exact integers.
    fn settle_in_space(
        &self,
        corners: &Corners<f64, K>,
        scale: Option<[f64; 3]>,
        interval: [f64; 2],
    ) -> (bool, Stage) {
        let verdict = corners.examine(interval, MOST_INTERVALS);
        if let Verdict::Decided(contact) = verdict {
            return (contact, Stage::Subdivision);
        }
        if !self.is_finite() {
            return (false, Stage::NonFinite);
        }
        if let Some(settled) = self.settle_ends(interval) {
            return settled;
        }
        match self.examine_finely(verdict, scale, interval) {
            Verdict::Decided(contact) => (contact, Stage::DoubleDouble),
            Verdict::Brackets(brackets) => {
                (brackets.iter().flatten().any(|bracket| self.decide_at_root(bracket)), Stage::Exact)
            }
            Verdict::Open => (self.decide(interval, None), Stage::Exact),
        }
    }

    /// A contact at an end of the step.
    fn settle_ends(&self, interval: [f64; 2]) -> Option<(bool, Stage)> {
        let touches = interval == STEP && self.step.iter().any(|&places| (self.touch)(places));
        touches.then_some((true, Stage::Ends))
    }

    /// In double-double numbers: the brackets that are left, or the whole interval.
    #[inline(never)]
    fn examine_finely(&self, verdict: Verdict, scale: Option<[f64; 3]>, interval: [f64; 2]) -> Verdict {
        let fine: Corners<DoubleDouble, K> = self.rounded(scale);
        let Verdict::Brackets(mut brackets) = verdict else {
            return fine.examine(interval, MOST_FINE_INTERVALS);
        };
        for bracket in &mut brackets {
            match bracket.as_ref().map(|bracket| fine.examine_bracket(bracket)) {
                Some(Some(true)) => return Verdict::Decided(true),
                Some(Some(false)) => *bracket = None,
                _ => {}
            }
        }
        if brackets.iter().all(Option::is_none) {
            Verdict::Decided(false)
        } else {
            Verdict::Brackets(brackets)
        }
    }

    /// Exact integers, at the root of a bracket.
    fn decide_at_root(&self, bracket: &Bracket) -> bool {
        if bracket.sides.positive | bracket.sides.negative == 0 {
            return self.decide(bracket.single, None);
        }
        let [t0, t1] = self.step;
        exact::holds_at_root([t0, t1], self.corners, bracket)
    }

    /// Exact integers, within an interval; of motion in the plane of two axes, if they are given.
    fn decide(&self, interval: [f64; 2], axes: Option<[usize; 2]>) -> bool {
        (self.exact)(interval, Ask::Any, axes).any()
    }

    /// Powers of two, one for each axis, that bring the coordinates below 1, but for the smallest, which become larger
    /// than 2^-100. Contact does not depend on the scale of an axis. All coordinates are finite.
    fn scale(&self) -> [f64; 3] {
        core::array::from_fn(|k| {
            let places = self.step.as_flattened();
            let largest = places.iter().fold(0.0, |m: f64, p| if p[k].abs() > m { p[k].abs() } else { m });
            let exponent = (largest.to_bits() >> 52) as i32 - 1022;
            power_of_two((-exponent).clamp(-1000, 1000))
        })
    }
}

/// True when the culling stages exclude contact.
#[inline]
pub(super) fn never<const K: usize>(
    t0: &[[f64; 3]; 4],
    t1: &[[f64; 3]; 4],
    corners: &[(usize, usize); K],
) -> bool {
    culled(t0, t1, corners).is_some() || Corners::new([t0, t1], corners, None).separated_otherwise()
}

/// True when, along an axis of the plane, the segment is strictly on one side of the vertex at both ends of the step.
pub(super) fn boxes_apart_in_plane(t0: &[[f64; 2]; 3], t1: &[[f64; 2]; 3]) -> bool {
    (0..2).any(|k| {
        let all = |apart: fn(f64, f64) -> bool| {
            [t0, t1].iter().all(|p| apart(p[1][k], p[0][k]) && apart(p[2][k], p[0][k]))
        };
        all(|x, y| x < y) || all(|x, y| x > y)
    })
}

/// True when all coordinates are finite.
pub(super) fn all_finite<const N: usize, const P: usize>(t0: &[[f64; N]; P], t1: &[[f64; N]; P]) -> bool {
    t0.as_flattened().iter().chain(t1.as_flattened()).all(|x| x.is_finite())
}

/// The axes of the coordinate plane in which all motion is, given which coordinates are zero throughout; none if it is not, or
/// if it is along one line.
fn plane_of(zeros: [bool; 3]) -> Option<[usize; 2]> {
    match zeros {
        [true, false, false] => Some([1, 2]),
        [false, true, false] => Some([2, 0]),
        [false, false, true] => Some([0, 1]),
        _ => None,
    }
}

const _: () = assert!(LEAST < 1.0 && MOST > 1.0, "scaled coordinates are in the range");
