//! Progress of long work on standard error: a bar, plain lines, or one JSON object a line.
//!
//! Lines come at every tenth of a stage, a bar at most ten times a second and only for work that lasts.

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;
use std::io::{IsTerminal, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressMode {
    // A bar on a terminal, nothing otherwise.
    Auto,
    // A line at every tenth of a stage.
    Plain,
    // Nothing.
    None,
    // A JSON object a line, on standard error.
    Json,
}

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(400);

/// Seconds left that plain lines tell; fewer are over before they are read.
const WORTH_TELLING: f64 = 2.0;

/// Shows the progress of one stage after another.
#[derive(Debug)]
pub(crate) struct Progress {
    mode: ProgressMode,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    stage: Option<Stage>,
    bar: Option<ProgressBar>,
}

#[derive(Debug)]
struct Stage {
    name: &'static str,
    total: u64,
    done: u64,
    /// Tenths told so far.
    told: Option<u64>,
    started: Instant,
}

impl Stage {
    /// Seconds to the end of the stage at the rate so far; none before anything is done, or where the end is not known.
    fn seconds_left(&self) -> Option<f64> {
        let rate = (self.done > 0).then(|| self.started.elapsed().as_secs_f64() / self.done as f64)?;
        (self.total > 0).then(|| rate * self.total.saturating_sub(self.done) as f64)
    }
}

impl Progress {
    pub(crate) fn new(mode: ProgressMode, quiet: bool) -> Self {
        let mode = match mode {
            ProgressMode::Auto if quiet || !std::io::stderr().is_terminal() => ProgressMode::None,
            mode => mode,
        };
        Self { mode, state: Mutex::default() }
    }

    /// How far a stage is; may come from any thread and out of order.
    pub(crate) fn report(&self, name: &'static str, done: u64, total: u64) {
        if self.mode == ProgressMode::None {
            return;
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let State { stage, bar } = &mut *state;
        let another = stage.as_ref().is_none_or(|stage| stage.name != name || stage.total != total);
        if another && let Some(bar) = bar.take() {
            bar.finish_and_clear();
        }
        let stage = match stage {
            Some(stage) if stage.name == name && stage.total == total => stage,
            _ => stage.insert(Stage { name, total, done: 0, told: None, started: Instant::now() }),
        };
        stage.done = stage.done.max(done);
        if self.mode == ProgressMode::Auto {
            if stage.started.elapsed() >= PATIENCE {
                bar.get_or_insert_with(|| new_bar(name, total)).set_position(stage.done);
            }
            return;
        }
        let tenth = stage.done.saturating_mul(10).checked_div(total).unwrap_or(0);
        if stage.told.is_some_and(|told| told >= tenth) {
            return;
        }
        stage.told = Some(tenth);
        let line = if self.mode == ProgressMode::Json {
            let seconds = stage.started.elapsed().as_secs_f64();
            let left = stage.seconds_left();
            json!({ "stage": name, "done": stage.done, "total": total, "seconds": seconds, "seconds_left": left })
                .to_string()
        } else if total == 0 {
            format!("{name} ...")
        } else {
            let left = stage.seconds_left().filter(|&left| left >= WORTH_TELLING);
            let left = left.map_or(String::new(), |left| format!(", about {left:.0} s left"));
            format!("{name}: {} %{left}", tenth * 10)
        };
        let _ = writeln!(std::io::stderr().lock(), "{line}");
    }

    /// Takes the bar away for good.
    pub(crate) fn clear(&self) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.stage = None;
        if let Some(bar) = state.bar.take() {
            bar.finish_and_clear();
        }
    }

    /// Takes the bar away while `print` writes to the terminal.
    pub(crate) fn hide(&self, print: impl FnOnce()) {
        let bar = self.state.lock().unwrap_or_else(PoisonError::into_inner).bar.clone();
        match bar {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}

fn new_bar(name: &'static str, total: u64) -> ProgressBar {
    let (bar, template) = if total == 0 {
        (ProgressBar::no_length(), "{msg} {spinner} {elapsed}")
    } else {
        (ProgressBar::new(total), "{msg} {wide_bar} {percent:>3} % {eta}")
    };
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
    bar.set_style(style);
    bar.set_message(name);
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_follows_from_the_rate() {
        let stage = |done, total| {
            let started =
                Instant::now().checked_sub(Duration::from_secs(30)).expect("a clock beyond its start");
            Stage { name: "meshing", total, done, told: None, started }
        };
        let left = stage(25, 100).seconds_left().expect("something is done");
        assert!((90.0..120.0).contains(&left), "{left}");
        assert_eq!((stage(0, 100).seconds_left(), stage(5, 0).seconds_left()), (None, None));
        assert_eq!(stage(7, 7).seconds_left(), Some(0.0));
    }
}
