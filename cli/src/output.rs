//! Files written whole or not at all.
//!
//! Promises: [`Output::prepare`] finds out before the work whether the result can be written; what is written goes to
//! a temporary name in the same folder, is flushed to the disk, and takes its name in one step. Whatever stops the
//! process in between (an error, Ctrl-C, a panic) leaves an existing file as it was and no unfinished one.
//!
//! Does not promise: anything against a signal that cannot be caught; a temporary file may then stay behind.
//!
//! Devices and pipes (`/dev/stdout`, `/dev/null`) have no folder to rename in and are written directly.

use crate::codes::Code;
use crate::console::Stream;
use crate::failure::{Failure, shell_word};
use crate::input::STANDARD;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 18;

/// Temporary files that exist now; the handler of Ctrl-C removes them and keeps the lock, so that none comes after.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every unfinished file; as long as the guard lives none can be made and none can take its name.
pub(crate) fn abandon_all() -> impl Drop {
    let mut paths = unfinished();
    for path in paths.drain(..) {
        let _ = fs::remove_file(path);
    }
    paths
}

/// A file that is to go when the process ends early, such as a lock, or with this.
#[derive(Debug)]
pub(crate) struct Passing(PathBuf);

impl Passing {
    /// Takes care of a file that exists.
    pub(crate) fn of(path: PathBuf) -> Self {
        unfinished().push(path.clone());
        Self(path)
    }
}

impl Drop for Passing {
    fn drop(&mut self) {
        let mut known = unfinished();
        if let Some(at) = known.iter().position(|path| path == &self.0) {
            let _ = fs::remove_file(&self.0);
            known.swap_remove(at);
        }
    }
}

