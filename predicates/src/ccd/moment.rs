//! A motion at single times, and within intervals of time, in rounded numbers: [`Moment`].
//!
//! # What it computes
//! Notation as in [`super::decide`]: the corners `P_i(t)`, the volume `f(t)`, the vectors `n_i(t)`. On an interval of time,
//! the Bernstein coefficients of `f` and of one coordinate of all `n_i`; where these have one strict sign, the
//! polynomial has that sign throughout the interval.
//!
//! # Bounds
//! `m_k` is the largest magnitude of coordinate `k`, `u` the unit of the [`Number`]; to first order, with at least a
//! twentieth to spare for the higher orders and for the rounding of the bound itself:
//!
//! ```text
//! corner     P = p + t (q - p)                            8u m_k
//! n_i        two products of corners                     40u m_k m_l
//! 2 n_i      mixed coefficient: two of these             84u m_k m_l
//! f          three products with an n_i                 190u m_0 m_1 m_2
//! 3 f        mixed coefficient: three determinants      600u m_0 m_1 m_2
//! ```
//!
//! Each line adds the errors of its operands times the others' magnitudes, and one u of the magnitude of each rounded
//! result. The time `t` is the exact number that its digits stand for. Underflow and overflow are kept away by [`LEAST`]
//! and [`MOST`]: with all `m_k` between them, what underflow adds is below `2^-1060`, and the spare part of every
//! bound above `2^-1010`.

use super::corners::Corners;
use super::number::Number;
use crate::Sign;

/// Bounds above, rounded up.
const CORNER: f64 = 9.0;
const NORMAL: f64 = 42.0;
const TWICE_NORMAL: f64 = 89.0;
const VOLUME: f64 = 200.0;
const THRICE_VOLUME: f64 = 630.0;

/// 2^-300 and 2^300: between them the products of three numbers, and their errors, are normal numbers.
pub(super) const LEAST: f64 = f64::from_bits((1023 - 300) << 52);
pub(super) const MOST: f64 = f64::from_bits((1023 + 300) << 52);

/// The corners and the volume at one time.
#[derive(Clone, Copy)]
pub(super) struct Moment<T, const K: usize> {
    pub(super) t: T,
    /// Coordinate, corner.
    pub(super) corners: [[T; K]; 3],
    pub(super) volume: T,
}

/// Corners of the polygon by bits.
pub(super) type Mask = u8;

/// On which sides of the polygon's edges the origin is throughout an interval: the edges whose `n_i` has, in one
/// coordinate, a strict sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides {
    pub(super) positive: Mask,
    pub(super) negative: Mask,
    /// Some of the others may have a sign on a part of the interval, as far as these numbers can tell.
    pub(super) hopeful: bool,
}

impl Sides {
    pub(super) const UNKNOWN: Self = Self { positive: 0, negative: 0, hopeful: true };

    /// The origin is outside: two have opposite signs.
    #[inline(always)]
    pub(super) fn differ(self) -> bool {
        self.positive != 0 && self.negative != 0
    }

    /// If the origin is in the plane of the polygon it is inside: all have one sign.
    #[inline(always)]
    pub(super) fn agree<const K: usize>(self) -> bool {
        self.positive | self.negative == all::<K>() && !self.differ()
    }
}

/// All corners.
const fn all<const K: usize>() -> Mask {
    (1 << K) - 1
}

impl<T: Number, const K: usize> Corners<T, K> {
    /// Whether the bounds hold: no coordinate but zeros is near the ends of the exponent range.
    #[inline(always)]
    pub(super) fn in_range(&self) -> bool {
        self.maxima.iter().all(|m| (LEAST..=MOST).contains(m))
    }

    /// The motion at the time `t` in [0, 1].
    #[inline(always)]
    pub(super) fn at(&self, t: T) -> Moment<T, K> {
        let [p, q] = &self.ends;
        let corners = core::array::from_fn(|k| {
            core::array::from_fn(|i| p[k][i].plus(&t.times(&q[k][i].minus(&p[k][i]))))
        });
        Moment { t, corners, volume: determinant::<T, K>([&corners; 3]) }
    }

