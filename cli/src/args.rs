//! The command line: global options and the list of commands.

use crate::commands::{
    ccd, check, completions, convert, demo, doctor, info, isosurface, mesh, new, render, replay, report,
    shape, sim, track, view,
};
use crate::progress::ProgressMode;
use clap::{Parser, Subcommand, value_parser};

/// Exact computational geometry on triangle surfaces, from the command line.
#[derive(Debug, Parser)]
#[command(name = "welter", version, propagate_version = true, max_term_width = 100, after_help = AFTER)]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER: &str = "\
Exit codes: 0 ok, 1 own bug, 2 usage, 3 bad geometry, 4 unreadable or unsupported file, 5 bad scene, 6 would
pass the memory limit, 7 output cannot be written, 8 did not converge or time limit, 9 verification failed,
130 interrupted.
`welter doctor --codes` lists every error code.

First steps:
  welter demo                       a self-intersecting surface, checked exactly, with a picture
  welter check part.stl             is it closed, oriented, and where does it intersect itself?
  welter check --json *.obj         the same for scripts
  welter mesh part.stl -o part.vtu  its volume as hexahedra; where it overlaps itself the sheets stay apart
  welter track scene.toml -o run    a surface that moves, merges and parts, without ever intersecting itself
  welter sim plume.toml -o run      smoke that is released over time and carried by a flow
  welter view run                   its frames in a browser, to turn and to play
  welter new plume                  writes plume.toml, a scene to begin with; `welter new --list` names them";

/// Options of every command.
#[derive(clap::Args, Clone, Debug)]
#[command(next_help_heading = "Global options")]
pub(crate) struct Global {
    /// Only errors; the exit code and --json tell the result
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
    /// Tell the stages and their seconds (-vv: details)
    #[arg(short, long, global = true, action = clap::ArgAction::Count, conflicts_with = "quiet")]
    pub(crate) verbose: u8,
    /// Exactly one JSON object on standard output; text for people goes to standard error
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Threads to use [default: all]; the result is the same for any number
    #[arg(short = 'j', long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Progress on standard error: a bar on a terminal, plain lines, none, or JSON lines
    #[arg(long, global = true, value_enum, default_value_t = ProgressMode::Auto, value_name = "HOW")]
    pub(crate) progress: ProgressMode,
    /// Overwrite outputs that exist
    #[arg(long, global = true)]
    pub(crate) force: bool,
    /// Seed of everything drawn at random that a scene gives no seed for
    #[arg(long, global = true, default_value_t = 0, value_name = "N")]
    pub(crate) seed: u64,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(demo::Args),
    Shape(shape::Args),
    Isosurface(isosurface::Args),
    Mesh(mesh::Args),
    Track(track::Args),
    Sim(sim::Args),
    New(new::Args),
    Check(check::Args),
    Ccd(ccd::Args),
    Convert(convert::Args),
    Info(info::Args),
    Render(render::Args),
    View(view::Args),
    Replay(replay::Args),
    Report(report::Args),
    Doctor(doctor::Args),
    Completions(completions::Args),
}
