//! One process at a time in a run folder: [`Lock`].
//!
//! Promises: while a lock lives, no other process gets one for the folder. The system lets go of it when the process ends, however it ends,
//! so that no lock is left behind; a file that one was held on may be, and tells which process did not end as it should.
//!
//! Does not promise: anything on file systems without locks; there the run goes on without one.

use crate::clock;
use crate::codes::Code;
use crate::failure::Failure;
use crate::output::{Passing, cannot_write};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::Path;

/// The name of the file.
pub(super) const NAME: &str = "lock";

/// Tries until the file that is locked is the one of the name: its holder before removes it.
const TRIES: usize = 100;

/// Held while it lives.
#[derive(Debug)]
pub(crate) struct Lock {
    /// What a process wrote that ended without removing it.
    pub(crate) stale: Option<String>,
    _file: File,
    _passing: Passing,
}

impl Lock {
    pub(crate) fn take(folder: &Path) -> Result<Self, Box<Failure>> {
        let path = folder.join(NAME);
        let failed = |error: &std::io::Error| cannot_write(&path, error);
        let mine = format!("process {}, since {}\n", std::process::id(), clock::now());
        for _ in 0..TRIES {
            let mut options = OpenOptions::new();
            let options = options.read(true).write(true).create(true).truncate(false);
            let mut file = options.open(&path).map_err(|error| failed(&error))?;
            let mut before = String::new();
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let _ = file.read_to_string(&mut before);
                    return Err(held(folder, before.trim()));
                }
                // The file system has no locks.
                Err(TryLockError::Error(_)) => {}
            }
            let _ = file.read_to_string(&mut before);
            file.set_len(0)
                .and_then(|()| write_at_start(&mut file, &mine))
                .map_err(|error| failed(&error))?;
            if fs::read_to_string(&path).is_ok_and(|found| found == mine) {
                let before = before.trim();
                let stale = (!before.is_empty()).then(|| before.to_owned());
                return Ok(Self { stale, _file: file, _passing: Passing::of(path) });
            }
        }
        Err(held(folder, "another process"))
    }
}

fn write_at_start(file: &mut File, text: &str) -> std::io::Result<()> {
    use std::io::Seek;
    file.rewind()?;
    file.write_all(text.as_bytes())?;
    file.sync_data()
}

fn held(folder: &Path, by: &str) -> Box<Failure> {
    Failure::new(Code::RunLocked, "another process is writing this run")
        .subject(folder.display().to_string())
        .place(by)
        .help("wait until it has ended, or name another folder with -o")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_none_left() {
        let folder = tempfile::tempdir().unwrap();
        let lock = Lock::take(folder.path()).unwrap();
        assert_eq!(lock.stale, None);
        let second = Lock::take(folder.path()).unwrap_err();
        assert_eq!(second.code, Code::RunLocked);
        assert!(second.places[0].contains(&std::process::id().to_string()));
        drop(lock);
        assert!(!folder.path().join(NAME).exists());
        assert!(Lock::take(folder.path()).is_ok());
    }

    #[test]
    fn what_a_dead_process_left_is_told_and_taken_over() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(NAME), "process 1, since long ago\n").unwrap();
        let lock = Lock::take(folder.path()).unwrap();
        assert_eq!(lock.stale.as_deref(), Some("process 1, since long ago"));
        let text = fs::read_to_string(folder.path().join(NAME)).unwrap();
        assert!(text.contains(&std::process::id().to_string()));
    }
}
