//! `stats.jsonl`: an object a step, the first of the initial state: [`Stats`].
//!
//! Promises: line `k` is of step `k`; lines are only appended while a run goes on. When one goes on from a checkpoint, what comes after the
//! checkpoint is dropped, and a last line that is torn with it.

use crate::failure::Failure;
use crate::output::{cannot_write, write_whole};
use serde_json::{Map, Value, json};
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use welter_tracking::tracker::PhaseSeconds;

/// The name of the file.
pub(super) const NAME: &str = "stats.jsonl";

/// A line, as it stands in the file. Values are always those read from the text, so that a run that goes on counts with the same ones.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    text: String,
    pub(crate) value: Value,
}

/// The lines of a run, in memory and in the file.
#[derive(Debug)]
pub(crate) struct Stats {
    path: PathBuf,
    file: File,
    /// Length of the file in bytes.
    length: u64,
    lines: Vec<Line>,
}

/// The seconds of a step of a tracker, by phase.
pub(crate) fn phase_seconds(seconds: &PhaseSeconds) -> Value {
    json!({
        "improvement": seconds.improvement,
        "topology": seconds.topology,
        "velocity": seconds.velocity,
        "collisions": seconds.collisions,
        "compaction": seconds.compaction,
        "check": seconds.check,
        "total": seconds.total,
    })
}

/// The lines of a file that are whole, from the first on.
pub(crate) fn read(folder: &Path) -> Vec<Line> {
    let text = fs::read(folder.join(NAME)).unwrap_or_default();
    let mut lines = Vec::new();
    for line in text.split_inclusive(|&byte| byte == b'\n') {
        let text = line.strip_suffix(b"\n").and_then(|line| std::str::from_utf8(line).ok());
        match text.and_then(Line::of) {
            Some(line) if line.value["step"] == lines.len() => lines.push(line),
            _ => break,
        }
    }
    lines
}

impl Line {
    fn of(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok().map(|value| Self { text: text.to_owned(), value })
    }
}

impl Stats {
    /// Begins, or goes on after `lines`.
    pub(crate) fn open(folder: &Path, lines: Vec<Line>) -> Result<Self, Box<Failure>> {
        let path = folder.join(NAME);
        let text: String = lines.iter().map(|line| format!("{}\n", line.text)).collect();
        write_whole(&path, |file| file.write_all(text.as_bytes()))?;
        let file =
            OpenOptions::new().append(true).open(&path).map_err(|error| cannot_write(&path, &error))?;
        Ok(Self { path, file, length: text.len() as u64, lines })
    }

    /// Appends a line. If it cannot be written whole, nothing of it is left.
    pub(crate) fn push(&mut self, line: Map<String, Value>) -> Result<(), Box<Failure>> {
        let line = Value::Object(line).to_string();
        let text = format!("{line}\n");
        if let Err(error) = self.file.write_all(text.as_bytes()) {
            let _ = self.file.set_len(self.length);
            return Err(cannot_write(&self.path, &error));
        }
        self.length += text.len() as u64;
        self.lines.push(Line::of(&line).expect("it was written as JSON"));
        Ok(())
    }

    /// What was written is on the disk.
    pub(crate) fn sync(&self) -> Result<(), Box<Failure>> {
        self.file.sync_data().map_err(|error| cannot_write(&self.path, &error))
    }

    pub(crate) fn lines(&self) -> &[Line] {
        &self.lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn line(step: u64) -> Map<String, Value> {
        json!({ "step": step, "volume": 0.1 + 0.2 }).as_object().unwrap().clone()
    }

    #[test]
    fn torn_lines_and_what_comes_after_them_are_dropped() {
        let folder = tempfile::tempdir().unwrap();
        assert!(read(folder.path()).is_empty());
        let mut stats = Stats::open(folder.path(), Vec::new()).unwrap();
        (0..5).for_each(|step| stats.push(line(step)).unwrap());
        let whole = fs::read(folder.path().join(NAME)).unwrap();
        let lines = read(folder.path());
        assert_eq!((lines.len(), &lines[..]), (5, stats.lines()));
        for (end, kept) in [(whole.len() - 1, 4), (whole.len() / 5 + 3, 1), (0, 0)] {
            fs::write(folder.path().join(NAME), &whole[..end]).unwrap();
            assert_eq!(read(folder.path()).len(), kept);
        }
        // A line that is missing, and one that is no JSON.
        let text = String::from_utf8(whole.clone()).unwrap();
        fs::write(folder.path().join(NAME), text.replacen("\"step\":2", "\"step\":3", 1)).unwrap();
        assert_eq!(read(folder.path()).len(), 2);
        fs::write(folder.path().join(NAME), text.replacen("{\"step\":1", "\u{0}", 1)).unwrap();
        assert_eq!(read(folder.path()).len(), 1);
        // Going on gives the bytes of a run that was never stopped.
        let mut stats = Stats::open(folder.path(), lines[..2].to_vec()).unwrap();
        (2..5).for_each(|step| stats.push(line(step)).unwrap());
        assert_eq!(fs::read(folder.path().join(NAME)).unwrap(), whole);
    }
}
