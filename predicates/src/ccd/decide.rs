//! The complete decision in exact integers: [`Motion`].
//!
//! # What it computes
//! The corners `P_0(t), ..., P_{k-1}(t)` of a convex polygon move linearly in `0 <= t <= 1`. At which times does the closed
//! polygon hold the origin? Every collision query is of this form:
//!
//! ```text
//! vertex-face      f0 - v, f1 - v, f2 - v                          a triangle
//! edge-edge        a0 - b0, a1 - b0, a1 - b1, a0 - b1              a parallelogram
//! vertex-segment   s0 - v, s1 - v              (in the plane)      a segment
//! ```
//!
//! # Method
//! At one time, let `f` be the volume `det(P_0, P_1, P_last)` and `n_i = P_i x P_{i+1}`. The polygon holds the origin
//! if and only if (`touches`)
//!
//! 1. some corner is the origin; or
//! 2. `f = 0`, in no coordinate do two `n_i` have opposite signs, and some `n_i` is not zero; or
//! 3. `f = 0`, all `n_i` are zero, and in some coordinate two corners have opposite signs.
//!
//! Proof. `f = 0` says that the plane of the polygon holds the origin, or that the polygon has no plane. The sum of the
//! `n_i` is twice the polygon's vector area `N`. If `f = 0` and `N` is not zero, all `n_i` are multiples of `N`, and the
//! origin is on the inner side of edge `i` or on its line when the multiple is not negative: 2. If `N` is zero the polygon
//! lies on a line. If that line misses the origin, the `n_i` are multiples of one vector, not all zero, of sum zero:
//! some have opposite signs. If it does not, all `n_i` are zero, and a segment on a line through the origin holds it
//! if its ends are on different sides: 3. If the polygon holds the origin and neither 1. nor 3. does, `N` is not
//! zero and 2. holds. Of a segment in the plane `f` is the only `n_i`; of a polygon in the plane `f` is zero, and each `n_i` has one
//! coordinate.
//!
//! `f` is a cubic of `t`, each coordinate of an `n_i` a quadratic, each coordinate of a corner linear. If `f` is not zero
//! for all `t`, the contact times are among its roots, at most three, and 0 and 1. If it is, the set of contact times
//! is closed and can begin or end only at 0, 1 or a root of one of the quadratics or linear functions: these are
//! examined, and the signs just before and after each tell whether there is an interval of contact. To know whether there is any
//! contact, less is enough: if there is none at 0 and a first one later, then the origin is on an edge at that time, where `n_i`
//! is zero and `P_i . P_{i+1}` is not positive. Signs at roots are
//! exact ([`crate::arithmetic::univariate`]).
//!
//! # Cost
//! Bounded by a constant. The integers have up to 2100 bits times the degree of what is formed.

use super::ContactTimes;
use super::trajectory::{minor, trajectories, volume};
use crate::Sign;
use crate::arithmetic::arena::Arena;
use crate::arithmetic::univariate::{MOST_ROOTS, Polynomial, Roots, roots_in_unit_interval};

use super::trajectory::MOST_CORNERS;

/// The most functions whose signs make a contact: three coordinates of each `n_i` and of each corner.
const MOST_SIGNS: usize = 6 * MOST_CORNERS;

/// Signs of the coordinates of all `n_i`, then of all corners.
type Signs = [Sign; MOST_SIGNS];

/// A polygon whose corners move linearly, as exact polynomials of time.
pub(super) struct Motion {
    corners: usize,
    dimension: usize,
    /// `f`.
    volume: Polynomial,
    /// Coordinates of all `n_i` (none of a segment in the plane), then of all corners.
    functions: [Polynomial; MOST_SIGNS],
    /// How many of these are coordinates of an `n_i`.
    normals: usize,
    count: usize,
}

/// What is wanted of the decision.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Ask {
    /// Whether there is a contact: the first one found ends the search.
    Any,
    /// All contact times.
    Count,
}

impl Motion {
    /// A polygon with these corners, each the difference of two of the `points`: `(i, j)` stands for
    /// `points[i] - points[j]`. `points` holds the places at time 0, then those at time 1; of the motion, the part
    /// within the `interval` of [0, 1] is taken, and its ends are the times 0 and 1 of all that follows.
    pub(super) fn new<const N: usize>(
        points: [&[[f64; N]]; 2],
        corners: &[(usize, usize)],
        interval: [f64; 2],
        arena: &mut Arena<'_>,
    ) -> Self {
        let places = trajectories(points, corners, interval, arena);
        let mut motion = Self {
            corners: corners.len(),
            dimension: N,
            volume: Polynomial::ZERO,
            functions: [Polynomial::ZERO; MOST_SIGNS],
            normals: 0,
            count: 0,
        };
        let places = &places[..corners.len()];
        let sides = || places.iter().zip(places.iter().cycle().skip(1));
        if N == 3 {
            for (place, next) in sides() {
                for k in 0..3 {
                    motion.push(minor(place, next, (k + 1) % 3, (k + 2) % 3, arena));
                }
            }
            motion.normals = motion.count;
            let first = [0, 1, 2].map(|k| motion.functions[k]);
            motion.volume = volume(&first, &places[motion.corners - 1], arena);
        } else if motion.corners > 2 {
            for (place, next) in sides() {
                motion.push(minor(place, next, 0, 1, arena));
            }
            motion.normals = motion.count;
        } else {
            motion.volume = minor(&places[0], &places[1], 0, 1, arena);
        }
        for place in places {
            for coordinate in &place[..N] {
                motion.push(*coordinate);
            }
        }
        motion
    }

