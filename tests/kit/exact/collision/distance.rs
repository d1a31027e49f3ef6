//! The distance of two convex sets given by few points, exactly: [`squared_distance`].

use crate::exact::linear;
use rug::{Integer, Rational};

/// The squared distance of the hulls of two sets of points.
///
/// The nearest two points are carried by sets of points whose columns `(coordinates, sums of weights)` are independent,
/// with positive weights; so they minimise `|sum s_i a_i - sum t_j b_j|^2` under `sum s_i = sum t_j = 1` also among weights
/// of any sign, and are the only solution of the linear equations that Lagrange's multipliers give. All supports are
/// tried. A solution without negative weight is a pair of points of the two sets, so no candidate is too small.
pub(super) fn squared_distance<const D: usize>(a: &[[Integer; D]], b: &[[Integer; D]]) -> Rational {
    let columns: Vec<[Integer; D]> =
        a.iter().cloned().chain(b.iter().map(|p| p.clone().map(|c| -c))).collect();
    let in_a = (1_u32 << a.len()) - 1;
    let mut least: Option<Rational> = None;
    for support in 1_u32..1 << columns.len() {
        if support & in_a == 0 || support & !in_a == 0 {
            continue;
        }
        let chosen: Vec<usize> = (0..columns.len()).filter(|i| support >> i & 1 == 1).collect();
        let Some(square) = stationary(&columns, &chosen, a.len()) else { continue };
        least = Some(match least {
            Some(least) => least.min(square),
            None => square,
        });
    }
    least.expect("there is a nearest pair of points")
}

/// The squared length at the only stationary point for weights of the chosen columns, unless one of them is negative or
/// there are several such points.
fn stationary<const D: usize>(columns: &[[Integer; D]], chosen: &[usize], first: usize) -> Option<Rational> {
    let dot = |i: usize, j: usize| {
        columns[i].iter().zip(&columns[j]).fold(Integer::new(), |sum, (x, y)| sum + Integer::from(x * y))
    };
    let sums = |i: usize| [i < first, i >= first].map(Integer::from);
    // Unknowns: the weights, then one multiplier for either sum of weights.
    let mut system: Vec<Vec<Integer>> =
        chosen.iter().map(|&i| chosen.iter().map(|&j| dot(i, j)).chain(sums(i)).collect()).collect();
    for side in 0..2 {
        system.push(
            chosen.iter().map(|&i| sums(i)[side].clone()).chain([Integer::new(), Integer::new()]).collect(),
        );
    }
    let target: Vec<Integer> = (0..chosen.len() + 2).map(|row| Integer::from(row >= chosen.len())).collect();
    let system: Vec<&[Integer]> = system.iter().map(Vec::as_slice).collect();
    let (solution, denominator) = linear::solve(&system, &target)?;
    let weights = &solution[..chosen.len()];
    if weights.iter().any(|w| w.cmp0() == denominator.cmp0().reverse()) {
        return None;
    }
    let mut difference = [(); D].map(|()| Integer::new());
    for (&i, weight) in chosen.iter().zip(weights) {
        for (sum, x) in difference.iter_mut().zip(&columns[i]) {
            *sum += weight * x;
        }
    }
    let square = difference.into_iter().fold(Integer::new(), |sum, x| sum + x.square());
    Some(Rational::from((square, denominator.square())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(points: &[[i32; 3]]) -> Vec<[Integer; 3]> {
        points.iter().map(|p| p.map(Integer::from)).collect()
    }

    #[test]
    fn known_distances() {
        let triangle = whole(&[[0, 0, 0], [6, 0, 0], [0, 6, 0]]);
        let from = |v: [i32; 3]| squared_distance(&whole(&[v]), &triangle);
        // Above the inside, beyond an edge, beyond a corner, beyond the long edge, on it.
        assert_eq!([from([1, 1, 5]), from([2, -3, 4]), from([-1, -2, 2])], [25, 25, 9].map(Rational::from));
        assert_eq!(
            [from([6, 6, 0]), from([4, 3, 0]), from([2, 2, 0])],
            [(18, 1), (1, 2), (0, 1)].map(Rational::from)
        );
        let edges = |a: [[i32; 3]; 2], b: [[i32; 3]; 2]| squared_distance(&whole(&a), &whole(&b));
        // Crossing, parallel, end to end, and points.
        assert_eq!(edges([[-1, 0, 0], [1, 0, 0]], [[0, -1, 3], [0, 1, 3]]), 9);
        assert_eq!(edges([[0, 0, 0], [4, 0, 0]], [[1, 2, 0], [9, 2, 0]]), 4);
        assert_eq!(edges([[0, 0, 0], [1, 0, 0]], [[2, 1, 1], [5, 1, 1]]), 3);
        assert_eq!(edges([[1, 2, 3]; 2], [[2, 4, 3]; 2]), 5);
        assert_eq!(edges([[0, 0, 0], [1, 0, 0]], [[0, 1, 1], [1, 0, 1]]), 1);
    }
}
