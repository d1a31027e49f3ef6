//! Ranks of boundary matrices modulo 2: [`ranks`].
//!
//! Method: the standard reduction of columns, each by earlier ones with the same lowest entry \[Edelsbrunner02\], from the highest
//! dimension down, so that cells that are the lowest entry of a reduced column need no column of their own \[Chen11\].
//! Complexity: cubic in the number of cells at worst; the entries that are written are counted against a limit.

use std::cmp::Ordering;

use super::super::complex::NONE;
use super::chains::Chains;
use super::reduction::Reduction;
use crate::{Cancelled, Monitor};

/// Columns reduced between two looks at the monitor.
const BATCH: usize = 256;

/// Why there are no ranks.
pub(super) enum NoRanks {
    /// More entries than allowed.
    TooManyEntries,
    /// The monitor asked to stop.
    Cancelled(Cancelled),
}

/// The rest of a component: how many cells of each dimension are left, and the rank of the boundary of those.
#[derive(Clone, Copy, Default)]
pub(super) struct Rest {
    pub(super) cells: [u64; 4],
    pub(super) ranks: [u64; 4],
}

/// The rest of each component.
pub(super) fn ranks(
    chains: &Chains,
    reduction: &Reduction<'_>,
    components: usize,
    most_entries: u64,
    monitor: &Monitor<'_>,
) -> Result<Vec<Rest>, NoRanks> {
    let mut rest = vec![Rest::default(); components];
    let mut entries_left = most_entries;
    let mut cells = reduction.left(3);
    let mut cleared = vec![false; cells.len()];
    for dimension in (0..4).rev() {
        let below = if dimension == 0 { Vec::new() } else { reduction.left(dimension - 1) };
        let mut matrix = Matrix { columns: Vec::new(), with_lowest: vec![NONE; below.len()] };
        for (i, &cell) in cells.iter().enumerate() {
            if i % BATCH == 0 {
                monitor.check().map_err(NoRanks::Cancelled)?;
            }
            let rest = &mut rest[chains.component(dimension, cell as usize) as usize];
            rest.cells[dimension] += 1;
            if !cleared[i] {
                let faces = chains.faces(dimension, cell as usize).iter();
                let mut column: Vec<u32> =
                    faces.filter_map(|face| below.binary_search(face).ok()).map(|row| row as u32).collect();
                column.sort_unstable();
                let independent = matrix.add(column, &mut entries_left).ok_or(NoRanks::TooManyEntries)?;
                rest.ranks[dimension] += u64::from(independent);
            }
        }
        cleared = matrix.with_lowest.iter().map(|&column| column != NONE).collect();
        cells = below;
    }
    Ok(rest)
}

/// Columns of rows, ascending, no two with the same last row.
struct Matrix {
    columns: Vec<Vec<u32>>,
    /// The column with each row as its last.
    with_lowest: Vec<u32>,
}

impl Matrix {
    /// Adds a column; false if it is a sum of those there are. Nothing if that takes more entries than are left.
    fn add(&mut self, mut column: Vec<u32>, entries_left: &mut u64) -> Option<bool> {
        while let Some(&lowest) = column.last() {
            *entries_left = entries_left.checked_sub(column.len() as u64)?;
            let earlier = &mut self.with_lowest[lowest as usize];
            if *earlier == NONE {
                *earlier = self.columns.len() as u32;
                self.columns.push(column);
                return Some(true);
            }
            column = sum(&column, &self.columns[*earlier as usize]);
        }
        Some(false)
    }
}

/// The rows that are in one of two columns.
fn sum(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut rows = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].cmp(&b[j]) {
            Ordering::Less => {
                rows.push(a[i]);
                i += 1;
            }
            Ordering::Greater => {
                rows.push(b[j]);
                j += 1;
            }
            Ordering::Equal => (i, j) = (i + 1, j + 1),
        }
    }
    rows.extend_from_slice(&a[i..]);
    rows.extend_from_slice(&b[j..]);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_symmetric_differences() {
        assert_eq!(sum(&[1, 3, 5], &[2, 3, 6, 7]), [1, 2, 5, 6, 7]);
        assert!(sum(&[1, 2], &[1, 2]).is_empty());
    }

    #[test]
    fn dependent_columns_and_limits_are_noticed() {
        let mut matrix = Matrix { columns: Vec::new(), with_lowest: vec![NONE; 3] };
        let mut entries = 8;
        assert_eq!(matrix.add(vec![0, 1], &mut entries), Some(true));
        assert_eq!(matrix.add(vec![1, 2], &mut entries), Some(true));
        assert_eq!(matrix.add(vec![0, 2], &mut entries), Some(false));
        assert_eq!(entries, 0);
        assert_eq!(matrix.add(vec![0, 2], &mut entries), None);
    }
}
