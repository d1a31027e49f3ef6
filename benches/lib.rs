//! Baselines and inputs of the benchmarks, and how they measure.

use std::hint::black_box;
use std::time::Instant;

/// The shortest wall time of some runs in seconds, and the result of that run.
///
/// # Panics
/// For no run.
pub fn best<T>(runs: usize, mut run: impl FnMut() -> T) -> (f64, T) {
    let timed = |_| {
        let start = Instant::now();
        let result = black_box(run());
        (start.elapsed().as_secs_f64(), result)
    };
    (0..runs).map(timed).min_by(|a, b| a.0.total_cmp(&b.0)).expect("one run at least")
}

/// A size in /proc/self/status in bytes, where Linux tells it: "VmRSS:" is the resident memory, "VmHWM:" its peak.
#[must_use]
pub fn memory(key: &str) -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kib| kib * 1024.0)
}
