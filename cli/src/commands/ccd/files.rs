//! Files of queries: found and checked before the work, then opened one after the other.

use super::kind::{Kind, KindOption};
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::{STANDARD, cannot_read};
use crate::output::plain;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use welter_tracking::queries::{Parameters, Queries, ReadError};

/// Bytes asked of the system at once.
const BUFFER: usize = 1 << 18;

/// A file of queries that exists and whose kind is known.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) name: PathBuf,
    pub(super) kind: Kind,
    /// Size, where it is known.
    pub(super) bytes: Option<u64>,
}

/// The files that the command line names, those of a folder sorted by name.
pub(super) fn find(named: &[PathBuf], kind: KindOption) -> Result<Vec<Source>, Box<Failure>> {
    let mut sources = Vec::new();
    for name in named {
        let files = if name.is_dir() { csv_files(name)? } else { vec![name.clone()] };
        for file in files {
            sources.push(Source::check(file, kind)?);
        }
    }
    Ok(sources)
}

/// Every `*.csv` at any depth below a folder; hidden names and links to folders are passed over.
fn csv_files(folder: &Path) -> Result<Vec<PathBuf>, Box<Failure>> {
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|error| cannot_read(&folder, &error))? {
            let entry = entry.map_err(|error| cannot_read(&folder, &error))?;
            let path = entry.path();
            if entry.file_name().as_encoded_bytes().starts_with(b".") {
                continue;
            }
            let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                folders.push(path);
            } else if is_csv && path.is_file() {
                files.push(path);
            }
        }
    }
    if files.is_empty() {
        return Err(Failure::new(Code::EmptySequence, "there is no *.csv in this folder or below it")
            .subject(folder.display().to_string())
            .help(format!("ls -R {}", shell_word(folder))));
    }
    files.sort();
    Ok(files)
}

impl Source {
    /// Checks everything that needs no reading.
    fn check(name: PathBuf, kind: KindOption) -> Result<Self, Box<Failure>> {
        let bytes = if name == Path::new(STANDARD) {
            None
        } else {
            let meta = fs::metadata(&name).map_err(|error| cannot_read(&name, &error))?;
            // A pipe is not opened on trial: its writer would take the closing for the end.
            if meta.is_file() {
                drop(open(&name)?);
            }
            meta.is_file().then_some(meta.len())
        };
        let kind = kind.of(&name)?;
        Ok(Self { name, kind, bytes })
    }

    /// A reader of its queries.
    pub(super) fn queries(&self, parameters: Parameters) -> Result<Queries<Box<dyn BufRead>>, Box<Failure>> {
        let input: Box<dyn BufRead> = if self.name == Path::new(STANDARD) {
            Box::new(io::stdin().lock())
        } else {
            Box::new(BufReader::with_capacity(BUFFER, open(&self.name)?))
        };
        Ok(Queries::new(input, parameters))
    }
}

fn open(name: &Path) -> Result<File, Box<Failure>> {
    File::open(name).map_err(|error| cannot_read(name, &error))
}

/// The failure for a file whose content could not be read.
pub(super) fn not_understood(source: &Source, error: &ReadError) -> Box<Failure> {
    let (name, kind) = (&source.name, source.kind.name());
    let (shown, word) = (name.display().to_string(), shell_word(name));
    let again = "download it again, or write it again with the program it comes from";
    let at_line = |line: u64| {
        format!("sed -n {line}p {word}   # shows the line; a row is 6 integers and the answer, 0 or 1")
    };
    let (code, help) = match error {
        ReadError::Empty => (Code::EmptyFile, format!("ls -l {word}   # then {again}")),
        ReadError::Truncated { .. } => (Code::Truncated, again.to_owned()),
        ReadError::NotRepresentable { .. } => (
            Code::NotRepresentable,
            format!("welter ccd {word} --kind {kind} --rounded   # takes the nearest numbers"),
        ),
        ReadError::BeyondRange { .. } => {
            (Code::NotRepresentable, "scale the coordinates of the query by a power of two".to_owned())
        }
        ReadError::NotUtf8 { .. } => (Code::NotUtf8Text, format!("file {word}   # tells what it is")),
        ReadError::LineTooLong { .. } => (Code::Malformed, format!("file {word}   # tells what it is")),
        ReadError::Io { source, .. } => (
            Code::ReadFailed,
            format!("cp {word} /tmp   # to see whether the disk delivers it: {}", plain(source)),
        ),
        _ => (Code::Malformed, at_line(error.line().unwrap_or(1))),
    };
    let text = error.to_string();
    let what = match error.line() {
        Some(line) => {
            let rest = text.strip_prefix(&format!("line {line}")).unwrap_or(&text);
            rest.trim_start_matches([':', ',', ' ']).to_owned()
        }
        None => text,
    };
    let why = match error {
        ReadError::Truncated { .. } => "a part of the queries is missing",
        ReadError::Empty => "there is no query in it",
        ReadError::NotRepresentable { .. } | ReadError::BeyondRange { .. } => Code::NotRepresentable.why(),
        _ if code == Code::Malformed => "a guess at what is meant would answer another question",
        _ => code.why(),
    };
    let failure = Failure::new(code, what).subject(&shown).why(why).help(help);
    match error.line() {
        Some(line) => failure.place(format!("{shown}:{line}")),
        None => failure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disk_that_does_not_deliver_is_told_with_the_line() {
        let source = Source { name: "ee.csv".into(), kind: Kind::EdgeEdge, bytes: None };
        let error = ReadError::Io { line: 7, source: io::ErrorKind::TimedOut.into() };
        let failure = not_understood(&source, &error);
        assert_eq!((failure.code, failure.places[0].as_str()), (Code::ReadFailed, "ee.csv:7"));
    }
}
