//! Numbers of one triangle that tell how good it is. All are free of units, or squares of lengths: nothing
//! overflows for lengths up to
//! [`MAX_LENGTH`](crate::shapes::MAX_LENGTH).

use crate::DVec3;

/// Twice the area times the unit normal.
#[inline]
pub(super) fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Cosine of the smallest angle: 1/2 of the equilateral triangle, 1 of one that is flat. By the law of
/// cosines, as the smallest angle is opposite to the shortest side.
#[inline]
pub(super) fn sharpness([a, b, c]: [DVec3; 3]) -> f64 {
    let mut squares = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    if squares[0] > squares[1] {
        squares.swap(0, 1);
    }
    if squares[0] > squares[2] {
        squares.swap(0, 2);
    }
    let [least, p, q] = squares;
    let product = p * q;
    if product > 0.0 { (p + q - least) / (2.0 * product.sqrt()) } else { 1.0 }
}

/// The largest [`sharpness`] of some triangles.
#[inline]
pub(super) fn sharpest(triangles: impl Iterator<Item = [DVec3; 3]>) -> f64 {
    triangles.map(sharpness).fold(0.5, f64::max)
}

/// Whether one sharpness improves on another: by more than rounding, so that no change is undone and made
/// again.
#[inline]
pub(super) fn blunter(after: f64, before: f64) -> bool {
    after < before - 1e-6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sharpness_is_the_cosine_of_the_smallest_angle() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 3.0, 0.0]].map(DVec3::from_array);
        for turn in 0..3 {
            let turned = [corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]];
            assert!((sharpness(turned) - 0.8).abs() < 1e-15);
        }
        assert_eq!(sharpness([DVec3::ZERO; 3]), 1.0);
        assert_eq!(sharpness([DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), 1.0);
    }
}
