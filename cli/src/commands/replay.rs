//! `welter replay`: runs one step of a run again, from the file that a failure left or from a checkpoint.

use crate::commands::sim;
use crate::commands::track::{self, Replayed};
use crate::failure::shown;
use crate::run::{Outcome, Run};
use crate::runs::failed_step::FailedStep;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Run the step of a run that failed again, from the file that it left
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The file holds everything that is needed: the scene, the state before the step in its bits, what failed. A
checkpoint can be named as well; then the step after it is run. The exit code is that of the failure, or 0 if the
step is completed.

Example:
  welter replay run/failure/step_00000007.bin")]
pub(crate) struct Args {
    /// A file in the folder failure or checkpoint of a run
    file: PathBuf,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let failed = FailedStep::read(&args.file)?;
    let replayed = if failed.before.solver == sim::SOLVER {
        sim::replay(&args.file, &failed, run)?
    } else {
        track::replay(&args.file, &failed, run)?
    };
    run.console.progress.clear();
    let step = failed.before.step + 1;
    let known = failed.failure.as_ref().map(|failure| {
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        [text(&failure["error"]["code"]), text(&failure["stage"]), text(&failure["error"]["what"])]
    });
    let mut object = json!({
        "file": shown(&args.file),
        "solver": failed.before.solver,
        "step": step,
        "time": failed.before.time,
        "known": failed.failure,
    });
    let (text, exit) = match replayed {
        Replayed::Completed(line) => {
            object["completed"] = Value::Object(line);
            object["reproduced"] = if known.is_some() { json!(false) } else { Value::Null };
            let text = match &known {
                Some([code, stage, what]) => {
                    format!("step {step} is completed; then it failed: {code}, {stage}: {what}\n")
                }
                None => format!("step {step} is completed\n"),
            };
            (text, 0)
        }
        Replayed::Failed(failure) => {
            let now = [
                failure.failure.code.id().to_owned(),
                failure.stage.to_owned(),
                failure.failure.what.clone(),
            ];
            object["failed"] = failure.to_json();
            object["reproduced"] = known.as_ref().map_or(Value::Null, |known| json!(*known == now));
            let words = match &known {
                Some(known) if *known == now => "fails as it did".to_owned(),
                Some([code, stage, what]) => format!("fails otherwise than it did ({code}, {stage}: {what})"),
                None => "fails".to_owned(),
            };
            let told = failure.failure.to_text(false);
            (format!("step {step} {words}, in {}:\n{told}", failure.stage), failure.failure.code.exit())
        }
    };
    run.console.result(&text)?;
    run.console.object(&object)?;
    Ok(exit)
}
