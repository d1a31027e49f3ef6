//! Configurations at a chosen distance from degenerate: [`near_hyperplane`], [`near_sphere`].
//!
//! An exactly degenerate configuration whose last point is the origin, which is then displaced by a random vector of a
//! chosen power of two. Where along that scale a stage stops settling signs measures its error bound to a fraction of a
//! bit, and displacements of any size are representable.

use super::number::{dyadic, power_of_two, uniform};
use crate::entropy::Entropy;

/// `D + 1` points of `D` dimensions, the last one displaced by at most `2^-bits` in each coordinate from the hyperplane
/// of the others; not displaced for `None`.
pub fn near_hyperplane<const D: usize, const N: usize>(
    bits: Option<i32>,
    entropy: &mut Entropy<'_>,
) -> [[f64; D]; N] {
    assert_eq!(N, D + 1);
    // The origin is the mean of the others.
    let mut points = [[0.0; D]; N];
    let mut sum = [0.0; D];
    for point in points.iter_mut().take(D - 1) {
        *point = [(); D].map(|()| dyadic(entropy) / 16.0);
        sum = std::array::from_fn(|axis| sum[axis] + point[axis]);
    }
    points[D - 1] = sum.map(|c| -c);
    points[D] = displacement(bits, entropy);
    points
}

/// `D + 2` points, the last one displaced by at most `2^-bits` in each coordinate from the sphere through the others; not
/// displaced for `None`.
pub fn near_sphere<const D: usize, const N: usize>(
    bits: Option<i32>,
    entropy: &mut Entropy<'_>,
) -> [[f64; D]; N] {
    assert_eq!(N, D + 2);
    // Vectors of integers of length 65 and of length 9, over a power of two: of length about 1.
    const PLANE: [[f64; 3]; 4] = [[16.0, 63.0, 0.0], [33.0, 56.0, 0.0], [25.0, 60.0, 0.0], [39.0, 52.0, 0.0]];
    const SPACE: [[f64; 3]; 3] = [[1.0, 4.0, 8.0], [4.0, 4.0, 7.0], [3.0, 6.0, 6.0]];
    let mut radius = || -> [f64; D] {
        let (lengths, unit) = if D == 2 { (entropy.pick(&PLANE), 64.0) } else { (entropy.pick(&SPACE), 8.0) };
        let start = usize::from(entropy.byte());
        std::array::from_fn(|axis| {
            let length = lengths[(start + axis) % D] / unit;
            if entropy.below(2) == 0 { length } else { -length }
        })
    };
    // All on the sphere around minus the first radius, which passes through the origin.
    let first = radius();
    let mut points = [[0.0; D]; N];
    for point in points.iter_mut().take(D + 1) {
        let radius = radius();
        *point = std::array::from_fn(|axis| radius[axis] - first[axis]);
    }
    points[D + 1] = displacement(bits, entropy);
    points
}

fn displacement<const D: usize>(bits: Option<i32>, entropy: &mut Entropy<'_>) -> [f64; D] {
    let factor = bits.map_or(0.0, |bits| power_of_two(-bits));
    [(); D].map(|()| uniform(entropy) * factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{entropy::stream, exact};

    #[test]
    fn without_displacement_they_are_degenerate() {
        for seed in 0..300 {
            let bytes = stream(seed, 600);
            let entropy = &mut Entropy::new(&bytes);
            assert_eq!(exact::orient(&near_hyperplane::<2, 3>(None, entropy)), 0);
            assert_eq!(exact::orient(&near_hyperplane::<3, 4>(None, entropy)), 0);
            assert_eq!(exact::orient(&near_hyperplane::<4, 5>(None, entropy)), 0);
            assert_eq!(exact::in_sphere(&near_sphere::<2, 4>(None, entropy)), 0);
            assert_eq!(exact::in_sphere(&near_sphere::<3, 5>(None, entropy)), 0);
        }
    }

    #[test]
    fn with_displacement_they_seldom_are() {
        let zeros = (0..300).filter(|&seed| {
            let bytes = stream(seed, 600);
            let entropy = &mut Entropy::new(&bytes);
            exact::orient(&near_hyperplane::<3, 4>(Some(300), entropy)) == 0
                || exact::in_sphere(&near_sphere::<3, 5>(Some(300), entropy)) == 0
        });
        let zeros = zeros.count();
        // Only those whose first points are degenerate among themselves: repeated or on one circle.
        assert!(zeros < 200, "{zeros} of 300");
    }
}
