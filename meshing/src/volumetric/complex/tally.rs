//! Counts for each component that several threads add to: [`Tallies`].

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use super::CellCounts;

/// For each component the cells of dimension 0 to 3. Sums of whole numbers do not depend on the order.
pub(super) struct Tallies {
    counts: Vec<[AtomicU64; 4]>,
}

impl Tallies {
    pub(super) fn new(components: usize) -> Self {
        Self { counts: std::iter::repeat_with(Default::default).take(components).collect() }
    }

    pub(super) fn into_counts(self) -> Vec<CellCounts> {
        let plain = |counts: [AtomicU64; 4]| counts.map(AtomicU64::into_inner);
        self.counts
            .into_iter()
            .map(plain)
            .map(|[vertices, edges, faces, cells]| CellCounts { vertices, edges, faces, cells })
            .collect()
    }
}

/// One thread's additions: those to the same component in a row are made at once.
pub(super) struct Tally<'a> {
    tallies: &'a Tallies,
    component: u32,
    pending: [u64; 4],
}

impl<'a> Tally<'a> {
    pub(super) fn new(tallies: &'a Tallies) -> Self {
        Self { tallies, component: 0, pending: [0; 4] }
    }

    /// Counts a cell of a dimension.
    pub(super) fn add(&mut self, component: u32, dimension: usize) {
        if component != self.component {
            self.flush();
            self.component = component;
        }
        self.pending[dimension] += 1;
    }

    fn flush(&mut self) {
        for (dimension, pending) in self.pending.iter_mut().enumerate() {
            if *pending > 0 {
                self.tallies.counts[self.component as usize][dimension].fetch_add(*pending, Relaxed);
                *pending = 0;
            }
        }
    }
}

impl Drop for Tally<'_> {
    fn drop(&mut self) {
        self.flush();
    }
}
