//! How often each stage settled each predicate: counters, compiled away without the feature `stats`.

use crate::Stage;

/// The predicates that are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Kind {
    /// [`orient2d`](crate::orient2d).
    Orient2d,
    /// [`orient3d`](crate::orient3d).
    Orient3d,
    /// [`orient4d`](crate::orient4d).
    Orient4d,
    /// [`incircle`](crate::incircle).
    Incircle,
    /// [`insphere`](crate::insphere).
    Insphere,
    /// [`compare_crossings`](crate::moved_grid::compare_crossings): of the crossings, and of the slopes at a tie.
    Crossings,
}

impl Kind {
    /// All kinds, in the order of their discriminants.
    pub const ALL: [Self; 6] =
        [Self::Orient2d, Self::Orient3d, Self::Orient4d, Self::Incircle, Self::Insphere, Self::Crossings];
}

#[cfg(feature = "stats")]
mod counters {
    use super::{Kind, Stage};
    use core::sync::atomic::{AtomicU64, Ordering::Relaxed};

    static COUNTERS: [[AtomicU64; Stage::ALL.len()]; Kind::ALL.len()] =
        [const { [const { AtomicU64::new(0) }; Stage::ALL.len()] }; Kind::ALL.len()];

    #[inline]
    pub(crate) fn count(kind: Kind, stage: Stage) {
        COUNTERS[kind as usize][stage as usize].fetch_add(1, Relaxed);
    }

    /// Evaluations since the start or the last [`reset`], over all threads.
    ///
    /// ```
    /// use welter_predicates::{Stage, orient2d, stats};
    /// let count = || stats::snapshot().get(stats::Kind::Orient2d, Stage::Filter);
    /// let before = count();
    /// orient2d([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]);
    /// assert!(count() > before);
    /// ```
    pub fn snapshot() -> Snapshot {
        Snapshot(core::array::from_fn(|i| core::array::from_fn(|j| COUNTERS[i][j].load(Relaxed))))
    }

    /// Sets all counters to zero.
    pub fn reset() {
        COUNTERS.iter().flatten().for_each(|counter| counter.store(0, Relaxed));
    }

    /// The counters at one time. Counts made by other threads meanwhile may be in or not.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Snapshot([[u64; Stage::ALL.len()]; Kind::ALL.len()]);

    impl Snapshot {
        /// How often `stage` settled `kind`.
        #[must_use]
        pub fn get(&self, kind: Kind, stage: Stage) -> u64 {
            self.0[kind as usize][stage as usize]
        }
    }
}

#[cfg(feature = "stats")]
pub(crate) use counters::count;
#[cfg(feature = "stats")]
pub use counters::{Snapshot, reset, snapshot};

#[cfg(not(feature = "stats"))]
#[inline(always)]
pub(crate) fn count(_: Kind, _: Stage) {}
