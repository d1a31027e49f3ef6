//! A run that is there, to be told of again: [`PastRun`].
//!
//! Promises: nothing of the run but its report is written, and that whole; the folder is locked meanwhile, so a run that still goes on is refused.
//! The report of a run that ended by itself has the bytes that it had. Of one that was killed it is that of the newest whole checkpoint.

use super::checkpoint::{self, Checkpoint};
use super::lock::Lock;
use super::record::Status;
use super::stats::Line;
use super::{Simulation, record, report, stats};
use crate::codes::Code;
use crate::failure::Failure;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// The folder of a run, with its newest state.
pub(crate) struct PastRun {
    folder: PathBuf,
    status: Status,
    /// The state up to which is told.
    pub(crate) state: Checkpoint,
    /// Of the steps before it.
    lines: Vec<Line>,
    _lock: Lock,
}

impl PastRun {
    pub(crate) fn open(folder: &Path) -> Result<Self, Box<Failure>> {
        let refuse = |code: Code, what: &str| Failure::new(code, what).subject(folder.display().to_string());
        if !folder.is_dir() {
            return Err(refuse(Code::NotFound, "there is no such folder")
                .help("name the folder that a run was written into with -o"));
        }
        let Some(record) = record::read(folder) else {
            return Err(refuse(Code::NoRunFile, "the folder holds no run")
                .help("name a folder that has a run.json of welter track or welter sim"));
        };
        let lock = Lock::take(folder)?;
        let solver = record["solver"].as_str().unwrap_or_default();
        let mut lines = stats::read(folder);
        let (found, _) = checkpoint::newest(folder, |checkpoint| {
            if checkpoint.solver == solver && checkpoint.step < lines.len() as u64 {
                Ok(())
            } else {
                Err("it is of another run, or of steps that are not told of".to_owned())
            }
        });
        let Some(state) = found else {
            return Err(refuse(Code::NoRunFile, "no whole checkpoint is there, so its state is not known")
                .help("go on with the run: --resume begins where it can"));
        };
        lines.truncate(state.step as usize + 1);
        let status = record["status"].as_str().and_then(Status::of).unwrap_or(Status::Running);
        Ok(Self { folder: folder.to_owned(), status, state, lines, _lock: lock })
    }

    /// Writes the report of `simulation`, which is at the state of the run; gives the result.
    pub(crate) fn report(&self, simulation: &impl Simulation) -> Result<Map<String, Value>, Box<Failure>> {
        let lines: Vec<&Value> = self.lines.iter().map(|line| &line.value).collect();
        let mut result = simulation.conclude(&lines, self.status == Status::Finished);
        result.insert("status".into(), json!(self.status.name()));
        report::write(&self.folder, &self.state.solver, self.status, &result, &lines)?;
        Ok(result)
    }
}
