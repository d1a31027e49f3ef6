//! Configurations of points: [`Kind`].
//!
//! A predicate goes wrong where its value is nearly or exactly zero, or where a product leaves the range of `f64`.
//! Each kind is one way to get there. Configurations close to degenerate are made by building a degenerate one in
//! rounded arithmetic and moving coordinates by a few units in the last place.

use super::number;
use crate::entropy::Entropy;

/// A family of configurations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Coordinates uniform in `[-1, 1)`.
    Uniform,
    /// Coordinates with few bits: multiples of 1/8 of magnitude at most 16.
    Dyadic,
    /// Coordinates 0, +-1, +-2, +-4.
    Grid,
    /// As `Grid`, with one coordinate (now and then more) the same for all points.
    FlatGrid,
    /// Points in the affine hull of earlier ones (coincident, collinear, coplanar) up to a few ulp.
    NearFlat,
    /// Points of one sphere up to a few ulp.
    NearSphere,
    /// `Uniform`, all multiplied by one power of two, from 2^-1022 to 2^1022.
    Scaled,
    /// The whole exponent range, each coordinate its own.
    Exponents,
    /// Subnormal numbers and the smallest normal ones.
    Subnormal,
    /// Numbers within a factor of 32 of the greatest.
    NearMax,
    /// Zeros of both signs, the smallest numbers, and one.
    SignedZero,
    /// Each coordinate from any of these families.
    Mixed,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 12] = [
        Self::Uniform,
        Self::Dyadic,
        Self::Grid,
        Self::FlatGrid,
        Self::NearFlat,
        Self::NearSphere,
        Self::Scaled,
        Self::Exponents,
        Self::Subnormal,
        Self::NearMax,
        Self::SignedZero,
        Self::Mixed,
    ];

    /// Draws one configuration of `N` points.
    pub fn draw<const D: usize, const N: usize>(self, entropy: &mut Entropy<'_>) -> [[f64; D]; N] {
        let mut each =
            |family: fn(&mut Entropy<'_>) -> f64| [(); N].map(|()| [(); D].map(|()| family(entropy)));
        match self {
            Self::Uniform => each(number::uniform),
            Self::Dyadic => each(number::dyadic),
            Self::Grid => each(number::grid),
            Self::Exponents => each(number::any_exponent),
            Self::Subnormal => each(number::subnormal),
            Self::NearMax => each(number::near_max),
            Self::SignedZero => each(number::signed_zero),
            Self::Mixed => each(number::mixed),
            Self::FlatGrid => flat_grid(entropy),
            Self::NearFlat => near_flat(entropy),
            Self::NearSphere => near_sphere(entropy),
            Self::Scaled => {
                let factor = number::power_of_two(entropy.between(-1022, 1022));
                [(); N].map(|()| [(); D].map(|()| number::uniform(entropy) * factor))
            }
        }
    }

    /// Draws the kind, then one configuration of it.
    pub fn draw_any<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> (Self, [[f64; D]; N]) {
        let kind = entropy.pick(&Self::ALL);
        (kind, kind.draw(entropy))
    }
}

fn flat_grid<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[f64; D]; N] {
    let mut points = [(); N].map(|()| [(); D].map(|()| number::grid(entropy)));
    let axis = usize::from(entropy.byte()) % D;
    let second = if entropy.below(8) == 0 { usize::from(entropy.byte()) % D } else { axis };
    for axis in [axis, second] {
        let height = number::grid(entropy);
        for point in &mut points {
            point[axis] = height;
        }
    }
    points
}

