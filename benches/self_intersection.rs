//! Benchmark: self_intersection.

fn main() {}
