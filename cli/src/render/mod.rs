//! A small deterministic renderer on the CPU.
