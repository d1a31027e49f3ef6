//! From the command line to the exit code.

use crate::args::{Cli, Command};
use crate::codes::Code;
use crate::commands::{
    ccd, check, completions, convert, demo, doctor, info, isosurface, mesh, new, render, replay, report,
    shape, sim, track, view,
};
use crate::console::{Console, print_error, write_json_once};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::{bug, interrupt, machine, numbers};
use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use serde_json::json;
use std::ffi::OsString;
use std::io::{self, Write};
use std::time::Instant;

/// What every command gets: where to speak, and the global options.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) console: Console,
    /// Existing outputs may be overwritten.
    pub(crate) force: bool,
    /// Threads in use.
    pub(crate) threads: usize,
    /// For what is drawn at random.
    pub(crate) seed: u64,
}

/// What a command gives back: the exit code of a run that ended as it should, or why it failed.
pub(crate) type Outcome = Result<u8, Box<Failure>>;

/// Runs the command line `args`; returns the exit code.
pub(crate) fn main(args: Vec<OsString>) -> u8 {
    // Known before the rest is understood, so that a wrong command line is told as JSON too.
    let json = args.iter().take_while(|arg| *arg != "--").any(|arg| arg == "--json");
    let result = bug::guard(&args, || match Cli::try_parse_from(&args) {
        Ok(cli) => run(cli),
        Err(error) if error.exit_code() == 0 => show(&error.to_string()),
        Err(error) => Err(usage(&error)),
    });
    match result {
        Ok(exit) => exit,
        Err(failure) => {
            print_error(&failure);
            if json {
                let _ = write_json_once(&json!({ "error": failure.to_json() }));
            }
            failure.code.exit()
        }
    }
}

fn run(cli: Cli) -> Outcome {
    let global = cli.global;
    interrupt::install(global.json);
    let threads = global.threads.map_or_else(machine::threads, usize::from);
    // A second initialisation is the only way for this to fail, and this is the first.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    let console = Console {
        json: global.json,
        verbose: global.verbose,
        quiet: global.quiet,
        progress: Progress::new(global.progress, global.quiet),
        started: Instant::now(),
    };
    let run = Run { console, force: global.force, threads, seed: global.seed };
    let outcome = match cli.command {
        Command::Demo(args) => demo::run(&args, &run),
        Command::Check(args) => check::run(&args, &run),
        Command::Ccd(args) => ccd::run(&args, &run),
        Command::Render(args) => render::run(&args, &run),
        Command::View(args) => view::run(&args, &run),
        Command::Shape(args) => shape::run(&args, &run),
        Command::New(args) => new::run(&args, &run),
        Command::Isosurface(args) => isosurface::run(&args, &run),
        Command::Mesh(args) => mesh::run(&args, &run),
        Command::Track(args) => track::run(&args, &run),
        Command::Sim(args) => sim::run(&args, &run),
        Command::Replay(args) => replay::run(&args, &run),
        Command::Report(args) => report::run(&args, &run),
        Command::Convert(args) => convert::run(&args, &run),
        Command::Info(args) => info::run(&args, &run),
        Command::Doctor(args) => doctor::run(&args, &run),
        Command::Completions(args) => completions::run(&args, &run),
    };
    interrupt::end_begins();
    run.console.progress.clear();
    run.console.detail(1, &format!("{:<24} {:>9.3} s", "total", run.console.started.elapsed().as_secs_f64()));
    if let Some(peak) = machine::peak_memory() {
        run.console.detail(2, &format!("{:<24} {:>11}", "peak memory", numbers::bytes(peak)));
    }
    outcome
}

/// Help and version.
fn show(text: &str) -> Outcome {
    let _ = io::stdout().lock().write_all(text.as_bytes());
    Ok(0)
}

/// What `clap` says of a wrong command line, in the form of every other failure.
fn usage(error: &clap::Error) -> Box<Failure> {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return Failure::new(Code::Usage, "no command given")
            .help("welter demo   # or: welter --help, for all commands");
    }
    let text = error.to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let what: Vec<&str> = text.lines().take_while(|line| !line.trim().is_empty()).map(str::trim).collect();
    let called = text.lines().find_map(|line| line.strip_prefix("Usage: ")).unwrap_or("welter <COMMAND>");
    let command: Vec<&str> =
        called.split(' ').take_while(|word| !word.starts_with(['[', '<', '-'])).collect();
    let mut failure = Failure::new(Code::Usage, what.join(" ")).place(format!("usage: {called}"));
    let mut help = format!("{} --help", command.join(" "));
    for (kind, value) in error.context() {
        let (ContextKind::SuggestedArg | ContextKind::SuggestedSubcommand | ContextKind::SuggestedValue, _) =
            (kind, value)
        else {
            continue;
        };
        let nearest = match value {
            ContextValue::String(one) => Some(one),
            ContextValue::Strings(all) => all.first(),
            _ => None,
        };
        if let Some(nearest) = nearest {
            failure.what = format!("{}; the nearest known is '{nearest}'", failure.what);
            help = match kind {
                ContextKind::SuggestedSubcommand => format!("welter {nearest} --help"),
                _ => help,
            };
        }
    }
    failure.help(help)
}
