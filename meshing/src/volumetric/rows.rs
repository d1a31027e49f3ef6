//! Things on the rows of a grid, rows along x: [`Rows`].

use std::ops::Range;

use rayon::prelude::*;

/// Items in rows: row `j + count_y * k` holds those with index `(., j, k)`.
#[derive(Clone, Debug)]
pub(super) struct Rows<T> {
    starts: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy + Default + Send + Sync> Rows<T> {
    /// Sorts items, given with their rows, into `count` rows; within a row by `compare`, which must tell all items apart.
    pub(super) fn sorted(
        count: usize,
        lists: &[Vec<(usize, T)>],
        compare: impl Fn(usize, &T, &T) -> std::cmp::Ordering + Sync,
    ) -> Self {
        let mut starts = vec![0; count + 1];
        for &(row, _) in lists.iter().flatten() {
            starts[row + 1] += 1;
        }
        for row in 0..count {
            starts[row + 1] += starts[row];
        }
        let mut items = vec![T::default(); starts[count]];
        let mut free = starts.clone();
        for &(row, item) in lists.iter().flatten() {
            items[free[row]] = item;
            free[row] += 1;
        }
        drop(free);
        let mut rest = items.as_mut_slice();
        let mut rows = Vec::new();
        for (row, pair) in starts.windows(2).enumerate() {
            let (part, behind) = rest.split_at_mut(pair[1] - pair[0]);
            rest = behind;
            if part.len() > 1 {
                rows.push((row, part));
            }
        }
        rows.into_par_iter().for_each(|(row, part)| part.sort_unstable_by(|a, b| compare(row, a, b)));
        Self { starts, items }
    }
}

impl<T> Rows<T> {
    /// Items that are sorted by row already.
    pub(super) fn new(starts: Vec<usize>, items: Vec<T>) -> Self {
        debug_assert_eq!(starts.last(), Some(&items.len()));
        Self { starts, items }
    }

    /// All items, row after row.
    pub(super) fn items(&self) -> &[T] {
        &self.items
    }

    /// Number of rows.
    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the items of a row are among all.
    pub(super) fn range(&self, row: usize) -> Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// The row of an item.
    pub(super) fn row_of(&self, item: usize) -> usize {
        self.starts.partition_point(|&start| start <= item) - 1
    }

    /// The items of a row.
    pub(super) fn row(&self, row: usize) -> &[T] {
        &self.items[self.range(row)]
    }
}
