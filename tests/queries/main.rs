//! Integration tests: the reader of collision queries, its format and its arithmetic.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
#![allow(clippy::print_stdout, reason = "a test that cannot run here says so")]

mod format;
mod values;
