//! The corners of the polygon as exact polynomials of time: [`trajectories`].

use crate::arithmetic::arena::{Arena, Int};
use crate::arithmetic::fixed_point::Unit;
use crate::arithmetic::univariate::Polynomial;

/// The most corners of a polygon.
pub(super) const MOST_CORNERS: usize = 4;

/// The coordinates of one corner.
pub(super) type Place = [Polynomial; 3];

/// The coordinates of the corners, each the difference of two of the `points`: `(i, j)` stands for `points[i] - points[j]`.
///
/// `points` holds the places at time 0, then those at time 1; of the motion, the part within the `interval` of [0, 1] is
/// taken, and its ends are the times 0 and 1 of the polynomials. Each axis has a unit of its own.
pub(super) fn trajectories<const N: usize>(
    points: [&[[f64; N]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    arena: &mut Arena<'_>,
) -> [Place; MOST_CORNERS] {
    let mut places = [[Polynomial::ZERO; 3]; MOST_CORNERS];
    for k in 0..N {
        let unit = Unit::of(axis(points, k)).exponent();
        for (place, &(i, j)) in places.iter_mut().zip(corners) {
            let ends = points.map(|p| {
                let (a, b) = (arena.load(p[i][k], unit), arena.load(p[j][k], unit));
                arena.sub(a, b)
            });
            let [start, end] = if interval == super::STEP { ends } else { restricted(ends, interval, arena) };
            let slope = arena.sub(end, start);
            place[k] = Polynomial::new(&[start, slope]);
        }
    }
    places
}

/// Limbs of the largest integer that [`trajectories`] loads.
pub(super) fn limbs<const N: usize>(points: [&[[f64; N]]; 2], interval: [f64; 2]) -> usize {
    let [from, to] = interval;
    let time = if interval == super::STEP { 0 } else { Unit::limbs([from, to, 1.0].into_iter()) };
    (0..N).map(|k| Unit::limbs(axis(points, k))).max().unwrap_or(0) + time
}

/// One coordinate of all points.
fn axis<const N: usize>(points: [&[[f64; N]]; 2], k: usize) -> impl Iterator<Item = f64> + Clone {
    points.into_iter().flat_map(move |p| p.iter().map(move |point| point[k]))
}

/// A coordinate at the ends of the interval, given its values at times 0 and 1; all times one power of two.
fn restricted([at_0, at_1]: [Int; 2], interval: [f64; 2], arena: &mut Arena<'_>) -> [Int; 2] {
    let unit = Unit::of(interval).exponent().min(0);
    interval.map(|time| {
        let mark = arena.mark();
        let (one, time) = (arena.load(1.0, unit), arena.load(time, unit));
        let origin = arena.mul(at_0, one);
        let slope = arena.sub(at_1, at_0);
        let way = arena.mul(slope, time);
        let mut place = arena.add(origin, way);
        arena.keep(mark, [&mut place]);
        place
    })
}

/// `det(P_0, P_1, P_last) = n_0 . P_last`.
pub(super) fn volume(normal: &[Polynomial; 3], last: &Place, arena: &mut Arena<'_>) -> Polynomial {
    let mark = arena.mark();
    let mut volume = Polynomial::ZERO;
    for (n, coordinate) in normal.iter().zip(last) {
        let term = n.mul(coordinate, arena);
        volume = volume.add(&term, arena);
    }
    volume.keep(mark, arena);
    volume
}

/// `a_i b_j - a_j b_i`.
pub(super) fn minor(a: &Place, b: &Place, i: usize, j: usize, arena: &mut Arena<'_>) -> Polynomial {
    let mark = arena.mark();
    let first = a[i].mul(&b[j], arena);
    let second = a[j].mul(&b[i], arena);
    let mut minor = first.add(&second.negated(), arena);
    minor.keep(mark, arena);
    minor
}
