//! Crossings that rounded arithmetic can decide: the volume changes its sign once, well inside or well outside.
//!
//! # Method
//! Notation as in [`super::decide`]: the volume `f(t)`, the vectors `n_i(t)`. The Bernstein coefficients of `f` on [0, 1], each with an
//! error bound, end the query when they have one strict sign. If `f` has strict and opposite signs at 0 and 1,
//! it has a root; the bracket of a root shrinks, by secants and bisection in turn, until the Bernstein coefficients on it of
//! one coordinate of all `n_i` have strict signs. If these all agree, the root in the bracket is a contact. If two
//! disagree, no root in the bracket is; the query ends if `f` has no other root, that is, if its coefficients change sign
//! only once. Whatever is not strict, or takes too long, is left to the exact decision.
//!
//! # Bounds
//! `m_k` is the largest magnitude of coordinate `k`, `u = 2^-53`; to first order, with at least a twentieth to spare for
//! the higher orders and for the rounding of the bound itself:
//!
//! ```text
//! corner         p + t (q - p)                          8u m_k
//! n_i            two products of corners               40u m_k m_l
//! 2 n_i          mixed coefficient: two of these       84u m_k m_l
//! f              three products with an n_i           190u m_0 m_1 m_2
//! 3 f            mixed coefficient: three determinants
//!                of corners at the ends               168u m_0 m_1 m_2
//! ```
//!
//! Each line adds the errors of its operands times the others' magnitudes, and one u of the magnitude of each rounded
//! result. Underflow and overflow are kept away by [`SMALLEST`] and [`LARGEST`]: with all `m_k` between them, what underflow adds
//! is below `2^-1070`, and the spare part of every bound above `2^-960`.

use super::separation::Corners;

const U: f64 = f64::EPSILON / 2.0;

/// Bounds above, rounded up.
const NORMAL: f64 = 42.0 * U;
const TWICE_NORMAL: f64 = 89.0 * U;
const VOLUME: f64 = 200.0 * U;

/// 2^-300 and 2^300: between them the products of three numbers, and their errors, are normal numbers.
const SMALLEST: f64 = f64::from_bits((1023 - 300) << 52);
const LARGEST: f64 = f64::from_bits((1023 + 300) << 52);

/// Enough for a root that is inside by a relative 2^-40; a bracket of that width is near the resolution of `f` itself.
const MOST_STEPS: usize = 24;

type Row = [f64; 3];

impl<const K: usize> Corners<K> {
    /// Whether there is a contact, if that can be decided here.
    pub(super) fn crosses(&self) -> Option<bool> {
        if !self.maxima.iter().all(|m| (SMALLEST..=LARGEST).contains(m)) {
            return None;
        }
        let error = VOLUME * self.maxima[0] * self.maxima[1] * self.maxima[2];
        let sign = |x: f64| i32::from(x > error) - i32::from(x < -error);
        let [p, q] = &self.ends;
        let (a, b, c) = (0, 1, K - 1);
        let b0 = determinant(p[a], p[b], p[c]);
        let b1 =
            determinant(q[a], p[b], p[c]) + determinant(p[a], q[b], p[c]) + determinant(p[a], p[b], q[c]);
        let b2 =
            determinant(p[a], q[b], q[c]) + determinant(q[a], p[b], q[c]) + determinant(q[a], q[b], p[c]);
        let b3 = determinant(q[a], q[b], q[c]);
        let [s0, s1, s2, s3] = [b0, b1, b2, b3].map(sign);
        if s0 != 0 && s0 == s1 && s0 == s2 && s0 == s3 {
            return Some(false);
        }
        if s0 == 0 || s0 != -s3 {
            return None;
        }
        let single = s1 == s0 || s2 == s3;
        let axis = self.dominant_axis();
        let [x, y] = [(axis + 1) % 3, (axis + 2) % 3];
        let size = self.maxima[x] * self.maxima[y];
        let normal_errors = [NORMAL * size, TWICE_NORMAL * size];

        let (mut low, mut high) = ((0.0, b0, *p), (1.0, b3, *q));
        for step in 0..MOST_STEPS {
            match steady_sides(&low.2, &high.2, x, y, normal_errors) {
                Some(Sides::Agree) => return Some(true),
                Some(Sides::Differ) => return single.then_some(false),
                None => {}
            }
            let width: f64 = high.0 - low.0;
            let t = if step % 2 == 0 {
                low.0 + width * (low.1 / (low.1 - high.1)).clamp(0.01, 0.99)
            } else {
                low.0 + 0.5 * width
            };
            let corners = self.at(t);
            let f = determinant(corners[a], corners[b], corners[c]);
            let s = sign(f);
            if s == s0 {
                low = (t, f, corners);
            } else if s == s3 {
                high = (t, f, corners);
            } else {
                return None;
            }
        }
        None
    }

    fn at(&self, t: f64) -> [Row; K] {
        core::array::from_fn(|i| {
            core::array::from_fn(|k| {
                let (p, q) = (self.ends[0][i][k], self.ends[1][i][k]);
                p + t * (q - p)
            })
        })
    }

    /// The coordinate in which the vector area, at the middle of the step, is largest.
    fn dominant_axis(&self) -> usize {
        let c = self.at(0.5);
        let difference = |i: usize| -> Row { core::array::from_fn(|k| c[i][k] - c[0][k]) };
        let n = super::separation::cross(difference(1), difference(K - 1)).map(f64::abs);
        if n[0] >= n[1] && n[0] >= n[2] {
            0
        } else if n[1] >= n[2] {
            1
        } else {
            2
        }
    }
}

/// On which sides of the polygon's edges the origin is, throughout a bracket.
enum Sides {
    /// The inner side of all.
    Agree,
    /// The inner side of one and the outer side of another.
    Differ,
}

/// Compares the signs of the coordinate of all `n_i` that the axes `x`, `y` give; `None` when one is not strict.
fn steady_sides<const K: usize>(
    low: &[Row; K],
    high: &[Row; K],
    x: usize,
    y: usize,
    [error, twice]: [f64; 2],
) -> Option<Sides> {
    let (mut positive, mut negative, mut unknown) = (0, 0, 0);
    for i in 0..K {
        let j = (i + 1) % K;
        let cross = |a: &Row, b: &Row| a[x] * b[y] - a[y] * b[x];
        let first = cross(&low[i], &low[j]);
        let middle = cross(&low[i], &high[j]) + cross(&high[i], &low[j]);
        let last = cross(&high[i], &high[j]);
        if first > error && middle > twice && last > error {
            positive += 1;
        } else if first < -error && middle < -twice && last < -error {
            negative += 1;
        } else {
            unknown += 1;
        }
    }
    if positive > 0 && negative > 0 {
        Some(Sides::Differ)
    } else if unknown == 0 {
        Some(Sides::Agree)
    } else {
        None
    }
}

/// The determinant of three rows, expanded along the last column.
fn determinant(a: Row, b: Row, c: Row) -> f64 {
    let minor = |p: Row, q: Row| p[0] * q[1] - p[1] * q[0];
    a[2] * minor(b, c) - b[2] * minor(a, c) + c[2] * minor(a, b)
}
