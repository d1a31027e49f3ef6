//! The corners of the polygon that must not hold the origin, as rounded differences of coordinates: [`Corners`].
//!
//! Coordinate by coordinate, since all corners are treated alike and machines compute several at a time.

use super::number::Number;

/// A convex polygon that moves: every corner the difference of two given points, on a straight line at constant speed.
pub(super) struct Corners<T, const K: usize> {
    /// At the beginning and at the end of the step; coordinate, corner.
    pub(super) ends: [[[T; K]; 3]; 2],
    /// No coordinate of a corner is larger in magnitude (but for rounding).
    pub(super) maxima: [f64; 3],
}

impl<T: Number, const K: usize> Corners<T, K> {
    /// The corners `(i, j)` stand for `points[i] - points[j]`, coordinates times `scale`.
    #[inline(always)]
    pub(super) fn new(
        step: &[[[f64; 3]; 4]; 2],
        corners: &[(usize, usize); K],
        scale: Option<[f64; 3]>,
    ) -> Self {
        let scaled = |x: f64, k: usize| scale.map_or(x, |scale| x * scale[k]);
        let ends = [0, 1].map(|end| {
            let p = &step[end];
            core::array::from_fn(|k| {
                corners.map(|(i, j)| T::difference(scaled(p[i][k], k), scaled(p[j][k], k)))
            })
        });
        let mut maxima = [0.0; 3];
        for end in &ends {
            let end: &[[T; K]; 3] = end;
            for (m, row) in maxima.iter_mut().zip(end) {
                for x in row {
                    let magnitude = x.leading().abs();
                    *m = if magnitude > *m { magnitude } else { *m };
                }
            }
        }
        Self { ends, maxima }
    }
}

impl<const K: usize> Corners<f64, K> {
    /// True when, along some axis, all corners are strictly on one side of the origin at both ends of the step, and so
    /// throughout. The sign of a rounded difference is that of the difference: nothing is lost here.
    #[inline(always)]
    pub(super) fn boxes_apart(&self) -> bool {
        let [p, q] = &self.ends;
        (0..3).any(|k| {
            let (mut low, mut high) = (p[k][0], p[k][0]);
            for &x in p[k].iter().chain(&q[k]) {
                low = if x < low { x } else { low };
                high = if x > high { x } else { high };
            }
            low > 0.0 || high < 0.0
        })
    }
}