    fn volume_size(&self) -> f64 {
        T::UNIT * self.maxima[0] * self.maxima[1] * self.maxima[2]
    }

    /// The bound of the error of a volume.
    #[inline(always)]
    pub(super) fn volume_error(&self) -> f64 {
        VOLUME * self.volume_size()
    }

    /// The signs of the Bernstein coefficients of `f`; zero where they are not certain.
    #[inline(always)]
    pub(super) fn volume_signs(&self, low: &Moment<T, K>, high: &Moment<T, K>) -> [Sign; 4] {
        let (p, q) = (&low.corners, &high.corners);
        let mixed = |a: [&[[T; K]; 3]; 3], b, c| {
            let sum = determinant::<T, K>(a).plus(&determinant::<T, K>(b)).plus(&determinant::<T, K>(c));
            certain(sum.leading(), THRICE_VOLUME * self.volume_size())
        };
        let end = |moment: &Moment<T, K>| certain(moment.volume.leading(), self.volume_error());
        [end(low), mixed([q, p, p], [p, q, p], [p, p, q]), mixed([p, q, q], [q, p, q], [q, q, p]), end(high)]
    }

    /// The sides of the edges that are not in `known` yet, by the coordinate of the `n_i` that the axes `x`, `y` give.
    #[inline(always)]
    pub(super) fn sides(
        &self,
        low: &Moment<T, K>,
        high: &Moment<T, K>,
        [x, y]: [usize; 2],
        known: Sides,
    ) -> Sides {
        let size = T::UNIT * self.maxima[x] * self.maxima[y];
        let (error, twice) = (NORMAL * size, TWICE_NORMAL * size);
        let mut sides = Sides { hopeful: false, ..known };
        for i in 0..K {
            if (known.positive | known.negative) >> i & 1 == 1 {
                continue;
            }
            let j = (i + 1) % K;
            let cross = |a: &Moment<T, K>, b: &Moment<T, K>| {
                let (a, b) = (&a.corners, &b.corners);
                a[x][i].times(&b[y][j]).minus(&a[y][i].times(&b[x][j]))
            };
            let first = cross(low, low).leading();
            let middle = cross(low, high).plus(&cross(high, low)).leading();
            let last = cross(high, high).leading();
            if first > error && middle > twice && last > error {
                sides.positive |= 1 << i;
            } else if first < -error && middle < -twice && last < -error {
                sides.negative |= 1 << i;
            } else {
                sides.hopeful |= first.abs() > error || middle.abs() > twice || last.abs() > error;
            }
        }
        sides
    }

    /// True when all corners are strictly on one side of the origin along an axis, throughout the interval.
    pub(super) fn apart_between(&self, low: &Moment<T, K>, high: &Moment<T, K>) -> bool {
        (0..3).any(|k| {
            let error = CORNER * T::UNIT * self.maxima[k];
            let corners = || low.corners[k].iter().chain(&high.corners[k]).map(|x| x.leading());
            corners().all(|x| x > error) || corners().all(|x| x < -error)
        })
    }

    /// The axes whose coordinate of the vector area, at the middle of the interval, is largest.
    pub(super) fn dominant_axes(&self, low: &Moment<T, K>, high: &Moment<T, K>) -> [usize; 2] {
        let edge = |j: usize, k: usize| {
            let at = |i: usize| low.corners[k][i].leading() + high.corners[k][i].leading();
            at(j) - at(0)
        };
        let area = |x: usize, y: usize| (edge(1, x) * edge(K - 1, y) - edge(1, y) * edge(K - 1, x)).abs();
        let [a, b, c] = [area(1, 2), area(2, 0), area(0, 1)];
        if a >= b && a >= c {
            [1, 2]
        } else if b >= c {
            [2, 0]
        } else {
            [0, 1]
        }
    }
}

