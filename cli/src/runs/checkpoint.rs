//! Checkpoints of a run: [`Checkpoint`], in the folder `checkpoint`.
//!
//! Promises: written whole or not at all; the last two are kept, so that one is there while the next is written. Only a whole one is read:
//! the newest; others that are not whole are told and passed over.

use super::container::{Container, NoContainer};
use crate::failure::Failure;
use crate::output::{cannot_write, write_whole};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// The name of the folder.
pub(super) const FOLDER: &str = "checkpoint";

/// How many are kept.
const KEPT: usize = 2;

/// A state between two steps, with the scene that it is of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Checkpoint {
    /// Of which solver.
    pub(crate) solver: String,
    /// How many steps are done.
    pub(crate) step: u64,
    pub(crate) time: f64,
    /// The resolved scene.
    pub(crate) scene: String,
    /// Bytes of the solver.
    pub(crate) state: Vec<u8>,
    /// Version of the program that wrote it.
    pub(crate) version: String,
}

impl Checkpoint {
    /// With the sections that a reader of another kind of file also wants.
    pub(super) fn to_container(&self) -> Container {
        let about = json!({
            "solver": self.solver,
            "step": self.step,
            "time_bits": self.time.to_bits(),
            "version": self.version,
        });
        Container::default()
            .with("about", about.to_string())
            .with("scene", self.scene.as_str())
            .with("state", self.state.as_slice())
    }

    pub(super) fn of_container(container: &Container) -> Option<Self> {
        let about: Value = serde_json::from_str(container.text("about")?).ok()?;
        let text = |key: &str| about[key].as_str().map(str::to_owned);
        Some(Self {
            solver: text("solver")?,
            step: about["step"].as_u64()?,
            time: f64::from_bits(about["time_bits"].as_u64()?),
            scene: container.text("scene")?.to_owned(),
            state: container.section("state")?.to_vec(),
            version: text("version")?,
        })
    }

    fn read(path: &Path) -> Result<Self, String> {
        let bytes = fs::read(path).map_err(|error| crate::output::plain(&error))?;
        let container = Container::of_bytes(&bytes).map_err(|problem| problem.to_string())?;
        Self::of_container(&container).ok_or_else(|| NoContainer::Damaged("it is no checkpoint").to_string())
    }

    /// Writes it into a run folder, and removes older ones.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Box<Failure>> {
        let folder = folder.join(FOLDER);
        fs::create_dir_all(&folder).map_err(|error| cannot_write(&folder, &error))?;
        let bytes = self.to_container().to_bytes();
        write_whole(&folder.join(name(self.step)), |file| file.write_all(&bytes))?;
        for (_, path) in all(&folder).into_iter().filter(|(step, _)| *step <= self.step).skip(KEPT) {
            let _ = fs::remove_file(path);
        }
        Ok(())
    }
}

fn name(step: u64) -> String {
    format!("step_{step:08}.bin")
}

/// The checkpoints of a folder, the newest first.
fn all(folder: &Path) -> Vec<(u64, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<(u64, PathBuf)> = entries
        .filter_map(|entry| {
            let file = entry.file_name().into_string().ok()?;
            let step = file.strip_prefix("step_")?.strip_suffix(".bin")?.parse().ok()?;
            Some((step, entry.path()))
        })
        .collect();
    found.sort_by(|a, b| b.cmp(a));
    found
}

/// The newest whole checkpoint of a run folder that `fits`, and why newer ones are passed over.
pub(crate) fn newest(
    folder: &Path,
    fits: impl Fn(&Checkpoint) -> Result<(), String>,
) -> (Option<Checkpoint>, Vec<(PathBuf, String)>) {
    let mut passed_over = Vec::new();
    for (_, path) in all(&folder.join(FOLDER)) {
        match Checkpoint::read(&path).and_then(|checkpoint| fits(&checkpoint).map(|()| checkpoint)) {
            Ok(checkpoint) => return (Some(checkpoint), passed_over),
            Err(why) => passed_over.push((path, why)),
        }
    }
    (None, passed_over)
}

/// Removes those after a step: a run goes on from it.
pub(super) fn remove_after(folder: &Path, step: Option<u64>) {
    for (later, path) in all(&folder.join(FOLDER)) {
        if step.is_none_or(|step| later > step) {
            let _ = fs::remove_file(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoint(step: u64) -> Checkpoint {
        Checkpoint {
            solver: "test".into(),
            step,
            time: 0.1 * step as f64,
            scene: "a = 1\n".into(),
            state: vec![step as u8; 100],
            version: "0".into(),
        }
    }

    #[test]
    fn the_last_two_are_kept_and_the_newest_whole_one_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let any = |_: &Checkpoint| Ok(());
        assert_eq!(newest(folder.path(), any), (None, Vec::new()));
        for step in [0, 9, 10, 100] {
            checkpoint(step).write(folder.path()).unwrap();
        }
        let files = all(&folder.path().join(FOLDER));
        assert_eq!(files.iter().map(|(step, _)| *step).collect::<Vec<_>>(), [100, 10]);
        assert_eq!(newest(folder.path(), any), (Some(checkpoint(100)), Vec::new()));

        let mut bytes = fs::read(&files[0].1).unwrap();
        bytes[60] ^= 1;
        fs::write(&files[0].1, bytes).unwrap();
        let (found, passed_over) = newest(folder.path(), any);
        assert_eq!(found, Some(checkpoint(10)));
        assert_eq!(passed_over, [(files[0].1.clone(), "damaged: the checksum is another one".to_owned())]);

        let (found, passed_over) = newest(folder.path(), |_| Err("other scene".to_owned()));
        assert_eq!((found, passed_over.len()), (None, 2));
        remove_after(folder.path(), Some(10));
        assert_eq!(all(&folder.path().join(FOLDER)).len(), 1);
    }

    #[test]
    fn times_keep_their_bits() {
        let odd = Checkpoint { time: f64::from_bits(0x3fb9_9999_9999_999b), ..checkpoint(3) };
        let again = Container::of_bytes(&odd.to_container().to_bytes()).unwrap();
        assert_eq!(Checkpoint::of_container(&again), Some(odd));
        let other = Container::default().with("about", "{}").with("scene", "").with("state", "");
        assert_eq!(Checkpoint::of_container(&other), None);
    }
}
