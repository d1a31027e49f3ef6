//! Contacts of two moving primitives, exactly: [`Motion`].
//!
//! Two primitives `a` and `b` with `D + 1` points in `D` dimensions, which move linearly in time `t`, touch at the times
//! at which there are weights
//! ```text
//! sum s_i a_i(t) = sum u_j b_j(t),   sum s_i = 1,   sum u_j = 1,   s_i >= 0,   u_j >= 0,
//! ```
//! that is, `M(t) w = target` with `w >= 0`. Some independent columns of `M` then carry the target with positive weights,
//! which is a statement about signs of minors of the square matrix `[ M | target ]`, polynomials of `t`:
//!
//! * Where the determinant `f` of `[ M | target ]` does not vanish there is no contact. If `f` is not the zero polynomial,
//!   its roots in [0, 1], at most `D`, are the only times to look at.
//! * If `f` is zero throughout, the roots of all other minors cut [0, 1] into open intervals on each of which all signs,
//!   and so the answer, are constant. The times to look at are these roots, both ends, and one rational time of each
//!   interval.
//!
//! At a rational time the answer is that of [`meeting`], which enumerates weights. At an irrational time, a root
//! of a square-free polynomial in an interval of its own, signs of minors decide, and a minor is zero if it has a factor
//! in common with that polynomial which changes sign on the interval. Roots are isolated by bisection with Descartes'
//! rule of signs. No orientation, no parity, no case distinction on degenerate positions takes part.

mod distance;
mod minors;
mod polynomial;
mod time;

use super::{Meeting, lift, meeting_of_integers};
use minors::System;
use polynomial::Polynomial;
use rug::{Integer, Rational};
use time::Time;

#[cfg(doc)]
use super::meeting;

/// Two primitives moving from their places at time 0 to those at time 1.
#[derive(Clone, Debug)]
pub struct Motion<const D: usize> {
    /// Points at time 0, first those of the first primitive, in multiples of the unit.
    from: Vec<[Integer; D]>,
    /// The same at time 1.
    to: Vec<[Integer; D]>,
    /// How many of them the first primitive has.
    first: usize,
    unit: Rational,
}

/// The number of distinct times of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Count {
    /// So many.
    Finite(u32),
    /// Intervals of time, whether or not there are single times besides.
    Infinite,
}

/// What there is to say about the contacts of a motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contacts {
    /// The number of distinct times.
    pub count: Count,
    /// True if some contact lies on the boundary of the domain of time and weights: at time 0 or 1, or with weights of
    /// which one is zero.
    pub on_boundary: bool,
    /// The sum, over the contacts not on the boundary, of their multiplicities as roots of `f`; nothing if `f` is the
    /// zero polynomial. If no contact is on the boundary, its parity is the parity of the number of roots.
    pub multiplicity_sum: Option<u32>,
}

impl Contacts {
    /// True if there is a contact.
    #[must_use]
    pub fn any(&self) -> bool {
        self.count != Count::Finite(0)
    }
}

/// Contact at one time, ordered by what it says about the boundary of the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Touch {
    None,
    /// With one choice of weights, all positive.
    Inside,
    /// With weights of which some can be zero.
    Boundary,
}

/// All contacts of a motion.
struct Timeline {
    /// Single times of contact, and the beginnings and ends of intervals of contact, ascending.
    times: Vec<(Time, Touch)>,
    /// True if there are intervals.
    lasting: bool,
    on_boundary: bool,
    /// `f` of the module's head.
    determinant: Polynomial,
}

impl Motion<3> {
    /// A vertex against a face: `v, f0, f1, f2` at both ends of the step.
    #[must_use]
    pub fn vertex_face(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4]) -> Self {
        Self::new(t0, t1, 1)
    }

    /// An edge against an edge: `ea0, ea1, eb0, eb1` at both ends of the step.
    #[must_use]
    pub fn edge_edge(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4]) -> Self {
        Self::new(t0, t1, 2)
    }
}

impl Motion<2> {
    /// A vertex against a segment: `v, s0, s1` at both ends of the step.
    #[must_use]
    pub fn vertex_segment(t0: &[[f64; 2]; 3], t1: &[[f64; 2]; 3]) -> Self {
        Self::new(t0, t1, 1)
    }
}

impl<const D: usize> Motion<D> {
    fn new(t0: &[[f64; D]], t1: &[[f64; D]], first: usize) -> Self {
        let given = [t0, t1].concat();
        let mut from = lift(&given);
        let exact = |x: f64| Rational::from_f64(x).expect("lifted, so finite");
        let mut pairs = given.iter().flatten().zip(from.iter().flatten());
        let unit =
            pairs.find(|(x, _)| **x != 0.0).map_or(Rational::from(1), |(&x, lifted)| exact(x) / lifted);
        let to = from.split_off(t0.len());
        Self { from, to, first, unit }
    }

