//! Linear motions of a few points: [`Movement`].
//!
//! A collision query goes wrong where its polynomials of time vanish, have multiple or close roots, or have roots at the
//! ends of the step or on the border of a primitive. Integers of one or two bits bring all of that about by themselves;
//! the other kinds carry it over to numbers of any exponent, or set out from a contact and move it by a few ulp.

use super::{Kind, number};
use crate::entropy::Entropy;

/// A family of motions, of as many points as a query takes in any number of dimensions. Nothing depends on which of
/// them belong to which primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Movement {
    /// Integers from -1 to 1; one in three motions stays in a coordinate plane, in a slanting one or on a line.
    Grid1,
    /// The same from -2 to 2.
    Grid2,
    /// The same from -4 to 4.
    Grid4,
    /// Grids, some of whose points rest.
    Resting,
    /// Points that stay in one plane (3D) or on one line (2D), which moves and turns.
    Sheet,
    /// Grids in which a point lies in the affine hull of others at one end of the step.
    EndTouch,
    /// Grids, moved by a few ulp.
    Ulps,
    /// Grids with one factor for each axis, from 2^-1000 to 2^1000.
    ScaledAxes,
    /// Grids with one of two factors, from 2^-1000 to 2^1000, for each coordinate.
    ScaledCoordinates,
    /// Every coordinate of any exponent, subnormal numbers among them, now and then in a plane.
    Exponents,
    /// Two independent configurations of any [`Kind`].
    Independent,
}

impl Movement {
    /// Every kind.
    pub const ALL: [Self; 11] = [
        Self::Grid1,
        Self::Grid2,
        Self::Grid4,
        Self::Resting,
        Self::Sheet,
        Self::EndTouch,
        Self::Ulps,
        Self::ScaledAxes,
        Self::ScaledCoordinates,
        Self::Exponents,
        Self::Independent,
    ];

    /// How many kinds, the last ones, have exponents of the whole range.
    const WHOLE_RANGE: usize = 4;

    /// The integer grids.
    pub const GRIDS: [Self; 3] = [Self::Grid1, Self::Grid2, Self::Grid4];

    /// The kinds that mix exponents.
    pub const MIXED_EXPONENTS: [Self; 3] = [Self::ScaledAxes, Self::ScaledCoordinates, Self::Exponents];

    /// Draws the points at both ends of the step.
    pub fn draw<const D: usize, const N: usize>(self, entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
        match self {
            Self::Grid1 => grid(1, entropy),
            Self::Grid2 => grid(2, entropy),
            Self::Grid4 => grid(4, entropy),
            Self::Resting => resting(entropy),
            Self::Sheet => sheet(entropy),
            Self::EndTouch => end_touch(entropy),
            Self::Ulps => ulps(entropy),
            Self::ScaledAxes => {
                let factors: [f64; D] = [(); D].map(|()| factor(entropy));
                any_grid(entropy).map(|t| t.map(|p: [f64; D]| std::array::from_fn(|k| p[k] * factors[k])))
            }
            Self::ScaledCoordinates => {
                let factors = [factor(entropy), factor(entropy)];
                any_grid(entropy).map(|t| t.map(|p| p.map(|x| x * entropy.pick(&factors))))
            }
            Self::Exponents => {
                let family = entropy.pick(&[
                    number::any_exponent as fn(&mut Entropy<'_>) -> f64,
                    number::subnormal,
                    number::near_max,
                    number::mixed,
                ]);
                let points = [(); 2].map(|()| [(); N].map(|()| [(); D].map(|()| family(entropy))));
                if entropy.below(3) == 0 { flattened(points, entropy) } else { points }
            }
            Self::Independent => {
                let kind = entropy.pick(&Kind::ALL);
                [kind.draw(entropy), kind.draw(entropy)]
            }
        }
    }

    /// Draws the kind, then one motion of it; a kind with exponents of the whole range, which takes both the predicates
    /// and their oracles a hundred times as long as the others, one time in sixteen.
    pub fn draw_any<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> (Self, [[[f64; D]; N]; 2]) {
        let (quick, wide) = Self::ALL.split_at(Self::ALL.len() - Self::WHOLE_RANGE);
        let kind = if entropy.below(16) == 15 { entropy.pick(wide) } else { entropy.pick(quick) };
        (kind, kind.draw(entropy))
    }
}

fn factor(entropy: &mut Entropy<'_>) -> f64 {
    number::power_of_two(entropy.between(-1000, 1000))
}

fn grid<const D: usize, const N: usize>(size: i32, entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let points = integers(size, entropy);
    if entropy.below(3) == 0 { flattened(points, entropy) } else { points }
}

fn any_grid<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let size = entropy.pick(&[1, 2, 4]);
    grid(size, entropy)
}

fn integers<const D: usize, const N: usize>(size: i32, entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let span = u8::try_from(2 * size + 1).expect("a small grid");
    [(); 2].map(|()| [(); N].map(|()| [(); D].map(|()| f64::from(i32::from(entropy.below(span)) - size))))
}

