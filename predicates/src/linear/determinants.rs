//! The same questions answered by determinants: [`solve`] and its filter, [`filtered`].
//!
//! # Method
//! Cramer's rule: `x_j = D_j / D`, where `D_j` is the determinant `D` with column `j` replaced by the
//! right-hand side. All of these are minors of the matrix with the right-hand side as its last column, and
//! share their minors of lower order, which are expanded along the last row from the first rows down.
//!
//! Rank: if the minor of rows R and columns C is not zero, column `j` is a combination of the columns C exactly
//! if all minors of R and one row more, C and `j`, are zero. Columns are tried in their order, and the
//! right-hand side after them.
//!
//! Nothing is shared with [`super::elimination`] but the integers.
//!
//! # Filter
//! In rounded arithmetic, with the *permanent*, the same sum of the same terms without their signs, computed
//! beside each minor. A term of a minor of order n passes, order by order, one product and at most k - 1 sums:
//! at most `(n - 1) + n (n - 1) / 2 = 20` roundings, as does a permanent's. The determinant then errs by at
//! most `20 u / (1 - 20 u)` times the exact permanent, which the rounded one exceeds after division by `(1 -
//! u)^20`; 24 u is used. Coefficients are zero or from 2^-100 to 2^100 in magnitude: multiples of 2^-152, as
//! their products are multiples of 2^-912, so nothing underflows; nothing overflows.

use super::system::{System, Units};
use super::{MOST, Outcome};
use crate::Sign;
use crate::arithmetic::arena::{Arena, Int};

/// 24 u.
const PERMANENT: f64 = 24.0 * (f64::EPSILON / 2.0);

/// 2^-100 and 2^100.
const SMALLEST: f64 = f64::from_bits((1023 - 100) << 52);
const LARGEST: f64 = f64::from_bits((1023 + 100) << 52);

/// The sign of the term in which the last row's entry stands at place `place` of a minor of order `order`.
fn alternates(order: usize, place: usize) -> bool {
    (order - 1 + place) % 2 == 1
}

/// The solution by Cramer's rule in rounded arithmetic, as `super::filter` gives it; `None` if a sign is not
/// certain.
pub(super) fn filtered<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    const { assert!(N <= MOST) };
    let in_range = |x: &f64| *x == 0.0 || (SMALLEST..=LARGEST).contains(&x.abs());
    if !a.as_flattened().iter().chain(b).all(in_range) {
        return None;
    }
    let mut minors = [(0.0, 0.0); 2 << MOST];
    minors[0] = (1.0, 1.0);
    for set in 1_usize..2 << N {
        let order = set.count_ones() as usize;
        if order > N {
            continue;
        }
        let (mut minor, mut permanent) = (0.0, 0.0);
        let (mut rest, mut place) = (set, 0);
        while rest != 0 {
            let column = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let entry = if column < N { a[order - 1][column] } else { b[order - 1] };
            let (below, size) = minors[set ^ 1 << column];
            minor += if alternates(order, place) { -(entry * below) } else { entry * below };
            permanent += entry.abs() * size;
            place += 1;
        }
        minors[set] = (minor, permanent);
    }
    let all = (2 << N) - 1;
    let certain = |set: usize| minors[set].0.abs() > PERMANENT * minors[set].1;
    let (denominator, _) = minors[all ^ 1 << N];
    let mut solution = [0.0; N];
    for (j, x) in solution.iter_mut().enumerate() {
        let without = all ^ 1 << j;
        if !certain(without) {
            return None;
        }
        // The last column moves to place j.
        let numerator = minors[without].0;
        *x = if (N - 1 - j) % 2 == 1 { -numerator } else { numerator } / denominator;
    }
    certain(all ^ 1 << N).then_some(solution)
}

/// A matrix of integers whose last column is the right-hand side.
struct Matrix {
    rows: [[Int; MOST + 1]; MOST],
}

impl Matrix {
    /// The minor of these rows and columns, as many of either; columns in the given order.
    fn minor(&self, rows: &[usize], columns: &[usize], arena: &mut Arena<'_>) -> Int {
        let order = rows.len();
        let mark = arena.mark();
        let mut minors = [Int::ZERO; 1 << MOST];
        minors[0] = arena.load(1.0, 0);
        for set in 1_usize..1 << order {
            let row = &self.rows[rows[set.count_ones() as usize - 1]];
            let own = arena.mark();
            let mut sum = Int::ZERO;
            let chosen = (0..order).filter(|&column| set >> column & 1 == 1);
            for (place, column) in chosen.enumerate() {
                let term = arena.mul(row[columns[column]], minors[set ^ 1 << column]);
                let negative = alternates(set.count_ones() as usize, place);
                sum = arena.add(sum, if negative { term.negated() } else { term });
                arena.keep(own, [&mut sum]);
            }
            minors[set] = sum;
        }
        let mut result = minors[(1 << order) - 1];
        arena.keep(mark, [&mut result]);
        result
    }

    /// A row that makes a nonzero minor with the given rows and columns and `column`.
    fn bordering(
        &self,
        equations: usize,
        rows: &[usize],
        columns: &[usize],
        column: usize,
        arena: &mut Arena<'_>,
    ) -> Option<usize> {
        let order = rows.len() + 1;
        let (mut more_rows, mut more_columns) = ([0; MOST], [0; MOST]);
        if order > MOST {
            return None;
        }
        more_rows[..order - 1].copy_from_slice(rows);
        more_columns[..order - 1].copy_from_slice(columns);
        more_columns[order - 1] = column;
        (0..equations).filter(|row| !rows.contains(row)).find(|&row| {
            more_rows[order - 1] = row;
            let mark = arena.mark();
            let sign = self.minor(&more_rows[..order], &more_columns[..order], arena).sign();
            arena.keep(mark, []);
            sign != Sign::Zero
        })
    }
}

/// The outcome of a system, by determinants.
pub(super) fn solve(system: &System, units: &Units, arena: &mut Arena<'_>) -> Outcome {
    let (equations, unknowns) = (system.equations, system.unknowns);
    let mut matrix = Matrix { rows: [[Int::ZERO; MOST + 1]; MOST] };
    for i in 0..equations {
        for j in 0..=unknowns {
            matrix.rows[i][j] = arena.load(system.rows[i][j], -units.shift(i, j));
        }
    }
    let (mut rows, mut columns) = ([0; MOST], [0; MOST]);
    let (mut rank, mut free) = (0, 0_u32);
    for column in 0..unknowns {
        match matrix.bordering(equations, &rows[..rank], &columns[..rank], column, arena) {
            Some(row) => {
                (rows[rank], columns[rank]) = (row, column);
                rank += 1;
            }
            None => free |= 1 << column,
        }
    }
    let (rows, columns) = (&rows[..rank], &columns[..rank]);
    if matrix.bordering(equations, rows, columns, unknowns, arena).is_some() {
        return Outcome::Inconsistent;
    }
    if free != 0 {
        // Which columns a free one depends on is not asked here: all that there are.
        return Outcome::Underdetermined { rank, free, dependency: (1 << unknowns) - 1 };
    }
    let denominator = matrix.minor(rows, columns, arena);
    let mut solution = [0.0; MOST];
    for (j, x) in solution[..unknowns].iter_mut().enumerate() {
        let mut replaced = [0; MOST];
        replaced[..rank].copy_from_slice(columns);
        replaced[j] = unknowns;
        let numerator = matrix.minor(rows, &replaced[..rank], arena);
        *x = units.component(j, unknowns, arena.scaled(numerator), arena.scaled(denominator));
    }
    Outcome::Unique(solution)
}
