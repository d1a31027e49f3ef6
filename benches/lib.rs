//! Baselines and inputs of the benchmarks.
