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
//! the product infinite or NaN with an infinite bound: nothing is decided then.

/// Larger than the sum of all that underflow may add; a normal number.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52); // 2^-1000

/// 5u.
const DOT: f64 = 5.0 * (f64::EPSILON / 2.0);

/// The corners at both ends of the step, rounded differences.
pub(super) struct Corners<const K: usize> {
    pub(super) ends: [[[f64; 3]; K]; 2],
    /// The largest magnitude in each coordinate.
    pub(super) maxima: [f64; 3],
}

impl<const K: usize> Corners<K> {
    #[inline]
    pub(super) fn new(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4], corners: &[(usize, usize); K]) -> Self {
        let ends = [t0, t1].map(|p| {
            core::array::from_fn(|c| {
                let (i, j) = corners[c];
                core::array::from_fn(|k| p[i][k] - p[j][k])
            })
        });
        let mut maxima = [0.0; 3];
        for corner in ends.as_flattened() {
            let corner: &[f64; 3] = corner;
            for (m, x) in maxima.iter_mut().zip(corner) {
                *m = if x.abs() > *m { x.abs() } else { *m };
            }
        }
        Self { ends, maxima }
    }

    /// True when `direction` separates all corners from the origin throughout the step.
    #[inline]
    pub(super) fn separated_by(&self, direction: [f64; 3]) -> bool {
        let [x, y, z] = direction;
        let bound = (x.abs() * self.maxima[0] + y.abs() * self.maxima[1] + z.abs() * self.maxima[2]) * DOT
            + UNDERFLOW;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in self.ends.as_flattened() {
            let s = x * p[0] + y * p[1] + z * p[2];
            low = if s > low { low } else { s };
            high = if s < high { high } else { s };
        }
        low > bound || high < -bound
    }

    /// True when one of a few likely directions separates.
    #[inline]
    pub(super) fn separated(&self) -> bool {
        let [p, q] = &self.ends;
        // The normals at both ends of the step, and in its middle.
        let normal = |c: &[[f64; 3]; K]| {
            let last = c[K - 1];
            cross(subtract(c[1], c[0]), subtract(last, c[0]))
        };
        let n0 = normal(p);
        if self.separated_by(n0) {
            return true;
        }
        let n1 = normal(q);
        if self.separated_by(n1) || self.separated_by(add(n0, n1)) {
            return true;
        }
        // Towards the centre.
        let mut centre = [0.0; 3];
        for corner in self.ends.as_flattened() {
            centre = add(centre, *corner);
        }
        if self.separated_by(centre) {
            return true;
        }
        // In the plane of the polygon, across the edges.
        let n = add(n0, n1);
        let middle: [[f64; 3]; K] = core::array::from_fn(|i| add(p[i], q[i]));
        (0..K).any(|i| self.separated_by(cross(n, subtract(middle[(i + 1) % K], middle[i]))))
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] + b[k])
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] - b[k])
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
