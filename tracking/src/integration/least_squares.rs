//! Symmetric systems that may be singular: [`solve`].
//!
//! # What it computes
//! For a symmetric positive semidefinite `A` and a `b` in its range, some `x` with `A x = b`: zero where rows depend on
//! others.
//!
//! # Method
//! Cholesky factorisation with complete (diagonal) pivoting \[Higham02, section 10.3\], which reveals the rank: it stops where the
//! largest diagonal that is left is below [`DEPENDENT`] of the row's own. Rows are first scaled to a diagonal of 1,
//! so the criterion is the squared sine of the angle between a row and those before it. Complexity: n r^2 for rank r.

/// Squared sine of the angle to the rows before below which a row counts as dependent on them: 2^-24. Normals and
/// weights of contacts are known to some 2^-40, so what is left of a row above an angle of 2^-12 is still known to 2^-28; what is
/// below would be fulfilled only by motions thousands of times as large.
const DEPENDENT: f64 = 1.0 / (1 << 24) as f64;

/// What came of a system.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Solution {
    pub(super) x: Vec<f64>,
    /// How many rows do not depend on others.
    pub(super) rank: usize,
}

/// Solves for the rows `a`, of which the lower triangle is read. Rows with a diagonal of 0 do not count.
pub(super) fn solve(a: &[Vec<f64>], b: &[f64]) -> Solution {
    let n = b.len();
    let scale: Vec<f64> = (0..n).map(|i| if a[i][i] > 0.0 { 1.0 / a[i][i].sqrt() } else { 0.0 }).collect();
    let entry = |i: usize, j: usize| a[i.max(j)][i.min(j)] * scale[i] * scale[j];
    let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(x, y)| x * y).sum::<f64>();
    // Pivots in their order, then the other rows; the factor by row of the system, up to its own pivot.
    let mut order: Vec<usize> = (0..n).collect();
    let mut factor: Vec<Vec<f64>> = vec![Vec::new(); n];
    let mut left: Vec<f64> = scale.iter().map(|&s| if s > 0.0 { 1.0 } else { 0.0 }).collect();
    let mut rank = 0;
    while rank < n {
        let largest = (rank..n).max_by(|&p, &q| left[order[p]].total_cmp(&left[order[q]]).then(q.cmp(&p)));
        let Some(pivot) = largest.filter(|&p| left[order[p]] > DEPENDENT) else { break };
        order.swap(rank, pivot);
        let row = order[rank];
        let diagonal = left[row].sqrt();
        let pivot_row = std::mem::take(&mut factor[row]);
        for &i in &order[rank + 1..] {
            let below = (entry(i, row) - dot(&factor[i], &pivot_row)) / diagonal;
            factor[i].push(below);
            left[i] -= below * below;
        }
        factor[row] = pivot_row;
        factor[row].push(diagonal);
        rank += 1;
    }
    // Forward: L y = b, then backward: L^T x = y, on the independent rows.
    let mut y: Vec<f64> = Vec::with_capacity(rank);
    for (k, &row) in order[..rank].iter().enumerate() {
        y.push((b[row] * scale[row] - dot(&factor[row][..k], &y)) / factor[row][k]);
    }
    let mut x = vec![0.0; n];
    for k in (0..rank).rev() {
        let row = order[k];
        x[row] = y[k] / factor[row][k];
        for (known, entry) in y[..k].iter_mut().zip(&factor[row]) {
            *known -= entry * x[row];
        }
    }
    x.iter_mut().zip(&scale).for_each(|(x, s)| *x *= s);
    Solution { x, rank }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lower(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
        // C C^T
        let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(x, y)| x * y).sum::<f64>();
        (0..rows.len()).map(|i| (0..=i).map(|j| dot(&rows[i], &rows[j])).collect()).collect()
    }

    /// The residual of the constraints `C (u - C^T x)`.
    fn residual(rows: &[Vec<f64>], u: &[f64]) -> (f64, usize) {
        let b: Vec<f64> = rows.iter().map(|r| r.iter().zip(u).map(|(c, u)| c * u).sum()).collect();
        let Solution { x, rank } = solve(&lower(rows), &b);
        let after: Vec<f64> =
            (0..u.len()).map(|k| u[k] - rows.iter().zip(&x).map(|(r, x)| r[k] * x).sum::<f64>()).collect();
        let worst = rows.iter().map(|r| r.iter().zip(&after).map(|(c, u)| c * u).sum::<f64>().abs());
        (worst.fold(0.0, f64::max), rank)
    }

    fn noise(i: usize) -> f64 {
        let z = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (z >> 11) as f64 / 2f64.powi(52) - 1.0
    }

    #[test]
    fn independent_rows_are_solved() {
        for n in 1..12 {
            let rows: Vec<Vec<f64>> =
                (0..n).map(|i| (0..16).map(|k| noise(100 * n + 16 * i + k)).collect()).collect();
            let u: Vec<f64> = (0..16).map(|k| noise(7000 + k)).collect();
            let (worst, rank) = residual(&rows, &u);
            assert!(rank == n && worst < 1e-13, "{n} {rank} {worst}");
        }
    }

    #[test]
    fn dependent_rows_are_found_and_fulfilled() {
        for n in 1..8 {
            let mut rows: Vec<Vec<f64>> =
                (0..n).map(|i| (0..16).map(|k| noise(100 * n + 16 * i + k)).collect()).collect();
            // Each again, the sum of all, and nothing.
            rows.extend(rows.clone().iter().map(|r| r.iter().map(|c| -3.0 * c).collect::<Vec<f64>>()));
            rows.push((0..16).map(|k| rows[..n].iter().map(|r| r[k]).sum()).collect());
            rows.push(vec![0.0; 16]);
            let u: Vec<f64> = (0..16).map(|k| noise(7000 + k)).collect();
            let (worst, rank) = residual(&rows, &u);
            assert!(rank == n && worst < 1e-12, "{n} {rank} {worst}");
        }
    }

    #[test]
    fn scales_of_rows_do_not_matter() {
        let rows = |by: f64| vec![vec![by, 0.0, 0.0], vec![1.0, 1.0, 0.0]];
        for by in [1e-100, 1e-8, 1.0, 1e8, 1e100] {
            let Solution { x, rank } = solve(&lower(&rows(by)), &[by, 3.0]);
            assert_eq!(rank, 2);
            // u' = C^T x is the smallest with C u' = b: (1, 2, 0).
            let u = [by * x[0] + x[1], x[1]];
            assert!((u[0] - 1.0).abs() < 1e-14 && (u[1] - 2.0).abs() < 1e-14, "{u:?}");
        }
    }
}