    fn push(&mut self, function: Polynomial) {
        self.functions[self.count] = function;
        self.count += 1;
    }

    pub(super) fn contact_times(&self, ask: Ask, arena: &mut Arena<'_>) -> ContactTimes {
        let at_0 = self.volume.sign_at_0().is_zero()
            && self.touches(Sign::Zero, &self.signs_of(|q, _| q.sign_at_0(), arena));
        let at_1 = self.volume.sign_at_1(arena).is_zero()
            && self.touches(Sign::Zero, &self.signs_of(|q, a| q.sign_at_1(a), arena));
        let count = u8::from(at_0) + u8::from(at_1);
        if count > 0 && ask == Ask::Any {
            return ContactTimes::Finite(count);
        }
        if self.volume.is_zero() && ask == Ask::Any {
            let contact = (0..self.edges()).any(|i| self.edge_touches(i, arena));
            return ContactTimes::Finite(u8::from(contact));
        }
        if self.volume.is_zero() {
            return self.flat_contact_times(count, arena);
        }
        let roots = roots_in_unit_interval(&self.volume, arena);
        let inside = self.touches_at(&roots, arena).into_iter().filter(|&touches| touches).count();
        ContactTimes::Finite(count + inside as u8)
    }

    /// Whether the polygon holds the origin at each of the roots of the volume.
    ///
    /// One coordinate of the `n_i` that is not zero for all tells as much as all three: they are multiples of one vector.
    fn touches_at(&self, roots: &Roots, arena: &mut Arena<'_>) -> [bool; MOST_ROOTS] {
        let mut touches = [false; MOST_ROOTS];
        let mut settled: [bool; MOST_ROOTS] = core::array::from_fn(|r| r >= roots.count());
        let coordinates = self.normals / self.corners;
        for k in 0..coordinates {
            if settled == [true; MOST_ROOTS] {
                return touches;
            }
            let mut signs = [[Sign::Zero; MOST_CORNERS]; MOST_ROOTS];
            for (i, n) in self.functions[..self.normals].iter().skip(k).step_by(coordinates).enumerate() {
                for (row, sign) in signs.iter_mut().zip(roots.signs(n, arena)) {
                    row[i] = sign;
                }
            }
            for (r, row) in signs.iter().enumerate().filter(|(_, row)| row.iter().any(|s| !s.is_zero())) {
                touches[r] |= !settled[r] && !has_opposites(row.iter());
                settled[r] = true;
            }
        }
        if settled != [true; MOST_ROOTS] {
            // Corners that are the origin, or on two sides of it.
            let mut zero = [[true; MOST_CORNERS]; MOST_ROOTS];
            for k in 0..self.dimension {
                let mut signs = [[Sign::Zero; MOST_CORNERS]; MOST_ROOTS];
                let corners = self.functions[self.normals..self.count].iter().skip(k).step_by(self.dimension);
                for (i, coordinate) in corners.enumerate() {
                    for (r, sign) in roots.signs(coordinate, arena).into_iter().enumerate() {
                        signs[r][i] = sign;
                        zero[r][i] &= sign.is_zero();
                    }
                }
                for r in (0..MOST_ROOTS).filter(|&r| !settled[r]) {
                    touches[r] |= has_opposites(signs[r].iter());
                }
            }
            for r in (0..MOST_ROOTS).filter(|&r| !settled[r]) {
                touches[r] |= zero[r][..self.corners].contains(&true);
            }
        }
        touches
    }

