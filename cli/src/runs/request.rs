//! What every command that runs a scene is asked for, and its way from the scene to the result: [`Request`].

use super::resolved::Resolved;
use super::{OutputPlan, Plan, RunFolder, Simulation, Start, drive, resume_line};
use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::machine;
use crate::run::{Outcome, Run};
use crate::scene::Scene;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Arguments that all solvers have.
#[derive(Debug, clap::Args)]
pub(crate) struct Request {
    /// Scene to read
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// Folder for the run; made if its parent exists
    #[arg(short, long, value_name = "DIR", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// Put a value in the place of that of the scene, such as time.step=0.02; may be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Go on with the run in DIR
    #[arg(long)]
    resume: bool,
    /// Write nothing; tell the scene with every value that holds, and as comments every key without one
    #[arg(long)]
    dry_run: bool,
}

/// A scene as it was read, for a solver.
pub(crate) struct ToRun {
    /// The name of the solver.
    pub(crate) solver: &'static str,
    /// The scene with every value that holds.
    pub(crate) scene: Resolved,
    /// Of the whole scene.
    pub(crate) steps: u64,
    pub(crate) output: OutputPlan,
}

/// A run whose folder is open.
pub(crate) struct Begun<'r> {
    request: &'r Request,
    output: &'r Path,
    to_run: ToRun,
    pub(crate) folder: RunFolder,
    pub(crate) seconds: Seconds,
}

impl Request {
    /// The scene with the values that were put in.
    pub(crate) fn read(&self) -> Result<Scene, Box<Failure>> {
        Scene::read(&self.scene)?.set(&self.set)
    }

    /// Opens the folder. None if only the scene was asked for: it is told then.
    pub(crate) fn begin(&self, to_run: ToRun, run: &Run) -> Result<Option<Begun<'_>>, Box<Failure>> {
        let console = &run.console;
        let (false, Some(output)) = (self.dry_run, &self.output) else {
            console.result(&to_run.scene.to_toml_with_absent_keys())?;
            console.object(
                &json!({ "input": shown(&self.scene), "steps": to_run.steps, "scene": to_run.scene.to_json() }),
            )?;
            return Ok(None);
        };
        if self.resume && run.force {
            return Err(Failure::new(Code::Usage, "--resume goes on with a run, --force replaces it")
                .help("give one of them"));
        }
        let start = if self.resume { Start::Resume } else { Start::Anew(run.force) };
        let folder = RunFolder::open(output, start, to_run.solver, &to_run.scene.to_toml(), run)?;
        Ok(Some(Begun { request: self, output, to_run, folder, seconds: Seconds::default() }))
    }
}

impl Begun<'_> {
    /// What the run is called in its report.
    pub(crate) fn title(&self) -> String {
        self.request.scene.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    }

    pub(crate) fn output(&self) -> &Path {
        self.output
    }

    /// Steps until the step `last` or the end of the scene, and tells the result; `in_words` of the scene, the folder and the result is
    /// what people read.
    pub(crate) fn finish(
        mut self,
        simulation: &mut impl Simulation,
        last: u64,
        in_words: fn(&Path, &Path, &Map<String, Value>) -> String,
        run: &Run,
    ) -> Outcome {
        let (scene, output) = (&self.request.scene, self.output);
        let solver = self.to_run.solver;
        let plan = Plan {
            solver,
            resume: resume_line(solver, scene, output, &self.request.set, run.seed),
            scene: self.to_run.scene,
            steps: self.to_run.steps,
            last,
            output: self.to_run.output,
        };
        let mut object = drive(simulation, &plan, &mut self.folder, run, &mut self.seconds)?;
        drop(self.folder);
        run.console.result(&in_words(scene, output, &object))?;
        object.insert("input".into(), json!(shown(scene)));
        object.insert("output".into(), json!(shown(output)));
        object.insert("peak_rss_bytes".into(), json!(machine::peak_memory()));
        run.console.object(&Value::Object(object))?;
        Ok(0)
    }
}
