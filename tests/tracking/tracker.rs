//! The tracker as a whole: convergence to exact solutions, random motions, steps that fail.

mod figures;
mod immersed;
mod random;
mod steps;

use crate::improvement::{check, mapped, together, tracker, volume};
use welter_meshing::Monitor;
use welter_tracking::flows::Flow;
use welter_tracking::tracker::{StepReport, SurfaceTracker};

/// A number of an environment variable, for runs longer than those of every day.
pub(crate) fn setting<T: std::str::FromStr>(name: &str, default: T) -> T {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} is {text:?}, no such number")),
        Err(_) => default,
    }
}

/// Steps until a time; after each the surface is checked by independent code. How many there were.
pub(crate) fn advance_to(
    tracker: &mut SurfaceTracker,
    flow: &dyn Flow,
    end: f64,
    dt: f64,
    mut watch: impl FnMut(&SurfaceTracker, &StepReport),
) -> usize {
    let mut steps = 0;
    // What is left may be a rounding.
    while end - tracker.time() > 1e-9 * dt {
        let left = end - tracker.time();
        let report = tracker.step(flow, dt.min(left), &Monitor::none()).unwrap();
        check(tracker);
        watch(tracker, &report);
        steps += 1;
    }
    steps
}
