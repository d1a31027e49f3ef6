//! Rules of the house that no compiler checks: dependency direction, file sizes, citations, what code may hold.

#![allow(clippy::unwrap_used, reason = "a panic is the report of a test")]

mod citations;
mod code;
mod dependencies;
mod error_codes;
mod fuzz_targets;
mod sources;
mod tree;
