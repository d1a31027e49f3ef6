//! The stage that always answers: the whole surface in integers.
//!
//! Corners are differences of given points, so everything is a polynomial of degree at most 6 in such
//! differences: 379 bits for coordinates of one lattice of 61 bits, and 187 for one of 29.

use super::super::STEP;
use super::super::decide::Ask;
use super::super::exact::decide;
use super::surface::{Face, Image, Parity, surface};
use crate::Sign;
use crate::arithmetic::fixed_point::{self, Integers};
use crate::arithmetic::lattice::{self, Extent, Lattice, Words};
use crate::arithmetic::scaled::{Exact, power_of_two};
use crate::arithmetic::small::{self, Small};
use crate::polynomial::{Additive, SixthDegree, determinant3, minor2, patch_side};

/// As many points as two edges have at both ends of a step.
const MOST_POINTS: usize = 8;

/// The points, and the origin of coordinates behind them.
type Points = [[f64; 3]; MOST_POINTS + 1];

/// Finite points, and corners that are differences of two of these.
pub(super) struct Given<const C: usize> {
    points: Points,
    corners: [(usize, usize); C],
    direction: Option<[f64; 3]>,
}

impl<const C: usize> Given<C> {
    /// Corner `(i, j)` is `points[i] - points[j]`. Without a direction of the ray any will do.
    ///
    /// # Panics
    /// If there are more than [`MOST_POINTS`] points.
    pub(super) fn new(
        points: &[[f64; 3]],
        corners: [(usize, usize); C],
        direction: Option<[f64; 3]>,
    ) -> Self {
        let mut padded = [[0.0; 3]; MOST_POINTS + 1];
        padded[..MOST_POINTS][..points.len()].copy_from_slice(points);
        Self { points: padded, corners, direction }
    }

    #[inline(never)]
    pub(super) fn parity(&self, faces: &[Face]) -> Parity {
        let parity = self.in_few_bits(faces).or_else(|| self.in_machine_words(faces));
        parity.unwrap_or_else(|| self.in_any_bits(faces))
    }

    pub(super) fn in_few_bits(&self, faces: &[Face]) -> Option<Parity> {
        let (points, extent) = raised(&self.points)?;
        let (_, points) = small::rows(&points, extent, DEGREE)?;
        let direction = match self.direction {
            None => None,
            Some(r) => {
                let (r, extent) = raised(&[r, [0.0; 3]])?;
                let (_, [r]) = small::rows(&r, extent, DEGREE)?;
                Some(r)
            }
        };
        surface(&Exactly::<Small, C>::new(self, &points, direction), faces)
    }

    pub(super) fn in_machine_words(&self, faces: &[Face]) -> Option<Parity> {
        let (points, extent) = raised(&self.points)?;
        let points = Lattice::of(&points, extent)?.rows();
        let direction = match self.direction {
            None => None,
            Some(r) => {
                let (r, extent) = raised(&[r, [0.0; 3]])?;
                let [r] = Lattice::of(&r, extent)?.rows();
                Some(r)
            }
        };
        surface(&Exactly::<Words, C>::new(self, &points, direction), faces)
    }

    #[cold]
    #[inline(never)]
    pub(super) fn in_any_bits(&self, faces: &[Face]) -> Parity {
        let (_, points) = fixed_point::differences(&self.points);
        let direction = self.direction.map(|r| {
            let (_, [r]) = fixed_point::differences(&[r, [0.0; 3]]);
            r
        });
        surface(&Exactly::<Integers, C>::new(self, &points, direction), faces)
            .expect("integers are always certain")
    }
}

/// What the few bits of [`small`] must suffice for; the products of degree 6 have words enough.
const DEGREE: i32 = 3;

/// The points, multiplied by a power of two if they are tiny, and their extent; `None` if one is not finite.
fn raised<const P: usize>(points: &[[f64; 3]; P]) -> Option<([[f64; 3]; P], Extent)> {
    let extent = Extent::of(points)?;
    if !extent.is_tiny() {
        return Some((*points, extent));
    }
    let raised = points.map(|p| p.map(|x| x * power_of_two(lattice::RAISE)));
    Some((raised, Extent::of(&raised)?))
}

/// Corners as exact numbers.
struct Exactly<'g, K: SixthDegree, const C: usize> {
    given: &'g Given<C>,
    corners: [[K::D1; 3]; C],
    direction: Option<[K::D1; 3]>,
}

impl<'g, K: SixthDegree, const C: usize> Exactly<'g, K, C> {
    fn new(given: &'g Given<C>, points: &[[K::D1; 3]; MOST_POINTS], direction: Option<[K::D1; 3]>) -> Self {
        let corner = |(i, j): (usize, usize)| core::array::from_fn(|k| points[i][k].minus(&points[j][k]));
        Self { given, corners: given.corners.map(corner), direction }
    }
}

impl<K, const C: usize> Image for Exactly<'_, K, C>
where
    K: SixthDegree<Outcome: Exact, D6: Exact>,
{
    #[inline(always)]
    fn side(&self, i: usize, j: usize) -> Option<Sign> {
        let (p, q) = (&self.corners[i], &self.corners[j]);
        if let Some(r) = &self.direction {
            let sign = determinant3::<K>(r, p, q).into().sign();
            if !sign.is_zero() {
                return Some(sign);
            }
        }
        for [k, l] in [[1, 2], [2, 0], [0, 1]] {
            let sign = minor2::<K>(&p[k], &p[l], &q[k], &q[l]).into().sign();
            if !sign.is_zero() {
                return Some(sign);
            }
        }
        Some(Sign::Zero)
    }

    #[inline(always)]
    fn volume(&self, [i, j, k]: [usize; 3]) -> Option<Sign> {
        let [p, q, r] = [i, j, k].map(|i| &self.corners[i]);
        Some(determinant3::<K>(p, q, r).into().sign())
    }

    fn patch_side(&self, patch: [usize; 4]) -> Option<Sign> {
        Some(patch_side::<K>(patch.map(|i| &self.corners[i])).sign())
    }

    /// Parallel vectors point in opposite directions, or one is zero, if no coordinate has one sign in both.
    fn edge_holds_origin(&self, i: usize, j: usize) -> Option<bool> {
        let sign = |corner: usize, k: usize| {
            let (a, b) = self.given.corners[corner];
            Sign::of_difference(self.given.points[a][k], self.given.points[b][k])
        };
        Some((0..3).all(|k| sign(i, k) * sign(j, k) != Sign::Positive))
    }

    /// Asks whether the segment that moves from the first two corners to the last two ever holds the origin.
    fn flat_patch_holds_origin(&self, [a, b, c, d]: [usize; 4]) -> Option<bool> {
        let ends = |first: usize, second: usize| {
            let [(i, j), (k, l)] = [self.given.corners[first], self.given.corners[second]];
            [i, j, k, l].map(|point| self.given.points[point])
        };
        Some(decide([&ends(a, b), &ends(c, d)], &[(0, 1), (2, 3)], STEP, Ask::Any).any())
    }
}
