//! A bug of this program: what panicked is caught, and a file is written with which it can be reproduced.

use crate::codes::Code;
use crate::failure::{Failure, shell_word, shown};
use serde_json::{Value, json};
use std::backtrace::Backtrace;
use std::ffi::OsString;
use std::fs::File;
use std::io::{Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What the first panic said.
static FIRST: Mutex<Option<Value>> = Mutex::new(None);

/// Runs `work`; a panic in it becomes a failure that names the file written.
pub(crate) fn guard<T>(
    args: &[OsString],
    work: impl FnOnce() -> Result<T, Box<Failure>>,
) -> Result<T, Box<Failure>> {
    set_hook(Box::new(|info| {
        let said = info.payload();
        let said = said
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| said.downcast_ref::<String>().map(String::as_str));
        let message = said.unwrap_or("a panic without a message").to_owned();
        let place = info.location().map(|at| format!("{}:{}:{}", at.file(), at.line(), at.column()));
        let mut first = FIRST.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert_with(|| {
            json!({ "message": message, "place": place, "backtrace": Backtrace::force_capture().to_string() })
        });
    }));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err(failure(args)))
}

fn failure(args: &[OsString]) -> Box<Failure> {
    let panic = FIRST.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or(Value::Null);
    let text = |key: &str| panic[key].as_str().unwrap_or("unknown").to_owned();
    let failure =
        Failure::new(Code::OwnBug, format!("a bug of welter: {}", text("message"))).place(text("place"));
    match write_record(args, &panic) {
        Ok(path) => failure
            .place(format!("record {}", path.display()))
            .help(format!("send {} and the files it lists to the authors", shell_word(&path))),
        Err(error) => failure.help(format!("tell the authors the command line (no record: {error})")),
    }
}

/// Command line, folder, version, and each file named on the command line with its size and checksum.
fn write_record(args: &[OsString], panic: &Value) -> std::io::Result<PathBuf> {
    let files: Vec<Value> = args.iter().filter_map(|arg| describe(Path::new(arg))).collect();
    let record = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "system": format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        "command": args.iter().map(|arg| arg.to_string_lossy()).collect::<Vec<_>>(),
        "folder": std::env::current_dir().ok().map(|folder| shown(&folder)),
        "files": files,
        "panic": panic,
    });
    for attempt in 0.. {
        let name = format!("welter-bug-{}-{attempt}.json", std::process::id());
        let path = std::env::temp_dir().join(name);
        match File::create_new(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists && attempt < 100 => {}
            Err(error) => return Err(error),
            Ok(mut file) => {
                writeln!(file, "{record:#}")?;
                return Ok(path);
            }
        }
    }
    Err(std::io::ErrorKind::AlreadyExists.into())
}

fn describe(path: &Path) -> Option<Value> {
    let file = File::open(path).ok()?;
    let meta = file.metadata().ok()?;
    if !meta.is_file() {
        return None;
    }
    // FNV-1a, 64 bits: enough to tell whether the file at hand is the one that was read.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut reader = std::io::BufReader::new(file);
    let mut buffer = [0; 1 << 16];
    loop {
        match reader.read(&mut buffer).ok()? {
            0 => break,
            n => {
                for &byte in &buffer[..n] {
                    hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
                }
            }
        }
    }
    let full = std::fs::canonicalize(path).ok()?;
    Some(json!({ "file": shown(&full), "bytes": meta.len(), "fnv1a64": format!("{hash:016x}") }))
}
