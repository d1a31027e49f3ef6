//! Runs the command in a folder of its own and looks at what it did.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A tetrahedron as OBJ.
pub(crate) const TETRAHEDRON: &str = "\
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
";

/// A folder that goes away with the test.
pub(crate) struct Bench {
    folder: TempDir,
}

/// What one run of the command gave.
pub(crate) struct Ran {
    pub(crate) exit: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file.
    pub(crate) fn file(&self, name: &str, content: impl AsRef<[u8]>) -> &Self {
        std::fs::write(self.path(name), content).unwrap();
        self
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    pub(crate) fn exists(&self, name: &str) -> bool {
        self.path(name).exists()
    }

    /// Every name in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The command, in this folder, with nothing on standard input and no terminal settings of the caller.
    pub(crate) fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_welter"));
        command
            .args(args)
            .current_dir(self.folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .env("TMPDIR", self.folder.path())
            .env_remove("NO_COLOR");
        command
    }

    /// Waits until a command that runs has begun to write, so that there are more than `before` files, and interrupts it.
    pub(crate) fn interrupt_writing(&self, child: Child, before: usize) -> Ran {
        let start = Instant::now();
        while self.names().len() <= before {
            assert!(start.elapsed() < Duration::from_secs(60), "the temporary file never came");
            std::thread::sleep(Duration::from_millis(5));
        }
        let kill = format!("kill -INT {}", child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
        let ran = Ran::of(child.wait_with_output().unwrap());
        assert_eq!(ran.exit, Some(130), "{}", ran.err);
        ran
    }

    /// Runs the command with words separated by spaces.
    pub(crate) fn run(&self, line: &str) -> Ran {
        self.run_args(&line.split(' ').collect::<Vec<_>>())
    }

    pub(crate) fn run_args(&self, args: &[&str]) -> Ran {
        Ran::of(self.command(args).output().unwrap())
    }

    /// Runs with `--json`; gives the object and the rest.
    pub(crate) fn json(&self, line: &str) -> (Value, Ran) {
        let ran = self.run(&format!("{line} --json"));
        let object: Value = serde_json::from_str(&ran.out)
            .unwrap_or_else(|error| panic!("{error} in {:?}\n{}", ran.out, ran.err));
        assert!(object.is_object());
        (object, ran)
    }

    /// Runs a command that must fail, with and without `--json`: the exit code, and every part of the error in both
    /// forms. Gives the JSON form of the error.
    #[track_caller]
    pub(crate) fn fails(&self, line: &str, code: &str, exit: i32) -> Value {
        let plain = self.run(line);
        assert_eq!(plain.exit, Some(exit), "{line}: {}{}", plain.err, plain.out);
        assert!(plain.err.contains(&format!("error[{code}]: ")), "{line}: {}", plain.err);
        for part in ["  why:   ", "  help:  "] {
            assert!(plain.err.contains(part), "{line}: no {part} in {}", plain.err);
        }
        assert!(!plain.err.contains("panicked"), "{line}: {}", plain.err);
        let (object, ran) = self.json(line);
        assert_eq!(ran.exit, Some(exit), "{line} --json: {}", ran.err);
        let error = &object["error"];
        assert_eq!(error["code"], code, "{line}: {object:#}");
        assert_eq!(error["exit"], exit);
        for key in ["what", "why", "help"] {
            assert!(error[key].as_str().is_some_and(|text| !text.is_empty()), "{line}: {key} in {error:#}");
        }
        error.clone()
    }
}

impl Ran {
    pub(crate) fn of(output: Output) -> Self {
        Self {
            exit: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    #[track_caller]
    pub(crate) fn ok(self) -> Self {
        assert_eq!(self.exit, Some(0), "{}{}", self.err, self.out);
        self
    }
}

/// Whether permissions bind this user: not the superuser, whom every file lets in.
pub(crate) fn permissions_bind(bench: &Bench) -> bool {
    use std::os::unix::fs::PermissionsExt;
    bench.file("locked", "x");
    let path = bench.path("locked");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o000)).unwrap();
    let binds = std::fs::read(&path).is_err();
    std::fs::remove_file(&path).unwrap();
    binds
}

/// The folder of real meshes, if it is there.
pub(crate) fn real_meshes() -> Option<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/meshes"));
    folder.is_dir().then(|| folder.to_owned())
}

/// The folder of public collision queries, if it is there.
pub(crate) fn public_queries() -> Option<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/ccd-queries"));
    folder.is_dir().then(|| folder.to_owned())
}
