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
        step: [&[[f64; 3]; 4]; 2],
        corners: &[(usize, usize); K],
        scale: Option<[f64; 3]>,
    ) -> Self {
        let mut ends = [[[T::of(0.0); K]; 3]; 2];
        let mut maxima = [0.0; 3];
        for (end, places) in ends.iter_mut().zip(step) {
            for (k, row) in end.iter_mut().enumerate() {
                let factor = scale.map_or(1.0, |scale| scale[k]);
                for (corner, &(i, j)) in row.iter_mut().zip(corners) {
                    *corner = T::difference(places[i][k] * factor, places[j][k] * factor);
                    let magnitude = corner.leading().abs();
                    maxima[k] = if magnitude > maxima[k] { magnitude } else { maxima[k] };
                }
            }
        }
        Self { ends, maxima }
    }

    /// The corners at the beginning and at the end of the step, corner by corner.
    pub(super) fn by_corner(&self) -> [[[T; 3]; K]; 2] {
        [0, 1].map(|end| core::array::from_fn(|i| core::array::from_fn(|k| self.ends[end][k][i])))
    }
}

impl<const K: usize> Corners<f64, K> {
    /// The corners, and whether along some axis all are strictly on one side of the origin at both ends of the step. The sign of a
    /// rounded difference is that of the difference.
    #[inline(always)]
    pub(super) fn with_boxes(step: [&[[f64; 3]; 4]; 2], corners: &[(usize, usize); K]) -> (Self, bool) {
        let mut ends = [[[0.0; K]; 3]; 2];
        let (mut lows, mut highs) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (end, places) in ends.iter_mut().zip(step) {
            for (k, row) in end.iter_mut().enumerate() {
                for (corner, &(i, j)) in row.iter_mut().zip(corners) {
                    let x = places[i][k] - places[j][k];
                    *corner = x;
                    lows[k] = if x < lows[k] { x } else { lows[k] };
                    highs[k] = if x > highs[k] { x } else { highs[k] };
                }
            }
        }
        let mut maxima = [0.0; 3];
        let mut apart = false;
        for k in 0..3 {
            maxima[k] = if highs[k] > -lows[k] { highs[k] } else { -lows[k] };
            apart |= (lows[k] > 0.0) | (highs[k] < 0.0);
        }
        (Self { ends, maxima }, apart)
    }
}
