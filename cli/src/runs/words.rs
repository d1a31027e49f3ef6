//! What people are told of a run: [`Words`], [`resume_line`].

use crate::failure::shell_word;
use crate::numbers::{self, grouped};
use serde_json::{Map, Value};
use std::fmt::Write as _;
use std::path::Path;

/// The command line that goes on with a run: what is set belongs to the scene.
pub(crate) fn resume_line(solver: &str, scene: &Path, output: &Path, set: &[String], seed: u64) -> String {
    let mut line = format!("welter {solver} {} -o {} --resume", shell_word(scene), shell_word(output));
    for set in set {
        let _ = write!(line, " --set {}", shell_word(Path::new(set)));
    }
    if seed != 0 {
        let _ = write!(line, " --seed {seed}");
    }
    line
}

/// A result in a sentence and rows of name and value.
#[derive(Debug)]
pub(crate) struct Words {
    result: Value,
    text: String,
}

impl Words {
    /// Begins with the sentence: how it ended, and `what` was done.
    pub(crate) fn of(scene: &Path, result: &Map<String, Value>, what: &[&str]) -> Self {
        let mut words = Self { result: Value::Object(result.clone()), text: String::new() };
        let status = words.result["status"].as_str().unwrap_or("unknown");
        let done: String =
            what.iter().map(|what| format!("{} {what}, ", words.count(&format!("/{what}")))).collect();
        let time = words.number("/time").unwrap_or_default();
        words.text = format!("{}: {status} after {done}time {time}\n", scene.display());
        words
    }

    /// A whole number of the result.
    pub(crate) fn count(&self, path: &str) -> String {
        self.result.pointer(path).and_then(Value::as_u64).map_or("?".to_owned(), grouped)
    }

    /// A number of the result, if it is there.
    pub(crate) fn number(&self, path: &str) -> Option<String> {
        self.result.pointer(path).and_then(Value::as_f64).map(numbers::number)
    }

    pub(crate) fn row(&mut self, name: &str, value: &str) {
        let _ = writeln!(self.text, "  {name:<18} {value}");
    }

    /// Counts in a row, each a key of a part of the result and a word for it.
    pub(crate) fn counts(&mut self, name: &str, path: &str, counts: &[(&str, &str)]) {
        let count = |(key, word): &(&str, &str)| format!("{} {word}", self.count(&format!("{path}/{key}")));
        let counts: Vec<String> = counts.iter().map(count).collect();
        self.row(name, &counts.join(", "));
    }

    /// Ends with where everything is.
    pub(crate) fn end(mut self, output: &Path) -> String {
        self.row("report", &shell_word(&output.join("report.html")));
        self.row("for ParaView", &shell_word(&output.join("paraview/surface.pvd")));
        self.text
    }
}
