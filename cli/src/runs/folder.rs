//! The folder of a run: made, locked, and found to be new, to be gone on with, or neither: [`RunFolder`].
//!
//! Promises: a folder of something else is never written into; a run that is there is gone on with or replaced only when that is asked for;
//! a folder that was made for a run that never began is taken away again.

use super::checkpoint::{self, Checkpoint};
use super::lock::{self, Lock};
use super::resolved::first_difference;
use super::{failed_step, frames, record, report, stats};
use crate::codes::Code;
use crate::failure::Failure;
use crate::output::cannot_write;
use crate::run::Run;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    /// A new run; with true in the place of one that may be there.
    Anew(bool),
    /// To go on with the one that is there, or to begin if there is none.
    Resume,
}

/// A folder that this process may write a run into.
#[derive(Debug)]
pub(crate) struct RunFolder {
    path: PathBuf,
    /// Made here, and still empty: goes with the failure.
    made: bool,
    _lock: Option<Lock>,
    /// Where the run goes on.
    pub(crate) from: Option<Checkpoint>,
}

impl RunFolder {
    /// Opens a folder for a run of `solver` and of a resolved scene.
    pub(crate) fn open(
        path: &Path,
        start: Start,
        solver: &str,
        scene: &str,
        run: &Run,
    ) -> Result<Self, Box<Failure>> {
        let shown = path.display().to_string();
        let refuse = |code, what: &str| Failure::new(code, what).subject(&shown);
        if path == Path::new(crate::input::STANDARD) {
            return Err(refuse(Code::NotWritable, "a run is a folder of files").help("-o run"));
        }
        let made = match fs::metadata(path) {
            Ok(meta) if meta.is_dir() => false,
            Ok(_) => {
                return Err(refuse(Code::OutputExists, "this is a file, and a folder is needed")
                    .help("name another folder with -o"));
            }
            Err(_) => {
                fs::create_dir(path).map_err(|error| cannot_write(path, &error))?;
                true
            }
        };
        let mut folder = Self { path: path.to_owned(), made, _lock: None, from: None };
        // Before anything is written there, and again once nobody else does.
        folder.admit(start)?;
        let lock = Lock::take(path)?;
        if let Some(stale) = &lock.stale {
            run.console.note(&format!("{shown}: {stale} ended without finishing; its run is taken over"));
        }
        folder._lock = Some(lock);
        match folder.admit(start)? {
            Some(record) if start == Start::Resume => folder.find(&record, solver, scene, run)?,
            Some(_) => folder.clear(),
            None if start == Start::Resume => {
                run.console.note(&format!("{shown}: no run is there; a new one begins"))
            }
            None => {}
        }
        Ok(folder)
    }

    /// The record of the run that is there, if one may be.
    fn admit(&self, start: Start) -> Result<Option<Value>, Box<Failure>> {
        let refuse = |code, what: &str| Failure::new(code, what).subject(self.path.display().to_string());
        let record = record::read(&self.path);
        match &record {
            None if !is_free(&self.path)? => {
                Err(refuse(Code::NotARun, "the folder is not empty, and holds no run")
                    .help("name another folder with -o"))
            }
            Some(record) if start == Start::Anew(false) => {
                let status = record["status"].as_str().unwrap_or("unknown");
                Err(refuse(Code::OutputExists, "a run is there already")
                    .place(format!("its status is: {status}"))
                    .help("--resume goes on with it, --force replaces it"))
            }
            _ => Ok(record),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Finds where to go on. Without a whole checkpoint that is the beginning.
    fn find(&mut self, record: &Value, solver: &str, scene: &str, run: &Run) -> Result<(), Box<Failure>> {
        let name = self.path.display().to_string();
        let before = fs::read_to_string(self.path.join(record::SCENE)).unwrap_or_default();
        let differs = |what: String| {
            Failure::new(Code::SceneDiffers, what).subject(&name).help(
                "name another folder with -o for the scene as it is now, or replace the run with --force",
            )
        };
        if record["solver"] != solver {
            return Err(differs(format!(
                "this is a run of welter {}",
                record["solver"].as_str().unwrap_or("?")
            )));
        }
        // The record of the scene may be lost; checkpoints have their own.
        if let (false, Some([then, now])) = (before.is_empty(), first_difference(&before, scene)) {
            return Err(differs("the scene is not that of the run".to_owned())
                .place(format!("then: {then}"))
                .place(format!("now:  {now}")));
        }
        let lines = stats::read(&self.path).len() as u64;
        let (found, passed_over) = checkpoint::newest(&self.path, |checkpoint| {
            if checkpoint.solver != solver || checkpoint.scene != scene {
                Err("it is of another scene".to_owned())
            } else if checkpoint.step >= lines {
                Err(format!("it is of step {}, and statistics end before", checkpoint.step))
            } else {
                Ok(())
            }
        });
        for (path, why) in passed_over {
            run.console.note(&format!("{}: {why}; passed over", path.display()));
        }
        match &found {
            Some(checkpoint) => {
                let version = env!("CARGO_PKG_VERSION");
                if checkpoint.version != version {
                    let written = &checkpoint.version;
                    run.console.note(&format!(
                        "{name}: written by version {written}; {version} may give other bits"
                    ));
                }
                run.console.note(&format!("{name}: goes on after step {}", checkpoint.step));
            }
            None => {
                run.console.note(&format!("{name}: no checkpoint can be gone on from; the run begins again"));
            }
        }
        self.from = found;
        Ok(())
    }

    /// Removes the files of an earlier run, and no others.
    fn clear(&self) {
        frames::remove_from(&self.path, 0);
        checkpoint::remove_after(&self.path, None);
        failed_step::remove(&self.path);
        for name in [record::NAME, record::SCENE, record::LOG, stats::NAME, report::HTML, report::JSON] {
            let _ = fs::remove_file(self.path.join(name));
        }
    }

    /// From now on the folder stays, whatever comes.
    pub(super) fn keep(&mut self) {
        self.made = false;
    }
}

impl Drop for RunFolder {
    fn drop(&mut self) {
        self._lock = None;
        if self.made {
            // Removes it only if it is empty.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

/// Removes the unfinished files of a process that was killed; under the lock there can be no others.
pub(super) fn sweep(path: &Path) {
    for folder in ["", "surface", "paraview", "preview", "volume", "checkpoint", "failure"] {
        for entry in fs::read_dir(path.join(folder)).into_iter().flatten().flatten() {
            if is_unfinished(&entry.file_name().to_string_lossy()) {
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

fn is_unfinished(name: &str) -> bool {
    name.starts_with(".welter-") && name.ends_with(".part")
}

/// Whether nothing is in a folder but what a process that ended early leaves.
fn is_free(path: &Path) -> Result<bool, Box<Failure>> {
    let entries = fs::read_dir(path).map_err(|error| crate::input::cannot_read(path, &error))?;
    let mut names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    Ok(names.all(|name| name == lock::NAME || is_unfinished(&name)))
}
