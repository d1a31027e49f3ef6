//! Progress and cancellation of long operations: one [`Monitor`], passed by reference.
//!
//! # What it promises
//! * An operation that was asked to stop returns [`Cancelled`]; it never returns part of a result as if it were whole.
//! * Watching an operation never changes its result.
//! * [`Monitor::none`] costs a branch on a null reference.
//!
//! # What it does not promise
//! A rate of reports: a stage reports after each of its pieces of work, from whichever thread finished the piece,
//! so the callback must be quick and `done` may be seen out of order by it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// How far a stage of an operation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Name of the stage, for people: "intersecting triangle pairs".
    pub stage: &'static str,
    /// Units of work finished.
    pub done: u64,
    /// Units of work of the whole stage; 0 if it is not known.
    pub total: u64,
}

/// The operation stopped because its [`Monitor`] was asked to cancel; there is no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the operation was cancelled")]
pub struct Cancelled;

type Callback<'a> = dyn Fn(Progress) + Sync + 'a;

/// Where an operation reports its progress and asks whether it should stop.
///
/// ```
/// use std::sync::atomic::AtomicBool;
/// use welter_meshing::{Monitor, Progress};
///
/// let stop = AtomicBool::new(false);
/// let report = |progress: Progress| assert!(progress.done <= progress.total);
/// let monitor = Monitor::new(Some(&report), Some(&stop));
/// let stage = monitor.stage("counting", 10);
/// stage.advance(10);
/// assert!(monitor.check().is_ok());
/// stop.store(true, std::sync::atomic::Ordering::Relaxed);
/// assert!(monitor.check().is_err());
/// ```
#[derive(Clone, Copy, Default)]
pub struct Monitor<'a> {
    report: Option<&'a Callback<'a>>,
    cancel: Option<&'a AtomicBool>,
}

impl std::fmt::Debug for Monitor<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Monitor")
            .field("reports", &self.report.is_some())
            .field("cancel", &self.cancel)
            .finish()
    }
}

impl<'a> Monitor<'a> {
    /// A monitor that calls `report` as work proceeds and asks the operation to stop once `cancel` is true.
    #[must_use]
    pub fn new(report: Option<&'a Callback<'a>>, cancel: Option<&'a AtomicBool>) -> Self {
        Self { report, cancel }
    }

    /// Nobody watches, nobody cancels.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether the operation was asked to stop.
    #[inline]
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// # Errors
    /// [`Cancelled`] if the operation was asked to stop.
    #[inline]
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Begins a stage of `total` units of work (0 if unknown) and reports that nothing of it is done.
    pub fn stage(&self, name: &'static str, total: u64) -> Stage<'a> {
        let stage = Stage { monitor: *self, name, total, done: AtomicU64::new(0) };
        stage.advance(0);
        stage
    }
}

/// A stage of an operation under way; shared by the threads that work on it.
#[derive(Debug)]
pub struct Stage<'a> {
    monitor: Monitor<'a>,
    name: &'static str,
    total: u64,
    done: AtomicU64,
}

impl Stage<'_> {
    /// Counts `units` of work as finished.
    #[inline]
    pub fn advance(&self, units: u64) {
        if let Some(report) = self.monitor.report {
            let done = self.done.fetch_add(units, Ordering::Relaxed) + units;
            report(Progress { stage: self.name, done, total: self.total });
        }
    }

    /// # Errors
    /// [`Cancelled`] if the operation was asked to stop.
    #[inline]
    pub fn check(&self) -> Result<(), Cancelled> {
        self.monitor.check()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn reports_every_advance_of_every_stage() {
        let seen = Mutex::new(Vec::new());
        let report = |p: Progress| seen.lock().expect("no thread panicked").push((p.stage, p.done, p.total));
        let monitor = Monitor::new(Some(&report), None);
        let stage = monitor.stage("first", 3);
        stage.advance(1);
        stage.advance(2);
        monitor.stage("second", 0);
        let seen = seen.into_inner().expect("no thread panicked");
        assert_eq!(seen, [("first", 0, 3), ("first", 1, 3), ("first", 3, 3), ("second", 0, 0)]);
    }

    #[test]
    fn none_never_cancels() {
        assert_eq!(Monitor::none().check(), Ok(()));
        assert_eq!(Monitor::none().stage("any", 1).check(), Ok(()));
    }
}
