//! How primitives meet, by combinatorial case.
