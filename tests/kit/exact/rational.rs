//! Linear systems in rational numbers, by the elimination of the textbook: [`outcome`], [`solvable`].
//!
//! Rows are divided by their pivots and subtracted, back substitution gives the solution. Neither fraction-free
//! nor by determinants, so a witness for both.

use rug::Rational;

/// What a linear system has for solutions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// One.
    Unique(Vec<Rational>),
    /// None.
    Inconsistent,
    /// Many: the rank, and for each column whether it depends on those before it.
    Underdetermined(usize, Vec<bool>),
}

/// The outcome of `a x = b`, whose rows are given with the right-hand side at the end.
#[must_use]
pub fn outcome(rows: &[Vec<Rational>], unknowns: usize) -> Outcome {
    let mut rows = rows.to_vec();
    let mut pivots = Vec::new();
    for column in 0..unknowns {
        let rank = pivots.len();
        let Some(found) = (rank..rows.len()).find(|&row| !rows[row][column].is_zero()) else { continue };
        rows.swap(rank, found);
        let pivot = rows[rank][column].clone();
        rows[rank].iter_mut().for_each(|x| *x /= &pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        for row in below {
            let factor = row[column].clone();
            for (x, y) in row.iter_mut().zip(&above[rank]) {
                *x -= Rational::from(&factor * y);
            }
        }
        pivots.push(column);
    }
    let rank = pivots.len();
    if rows[rank..].iter().any(|row| !row[unknowns].is_zero()) {
        return Outcome::Inconsistent;
    }
    if rank < unknowns {
        return Outcome::Underdetermined(rank, (0..unknowns).map(|j| !pivots.contains(&j)).collect());
    }
    let mut x = vec![Rational::new(); unknowns];
    for i in (0..unknowns).rev() {
        x[i] = rows[i][unknowns].clone();
        for j in i + 1..unknowns {
            let term = Rational::from(&rows[i][j] * &x[j]);
            x[i] -= term;
        }
    }
    Outcome::Unique(x)
}

/// Whether some solution has no negative component: if there are many, tries every set of columns for the only
/// solution that is zero elsewhere.
#[must_use]
pub fn solvable(rows: &[Vec<Rational>], unknowns: usize) -> bool {
    match outcome(rows, unknowns) {
        Outcome::Unique(x) => return x.iter().all(|x| !x.is_negative()),
        Outcome::Inconsistent => return false,
        Outcome::Underdetermined(..) => {}
    }
    (0_u32..1 << unknowns).any(|set| {
        let chosen: Vec<usize> = (0..unknowns).filter(|&j| set >> j & 1 == 1).chain([unknowns]).collect();
        let few: Vec<Vec<Rational>> =
            rows.iter().map(|row| chosen.iter().map(|&j| row[j].clone()).collect()).collect();
        match outcome(&few, chosen.len() - 1) {
            Outcome::Unique(x) => x.iter().all(|x| !x.is_negative()),
            _ => false,
        }
    })
}

/// Finite coefficients, right-hand side last, as rational numbers.
#[must_use]
pub fn lifted<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Vec<Vec<Rational>> {
    let whole = |x: f64| Rational::from_f64(x).expect("an oracle speaks of finite numbers");
    a.iter().zip(b).map(|(row, &right)| row.iter().copied().chain([right]).map(whole).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes() {
        let third = Rational::from((1, 3));
        assert_eq!(outcome(&lifted(&[[3.0]], &[1.0]), 1), Outcome::Unique(vec![third]));
        let rows = |right: f64| lifted(&[[0.0, 1.0, 1.0], [0.0, 2.0, 2.0]], &[1.0, right]);
        assert_eq!(outcome(&rows(2.0), 3), Outcome::Underdetermined(1, vec![true, false, true]));
        assert_eq!(outcome(&rows(3.0), 3), Outcome::Inconsistent);
        let two = lifted(&[[1.0, 2.0], [3.0, 5.0]], &[5.0, 13.0]);
        assert_eq!(outcome(&two, 2), Outcome::Unique(vec![Rational::from(1), Rational::from(2)]));
        assert!(solvable(&two, 2) && solvable(&rows(2.0), 3) && !solvable(&rows(3.0), 3));
        assert!(!solvable(&lifted(&[[1.0, 1.0]], &[-1.0]), 2) && solvable(&lifted(&[[0.0]], &[0.0]), 1));
    }
}
