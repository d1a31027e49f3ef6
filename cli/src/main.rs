//! The command `welter`.
//!
//! What it promises: one table of error codes ([`codes`]); with `--json` exactly one JSON object on standard output;
//! outputs written whole or not at all ([`output`]); the same result for any number of threads.
//!
//! What it does not promise: the wording of text for people.
//!
//! Map: [`args`] is the command line, [`commands`] has one file a command; [`input`] and [`output`] own files,
//! [`scene`] reads scene files; [`console`] and [`progress`] own the terminal, [`failure`] and [`bug`] tell what went wrong; [`render`] draws;
//! [`runs`] is what every solver over time runs in: folder, checkpoints, frames, statistics, report.

#![forbid(unsafe_code)]

mod args;
mod bug;
mod clock;
mod closed;
mod codes;
mod commands;
mod console;
mod cutaway;
mod examine;
mod failure;
mod html;
mod input;
mod interrupt;
mod machine;
mod numbers;
mod output;
mod overrides;
mod picture;
mod progress;
mod render;
mod run;
mod runs;
mod scene;
mod sequence;
mod surface_file;
mod table;
mod volume_input;

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(run::main(std::env::args_os().collect()))
}
