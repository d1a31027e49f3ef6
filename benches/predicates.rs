//! Benchmark: predicates.

fn main() {}
