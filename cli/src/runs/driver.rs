//! The loop over the steps of a run: [`drive`].

use super::checkpoint::{self, Checkpoint};
use super::folder::sweep;
use super::record::{self, Record, Status};
use super::state::Writer;
use super::stats::{self, Stats};
use super::{PictureProblem, Plan, RunFolder, Simulation, StepFailure, StepProblem};
use super::{failed_step, frames, report};
use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::Failure;
use crate::interrupt::Asking;
use crate::run::Run;
use serde_json::{Map, Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use welter_meshing::Monitor;

/// Steps `simulation`, which is at the state of `folder.from` or at the initial one, to the end of the plan; gives the
/// result, as in `report.json`.
pub(crate) fn drive<S: Simulation>(
    simulation: &mut S,
    plan: &Plan,
    folder: &mut RunFolder,
    run: &Run,
    seconds: &mut Seconds,
) -> Result<Map<String, Value>, Box<Failure>> {
    let asking = Asking::begin();
    let path = folder.path().to_owned();
    let with_help = |mut failure: Box<Failure>| {
        if failure.code.exit() == Code::WriteFailed.exit() {
            failure.help = format!("{}; then: {}", failure.help, plan.resume);
        }
        failure
    };
    let mut driver = Driver::begin(simulation, plan, folder, run, seconds).map_err(|failure| {
        record::fail(&path);
        with_help(failure)
    })?;
    let outcome = driver.steps(&asking).map_err(with_help);
    let status = match &outcome {
        Ok(status) => *status,
        Err(failure) if failure.code == Code::Interrupted => Status::Interrupted,
        Err(_) => Status::Failed,
    };
    let told = driver.conclude(status, outcome.as_ref().err().map(AsRef::as_ref));
    // A failure of the run is worth more than one of its report.
    outcome?;
    told
}

struct Driver<'a, S> {
    simulation: &'a mut S,
    plan: &'a Plan,
    folder: &'a RunFolder,
    run: &'a Run,
    seconds: &'a mut Seconds,
    toml: String,
    record: Record,
    stats: Stats,
    step: u64,
    /// The time after the steps that are done.
    time: f64,
    /// The state after them.
    state: Writer,
}

impl<'a, S: Simulation> Driver<'a, S> {
    fn begin(
        simulation: &'a mut S,
        plan: &'a Plan,
        folder: &'a mut RunFolder,
        run: &'a Run,
        seconds: &'a mut Seconds,
    ) -> Result<Self, Box<Failure>> {
        let from = folder.from.take();
        let toml = plan.scene.to_toml();
        let record = Record::new(plan.solver, &plan.scene.to_json(), &toml);
        let (step, time) = from.as_ref().map_or((0, simulation.time()), |from| (from.step, from.time));
        folder.keep();
        sweep(folder.path());
        record.write(folder.path(), Status::Running, step, time)?;
        record::write_scene(folder.path(), &toml)?;
        record::log(folder.path(), &format!("process {} begins after step {step}", std::process::id()));
        frames::prepare(folder.path(), plan)?;
        failed_step::remove(folder.path());
        checkpoint::remove_after(folder.path(), from.as_ref().map(|from| from.step));
        let mut lines = stats::read(folder.path());
        lines.truncate(from.as_ref().map_or(0, |from| from.step as usize + 1));
        frames::remove_from(
            folder.path(),
            lines.iter().filter(|line| line.value["frame"].is_u64()).count() as u64,
        );
        let stats = Stats::open(folder.path(), lines)?;
        let state = Writer(from.as_ref().map_or_else(Vec::new, |from| from.state.clone()));
        let mut driver =
            Self { simulation, plan, folder, run, seconds, toml, record, stats, step, time, state };
        if from.is_none() {
            driver.save();
            let line = driver.simulation.initial();
            // The first frame is always made: there is nothing before it to go on from.
            driver.tell(line, &Monitor::none())?;
        }
        Ok(driver)
    }

    fn save(&mut self) {
        self.state.0.clear();
        self.simulation.save(&mut self.state);
    }

    fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            solver: self.plan.solver.to_owned(),
            step: self.step,
            time: self.time,
            scene: self.toml.clone(),
            state: self.state.0.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// Writes the line and the frame of the state that was reached; false if it was stopped before any of it was written.
    fn tell(&mut self, mut line: Map<String, Value>, monitor: &Monitor<'_>) -> Result<bool, Box<Failure>> {
        line.insert("step".into(), json!(self.step));
        line.insert("time".into(), json!(self.time));
        let number = self.plan.frame_of(self.step);
        if let Some(number) = number {
            match self.simulation.pictures(number, monitor) {
                Ok(mut pictures) => {
                    let names = frames::write_pictures(self.folder.path(), &pictures, number)?;
                    if !pictures.told.is_empty() {
                        pictures.told.insert("files".into(), json!(names));
                        line.insert("pictures".into(), Value::Object(pictures.told));
                    }
                    if !pictures.seconds.is_empty() {
                        let seconds = line.entry("seconds").or_insert_with(|| json!({}));
                        seconds["rendering"] = Value::Object(pictures.seconds);
                    }
                }
                Err(PictureProblem::Cancelled) => return Ok(false),
                Err(PictureProblem::Failed(failure)) => return Err(failure),
            }
            let frame = self.simulation.frame();
            frames::write(self.folder.path(), &frame, number, self.plan, self.run, self.seconds)?;
            line.insert("frame".into(), json!(number));
        }
        self.stats.push(line)?;
        Ok(true)
    }

