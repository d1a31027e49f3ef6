//! When two moving primitives first touch: [`Impact`].
//!
//! # What it computes
//! A bracket `[lo, hi]` of the first time of contact, and at `lo` the closest points and a normal for the
//! response.
//!
//! # What it promises
//! * An impact is returned if and only if there is a contact, exactly (as `welter_predicates::ccd` decides).
//! * `lo < first contact <= hi`, or `lo = hi = 0` if the primitives touch at time 0. So the places at `lo`
//!   are free of contact, and so is all the motion before.
//! * `hi - lo` is at most the width asked for, or else `lo` and `hi` are adjacent `f64`.
//! * With `V` the largest speed of a vertex of one primitive relative to one of the other and `r` the norm of
//!   the vector of the largest coordinate differences between them during the step, the points that the
//!   weights say are at `lo` within `V (hi - lo)` plus rounding of each other, at `hi` within `2 V (hi - lo)`
//!   plus rounding, which was below 2^-44 `r` in all tests.
//! * All of this holds for tangential, coplanar and collinear motion, degenerate primitives, subnormal
//!   numbers and 1e308.
//!
//! # What it does not promise
//! The smallest bracket, and that `hi` is free of contact or in contact.
//!
//! # Method
//! Conservative advancement in rounded arithmetic, with a proven bound (`advance`), ends at `lo` just before
//! the contact. One exact decision finds the contact in `[lo, lo + width]`: the usual case, and the only one
//! among random queries. If it is not there (a tangential contact, a speed near zero, a width near the
//! resolution), an exact decision tells whether there is one at all, further ones search with strides that
//! grow by 2^8, and bisection narrows what they find: of the interval, then, where that does not end, of the
//! ordered `f64`.
//!
//! # Cost
//! At most [`MOST_DECISIONS`] exact decisions.

use super::advance::{Advance, advance};
use super::error::{check_finite, require};
use super::motion::Motion;
use super::pair::{EDGE_EDGE, Pair, VERTEX_FACE, VERTEX_SEGMENT};
use super::response::{normal, outward};
use super::support::Place;
use super::{CollisionError, coordinates};
use welter_predicates::{Point, ccd};

/// The most exact decisions for one query: one at time 0, two for the first stride and what is after it, 7
/// further strides of at least 2^-52 that grow by 2^8, 64 halvings of the interval, 62 of the numbers between
/// 0 and 1 in their order.
pub const MOST_DECISIONS: u32 = 1 + 2 + 7 + MOST_HALVINGS + 62;

/// Halvings of an interval of time; what is left is below 2^-64, so only brackets next to 0 go on.
const MOST_HALVINGS: u32 = 64;

/// Steps of advancement: a tangential contact halves the time that is left with each, until the distance, its
/// square, is below 2^-48; 24 steps, and more than as many to spare.
const MOST_STEPS: u32 = 64;

/// What is asked of a time of impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOfImpactParameters {
    /// Width of the bracket, as part of the step, from 0 to 1. Where it is less than the distance of `f64`
    /// there, as 0 is, the bracket has adjacent ends.
    ///
    /// Default: 2^-40, some fifty times the error of times in rounded arithmetic, so that most queries need
    /// one exact decision; and a third of a millimetre of a flight to the moon.
    pub width: f64,
}

impl Default for TimeOfImpactParameters {
    fn default() -> Self {
        Self { width: 1.0 / (1u64 << 40) as f64 }
    }
}

impl TimeOfImpactParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`CollisionError::Parameter`] with the one that is not.
    pub fn validate(&self) -> Result<(), CollisionError> {
        require((0.0..=1.0).contains(&self.width), "width", self.width, "a part of the step, from 0 to 1")
    }
}

/// The first contact of two primitives of `D` dimensions with `P` vertices together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<const D: usize, const P: usize> {
    /// `[lo, hi]`: no contact before `lo`, nor at it unless both are 0; contact between them.
    pub time: [f64; 2],
    /// The weight of each vertex in the point of its primitive that is closest to the other at `lo`: not
    /// negative, with sum one over each primitive.
    pub weights: [f64; P],
    /// Unit vector from the second primitive to the first (from face to vertex, from edge b to edge a),
    /// against their relative velocity if they come together across it. The order of choices for degenerate
    /// input: the normal of the face or of both edges; for coplanar motion, parallel edges, faces of no area
    /// and tangential contact, the direction along which they were last apart; if they touch at time 0, the
    /// normal, the direction of the relative velocity reversed, any.
    pub normal: [f64; D],
    /// Exact decisions that the bracket took.
    pub decisions: u32,
}

