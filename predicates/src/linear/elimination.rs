//! Fraction-free Gaussian elimination: [`solve`].
//!
//! # Method
//! Gauss-Jordan elimination on integers \[Bareiss68\]. Step `k` takes a pivot `p` and replaces every other row
//! by
//!
//! ```text
//! a_ij  <-  (p a_ij - a_ip p_j) / q        q: the pivot of the step before, 1 at first
//! ```
//!
//! By Sylvester's identity every entry is then a minor of order `k` of the original matrix, so the division
//! leaves no rest, and the entries of the earlier pivots all equal `p`. In the end the solution is `b_i / p`. A
//! column without a pivot depends on those before it; a row without one must have a right-hand side of zero, or
//! the system is inconsistent.
//!
//! # Invariant
//! The outcome does not depend on the choice of pivots within a column, and so not on the order of equations.

use super::domain::Domain;
use super::system::{System, Units};
use super::{MOST, Outcome};

/// The first row from `rank` on that has a nonzero entry in `column`; the outer `None` if the domain cannot
/// tell.
fn pivot_row<D: Domain>(
    matrix: &[[D::Number; MOST + 1]; MOST],
    rows: core::ops::Range<usize>,
    column: usize,
    domain: &D,
) -> Option<Option<usize>> {
    for row in rows {
        if !domain.sign(&matrix[row][column])?.is_zero() {
            return Some(Some(row));
        }
    }
    Some(None)
}

/// The outcome of a system, by elimination; `None` if the domain has no room for it.
pub(super) fn solve<D: Domain>(system: &System, units: &Units, domain: &mut D) -> Option<Outcome> {
    let (equations, unknowns) = (system.equations, system.unknowns);
    let mut matrix = [[D::ZERO; MOST + 1]; MOST];
    for (i, (numbers, row)) in matrix.iter_mut().zip(system.equations()).enumerate() {
        for (j, (number, &value)) in numbers.iter_mut().zip(&row[..=unknowns]).enumerate() {
            *number = domain.load(value, units.shift(i, j));
        }
    }
    let mut pivot = domain.load(1.0, 0);
    let mut pivots = [0; MOST];
    let (mut rank, mut free) = (0, 0_u32);
    for column in 0..unknowns {
        let Some(found) = pivot_row(&matrix, rank..equations, column, domain)? else {
            free |= 1 << column;
            continue;
        };
        matrix.swap(rank, found);
        let by = domain.divisor(&pivot, rank + 1)?;
        let above = matrix[rank];
        pivot = above[column];
        for row in (0..equations).filter(|&row| row != rank) {
            let factor = matrix[row][column];
            for j in column + 1..=unknowns {
                matrix[row][j] = domain.cross(&pivot, &matrix[row][j], &factor, &above[j], &by);
            }
        }
        pivots[rank] = column;
        rank += 1;
    }
    if pivot_row(&matrix, rank..equations, unknowns, domain)?.is_some() {
        return Some(Outcome::Inconsistent);
    }
    if free != 0 {
        let dependency = dependency(&matrix, &pivots[..rank], free, domain)?;
        return Some(Outcome::Underdetermined { rank, free, dependency });
    }
    let mut solution = [0.0; MOST];
    for (i, x) in solution[..unknowns].iter_mut().enumerate() {
        let numerator = matrix[i][unknowns];
        domain.sign(&numerator)?;
        *x = units.component(i, unknowns, domain.scaled(&numerator), domain.scaled(&pivot));
    }
    Some(Outcome::Unique(solution))
}

/// Columns that depend on each other, as few as a free column gives: that column and those pivot columns of
/// which it is a combination.
///
/// The steps after the one that found the column free would only have multiplied its entries by nonzero
/// numbers: the row that they take from the others has a zero there.
fn dependency<D: Domain>(
    matrix: &[[D::Number; MOST + 1]; MOST],
    pivots: &[usize],
    free: u32,
    domain: &D,
) -> Option<u32> {
    let mut fewest = u32::MAX;
    for column in (0..MOST).filter(|column| free >> column & 1 == 1) {
        let mut set = 1_u32 << column;
        for (row, pivot) in pivots.iter().enumerate() {
            if !domain.sign(&matrix[row][column])?.is_zero() {
                set |= 1 << pivot;
            }
        }
        if set.count_ones() < fewest.count_ones() {
            fewest = set;
        }
    }
    Some(fewest)
}