    /// The contact times of a motion that stays in a plane through the origin (or on a line, in the plane), given
    /// the number of contacts at times 0 and 1.
    fn flat_contact_times(&self, at_ends: u8, arena: &mut Arena<'_>) -> ContactTimes {
        let mut count = at_ends;
        let after_0 = self.signs_of(|q, a| q.sign_after_0(a), arena);
        let before_1 = self.signs_of(|q, a| q.sign_before_1(a), arena);
        if self.touches(Sign::Zero, &after_0) || self.touches(Sign::Zero, &before_1) {
            return ContactTimes::Infinite;
        }
        for candidate in 0..self.count {
            if self.functions[candidate].is_zero() {
                continue;
            }
            let roots = roots_in_unit_interval(&self.functions[candidate], arena);
            if roots.count() == 0 {
                continue;
            }
            let at = self.signs_at(&roots, arena);
            let mut before = at;
            let mut after = at;
            for (i, q) in self.functions[..self.count].iter().enumerate() {
                let mark = arena.mark();
                let slope = q.derivative(arena);
                let curvature = slope.derivative(arena).sign_at_0();
                let slopes = roots.signs(&slope, arena);
                for r in (0..roots.count()).filter(|&r| at[r][i].is_zero()) {
                    let flat = slopes[r].is_zero();
                    after[r][i] = if flat { curvature } else { slopes[r] };
                    before[r][i] = if flat { curvature } else { -slopes[r] };
                }
                arena.keep(mark, []);
            }
            for r in 0..roots.count() {
                if self.touches(Sign::Zero, &before[r]) || self.touches(Sign::Zero, &after[r]) {
                    return ContactTimes::Infinite;
                }
                // A root shared with an earlier function has been counted with it.
                let first = (0..candidate).all(|i| self.functions[i].is_zero() || !at[r][i].is_zero());
                count += u8::from(first && self.touches(Sign::Zero, &at[r]));
            }
        }
        ContactTimes::Finite(count)
    }

    /// How many edges the polygon has: a segment has one.
    fn edges(&self) -> usize {
        if self.corners == 2 { 1 } else { self.corners }
    }

    /// Whether edge `i` holds the origin at a time strictly between 0 and 1: that of a motion in a plane or on a line.
    fn edge_touches(&self, i: usize, arena: &mut Arena<'_>) -> bool {
        let mark = arena.mark();
        let corner = |i: usize| &self.functions[self.normals + i * self.dimension..][..self.dimension];
        let mut product = Polynomial::ZERO;
        for (p, q) in corner(i).iter().zip(corner((i + 1) % self.corners)) {
            let term = p.mul(q, arena);
            product = product.add(&term, arena);
        }
        product.keep(mark, arena);
        let coordinates = self.normals / self.corners;
        let normal = &self.functions[i * coordinates..][..coordinates];
        let touches = match normal.iter().find(|n| !n.is_zero()) {
            // On the line of the edge throughout: between its ends when these change sides.
            None => {
                let outside = product.sign_at_0() == Sign::Positive;
                !outside || roots_in_unit_interval(&product, arena).count() > 0
            }
            Some(first) => {
                let roots = roots_in_unit_interval(first, arena);
                let mut at = [true; MOST_ROOTS];
                for n in normal {
                    let signs = roots.signs(n, arena);
                    at = core::array::from_fn(|r| at[r] && signs[r].is_zero());
                }
                let between = roots.signs(&product, arena);
                (0..roots.count()).any(|r| at[r] && between[r] != Sign::Positive)
            }
        };
        arena.keep(mark, []);
        touches
    }

    fn signs_of(&self, sign: impl Fn(&Polynomial, &mut Arena<'_>) -> Sign, arena: &mut Arena<'_>) -> Signs {
        let mut signs = [Sign::Zero; MOST_SIGNS];
        for (s, q) in signs.iter_mut().zip(&self.functions[..self.count]) {
            *s = sign(q, arena);
        }
        signs
    }

    fn signs_at(&self, roots: &Roots, arena: &mut Arena<'_>) -> [Signs; MOST_ROOTS] {
        let mut signs = [[Sign::Zero; MOST_SIGNS]; MOST_ROOTS];
        if roots.count() == 0 {
            return signs;
        }
        for (i, q) in self.functions[..self.count].iter().enumerate() {
            for (row, s) in signs.iter_mut().zip(roots.signs(q, arena)) {
                row[i] = s;
            }
        }
        signs
    }

    /// Whether the polygon holds the origin at a time when `f` and the functions have these signs.
    fn touches(&self, volume: Sign, signs: &Signs) -> bool {
        if !volume.is_zero() {
            return false;
        }
        let (normals, corners) = signs[..self.count].split_at(self.normals);
        if corners.chunks(self.dimension).any(|corner| corner.iter().all(|s| s.is_zero())) {
            return true;
        }
        if normals.iter().any(|s| !s.is_zero()) {
            let coordinates = normals.len() / self.corners;
            (0..coordinates).all(|k| !has_opposites(normals.iter().skip(k).step_by(coordinates)))
        } else {
            (0..self.dimension).any(|k| has_opposites(corners.iter().skip(k).step_by(self.dimension)))
        }
    }
}

fn has_opposites<'s>(signs: impl Iterator<Item = &'s Sign>) -> bool {
    let (mut positive, mut negative) = (false, false);
    for &sign in signs {
        positive |= sign == Sign::Positive;
        negative |= sign == Sign::Negative;
    }
    positive && negative
}
