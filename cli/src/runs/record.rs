//! What a run folder says of itself: `run.json`, `scene.toml`, `log.txt`.

use crate::clock;
use crate::failure::Failure;
use crate::output::write_whole;
use serde_json::{Map, Value, json};
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;

/// The record.
pub(super) const NAME: &str = "run.json";
/// The resolved scene.
pub(super) const SCENE: &str = "scene.toml";
/// What was told, with times.
pub(super) const LOG: &str = "log.txt";

/// What `run.json` says of its maker; only a folder that has it is a run.
const MAKER: &str = "welter run";

/// How a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    Running,
    /// To the end of the scene.
    Finished,
    /// Stopped where the command line asked for it, before the end of the scene.
    Stopped,
    Interrupted,
    Failed,
}

impl Status {
    const ALL: [Self; 5] = [Self::Running, Self::Finished, Self::Stopped, Self::Interrupted, Self::Failed];

    /// By its name.
    pub(crate) fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Finished => "finished",
            Self::Stopped => "stopped",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
        }
    }
}

/// The record of a run, if a folder has one.
pub(crate) fn read(folder: &Path) -> Option<Value> {
    let bytes = fs::read(folder.join(NAME)).ok()?;
    serde_json::from_slice::<Value>(&bytes).ok().filter(|record| record["maker"] == MAKER)
}

/// A name of the scene in 64 bits: FNV-1a of its text.
pub(crate) fn scene_hash(scene: &str) -> String {
    let hash = scene.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("fnv1a64:{hash:016x}")
}

/// What stays the same while a run goes on.
#[derive(Clone, Debug)]
pub(super) struct Record {
    fixed: Map<String, Value>,
}

impl Record {
    pub(super) fn new(solver: &str, scene: &Value, toml: &str) -> Self {
        let command: Vec<String> =
            std::env::args_os().map(|arg| arg.to_string_lossy().into_owned()).collect();
        let fixed = json!({
            "maker": MAKER,
            "solver": solver,
            "version": env!("CARGO_PKG_VERSION"),
            "command": command,
            "scene": scene,
            "scene_hash": scene_hash(toml),
            "started": clock::now(),
        });
        let Value::Object(fixed) = fixed else { unreachable!("an object was written") };
        Self { fixed }
    }

    pub(super) fn write(
        &self,
        folder: &Path,
        status: Status,
        step: u64,
        time: f64,
    ) -> Result<(), Box<Failure>> {
        let mut record = self.fixed.clone();
        record.insert("status".into(), json!(status.name()));
        record.insert("steps".into(), json!(step));
        record.insert("time".into(), json!(time));
        record.insert("updated".into(), json!(clock::now()));
        write_whole(&folder.join(NAME), |file| writeln!(file, "{:#}", Value::Object(record)))
    }
}

/// Notes that a run failed before its first step; where that cannot be written it stays as it was.
pub(super) fn fail(folder: &Path) {
    if let Some(Value::Object(mut record)) = read(folder) {
        record.insert("status".into(), json!(Status::Failed.name()));
        let _ = write_whole(&folder.join(NAME), |file| writeln!(file, "{:#}", Value::Object(record)));
    }
}

pub(super) fn write_scene(folder: &Path, toml: &str) -> Result<(), Box<Failure>> {
    write_whole(&folder.join(SCENE), |file| file.write_all(toml.as_bytes()))
}

/// Adds a line to the log; a log that cannot be written stops nothing.
pub(super) fn log(folder: &Path, text: &str) {
    if let Ok(mut file) = OpenOptions::new().append(true).create(true).open(folder.join(LOG)) {
        let _ = writeln!(file, "{} {}", clock::now(), text.trim_end().replace('\n', "\n    "));
    }
}