    /// The contacts in the whole step.
    #[must_use]
    pub fn contacts(&self) -> Contacts {
        let mut found = self.timeline();
        let count = match found.lasting {
            true => Count::Infinite,
            false => Count::Finite(u32::try_from(found.times.len()).expect("few times")),
        };
        let determinant = &found.determinant;
        let inside = found.times.iter_mut().filter(|(_, touch)| *touch == Touch::Inside);
        let multiplicity_sum =
            (!determinant.is_zero()).then(|| inside.map(|(time, _)| time.multiplicity(determinant)).sum());
        Contacts { count, on_boundary: found.on_boundary, multiplicity_sum }
    }

    /// Bounds, at most `width` apart, of the first time of contact.
    ///
    /// # Panics
    /// If the width is not positive.
    #[must_use]
    pub fn first_contact(&self, width: &Rational) -> Option<(Rational, Rational)> {
        assert!(width.is_positive(), "an irrational time has no bounds that are equal");
        // The set of contact times is closed, so that an interval of contact begins with a time of contact.
        let (mut first, _) = self.timeline().times.into_iter().next()?;
        loop {
            let (low, high) = first.bounds();
            if Rational::from(&high - &low) <= *width {
                return Some((low, high));
            }
            first.refine();
        }
    }

    /// The part of the motion between two times, as a motion from time 0 to time 1.
    #[must_use]
    pub fn during(&self, begin: f64, end: f64) -> Self {
        let [begin, end] = [begin, end].map(|t| Rational::from_f64(t).expect("a finite time"));
        let scale = Integer::from(begin.denom().lcm_ref(end.denom()));
        let places =
            |t: &Rational| self.places(&Integer::from(t.numer() * &scale).div_exact(t.denom()), &scale);
        let unit = Rational::from(&self.unit / &scale);
        Self { from: places(&begin), to: places(&end), first: self.first, unit }
    }

    /// The squared distance of the primitives at a time.
    #[must_use]
    pub fn squared_distance_at(&self, t: &Rational) -> Rational {
        let places = self.places(t.numer(), t.denom());
        let (a, b) = places.split_at(self.first);
        let unit = Rational::from(&self.unit / t.denom());
        distance::squared_distance(a, b) * unit.square()
    }

    /// The points at time `numerator / denominator`, times the denominator.
    fn places(&self, numerator: &Integer, denominator: &Integer) -> Vec<[Integer; D]> {
        let rest = Integer::from(denominator - numerator);
        let place = |from: &[Integer; D], to: &[Integer; D]| {
            std::array::from_fn(|k| Integer::from(&from[k] * &rest) + Integer::from(&to[k] * numerator))
        };
        self.from.iter().zip(&self.to).map(|(from, to)| place(from, to)).collect()
    }

    /// The common points at a rational time.
    fn meeting_at(&self, t: &Rational) -> Meeting {
        let mut places = self.places(t.numer(), t.denom());
        let second = places.split_off(self.first);
        meeting_of_integers(places, second)
    }

    /// Contact at a rational time, from the corners of the polytope of weights.
    fn touch_at(&self, t: &Rational) -> Touch {
        let (a, b) = ((1 << self.first) - 1, (1 << (D + 1 - self.first)) - 1);
        let corners = self.meeting_at(t).corners;
        let touches = corners.iter().map(|corner| match (corner.face_a, corner.face_b) == (a, b) {
            true => Touch::Inside,
            false => Touch::Boundary,
        });
        touches.max().unwrap_or(Touch::None)
    }

    fn timeline(&self) -> Timeline {
        let mut system = System::new(self);
        let determinant = system.determinant();
        if determinant.is_zero() {
            return self.timeline_of_intervals(system);
        }
        let candidates = time::sorted(time::roots(&determinant));
        self.timeline_of_times(candidates, &mut system, determinant)
    }

    fn timeline_of_times(
        &self,
        candidates: Vec<Time>,
        system: &mut System,
        determinant: Polynomial,
    ) -> Timeline {
        let mut times = Vec::new();
        let mut on_boundary = false;
        for mut time in candidates {
            let touch = match &time {
                Time::Rational(t) => match self.touch_at(t) {
                    Touch::Inside if *t == 0 || *t == 1 => Touch::Boundary,
                    touch => touch,
                },
                Time::Root { .. } => system.touch(&mut time),
            };
            on_boundary |= touch == Touch::Boundary;
            if touch != Touch::None {
                times.push((time, touch));
            }
        }
        Timeline { times, lasting: false, on_boundary, determinant }
    }

    /// Looks at the roots of all minors and between them.
    fn timeline_of_intervals(&self, mut system: System) -> Timeline {
        let minors = system.all_minors();
        let roots = minors.iter().flat_map(time::roots);
        let mut candidates = time::sorted(roots.chain([Time::integer(0), Time::integer(1)]).collect());
        let mut between = Touch::None;
        for i in 1..candidates.len() {
            let (before, after) = candidates.split_at_mut(i);
            let sample = before[i - 1].before(&mut after[0]);
            between = between.max(self.touch_at(&sample));
        }
        let determinant = system.determinant();
        let mut found = self.timeline_of_times(candidates, &mut system, determinant);
        found.lasting = between != Touch::None;
        found.on_boundary |= between == Touch::Boundary;
        found
    }
}

#[cfg(test)]
mod tests;
