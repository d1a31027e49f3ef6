//! One step of a run again, from the file of a step that failed or from a checkpoint.

use super::SOLVER;
use super::scene::TrackScene;
use super::simulation::Track;
use crate::codes::Code;
use crate::failure::Failure;
use crate::run::Run;
use crate::runs::failed_step::FailedStep;
use crate::runs::{Simulation, StepFailure, StepProblem};
use crate::scene::Scene;
use serde_json::{Map, Value};
use std::path::Path;
use welter_meshing::{Monitor, Progress};

/// What came of it.
pub(crate) enum Replayed {
    Completed(Map<String, Value>),
    Failed(Box<StepFailure>),
}

/// Runs the step after the state of a file.
pub(crate) fn replay(file: &Path, step: &FailedStep, run: &Run) -> Result<Replayed, Box<Failure>> {
    let refuse = |what: String| {
        Failure::new(Code::NoRunFile, what)
            .subject(file.display().to_string())
            .help("name a file of a run of welter track or welter sim")
    };
    let before = &step.before;
    if before.solver != SOLVER {
        return Err(refuse(format!(
            "the file is of welter {}, which this version does not have",
            before.solver
        )));
    }
    let scene = TrackScene::read_resolved(&Scene::of(file, before.scene.as_str()))?;
    let mut track = Track::resumed(&scene, String::new(), &before.state)
        .map_err(|error| refuse(format!("its state is none of a surface: {error}")))?;
    if before.step >= scene.time.steps {
        return Err(refuse(format!("it is of step {}, the last of its scene", before.step)));
    }
    replayed(&mut track, run)
}

/// What comes of the next step of a solver.
pub(crate) fn replayed(solver: &mut impl Simulation, run: &Run) -> Result<Replayed, Box<Failure>> {
    let report = |p: Progress| run.console.progress.report(p.stage, p.done, p.total);
    match solver.step(&Monitor::new(Some(&report), None)) {
        Ok(line) => Ok(Replayed::Completed(line)),
        Err(StepProblem::Failed(failed)) => Ok(Replayed::Failed(failed)),
        // Nobody can ask this monitor to stop.
        Err(StepProblem::Cancelled) => Err(Failure::new(Code::Interrupted, "the step was stopped")),
    }
}
