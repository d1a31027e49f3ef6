//! Ctrl-C: unfinished files are removed, the error is told, the process ends with 130.
//!
//! Most commands keep nothing between start and end that is worth saving, so the handler ends the process itself
//! instead of waiting for a stage to notice. A run over time does: while there is an [`Asking`], the first Ctrl-C only asks it to stop, and
//! the second ends the process. Once the result is being told there is nothing to interrupt: either the run ends and tells its
//! result, or it is interrupted and tells that, never both.

use crate::codes::Code;
use crate::console::{Stream, print_error, try_write_json_once};
use crate::failure::Failure;
use crate::output;
use serde_json::json;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::time::Duration;

/// If the person's terminal or the script's pipe takes nothing, the process ends all the same.
const GRACE: Duration = Duration::from_secs(1);

const RUNNING: u8 = 0;
/// The result is being told.
const ENDING: u8 = 1;
const INTERRUPTED: u8 = 2;

/// What comes first: the end or an interruption.
#[derive(Debug)]
struct State(AtomicU8);

static STATE: State = State(AtomicU8::new(RUNNING));

impl State {
    /// Whether the run goes over into a state, or did before.
    fn goes_to(&self, state: u8) -> bool {
        match self.0.compare_exchange(RUNNING, state, Ordering::AcqRel, Ordering::Acquire) {
            Ok(_) => true,
            Err(known) => known == state,
        }
    }
}

/// Whether somebody is asked to stop.
static ASKING: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);
/// Whether there is something to be said to who asked.
static TOLD: AtomicBool = AtomicBool::new(true);

/// As long as it lives, the first Ctrl-C sets a flag.
#[derive(Debug)]
pub(crate) struct Asking(());

impl Asking {
    /// There is one at a time.
    pub(crate) fn begin() -> Self {
        Self::with(true)
    }

    /// For what goes on until Ctrl-C, which is its end and no interruption.
    pub(crate) fn to_leave() -> Self {
        Self::with(false)
    }

    fn with(told: bool) -> Self {
        ASKED.store(false, Ordering::Release);
        TOLD.store(told, Ordering::Release);
        ASKING.store(true, Ordering::Release);
        Self(())
    }

    /// True once the work is to stop.
    pub(crate) fn flag(&self) -> &'static AtomicBool {
        &ASKED
    }
}

impl Drop for Asking {
    fn drop(&mut self) {
        ASKING.store(false, Ordering::Release);
    }
}

/// Called before the result is told. Does not return if the run was interrupted: the handler ends the process.
pub(crate) fn end_begins() {
    while !STATE.goes_to(ENDING) {
        std::thread::park();
    }
}

/// Sets the handler. Where the system refuses, Ctrl-C ends the process as it does any other.
pub(crate) fn install(json: bool) {
    let _ = ctrlc::set_handler(move || {
        if ASKING.load(Ordering::Acquire) && !ASKED.swap(true, Ordering::AcqRel) {
            if TOLD.load(Ordering::Acquire) {
                let _ = Stream::Err.write("note: stopping at a checkpoint; Ctrl-C again ends at once\n");
            }
            return;
        }
        std::thread::spawn(|| {
            std::thread::sleep(GRACE);
            std::process::exit(i32::from(Code::Interrupted.exit()));
        });
        if !STATE.goes_to(INTERRUPTED) {
            return;
        }
        let _no_new_files = output::abandon_all();
        let again = if ASKING.load(Ordering::Acquire) {
            "add --resume to the same command to go on from the last checkpoint"
        } else {
            "run the same command again"
        };
        let failure = Failure::new(Code::Interrupted, "interrupted").help(again);
        print_error(&failure);
        if json {
            try_write_json_once(&json!({ "error": failure.to_json() }));
        }
        std::process::exit(i32::from(Code::Interrupted.exit()));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_ends_or_is_interrupted() {
        for (first, second) in [(ENDING, INTERRUPTED), (INTERRUPTED, ENDING)] {
            let state = State(AtomicU8::new(RUNNING));
            assert!(state.goes_to(first) && !state.goes_to(second) && state.goes_to(first));
        }
    }
}
