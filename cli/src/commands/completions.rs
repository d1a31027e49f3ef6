//! `welter completions`: lets a shell complete the command line.

use crate::args::Cli;
use crate::run::{Outcome, Run};
use clap::CommandFactory;
use clap_complete::Shell;
use serde_json::json;

/// Print a completion script for a shell
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example: welter completions bash > ~/.local/share/bash-completion/completions/welter"
)]
pub(crate) struct Args {
    /// Which shell
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "welter", &mut script);
    let script = String::from_utf8_lossy(&script);
    run.console.object(&json!({ "shell": args.shell.to_string(), "script": script }))?;
    if !run.console.json {
        run.console.script(&script)?;
    }
    Ok(0)
}