/// The same points with one coordinate replaced, throughout the step, by a constant, by another one, or by the
/// difference of the others; or with all but one coordinate replaced by another or by zero.
fn flattened<const D: usize, const N: usize>(
    mut points: [[[f64; D]; N]; 2],
    entropy: &mut Entropy<'_>,
) -> [[[f64; D]; N]; 2] {
    let (axis, way) = (usize::from(entropy.below(3)) % D, entropy.below(5));
    let (next, last) = ((axis + 1) % D, (axis + D - 1) % D);
    let height = number::grid(entropy);
    for p in points.as_flattened_mut() {
        match way {
            0 => p[axis] = height,
            1 => p[axis] = p[next],
            // The largest numbers have no difference.
            2 if (p[next] - p[last]).is_finite() => p[axis] = p[next] - p[last],
            2 => p[axis] = -p[next],
            3 => *p = std::array::from_fn(|k| if k == axis { p[k] } else { 0.0 }),
            _ => *p = [p[axis]; D],
        }
    }
    points
}

fn resting<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let [t0, mut t1] = any_grid(entropy);
    let resting = entropy.byte();
    for i in (0..N).filter(|i| resting >> i & 1 == 1) {
        t1[i] = t0[i];
    }
    [t0, t1]
}

/// Affine combinations, the same at both ends, of a frame of `D - 1` vectors that is drawn for either end, or for both;
/// one point in eight leaves the sheet.
fn sheet<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let frames: [[[f64; D]; D]; 2] = integers(2, entropy);
    let frames = if entropy.below(3) == 0 { [frames[0]; 2] } else { frames };
    let weights: [[[f64; D]; N]; 2] = integers(2, entropy);
    // Points that keep their weights stay in the sheet while it turns; others only in one that does not.
    let weights = if entropy.below(4) == 0 { weights } else { [weights[0]; 2] };
    let strays = entropy.byte();
    std::array::from_fn(|t| {
        std::array::from_fn(|i| {
            let mut point = frames[t][0];
            for vector in 1..D {
                for (x, v) in point.iter_mut().zip(&frames[t][vector]) {
                    *x += weights[t][i][vector] * v;
                }
            }
            if strays == 0 && i == 0 {
                point[0] += weights[t][i][0];
            }
            point
        })
    })
}

fn end_touch<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let mut points = any_grid(entropy);
    let (end, moved) = (usize::from(entropy.below(2)), usize::from(entropy.byte()) % N);
    // Eighths that add up to one; from a coincident point to the inside of a primitive.
    let [i, j, k] = [(); 3].map(|()| usize::from(entropy.byte()) % N);
    let weights = entropy.pick(&[[8.0, 0.0, 0.0], [4.0, 4.0, 0.0], [2.0, 3.0, 3.0], [12.0, -4.0, 0.0]]);
    let t: [[f64; D]; N] = points[end];
    points[end][moved] = std::array::from_fn(|axis| {
        (weights[0] * t[i][axis] + weights[1] * t[j][axis] + weights[2] * t[k][axis]) / 8.0
    });
    points
}

fn ulps<const D: usize, const N: usize>(entropy: &mut Entropy<'_>) -> [[[f64; D]; N]; 2] {
    let (mut points, tenth) =
        (if entropy.below(2) == 0 { end_touch(entropy) } else { any_grid(entropy) }, entropy.byte());
    let moved_of_eight = entropy.pick(&[1, 4, 8]);
    for coordinate in points.iter_mut().flatten().flatten() {
        // Tenths are no numbers, so that products round.
        *coordinate *= if tenth % 2 == 0 { 0.1 } else { 1.0 };
        // Neighbours of zero have the smallest exponent: they belong to the kinds that mix exponents.
        if *coordinate != 0.0 && entropy.below(8) < moved_of_eight {
            *coordinate = number::nudge(*coordinate, i64::from(entropy.between(-2, 2)));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entropy::stream;
    use crate::exact;

    #[test]
    fn every_kind_is_finite() {
        for kind in Movement::ALL {
            for seed in 0..300 {
                let bytes = stream(seed, 700);
                let (space, plane) = (
                    kind.draw::<3, 4>(&mut Entropy::new(&bytes)),
                    kind.draw::<2, 3>(&mut Entropy::new(&bytes)),
                );
                assert!(space.iter().flatten().flatten().all(|x| x.is_finite()), "{kind:?} {space:?}");
                assert!(plane.iter().flatten().flatten().all(|x| x.is_finite()), "{kind:?} {plane:?}");
            }
        }
    }

    /// Four points that are coplanar at both ends and in the middle, where sums of two coordinates are exact.
    #[test]
    fn sheets_stay_flat_and_others_do_not() {
        let flat = |kind: Movement| {
            (0..200).filter(move |&seed| {
                let [t0, t1] = kind.draw::<3, 4>(&mut Entropy::new(&stream(seed, 700)));
                let middle: [[f64; 3]; 4] =
                    std::array::from_fn(|i| std::array::from_fn(|k| t0[i][k] + t1[i][k]));
                [t0, t1, middle].iter().all(|points| exact::orient(points) == 0)
            })
        };
        assert!((150..200).contains(&flat(Movement::Sheet).count()));
        for kind in [Movement::Grid1, Movement::Grid2, Movement::Grid4] {
            assert!((40..140).contains(&flat(kind).count()), "{kind:?}: {}", flat(kind).count());
        }
    }
}
