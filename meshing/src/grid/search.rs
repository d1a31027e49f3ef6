//! Which nodes along an axis come first behind a place: [`first_where`], [`first_at`], [`nodes_between`].

use std::ops::Range;

use super::Grid3;

/// The first number of `low..high` that `is` so, for a property that all numbers have from some on; `high` if none has it.
/// Steps away from the guess that double, then bisection.
pub(crate) fn first_where(low: u32, high: u32, guess: u32, is: impl Fn(u32) -> bool) -> u32 {
    let (mut low, mut high) = (low, high);
    let mut step = 1;
    let mut probe = guess.max(low);
    while low < high {
        probe = probe.min(high - 1);
        if is(probe) {
            high = probe;
            probe = probe.saturating_sub(step).max(low);
        } else {
            low = probe + 1;
            probe = probe.saturating_add(step);
        }
        step = step.saturating_mul(2);
        if step > 4 {
            probe = low + (high - low) / 2;
        }
    }
    low
}

/// The first node along an axis whose coordinate `reached` something about `value`; the number of nodes if there is none.
pub(crate) fn first_at(grid: &Grid3, axis: usize, reached: impl Fn(f64) -> bool, value: f64) -> u32 {
    let guess = (value - grid.origin()[axis]) / grid.spacing();
    let end = grid.nodes()[axis];
    first_where(0, end, guess.clamp(0.0, f64::from(end)) as u32, |i| reached(grid.coordinate(axis, i)))
}

/// The nodes along an axis from `low` to `high`, both included. Exact.
pub(crate) fn nodes_between(grid: &Grid3, axis: usize, low: f64, high: f64) -> Range<u32> {
    first_at(grid, axis, |x| x >= low, low)..first_at(grid, axis, |x| x > high, high)
}