    /// Steps to the end, or until asked to stop.
    fn steps(&mut self, asking: &Asking) -> Result<Status, Box<Failure>> {
        let monitor = Monitor::new(None, Some(asking.flag()));
        let last = self.plan.last.min(self.plan.steps);
        while self.step < last {
            if monitor.is_cancelled() {
                return Err(self.interrupted());
            }
            self.run.console.progress.report("steps", self.step, last);
            let done = catch_unwind(AssertUnwindSafe(|| self.simulation.step(&monitor)));
            let line = match done {
                Ok(Ok(line)) => line,
                Ok(Err(StepProblem::Cancelled)) => return Err(self.interrupted()),
                Ok(Err(StepProblem::Failed(failed))) => return Err(self.failed(&failed)),
                Err(panic) => {
                    self.panicked();
                    resume_unwind(panic);
                }
            };
            let before = (self.step, self.time);
            (self.step, self.time) = (self.step + 1, self.simulation.time());
            if !self.tell(line, &monitor)? {
                // The step is done again when the run goes on: the state that is kept is the one before it.
                (self.step, self.time) = before;
                return Err(self.interrupted());
            }
            self.save();
            if self.step.is_multiple_of(self.plan.output.checkpoint_every) || self.step == last {
                self.write_checkpoint()?;
            }
        }
        Ok(if self.step < self.plan.steps { Status::Stopped } else { Status::Finished })
    }

    /// Statistics and frames first: a checkpoint says that they are there up to it.
    fn write_checkpoint(&mut self) -> Result<(), Box<Failure>> {
        self.stats.sync()?;
        self.checkpoint().write(self.folder.path())?;
        self.write_list()?;
        self.record.write(self.folder.path(), Status::Running, self.step, self.time)
    }

    fn write_list(&self) -> Result<(), Box<Failure>> {
        let lines = self.stats.lines().iter().filter(|line| line.value["frame"].is_u64());
        let times: Vec<f64> = lines.filter_map(|line| line.value["time"].as_f64()).collect();
        frames::write_list(self.folder.path(), &times)
    }

    fn interrupted(&mut self) -> Box<Failure> {
        if let Err(failure) = self.write_checkpoint() {
            return failure;
        }
        Failure::new(Code::Interrupted, "interrupted")
            .subject(self.folder.path().display().to_string())
            .place(format!("checkpoint after step {} of {}", self.step, self.plan.steps))
            .why("the run is not finished; what was reached is kept")
            .help(self.plan.resume.clone())
    }

    /// Keeps the state before the step that failed.
    fn failed(&mut self, failed: &StepFailure) -> Box<Failure> {
        let before = self.checkpoint();
        let kept = self.write_checkpoint().and_then(|()| {
            let replay = failed_step::write(self.folder.path(), &before, &failed.to_json())?;
            let mesh = self.simulation.mesh_of(&before.state).ok_or_else(|| {
                Failure::new(Code::OwnBug, "the state that was saved before the step cannot be read back")
            })?;
            let surface = failed_step::write_surface_before(self.folder.path(), &mesh)?;
            Ok((replay, surface))
        });
        match kept {
            Ok((replay, surface)) => failed_step::tell(failed, self.step + 1, &replay, &surface),
            Err(failure) => {
                failure.place(format!("while step {} failed: {}", self.step + 1, failed.failure.what))
            }
        }
    }

    /// Keeps what it can of a step that broke a rule of the program.
    fn panicked(&mut self) {
        let details =
            json!({ "error": { "code": Code::OwnBug.id() }, "stage": "unknown", "details": Value::Null });
        if let Ok(replay) = failed_step::write(self.folder.path(), &self.checkpoint(), &details) {
            self.run.console.note(&format!("welter replay {}   # runs the step alone", replay.display()));
        }
        let _ = self.write_checkpoint();
        let _ = self.record.write(self.folder.path(), Status::Failed, self.step, self.time);
        record::log(self.folder.path(), &format!("step {} broke a rule of the program", self.step + 1));
    }

    fn conclude(
        &mut self,
        status: Status,
        failure: Option<&Failure>,
    ) -> Result<Map<String, Value>, Box<Failure>> {
        self.run.console.progress.clear();
        let text = failure.map_or_else(String::new, |failure| format!("\n{}", failure.to_text(false)));
        record::log(self.folder.path(), &format!("{} after step {}{text}", status.name(), self.step));
        let lines: Vec<&Value> = self.stats.lines().iter().map(|line| &line.value).collect();
        let mut result = self.simulation.conclude(&lines, status == Status::Finished);
        result.insert("status".into(), json!(status.name()));
        let reported = self
            .stats
            .sync()
            .and_then(|()| self.write_list())
            .and_then(|()| report::write(self.folder.path(), self.plan.solver, status, &result, &lines));
        self.record.write(self.folder.path(), status, self.step, self.time)?;
        reported.map(|()| result)
    }
}