/// When the moving vertex first touches the moving triangle; `None` if it does not.
///
/// `t0` and `t1` are the places of `v, f0, f1, f2` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{TimeOfImpactParameters, time_of_impact::vertex_face};
/// // The triangle swings through the vertex's path and back: contact at 1/4 and at 3/4.
/// let t0 = [[-1.0, 0.0, -0.25], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
/// let t1 = [[1.0, 0.0, -0.25], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
/// let impact = vertex_face(t0, t1, &TimeOfImpactParameters::default())?.expect("they touch");
/// let [lo, hi] = impact.time;
/// assert!(lo < 0.25 && 0.25 <= hi && hi - lo < 1e-12);
/// assert!(impact.weights[1..].iter().all(|&w| w > 0.0));
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// [`CollisionError`] for a coordinate that is not finite, or a parameter out of range.
pub fn vertex_face(
    t0: [impl Point<3>; 4],
    t1: [impl Point<3>; 4],
    parameters: &TimeOfImpactParameters,
) -> Result<Option<Impact<3, 4>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_contact(&VERTEX_FACE, [&t0, &t1], parameters, |part| ccd::vertex_face_during(t0, t1, part))
}

/// When the moving edges first touch; `None` if they do not.
///
/// `t0` and `t1` are the places of `ea0, ea1, eb0, eb1` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{TimeOfImpactParameters, time_of_impact::edge_edge};
/// // One edge slides along its own line onto the other, at rest, from 2/3 on.
/// let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let impact = edge_edge(t0, t1, &TimeOfImpactParameters::default())?.expect("they touch");
/// let [lo, hi] = impact.time;
/// assert!(lo <= 2.0 / 3.0 && 2.0 / 3.0 < hi);
/// assert_eq!(impact.normal, [-1.0, 0.0, 0.0]); // from b to a
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// As [`vertex_face`].
pub fn edge_edge(
    t0: [impl Point<3>; 4],
    t1: [impl Point<3>; 4],
    parameters: &TimeOfImpactParameters,
) -> Result<Option<Impact<3, 4>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_contact(&EDGE_EDGE, [&t0, &t1], parameters, |part| ccd::edge_edge_during(t0, t1, part))
}

/// When the moving vertex first touches the moving segment of the plane; `None` if it does not.
///
/// `t0` and `t1` are the places of `v, s0, s1` at the beginning and at the end of the step.
///
/// ```
/// use welter_tracking::collision::{TimeOfImpactParameters, time_of_impact::vertex_segment_2d};
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// let exact = TimeOfImpactParameters { width: 0.0 };
/// let impact = vertex_segment_2d([[0.0, 1.0], s[0], s[1]], [[0.0, -2.0], s[0], s[1]], &exact)?.expect("they touch");
/// assert_eq!(impact.time, [1.0 / 3.0, (1.0f64 / 3.0).next_up()]); // 1/3 was rounded down
/// assert_eq!(impact.normal, [0.0, 1.0]);
/// # Ok::<(), welter_tracking::collision::CollisionError>(())
/// ```
///
/// # Errors
/// As [`vertex_face`].
pub fn vertex_segment_2d(
    t0: [impl Point<2>; 3],
    t1: [impl Point<2>; 3],
    parameters: &TimeOfImpactParameters,
) -> Result<Option<Impact<2, 3>>, CollisionError> {
    let (t0, t1) = (coordinates(t0), coordinates(t1));
    first_contact(&VERTEX_SEGMENT, [&t0, &t1], parameters, |part| ccd::vertex_segment_2d_during(t0, t1, part))
}

/// The stages: advance, bracket, respond. `during` decides exactly whether there is contact within a part of
/// the step.
fn first_contact<const D: usize, const P: usize, const K: usize>(
    pair: &Pair<P, K>,
    ends: [&[[f64; D]; P]; 2],
    parameters: &TimeOfImpactParameters,
    during: impl Fn([f64; 2]) -> bool,
) -> Result<Option<Impact<D, P>>, CollisionError> {
    parameters.validate()?;
    check_finite(&pair.names, ends)?;
    let motion = Motion::new(pair, ends[0], ends[1]);
    if motion.boxes_apart(0.0) {
        return Ok(None);
    }
    let reached = advance(&motion, 0.0, 0.0, MOST_STEPS);
    if reached.time > 1.0 {
        return Ok(None);
    }
    let mut referee = Referee { during, decisions: 0 };
    let Some(time) = referee.bracket(reached.time, parameters.width) else { return Ok(None) };
    let reached = Advance { time: time[0], ..reached };
    let closest = Place::new(&motion, time[0]).closest;
    let normal = outward(pair, normal(&motion, &reached, &closest));
    Ok(Some(Impact {
        time,
        weights: (pair.weights)(closest.parameters),
        normal,
        decisions: referee.decisions,
    }))
}

/// Asks the exact predicate, and counts.
struct Referee<F> {
    during: F,
    decisions: u32,
}

impl<F: Fn([f64; 2]) -> bool> Referee<F> {
    fn contact(&mut self, from: f64, to: f64) -> bool {
        self.decisions += 1;
        (self.during)([from, to])
    }

