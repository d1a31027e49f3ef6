//! The one test of boxes: [`apart`].

use glam::DVec3;
use welter_meshing::spatial::Box3;

/// Whether two boxes are farther apart than `distance` along an axis; never true if a number is not one.
///
/// Differences are rounded to nearest, which is monotone, and `distance` is an `f64`: a difference that is not above it
/// is not rounded above it, nor does it overflow. So closed boxes within the distance are never found apart, and what
/// two boxes are not, the boxes around them are not either. Differences of `f64` lose nothing at small exponents: the answer
/// stays the same if everything is multiplied by a power of two.
#[inline]
pub(super) fn apart(a: &Box3, b: &Box3, distance: f64) -> bool {
    let distance = DVec3::splat(distance);
    ((a.min - b.max).cmpgt(distance) | (b.min - a.max).cmpgt(distance)).any()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Box3 {
        Box3::of([DVec3::new(x, 0.0, 0.0)])
    }

    #[test]
    fn a_gap_is_compared_with_the_distance_without_a_tolerance() {
        for scale in [-1060, -1000, 0, 1000].map(|k| 2f64.powi(k / 2) * 2f64.powi(k - k / 2)) {
            let [a, b] = [at(scale), at(3.0 * scale)];
            assert!(!apart(&a, &b, 2.0 * scale) && !apart(&b, &a, 2.0 * scale));
            assert!(apart(&a, &b, (2.0 * scale).next_down()) && apart(&b, &a, (2.0 * scale).next_down()));
        }
    }

    #[test]
    fn rounding_errs_towards_near_and_overflow_towards_nothing() {
        // The gap is 1 + 2^-60, which rounds to 1; then 1 - 2^-60, which does so too.
        assert!(!apart(&at(-(0.5f64.powi(60))), &at(1.0), 1.0));
        assert!(!apart(&at(0.5f64.powi(60)), &at(1.0), 1.0));
        assert!(apart(&at(-f64::MAX), &at(f64::MAX), f64::MAX));
        assert!(!apart(&at(-f64::MAX), &at(0.0), f64::MAX));
    }

    #[test]
    fn infinite_boxes_are_near_and_empty_ones_are_not() {
        let all = Box3 { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        assert!(!apart(&all, &at(1.0), 0.0) && !apart(&at(-f64::MAX), &all, 0.0));
        assert!(apart(&Box3::EMPTY, &at(1.0), f64::MAX) && apart(&at(1.0), &Box3::EMPTY, f64::MAX));
        let unknown = Box3 { min: DVec3::NAN, max: DVec3::NAN };
        assert!(!apart(&unknown, &at(1.0), 0.0));
    }
}
