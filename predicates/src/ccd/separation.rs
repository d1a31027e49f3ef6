//! Separating directions in rounded arithmetic: most queries end here.
//!
//! If for some direction `d` the products `d . P_i` have one strict sign for all corners at both ends of the step, the
//! polygon stays on that side of the origin, for each `P_i` moves linearly. Any `d` will do; it is taken as the
//! exact vector of the rounded numbers, so how it was computed does not matter for the proof.
//!
//! **Bound.** With rounded differences `x_k (1 + e)`, `|e| <= u`, the rounded `d_0 x_0 + d_1 x_1 + d_2 x_2` is within
//! `5u (|d_0| m_0 + |d_1| m_1 + |d_2| m_2)` of `d . P_i`, where `m_k >= |x_k|`: one rounding of the difference, one of the
//! product and at most two of the sums, `(1 + u)^4 <= 1 + 4.1u`; the rest covers the rounding of the bound itself.
//! Underflow of a product adds at most 2^-1075 each, covered by [`UNDERFLOW`]. Overflow makes the bound infinite, or
//! the product infinite or NaN with an infinite bound: nothing is decided then. Of coordinates that were scaled down below 1 the scaling may lose
//! 2^-1075 each, times a direction below 2^12: covered too.

use super::corners::Corners;

/// Larger than the sum of all that underflow may add; a normal number.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52); // 2^-1000

/// 5u.
const DOT: f64 = 5.0 * (f64::EPSILON / 2.0);

impl<const K: usize> Corners<f64, K> {
    /// True when `direction` separates all corners from the origin throughout the step.
    #[inline(always)]
    pub(super) fn separated_by(&self, direction: [f64; 3]) -> bool {
        let [x, y, z] = direction;
        let bound = (x.abs() * self.maxima[0] + y.abs() * self.maxima[1] + z.abs() * self.maxima[2]) * DOT
            + UNDERFLOW;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in &self.ends {
            for ((a, b), c) in p[0].iter().zip(&p[1]).zip(&p[2]) {
                let s = x * a + y * b + z * c;
                low = if s > low { low } else { s };
                high = if s < high { high } else { s };
            }
        }
        (low > bound) | (high < -bound)
    }

    /// True when the normal of the polygon at the beginning of the step separates. Together with the direction to the centre it
    /// finds nine in ten separations.
    #[inline(always)]
    pub(super) fn separated_by_first_normal(&self) -> bool {
        self.separated_by(self.normal(0))
    }

    /// True when the direction to the centre separates.
    #[inline(always)]
    pub(super) fn separated_by_centre(&self) -> bool {
        self.separated_by(self.centre())
    }

    /// The sum of all corners.
    #[inline(always)]
    fn centre(&self) -> [f64; 3] {
        let [p, q] = &self.ends;
        let mut centre = [0.0; 3];
        for (sum, (p, q)) in centre.iter_mut().zip(p.iter().zip(q)) {
            for i in 0..K {
                *sum += p[i] + q[i];
            }
        }
        centre
    }

    /// The normal of the polygon at one end of the step.
    #[inline(always)]
    fn normal(&self, end: usize) -> [f64; 3] {
        cross(self.edge(end, 0, 1), self.edge(end, 0, K - 1))
    }

    /// From corner `i` to corner `j`.
    #[inline(always)]
    fn edge(&self, end: usize, i: usize, j: usize) -> [f64; 3] {
        self.ends[end].map(|row| row[j] - row[i])
    }

    /// True when one of a few other likely directions separates.
    #[inline(never)]
    pub(super) fn separated_otherwise(&self) -> bool {
        let last = self.normal(1);
        if self.separated_by(last) {
            return true;
        }
        let n = add(self.normal(0), last);
        // In the plane of the polygon, across the edges.
        self.separated_by(n)
            || (0..K).any(|i| {
                let j = (i + 1) % K;
                self.separated_by(cross(n, add(self.edge(0, i, j), self.edge(1, i, j))))
            })
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] + b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
