//! Symbolic perturbation against an actual one: each coordinate is increased by a power of two so small that the
//! sign of the whole polynomial is that of its leading term, and the determinant is evaluated in unbounded integers.

use rug::Integer;
use welter_kit::exact::determinant;
use welter_kit::generate::{Kind, seeded};
use welter_predicates::Sign;
use welter_predicates::sos::{incircle_sos, orient2d_sos, orient3d_sos};

/// `e = 2^-BITS`. Coordinates are integers from 0 to 3; then no minor of these matrices reaches 2^24 in magnitude, and
/// with fewer than 2^10 terms each coefficient times `e` outweighs all that follow.
const BITS: u32 = 40;

/// The sign after the displacement that the module documents, by rank of the ids: coordinate `k` of the point of rank
/// `i` grows by `e^(2^(N + d i + k))`, its squared length by `e^(2^i)`.
fn displaced<const D: usize, const N: usize>(points: &[[f64; D]; N], ids: [u64; N], lifted: bool) -> Sign {
    let entries = N * (D + usize::from(lifted));
    // In units of the smallest displacement.
    let unit = BITS << (entries - 1);
    let displacement = |entry: usize| Integer::from(1) << (unit - (BITS << entry));
    let rank = |i: usize| ids.iter().filter(|id| **id < ids[i]).count();
    let shift = if lifted { N } else { 0 };
    let rows: Vec<Vec<Integer>> = (0..N)
        .map(|i| {
            let at = |x: i64, entry: usize| (Integer::from(x) << unit) + displacement(entry);
            let mut row: Vec<Integer> =
                (0..D).map(|k| at(points[i][k] as i64, shift + D * rank(i) + k)).collect();
            if lifted {
                row.push(at(points[i].iter().map(|x| (x * x) as i64).sum(), rank(i)));
            }
            row.push(Integer::from(1));
            row
        })
        .collect();
    match determinant(&rows).cmp0() {
        std::cmp::Ordering::Less => Sign::Negative,
        std::cmp::Ordering::Equal => Sign::Zero,
        std::cmp::Ordering::Greater => Sign::Positive,
    }
}

/// Points on a grid, many of them degenerate in several ways, with ids in an order that varies.
fn grids<const D: usize, const N: usize>(count: u64) -> impl Iterator<Item = ([[f64; D]; N], [u64; N])> {
    let half = seeded::<D, N>(Kind::Grid, count).chain(seeded::<D, N>(Kind::FlatGrid, count));
    half.enumerate().map(|(round, points)| {
        let side = 1.0 + (round % 4) as f64;
        let ids = std::array::from_fn(|i| ((i * (round % 7 + 1) + round) % 11) as u64 * 100 + i as u64);
        (points.map(|p| p.map(|x| x.rem_euclid(side).floor())), ids)
    })
}

#[test]
fn plane_orientations_are_those_of_displaced_points() {
    for (points, ids) in grids(200) {
        assert_eq!(orient2d_sos(points, ids), displaced(&points, ids, false), "{points:?} {ids:?}");
    }
}

#[test]
fn space_orientations_are_those_of_displaced_points() {
    for (points, ids) in grids(24) {
        assert_eq!(orient3d_sos(points, ids), displaced(&points, ids, false), "{points:?} {ids:?}");
    }
}

#[test]
fn incircle_is_that_of_displaced_points() {
    for (points, ids) in grids(24) {
        assert_eq!(incircle_sos(points, ids), displaced(&points, ids, true), "{points:?} {ids:?}");
    }
}
