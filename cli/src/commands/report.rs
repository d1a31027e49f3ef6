//! `welter report`: makes the report of a run again, from what the run wrote.

use crate::codes::Code;
use crate::commands::{sim, track};
use crate::failure::{Failure, shell_word, shown};
use crate::run::{Outcome, Run};
use crate::runs::PastRun;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Make report.html and report.json of a run again
#[derive(Debug, clap::Args)]
#[command(after_help = "\
For a run that was killed before it could tell, or whose report was lost: told is what is known up to its newest
checkpoint. Nothing else in the folder is changed. A run that still goes on is refused.

Example:
  welter report enright")]
pub(crate) struct Args {
    /// Folder of a run of welter track or welter sim
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let past = PastRun::open(&args.folder)?;
    let mut object = match past.state.solver.as_str() {
        sim::SOLVER => sim::report(&args.folder, &past, run)?,
        track::SOLVER => track::report(&args.folder, &past)?,
        other => {
            return Err(Failure::new(Code::NoRunFile, format!("this is a run of welter {other}"))
                .subject(shown(&args.folder))
                .help("it takes the version that made it"));
        }
    };
    run.console.progress.clear();
    let status = object["status"].as_str().unwrap_or_default().to_owned();
    run.console.result(&format!(
        "{}: {status}, told up to step {}, time {}\n  report             {}\n",
        args.folder.display(),
        past.state.step,
        past.state.time,
        shell_word(&args.folder.join("report.html"))
    ))?;
    object.insert("output".into(), json!(shown(&args.folder)));
    run.console.object(&Value::Object(object))?;
    Ok(0)
}
