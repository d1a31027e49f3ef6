//! What the machine offers: threads, memory, the peak of this process. Linux is asked; elsewhere the answer is `None`.

use std::fs;

/// Bytes that can still be taken: what the system reports as available, or what a control group leaves, if less.
pub(crate) fn available_memory() -> Option<u64> {
    let system = field_kib("/proc/meminfo", "MemAvailable:");
    let number = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let group = number("/sys/fs/cgroup/memory.max")
        .zip(number("/sys/fs/cgroup/memory.current"))
        .map(|(max, current)| max.saturating_sub(current));
    match (system, group) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// Bytes of memory of the machine.
pub(crate) fn total_memory() -> Option<u64> {
    field_kib("/proc/meminfo", "MemTotal:")
}

/// The most memory this process has held, in bytes.
pub(crate) fn peak_memory() -> Option<u64> {
    field_kib("/proc/self/status", "VmHWM:")
}

/// Threads the system lets this process use.
pub(crate) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn field_kib(path: &str, name: &str) -> Option<u64> {
    let text = fs::read_to_string(path).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}