    /// The bracket of the first contact, given that there is none at times up to `free`, except perhaps at
    /// `free` if that is 0.
    fn bracket(&mut self, free: f64, width: f64) -> Option<[f64; 2]> {
        if free == 0.0 && self.contact(0.0, 0.0) {
            return Some([0.0, 0.0]);
        }
        let (mut lo, mut hi) = self.stride(free, width)?;
        let mut halvings = 0;
        while is_wider(lo, hi, width) {
            let middle = if halvings < MOST_HALVINGS {
                lo + 0.5 * (hi - lo)
            } else {
                f64::from_bits(lo.to_bits() + (hi.to_bits() - lo.to_bits()) / 2)
            };
            halvings += 1;
            // A rounded middle of ends that are not adjacent may still be an end.
            let middle = middle.clamp(lo.next_up(), hi.next_down());
            if self.contact(lo, middle) {
                hi = middle;
            } else {
                lo = middle;
            }
        }
        Some([lo, hi])
    }

    /// Widens its stride until there is contact within it: two times, of which the contact is after the first
    /// and not after the second.
    fn stride(&mut self, free: f64, width: f64) -> Option<(f64, f64)> {
        /// Strides of this and more need no more than eight.
        const SHORTEST: f64 = f64::EPSILON;
        const GROWTH: f64 = 256.0;
        let (mut lo, mut stride) = (free, width.max(SHORTEST));
        let mut first = true;
        while lo < 1.0 {
            let mut to = (lo + stride).min(1.0);
            if to - lo > stride {
                to = to.next_down();
            }
            let to = to.max(lo.next_up());
            if self.contact(lo, to) {
                return Some((lo, to));
            }
            if first && !self.contact(to, 1.0) {
                return None;
            }
            first = false;
            (lo, stride) = (to, stride * GROWTH);
        }
        None
    }
}

/// Whether `hi - lo` exceeds the width and there is a number between them.
fn is_wider(lo: f64, hi: f64, width: f64) -> bool {
    let difference = hi - lo;
    // What the subtraction rounded away, exactly, since hi >= lo >= 0 [Dekker71].
    let rest = (hi - difference) - lo;
    lo.next_up() < hi && (difference > width || (difference == width && rest > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Searches of every width for a contact at every kind of time, from every kind of time before it.
    #[test]
    fn brackets_take_a_bounded_number_of_decisions() {
        let tiny = f64::from_bits(1);
        let mut times = vec![0.0, tiny, 3.0 * tiny, f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0, 1.0];
        times.extend((1..200).map(|i| 1.0 / f64::from(i)));
        times.extend((1..107).map(|i| libm::scalbn(0.7, -10 * i)));
        let mut most = 0;
        for &contact in &times {
            let before =
                [0.0, tiny, 1e-300, 1e-9, 0.3, 0.5 * contact, contact * (1.0 - 1e-9), contact.next_down()];
            for free in before.into_iter().filter(|&t| 0.0 <= t && (t < contact || t == 0.0)) {
                for width in [0.0, tiny, 1e-300, 1e-17, f64::EPSILON, 1e-12, 0.3, 1.0] {
                    let during = |[from, to]: [f64; 2]| from <= contact && contact <= to;
                    let mut referee = Referee { during, decisions: 0 };
                    let [lo, hi] = referee.bracket(free, width).expect("there is a contact");
                    let found = format!("{lo:e} {hi:e} {contact:e} {free:e} {width:e}");
                    if contact == 0.0 {
                        assert_eq!([lo, hi], [0.0, 0.0], "{found}");
                    } else {
                        assert!(free <= lo && lo < contact && contact <= hi, "{found}");
                        assert!(!is_wider(lo, hi, width), "{found}");
                    }
                    most = most.max(referee.decisions);
                }
            }
        }
        assert!((100..=MOST_DECISIONS).contains(&most), "{most}");
        let mut referee = Referee { during: |_| false, decisions: 0 };
        assert_eq!((referee.bracket(0.0, 0.0), referee.decisions), (None, 3));
    }

    #[test]
    fn widths_are_compared_without_rounding() {
        // 1 - 2^-60 is rounded to 1 by the subtraction, but is less than it.
        let small = libm::scalbn(1.0, -60);
        assert!(!is_wider(small, 1.0, 1.0));
        assert!(is_wider(small, 1.0, 1.0 - f64::EPSILON));
        // The difference 1 - 2^-54 - 2^-108 is rounded to 1 - 2^-53 or 1, and exceeds the former.
        let odd = libm::scalbn(1.0, -54) + libm::scalbn(1.0, -106);
        assert!(is_wider(odd, 1.0, 1.0 - f64::EPSILON / 2.0));
        assert!(!is_wider(0.5, 0.5f64.next_up(), 0.0) && is_wider(0.5, 0.5f64.next_up().next_up(), 0.0));
    }
}
