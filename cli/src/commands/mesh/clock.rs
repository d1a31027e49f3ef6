//! A limit on the time of a run: [`Clock`].

use crate::codes::Code;
use crate::failure::Failure;
use crate::numbers;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Asks the work to stop when its time is up.
#[derive(Debug)]
pub(super) struct Clock {
    limit: Option<Duration>,
    /// Set when the time is up.
    up: Arc<AtomicBool>,
}

impl Clock {
    /// Starts to count. The thread that waits ends with the process.
    pub(super) fn start(limit: Option<Duration>) -> Self {
        let up = Arc::new(AtomicBool::new(false));
        if let Some(limit) = limit {
            let up = Arc::clone(&up);
            std::thread::spawn(move || {
                std::thread::sleep(limit);
                up.store(true, Ordering::Relaxed);
            });
        }
        Self { limit, up }
    }

    /// What the work looks at.
    pub(super) fn flag(&self) -> &AtomicBool {
        &self.up
    }

    /// The failure for a run that was stopped in a stage.
    pub(super) fn time_is_up(&self, stage: &str) -> Box<Failure> {
        let limit = self.limit.unwrap_or_default().as_secs_f64();
        Failure::new(
            Code::TimeLimit,
            format!("the time limit of {} s was reached: {stage}", numbers::number(limit)),
        )
        .help(format!("--time-limit {}   # or larger cells: -s LENGTH, -r N", numbers::number(4.0 * limit)))
    }
}

/// Seconds, as the command line gives them.
pub(super) fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|&seconds| seconds > 0.0);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "a positive number of seconds is wanted, such as 60".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_positive_and_finite() {
        assert_eq!(parse_seconds("0.5"), Ok(Duration::from_millis(500)));
        for text in ["0", "-1", "nan", "inf", "1e300", "soon", ""] {
            assert!(parse_seconds(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_clock_without_limit_never_rings() {
        assert!(!Clock::start(None).flag().load(Ordering::Relaxed));
    }
}
