//! Integration tests of `welter_predicates`, against the exact oracles of the kit.

mod family;
mod laws;
mod oracle;
mod regressions;
