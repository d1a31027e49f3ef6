//! A step that failed, as a file of its own that `welter replay` runs: [`FailedStep`].
//!
//! Promises: the file has the scene, the state before the step in its bits, and what failed; nothing else is needed. The surface before the
//! step is there as PLY too.

use super::checkpoint::Checkpoint;
use super::container::Container;
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::cannot_read;
use crate::output::{cannot_write, write_whole};
use crate::surface_file::write_surface;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use welter_meshing::io::{Format, WriteOptions};
use welter_meshing::surface::TriMesh;

/// The folder in that of the run.
const FOLDER: &str = "failure";

/// Why a step was not completed.
#[derive(Clone, Debug)]
pub(crate) struct StepFailure {
    /// What, where and why, for people.
    pub(crate) failure: Box<Failure>,
    /// In which part of the step.
    pub(crate) stage: &'static str,
    /// Ids, positions and numbers of the place.
    pub(crate) details: Value,
}

/// What is known of a step that is to be run again.
#[derive(Debug)]
pub(crate) struct FailedStep {
    pub(crate) before: Checkpoint,
    /// None if the file is a checkpoint, after which nothing failed that is known.
    pub(crate) failure: Option<Value>,
}

impl StepFailure {
    pub(crate) fn to_json(&self) -> Value {
        json!({ "error": self.failure.to_json(), "stage": self.stage, "details": self.details })
    }
}

impl FailedStep {
    /// Reads the file of a failed step, or a checkpoint.
    pub(crate) fn read(path: &Path) -> Result<Self, Box<Failure>> {
        let bytes = fs::read(path).map_err(|error| cannot_read(path, &error))?;
        let refuse = |what: String| {
            Failure::new(Code::NoRunFile, what)
                .subject(path.display().to_string())
                .help("name a file in the folder failure or checkpoint of a run")
        };
        let container = Container::of_bytes(&bytes).map_err(|problem| refuse(problem.to_string()))?;
        let before = Checkpoint::of_container(&container)
            .ok_or_else(|| refuse("the file is whole, and holds no state of a solver".to_owned()))?;
        let failure = container.text("failure").and_then(|text| serde_json::from_str(text).ok());
        Ok(Self { before, failure })
    }
}

/// Writes the file of a step that failed with the state before it; gives its name.
pub(super) fn write(folder: &Path, before: &Checkpoint, failed: &Value) -> Result<PathBuf, Box<Failure>> {
    let folder = folder.join(FOLDER);
    fs::create_dir_all(&folder).map_err(|error| cannot_write(&folder, &error))?;
    let path = folder.join(format!("step_{:08}.bin", before.step + 1));
    let bytes = before.to_container().with("failure", failed.to_string()).to_bytes();
    write_whole(&path, |file| file.write_all(&bytes))?;
    Ok(path)
}

/// Writes the surface before the step.
pub(super) fn write_surface_before(folder: &Path, mesh: &TriMesh) -> Result<PathBuf, Box<Failure>> {
    let path = folder.join(FOLDER).join("before.ply");
    let output = crate::output::Output::prepare(&path, true, &[])?;
    let _ = write_surface(output, Format::Ply, mesh, &WriteOptions::default())?;
    Ok(path)
}

/// The failure of a run whose step failed, which names the files.
pub(super) fn tell(failed: &StepFailure, step: u64, replay: &Path, before: &Path) -> Box<Failure> {
    let mut failure = failed.failure.clone();
    failure.what = format!("step {step}, {}: {}", failed.stage, failure.what);
    failure
        .place(format!("surface before the step: {}", before.display()))
        .help(format!("welter replay {}   # runs this step alone", shell_word(replay)))
}

/// Removes what an earlier run left.
pub(super) fn remove(folder: &Path) {
    let folder = folder.join(FOLDER);
    for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name == "before.ply" || (name.starts_with("step_") && name.ends_with(".bin")) {
            let _ = fs::remove_file(entry.path());
        }
    }
    let _ = fs::remove_dir(folder);
}