/// The sign of a number whose error is at most `error`, zero if that is not certain.
#[inline(always)]
pub(super) fn certain(value: f64, error: f64) -> Sign {
    if value > error {
        Sign::Positive
    } else if value < -error {
        Sign::Negative
    } else {
        Sign::Zero
    }
}

/// The determinant of corners 0, 1 and the last, each at a time of its own, expanded along the last coordinate.
#[inline(always)]
fn determinant<T: Number, const K: usize>([p, q, r]: [&[[T; K]; 3]; 3]) -> T {
    let (a, b, c) = (0, 1, K - 1);
    let bc = q[0][b].times(&r[1][c]).minus(&q[1][b].times(&r[0][c]));
    let ac = p[0][a].times(&r[1][c]).minus(&p[1][a].times(&r[0][c]));
    let ab = p[0][a].times(&q[1][b]).minus(&p[1][a].times(&q[0][b]));
    p[2][a].times(&bc).minus(&q[2][b].times(&ac)).plus(&r[2][c].times(&ab))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::{Additive, Times};

    /// A bound of a magnitude, and of an error in units of u.
    #[derive(Clone, Copy, Debug)]
    struct Bound {
        size: f64,
        error: f64,
    }

    impl Additive for Bound {
        fn plus(&self, other: &Self) -> Self {
            let size = self.size + other.size;
            Self { size, error: self.error + other.error + size }
        }
        fn minus(&self, other: &Self) -> Self {
            self.plus(other)
        }
    }

    impl Times<Bound> for Bound {
        type Product = Bound;
        fn times(&self, other: &Self) -> Self {
            let size = self.size * other.size;
            Self { size, error: self.size * other.error + other.size * self.error + size }
        }
    }

    impl Number for Bound {
        const UNIT: f64 = 1.0;
        fn difference(_: f64, _: f64) -> Self {
            Self { size: 1.0, error: 1.0 }
        }
        fn of(_: f64) -> Self {
            Self { size: 1.0, error: 0.0 }
        }
        fn leading(self) -> f64 {
            self.size
        }
    }

    /// The lines of the table, recomputed by the text that computes; with a twentieth to spare.
    #[test]
    fn bounds_are_those_of_the_text() {
        let spare = |constant: f64, error: f64| constant >= 1.05 * error && constant < 1.3 * error;
        let way = Bound::of(0.5).times(&Bound::difference(0.0, 0.0).minus(&Bound::difference(0.0, 0.0)));
        // The place itself is within the box of its ends, which the sum of the bounds does not know.
        let corner = Bound { size: 1.0, error: 1.0 + way.error + 1.0 };
        assert!(spare(CORNER, corner.error), "{corner:?}");
        let cross = corner.times(&corner).minus(&corner.times(&corner));
        assert!(spare(NORMAL, cross.error), "{cross:?}");
        assert!(spare(TWICE_NORMAL, cross.plus(&cross).error));
        let corners = [[corner; 4]; 3];
        let volume = determinant::<Bound, 4>([&corners; 3]);
        assert!(spare(VOLUME, volume.error), "{volume:?}");
        assert!(spare(THRICE_VOLUME, volume.plus(&volume).plus(&volume).error));
    }

    #[test]
    fn signs_need_a_margin() {
        assert_eq!(certain(1.0, 1.0), Sign::Zero);
        assert_eq!(certain(-1.0, 0.5), Sign::Negative);
        assert_eq!(certain(f64::NAN, 0.5), Sign::Zero);
        let all_but_one = Sides { positive: 0b0111, negative: 0, hopeful: false };
        assert!(!all_but_one.agree::<4>() && all_but_one.agree::<3>() && !all_but_one.differ());
        let both = Sides { negative: 0b1000, ..all_but_one };
        assert!(both.differ() && !both.agree::<4>());
    }
}
