//! What goes to the person and what goes to the script.
//!
//! The result goes to standard output: text, or with `--json` exactly one JSON object and the text to standard error.
//! Notes, progress and errors go to standard error. A reader that closes its end early (`welter check ... | head`)
//! is no error: what is left is dropped and the exit code stays.

use crate::codes::Code;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use serde_json::{Value, json};
use std::io::{self, IsTerminal, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Where a line goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stream {
    Out,
    Err,
}

impl Stream {
    pub(crate) fn lock(self) -> Box<dyn Write> {
        match self {
            Self::Out => Box::new(io::stdout().lock()),
            Self::Err => Box::new(io::stderr().lock()),
        }
    }

    /// Writes and flushes; a closed reader is no error.
    pub(crate) fn write(self, text: &str) -> io::Result<()> {
        let mut stream = self.lock();
        match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result,
        }
    }

    fn is_terminal(self) -> bool {
        match self {
            Self::Out => io::stdout().is_terminal(),
            Self::Err => io::stderr().is_terminal(),
        }
    }

    /// Whether colour is wanted there: a terminal, no `NO_COLOR`, not `TERM=dumb`.
    pub(crate) fn color(self) -> bool {
        let unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
        self.is_terminal() && unset("NO_COLOR") && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
    }
}

/// Set as soon as the one JSON object of this process is being written.
static JSON_WRITTEN: Mutex<bool> = Mutex::new(false);

/// Writes the one JSON object; a second call writes nothing.
pub(crate) fn write_json_once(object: &Value) -> io::Result<()> {
    let mut written = JSON_WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    if std::mem::replace(&mut *written, true) {
        return Ok(());
    }
    Stream::Out.write(&format!("{object:#}\n"))
}

/// As [`write_json_once`], for the handler of Ctrl-C: gives up if the object is being written at this moment.
pub(crate) fn try_write_json_once(object: &Value) {
    if let Ok(mut written) = JSON_WRITTEN.try_lock()
        && !std::mem::replace(&mut *written, true)
    {
        let _ = Stream::Out.write(&format!("{object:#}\n"));
    }
}

/// How much is said, and where.
#[derive(Debug)]
pub(crate) struct Console {
    pub(crate) json: bool,
    /// 0 as usual, 1 the stages with their seconds, 2 details.
    pub(crate) verbose: u8,
    pub(crate) quiet: bool,
    pub(crate) progress: Progress,
    pub(crate) started: Instant,
}

impl Console {
    /// Where text for people goes.
    pub(crate) fn people(&self) -> Stream {
        if self.json { Stream::Err } else { Stream::Out }
    }

    /// The result for people. Left out with `--quiet`.
    pub(crate) fn result(&self, text: &str) -> Result<(), Box<Failure>> {
        if self.quiet {
            Ok(())
        } else {
            self.people().write(text).map_err(|error| standard_output_failed(&error))
        }
    }

    /// The result for scripts: written with `--json` only. With it the run ends.
    pub(crate) fn object(&self, object: &Value) -> Result<(), Box<Failure>> {
        interrupt::end_begins();
        if self.json {
            write_json_once(object).map_err(|error| standard_output_failed(&error))
        } else {
            Ok(())
        }
    }

    /// Text that is itself the product: written to standard output even with `--quiet`.
    pub(crate) fn script(&self, text: &str) -> Result<(), Box<Failure>> {
        Stream::Out.write(text).map_err(|error| standard_output_failed(&error))
    }

    /// A remark on standard error, left out with `--quiet`.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet {
            self.progress.hide(|| {
                let _ = Stream::Err.write(&format!("note: {text}\n"));
            });
        }
    }

    /// A detail on standard error, from the given level of `-v` on.
    pub(crate) fn detail(&self, level: u8, text: &str) {
        if self.verbose >= level {
            self.progress.hide(|| {
                let _ = Stream::Err.write(&format!("{text}\n"));
            });
        }
    }

    /// An error as text on standard error.
    pub(crate) fn error(&self, failure: &Failure) {
        self.progress.hide(|| print_error(failure));
    }

    /// Runs one stage of the work, tells its seconds with `-v` and adds them to `seconds`.
    pub(crate) fn stage<T>(&self, seconds: &mut Seconds, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let value = work();
        let spent = start.elapsed();
        seconds.add(name, spent);
        self.detail(1, &format!("{name:<24} {:>9.3} s", spent.as_secs_f64()));
        value
    }
}

/// An error as text on standard error, with colour where wanted.
pub(crate) fn print_error(failure: &Failure) {
    let _ = Stream::Err.write(&failure.to_text(Stream::Err.color()));
}

fn standard_output_failed(error: &io::Error) -> Box<Failure> {
    Failure::new(Code::WriteFailed, format!("standard output: {}", crate::output::plain(error)))
        .why("the result was computed but could not be delivered")
        .help("send standard output to a disk with room")
}

/// Seconds of each stage, in the order in which the stages first ran.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seconds(Vec<(&'static str, Duration)>);

impl Seconds {
    fn add(&mut self, name: &'static str, spent: Duration) {
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some((_, total)) => *total += spent,
            None => self.0.push((name, spent)),
        }
    }

    /// `{ <stage>: s, total }`.
    pub(crate) fn to_json(&self) -> Value {
        let total: Duration = self.0.iter().map(|(_, spent)| *spent).sum();
        let mut object = serde_json::Map::new();
        for (name, spent) in &self.0 {
            object.insert(name.replace(' ', "_"), json!(spent.as_secs_f64()));
        }
        object.insert("total".to_owned(), json!(total.as_secs_f64()));
        Value::Object(object)
    }
}
