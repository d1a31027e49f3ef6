//! Compensated summation: [`Sum`].

use rayon::prelude::*;

/// A running sum with the rounding errors of its additions \[Neumaier74\].
///
/// The result of `n` terms is off by at most `u |sum| + 2 n^2 u^2 (sum of magnitudes)`, where `u = 2^-53`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.high + term;
        // The error of the addition, exactly.
        self.low +=
            if self.high.abs() >= term.abs() { (self.high - sum) + term } else { (term - sum) + self.high };
        self.high = sum;
    }

    pub(crate) fn merge(&mut self, other: Self) {
        self.add(other.high);
        self.low += other.low;
    }

    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }
}

/// Elements of a task. A fixed number, so that the sums do not depend on the number of threads.
pub(crate) const CHUNK: usize = 4096;

/// Sums several quantities of each element: in parallel within chunks, then chunk after chunk.
pub(super) fn sums<T: Sync, const N: usize>(
    elements: &[T],
    terms: impl Fn(&T) -> [f64; N] + Sync,
) -> [f64; N] {
    let chunks: Vec<[Sum; N]> = elements
        .par_chunks(CHUNK)
        .map(|chunk| {
            let mut sums = [Sum::default(); N];
            for element in chunk {
                for (sum, term) in sums.iter_mut().zip(terms(element)) {
                    sum.add(term);
                }
            }
            sums
        })
        .collect();
    let mut total = [Sum::default(); N];
    for chunk in chunks {
        for (sum, part) in total.iter_mut().zip(chunk) {
            sum.merge(part);
        }
    }
    total.map(Sum::value)
}
