//! Rules of the house that no compiler checks: dependency direction, file sizes, citations, what code may hold.

mod citations;
mod code;
mod dependencies;
mod error_codes;
mod fuzz_targets;
mod sources;
mod tree;
