//! The stages of a collision query, in order: [`Query`].

use super::corners::Corners;
use super::decide::Ask;
use super::moment::{LEAST, MOST};
use super::number::Number;
use super::stage::Stage;
use super::subdivision::Verdict;
use super::{ContactTimes, STEP};
use crate::arithmetic::double_double::DoubleDouble;
use crate::arithmetic::scaled::power_of_two;

/// The places of four points at the beginning and at the end of a step.
pub(super) type Step = [[[f64; 3]; 4]; 2];

/// Two moving primitives: whether and when they touch is whether and when a polygon of `K` corners holds the origin.
pub(super) struct Query<'s, const K: usize, E> {
    pub(super) step: &'s Step,
    /// The corners: `(i, j)` stands for point `i` less point `j`.
    pub(super) corners: &'static [(usize, usize); K],
    /// Whether the primitives touch when they are at rest.
    pub(super) touch: fn([[f64; 3]; 4]) -> bool,
    /// The exact decision within an interval of the step.
    pub(super) exact: E,
}

/// Intervals that `f64` may take: eight halvings towards one time leave 17.
const MOST_INTERVALS: usize = 24;

/// The same for double-double numbers, whose intervals cost a microsecond each.
const MOST_FINE_INTERVALS: usize = 8;

impl<const K: usize, E: Fn([f64; 2], Ask) -> ContactTimes> Query<'_, K, E> {
    /// Whether there is a contact, and the stage that told.
    #[inline(always)]
    pub(super) fn settle(&self) -> (bool, Stage) {
        let corners = self.rounded(None);
        match apart(&corners) {
            Some(stage) => (false, stage),
            None => self.settle_close(&corners, STEP),
        }
    }

    /// Whether there is a contact in the closed interval, which is a part of the step.
    pub(super) fn settle_during(&self, interval: [f64; 2]) -> bool {
        let corners = self.rounded(None);
        apart(&corners).is_none() && self.settle_close(&corners, interval).0
    }

    /// The contact times.
    pub(super) fn contact_times(&self) -> ContactTimes {
        let corners = self.rounded(None);
        let clear = apart(&corners).is_some() || corners.separated_otherwise() || !self.is_finite();
        if clear { ContactTimes::Finite(0) } else { (self.exact)(STEP, Ask::Count) }
    }

    #[inline(always)]
    fn rounded<T: Number>(&self, scale: Option<[f64; 3]>) -> Corners<T, K> {
        Corners::new(self.step, self.corners, scale)
    }

    fn is_finite(&self) -> bool {
        self.step.as_flattened().as_flattened().iter().all(|x| x.is_finite())
    }

    /// For what boxes and normals leave open.
    #[inline(never)]
    fn settle_close(&self, corners: &Corners<f64, K>, interval: [f64; 2]) -> (bool, Stage) {
        if corners.separated_otherwise() {
            return (false, Stage::Direction);
        }
        if corners.in_range() {
            return self.settle_in_space(corners, None, interval);
        }
        if !self.is_finite() {
            return (false, Stage::NonFinite);
        }
        let scale = self.scale();
        let scaled = self.rounded(Some(scale));
        let axes = match corners.maxima.map(|m| m == 0.0) {
            [false, false, false] if scaled.separated_otherwise() => return (false, Stage::Direction),
            [false, false, false] if scaled.in_range() => {
                return self.settle_in_space(&scaled, Some(scale), interval);
            }
            [true, false, false] => [1, 2],
            [false, true, false] => [2, 0],
            [false, false, true] => [0, 1],
            // Along a line the boxes, which are not apart, are the whole truth: see `planar`.
            _ if interval == STEP => return (true, Stage::Boxes),
            _ => return (self.decide(interval), Stage::Exact),
        };
        match scaled.examine_planar(axes, interval) {
            Some(contact) => (contact, Stage::Subdivision),
            None => self.settle_ends(interval).unwrap_or_else(|| (self.decide(interval), Stage::Exact)),
        }
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
        self.settle_ends(interval)
            .or_else(|| self.settle_finely(&verdict, scale, interval))
            .unwrap_or_else(|| (self.decide(interval), Stage::Exact))
    }

    /// A contact at an end of the step.
    fn settle_ends(&self, interval: [f64; 2]) -> Option<(bool, Stage)> {
        let touches = interval == STEP && self.step.iter().any(|&places| (self.touch)(places));
        touches.then_some((true, Stage::Ends))
    }

    /// In double-double numbers: the brackets that are left, or the whole interval.
    #[inline(never)]
    fn settle_finely(
        &self,
        verdict: &Verdict,
        scale: Option<[f64; 3]>,
        interval: [f64; 2],
    ) -> Option<(bool, Stage)> {
        let fine: Corners<DoubleDouble, K> = self.rounded(scale);
        let contact = match verdict {
            Verdict::Decided(contact) => Some(*contact),
            Verdict::Brackets(brackets) => {
                let mut contact = Some(false);
                for bracket in brackets.iter().flatten() {
                    match fine.examine_bracket(bracket) {
                        Some(true) => return Some((true, Stage::DoubleDouble)),
                        Some(false) => {}
                        None => contact = None,
                    }
                }
                contact
            }
            Verdict::Open => match fine.examine(interval, MOST_FINE_INTERVALS) {
                Verdict::Decided(contact) => Some(contact),
                _ => None,
            },
        };
        contact.map(|contact| (contact, Stage::DoubleDouble))
    }

    fn decide(&self, interval: [f64; 2]) -> bool {
        (self.exact)(interval, Ask::Any).any()
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

/// The stage that tells, without more ado, that there is no contact.
#[inline(always)]
fn apart<const K: usize>(corners: &Corners<f64, K>) -> Option<Stage> {
    if corners.boxes_apart() {
        return Some(Stage::Boxes);
    }
    corners.normals().into_iter().any(|n| corners.separated_by(n)).then_some(Stage::Direction)
}

const _: () = assert!(LEAST < 1.0 && MOST > 1.0, "scaled coordinates are in the range");