/// Each point is new or an affine combination, with weights in eighths, of up to `D` earlier points.
fn near_flat<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[f64; D]; N] {
    let family =
        entropy.pick(&[number::uniform as fn(&mut Entropy<'_>) -> f64, number::dyadic, number::grid]);
    let mut points = [[0.0; D]; N];
    for i in 0..N {
        if i < 2 || entropy.below(4) == 0 {
            points[i] = [(); D].map(|()| family(entropy));
            continue;
        }
        // base + sum of weight * (other - base); often all weights are convex, so that points land inside.
        let base = points[usize::from(entropy.byte()) % i];
        points[i] = base;
        let terms = entropy.below(u8::try_from(D).expect("few dimensions")) + 1;
        let weights = entropy.pick(&[(0, 4), (0, 8), (-8, 16)]);
        for _ in 0..terms {
            let other = points[usize::from(entropy.byte()) % i];
            let weight = f64::from(entropy.between(weights.0, weights.1)) / 8.0;
            for axis in 0..D {
                points[i][axis] += weight * (other[axis] - base[axis]);
            }
        }
    }
    finish(points, entropy)
}

/// Signed permutations of one vector of integers around a common centre.
fn near_sphere<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[f64; D]; N] {
    // Integer vectors of equal length: several of each length, so that the points are not all symmetric.
    const FIVE: &[&[f64]] = &[&[5.0], &[3.0, 4.0]];
    const NINE: &[&[f64]] =
        &[&[9.0], &[1.0, 4.0, 8.0], &[4.0, 4.0, 7.0], &[3.0, 6.0, 6.0], &[1.0, 4.0, 0.0, 8.0]];
    const SIXTY_FIVE: &[&[f64]] = &[&[65.0], &[16.0, 63.0], &[33.0, 56.0], &[25.0, 60.0], &[39.0, 52.0]];
    let family = entropy.pick(&[FIVE, NINE, SIXTY_FIVE]);
    let fitting: Vec<&[f64]> = family.iter().copied().filter(|vector| vector.len() <= D).collect();
    let centre: [f64; D] = match entropy.below(3) {
        0 => [0.0; D],
        1 => [(); D].map(|()| number::dyadic(entropy)),
        _ => [(); D].map(|()| number::uniform(entropy)),
    };
    let mut points = [centre; N];
    for point in &mut points {
        let start = usize::from(entropy.byte()) % D;
        for (axis, &length) in entropy.pick(&fitting).iter().enumerate() {
            let side = if entropy.below(2) == 0 { length } else { -length };
            point[(start + axis) % D] += side;
        }
    }
    finish(points, entropy)
}

/// Moves no, some or all coordinates by at most three ulp, then scales all by one power of two (exactly).
fn finish<const D: usize, const N: usize>(
    mut points: [[f64; D]; N],
    entropy: &mut Entropy<'_>,
) -> [[f64; D]; N] {
    let moved_of_eight = entropy.pick(&[0, 1, 8]);
    // Coordinates are multiples of 2^-56 (3/8 of a product of 2^-52) unless nudged, and at most 2^8.
    let exponent = entropy.pick(&[0, 1, 2, 3]) * entropy.between(-320, 320);
    let factor = number::power_of_two(exponent.clamp(-960, 960));
    for coordinate in points.iter_mut().flatten() {
        if entropy.below(8) < moved_of_eight {
            *coordinate = number::nudge(*coordinate, i64::from(entropy.between(-3, 3)));
        }
        *coordinate *= factor;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{entropy::stream, exact};

    /// How many of `count` draws of five points in the plane of `kind` give a zero of `oracle`.
    fn zeros(kind: Kind, count: u64, oracle: fn(&[[f64; 2]; 4]) -> i32) -> u64 {
        (0..count)
            .filter(|&seed| oracle(&kind.draw::<2, 4>(&mut Entropy::new(&stream(seed, 400)))) == 0)
            .count() as u64
    }

    #[test]
    fn every_kind_is_finite() {
        for kind in Kind::ALL {
            for seed in 0..200 {
                let points: [[f64; 3]; 6] = kind.draw(&mut Entropy::new(&stream(seed, 500)));
                assert!(points.iter().flatten().all(|c| c.is_finite()), "{kind:?} {points:?}");
            }
        }
    }

    #[test]
    fn degenerate_kinds_are_sometimes_but_not_always_degenerate() {
        let orient = |p: &[[f64; 2]; 4]| exact::orient(&[p[0], p[1], p[2]]);
        let incircle = |p: &[[f64; 2]; 4]| exact::in_sphere(p);
        assert_eq!(zeros(Kind::Uniform, 300, orient), 0);
        for (kind, oracle) in [
            (Kind::Grid, orient as fn(&[[f64; 2]; 4]) -> i32),
            (Kind::FlatGrid, orient),
            (Kind::NearFlat, orient),
            (Kind::NearSphere, incircle),
            (Kind::SignedZero, orient),
        ] {
            let found = zeros(kind, 300, oracle);
            assert!((10..=300).contains(&found), "{kind:?}: {found} of 300");
        }
    }
}
