//! Linear algebra on integers: solving, rank, dimension. Fraction-free, so no number is ever reduced or rounded.

use rug::{Assign, Integer};

/// The only solution of `sum x_i columns_i = target`, as numerators and one common nonzero denominator; nothing if there
/// is no solution or the columns are dependent.
///
/// Gauss-Jordan elimination in which every division is exact \[Bareiss68\].
#[must_use]
pub fn solve(columns: &[&[Integer]], target: &[Integer]) -> Option<(Vec<Integer>, Integer)> {
    let unknowns = columns.len();
    let mut rows: Vec<Vec<Integer>> = (0..target.len())
        .map(|row| columns.iter().map(|column| column[row].clone()).chain([target[row].clone()]).collect())
        .collect();
    let mut pivot = Integer::from(1);
    for step in 0..unknowns {
        let found = (step..rows.len()).find(|&row| !rows[row][step].is_zero())?;
        rows.swap(step, found);
        eliminate(&mut rows, step, &pivot);
        pivot.assign(&rows[step][step]);
    }
    if rows[unknowns..].iter().any(|row| !row[unknowns].is_zero()) {
        return None;
    }
    // Every diagonal entry is now the last pivot.
    Some((rows[..unknowns].iter().map(|row| row[unknowns].clone()).collect(), pivot))
}

/// Clears column `step` in all rows but row `step`; `previous` is the pivot of the step before.
fn eliminate(rows: &mut [Vec<Integer>], step: usize, previous: &Integer) {
    let by = rows[step].clone();
    for (index, row) in rows.iter_mut().enumerate() {
        if index == step {
            continue;
        }
        let factor = row[step].clone();
        for (entry, above) in row.iter_mut().zip(&by) {
            *entry *= &by[step];
            *entry -= Integer::from(&factor * above);
            entry.div_exact_mut(previous);
        }
    }
}

/// The rank of a matrix given by its rows.
#[must_use]
pub fn rank(rows: &[Vec<Integer>]) -> usize {
    let mut rows = rows.to_vec();
    let (mut rank, mut pivot) = (0, Integer::from(1));
    for column in 0..rows.first().map_or(0, Vec::len) {
        let Some(found) = (rank..rows.len()).find(|&row| !rows[row][column].is_zero()) else { continue };
        rows.swap(rank, found);
        let (above, below) = rows.split_at_mut(rank + 1);
        let by = &above[rank];
        for row in below {
            let factor = row[column].clone();
            for (entry, above) in row.iter_mut().zip(by) {
                *entry *= &by[column];
                *entry -= Integer::from(&factor * above);
                entry.div_exact_mut(&pivot);
            }
        }
        pivot.assign(&by[column]);
        rank += 1;
    }
    rank
}

/// The dimension of the affine hull of points in homogeneous coordinates (last one not zero); nothing for no points.
#[must_use]
pub fn affine_dimension(points: &[Vec<Integer>]) -> Option<usize> {
    rank(points).checked_sub(1)
}

/// The same homogeneous point with coprime coordinates and a positive last one.
#[must_use]
pub fn primitive(mut point: Vec<Integer>) -> Vec<Integer> {
    let mut content = point.iter().fold(Integer::new(), |gcd, c| gcd.gcd(c));
    if point.last().is_some_and(|last| last.is_negative()) {
        content = -content;
    }
    if !content.is_zero() {
        for c in &mut point {
            c.div_exact_mut(&content);
        }
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(values: &[i32]) -> Vec<Integer> {
        values.iter().map(|&v| Integer::from(v)).collect()
    }

    #[test]
    fn solves_with_a_common_denominator() {
        // 2x + y = 4, x - 3y = -5, and a dependent third row.
        let (x, d) = solve(&[&whole(&[2, 1, 3]), &whole(&[1, -3, -2])], &whole(&[4, -5, -1])).unwrap();
        assert_eq!((x[0] == d, x[1] == Integer::from(2) * &d), (true, true));
        assert!(solve(&[&whole(&[2, 1, 3]), &whole(&[1, -3, -2])], &whole(&[4, -5, 0])).is_none());
        assert!(solve(&[&whole(&[1, 2]), &whole(&[2, 4])], &whole(&[3, 6])).is_none());
    }

    #[test]
    fn rank_and_dimension() {
        assert_eq!(rank(&[whole(&[0, 1, 2]), whole(&[0, 2, 4]), whole(&[0, 0, 5])]), 2);
        assert_eq!(rank(&[]), 0);
        assert_eq!(affine_dimension(&[]), None);
        assert_eq!(affine_dimension(&[whole(&[3, 4, 1]), whole(&[6, 8, 2])]), Some(0));
        assert_eq!(affine_dimension(&[whole(&[0, 0, 1]), whole(&[1, 1, 1]), whole(&[4, 4, 2])]), Some(1));
    }

    #[test]
    fn primitive_points() {
        assert_eq!(primitive(whole(&[6, -4, -2])), whole(&[-3, 2, 1]));
        assert_eq!(primitive(whole(&[0, 0, 7])), whole(&[0, 0, 1]));
    }
}