/// Writes a file whole or not at all, in the place of one that may be there.
pub(crate) fn write_whole<E: Into<WriteProblem>>(
    name: &Path,
    body: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> Result<(), Box<Failure>> {
    Output::prepare(name, true, &[])?.write(body)
}

/// A place where a result will be written.
#[derive(Debug)]
pub(crate) struct Output {
    /// As the user named it.
    name: PathBuf,
    place: Place,
}

#[derive(Debug)]
enum Place {
    StandardOutput,
    /// Written directly.
    Device(File),
    /// Written under a temporary name.
    File {
        temporary: PathBuf,
        file: File,
        target: PathBuf,
    },
}

impl Output {
    /// The name the user gave.
    pub(crate) fn name(&self) -> &Path {
        &self.name
    }

    /// Checks that `name` can be written and is not one of `inputs`, and opens a temporary file beside it.
    pub(crate) fn prepare(name: &Path, force: bool, inputs: &[&Path]) -> Result<Self, Box<Failure>> {
        let fail = |code, what: &str| Failure::new(code, what).subject(name.display().to_string());
        if name == Path::new(STANDARD) {
            return Ok(Self { name: name.to_owned(), place: Place::StandardOutput });
        }
        // A link is followed: its target is replaced, the link stays.
        let target = fs::canonicalize(name).unwrap_or_else(|_| name.to_owned());
        match fs::metadata(&target) {
            Ok(now) if now.is_dir() => {
                return Err(fail(
                    Code::OutputIsDirectory,
                    "this is a directory, and a file is to be written",
                )
                .help(format!("name a file, which may be in it: {}/NAME", shell_word(name))));
            }
            Ok(now) if now.is_file() => {
                if inputs.iter().any(|input| fs::canonicalize(input).is_ok_and(|input| input == target)) {
                    return Err(
                        fail(Code::OutputIsInput, "this is the input too").help("name another output")
                    );
                }
                if !force {
                    return Err(fail(Code::OutputExists, "this file exists already")
                        .help("add --force to overwrite it, or name another output"));
                }
                if now.permissions().readonly() {
                    return Err(fail(Code::NotWritable, "this file is write-protected")
                        .help(format!("chmod u+w {}", shell_word(name))));
                }
            }
            Ok(_) => {
                return match OpenOptions::new().write(true).open(&target) {
                    Ok(file) => Ok(Self { name: name.to_owned(), place: Place::Device(file) }),
                    Err(error) => Err(cannot_write(name, &error)),
                };
            }
            Err(_) => {}
        }
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        if !folder.is_dir() {
            let named = name.parent().unwrap_or(Path::new("."));
            return Err(fail(Code::FolderMissing, "its folder does not exist")
                .place(format!("folder {}", named.display()))
                .help(format!("mkdir -p {}", shell_word(named))));
        }
        if target.file_name().is_none() {
            return Err(fail(Code::NotWritable, "this names no file").help("name an output file"));
        }
        let mut known = unfinished();
        for attempt in 0..100 {
            // Not made of the name, which may be as long as names can be.
            let temporary = folder.join(format!(".welter-{}-{attempt}.part", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&temporary) {
                Ok(file) => {
                    known.push(temporary.clone());
                    return Ok(Self {
                        name: name.to_owned(),
                        place: Place::File { temporary, file, target },
                    });
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(cannot_write(name, &error)),
            }
        }
        Err(fail(Code::NotWritable, "no temporary name is free beside it")
            .help(format!("rm {}/.welter-*.part", shell_word(folder))))
    }

    /// Writes with `body` and gives the result its name. `body` returns what the caller wants to know.
    pub(crate) fn write<T, E>(
        mut self,
        body: impl FnOnce(&mut dyn Write) -> Result<T, E>,
    ) -> Result<T, Box<Failure>>
    where
        E: Into<WriteProblem>,
    {
        let result = match &mut self.place {
            Place::StandardOutput => fill(MayLeave(Stream::Out.lock()), body).map(|(value, _)| value),
            Place::Device(file) => fill(file, body).map(|(value, _)| value),
            Place::File { file, .. } => fill(file, body).and_then(|(value, file)| {
                file.sync_all()?;
                Ok(value)
            }),
        };
        let value = match result {
            Ok(value) => value,
            Err(WriteProblem::Io(error)) => return Err(cannot_write(&self.name, &error)),
            Err(WriteProblem::Failure(failure)) => return Err(failure),
        };
        self.finish()?;
        Ok(value)
    }

    fn finish(&mut self) -> Result<(), Box<Failure>> {
        if let Place::File { temporary, target, .. } = &self.place {
            let mut known = unfinished();
            fs::rename(temporary, target).map_err(|error| cannot_write(&self.name, &error))?;
            known.retain(|path| path != temporary);
        }
        Ok(())
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if let Place::File { temporary, .. } = &self.place {
            let mut known = unfinished();
            if let Some(at) = known.iter().position(|path| path == temporary) {
                let _ = fs::remove_file(temporary);
                known.swap_remove(at);
            }
        }
    }
}

/// A stream whose reader may leave early (`| head`): what is left is dropped.
struct MayLeave<W>(W);

impl<W: Write> Write for MayLeave<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.write(bytes) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(bytes.len()),
            result => result,
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self.0.flush() {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            result => result,
        }
    }
}

fn fill<W: Write, T, E: Into<WriteProblem>>(
    to: W,
    body: impl FnOnce(&mut dyn Write) -> Result<T, E>,
) -> Result<(T, W), WriteProblem> {
    let mut buffer = BufWriter::with_capacity(BUFFER, to);
    let value = body(&mut buffer).map_err(Into::into)?;
    buffer.flush()?;
    let to = buffer.into_inner().map_err(|error| WriteProblem::Io(error.into_error()))?;
    Ok((value, to))
}

/// Why a body could not write.
pub(crate) enum WriteProblem {
    Io(io::Error),
    Failure(Box<Failure>),
}

impl From<io::Error> for WriteProblem {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Box<Failure>> for WriteProblem {
    fn from(failure: Box<Failure>) -> Self {
        Self::Failure(failure)
    }
}

/// The failure for an error of the system on writing to `name`.
pub(crate) fn cannot_write(name: &Path, error: &io::Error) -> Box<Failure> {
    let (code, help) = match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            (Code::NotWritable, "name an output in a folder you can write, for example in ~".to_owned())
        }
        ErrorKind::NotFound => {
            let folder = name.parent().unwrap_or(Path::new("."));
            if folder.is_dir() {
                (
                    Code::NotWritable,
                    "name an output in another folder: this one takes no new files".to_owned(),
                )
            } else {
                (Code::FolderMissing, format!("mkdir -p {}", shell_word(folder)))
            }
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            let folder = match name.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            };
            (
                Code::WriteFailed,
                format!("df -h {}   # then name an output on a disk with room", shell_word(folder)),
            )
        }
        _ => (Code::WriteFailed, "name another output".to_owned()),
    };
    Failure::new(code, format!("cannot be written: {}", plain(error)))
        .subject(name.display().to_string())
        .help(help)
}

/// An error of the system without its number.
pub(crate) fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_lowercase(),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_the_system_have_their_codes() {
        let code = |kind: ErrorKind| cannot_write(Path::new("folder/out.ply"), &kind.into()).code;
        assert_eq!(code(ErrorKind::PermissionDenied), Code::NotWritable);
        assert_eq!(code(ErrorKind::ReadOnlyFilesystem), Code::NotWritable);
        assert_eq!(code(ErrorKind::NotFound), Code::FolderMissing);
        // A folder of the system that is there, and takes no files.
        let there = cannot_write(&std::env::temp_dir().join("out.ply"), &ErrorKind::NotFound.into());
        assert_eq!(there.code, Code::NotWritable);
        assert_eq!(code(ErrorKind::StorageFull), Code::WriteFailed);
        assert_eq!(code(ErrorKind::Other), Code::WriteFailed);
    }
}
