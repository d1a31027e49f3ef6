//! What every solver over time runs in: [`drive`] steps a [`Simulation`] and keeps its folder.
//!
//! Promises: files are written whole or not at all. A run that was interrupted, killed or failed goes on from the newest whole checkpoint
//! of the same scene, and then every file has the bytes of a run that was never stopped, apart from times of the clock and from which
//! checkpoints are kept. A step that fails leaves the state before it as a checkpoint, and as a file that can be run alone.
//!
//! Does not promise: the same bits from another version of the program.
//!
//! Map: a [`request`] is what a command is asked for; [`settings`] reads scenes and [`resolved`] writes them; [`folder`] is found or made under its [`lock`]; [`driver`] is the loop;
//! [`frames`], [`stats`], [`checkpoint`] and [`record`] are what it writes, [`report`] is made of that in the end, and of a [`past`] run again; [`container`] is the file
//! format of checkpoints and of failed steps ([`failed_step`]), [`state`] that of the numbers within; [`words`] is for
//! people.

pub(crate) mod checkpoint;
mod container;
mod driver;
pub(crate) mod failed_step;
mod folder;
mod frames;
mod lock;
mod past;
mod record;
mod report;
mod request;
pub(crate) mod resolved;
pub(crate) mod settings;
pub(crate) mod state;
mod stats;
#[cfg(test)]
mod tests;
mod words;

pub(crate) use driver::drive;
pub(crate) use failed_step::StepFailure;
pub(crate) use folder::{RunFolder, Start};
pub(crate) use past::PastRun;
pub(crate) use request::{Request, ToRun};
pub(crate) use stats::phase_seconds;
pub(crate) use words::{Words, resume_line};

use crate::failure::Failure;
use crate::numbers::{grouped, number};
use crate::render::Camera;
use resolved::Resolved;
use serde_json::{Map, Value};
use state::Writer;
use welter_meshing::Monitor;
use welter_meshing::surface::TriMesh;

/// A solver over time.
pub(crate) trait Simulation {
    /// Goes on by a step, which keeps to what [`save`](Self::save) wrote before it: the same bytes give the same step. Gives what is to be
    /// told of it. After an error the state is not used again.
    fn step(&mut self, monitor: &Monitor<'_>) -> Result<Map<String, Value>, StepProblem>;

    /// What is to be told of the state before the first step.
    fn initial(&self) -> Map<String, Value>;

    fn time(&self) -> f64;

    fn frame(&self) -> Frame;

    /// Pictures that the solver makes of a frame by itself, beside that of its surface. None if it makes none.
    fn pictures(&self, _number: u64, _monitor: &Monitor<'_>) -> Result<Pictures, PictureProblem> {
        Ok(Pictures::default())
    }

    /// Everything that later steps depend on, in bits.
    fn save(&self, state: &mut Writer);

    /// The surface of a state that [`save`](Self::save) wrote.
    fn mesh_of(&self, state: &[u8]) -> Option<TriMesh>;

    /// The result, from what was told of all steps; `complete` once the last step of the scene is done.
    fn conclude(&self, lines: &[&Value], complete: bool) -> Map<String, Value>;
}

/// Why there is no step.
#[derive(Debug)]
pub(crate) enum StepProblem {
    /// The monitor asked to stop.
    Cancelled,
    Failed(Box<StepFailure>),
}

/// Pictures of a frame, and what is to be told of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pictures {
    /// What each shows, one of those that [`frames`] knows, and the bytes of its file.
    pub(crate) files: Vec<(&'static str, Vec<u8>)>,
    /// The same in every run.
    pub(crate) told: Map<String, Value>,
    /// Times of the clock.
    pub(crate) seconds: Map<String, Value>,
}

/// Why there are no pictures.
#[derive(Debug)]
pub(crate) enum PictureProblem {
    /// The monitor asked to stop.
    Cancelled,
    Failed(Box<Failure>),
}

/// What a state looks like.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) mesh: TriMesh,
    /// Numbers at the vertices, with their names.
    pub(crate) arrays: Vec<(&'static str, Vec<f64>)>,
    /// Text of the picture.
    pub(crate) title: String,
    pub(crate) caption: Vec<String>,
}

impl Frame {
    /// A surface at a time.
    pub(crate) fn of(mesh: TriMesh, arrays: Vec<(&'static str, Vec<f64>)>, title: &str, time: f64) -> Self {
        let triangles = grouped(mesh.triangles().len() as u64);
        let caption = vec![format!("time {}", number(time)), format!("{triangles} triangles")];
        Self { mesh, arrays, title: title.to_owned(), caption }
    }
}

/// What is to be done with a simulation.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The command, and name of the solver.
    pub(crate) solver: &'static str,
    /// The command line that goes on with the run.
    pub(crate) resume: String,
    pub(crate) scene: Resolved,
    /// Steps of the whole scene.
    pub(crate) steps: u64,
    /// Where to stop, before the last step or at it.
    pub(crate) last: u64,
    pub(crate) output: OutputPlan,
}

/// What is written while a run goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutputPlan {
    /// Steps from frame to frame; the last step has one too.
    pub(crate) every: u64,
    /// Steps from checkpoint to checkpoint; the last step has one too.
    pub(crate) checkpoint_every: u64,
    /// Width and height of a picture of each frame.
    pub(crate) pictures: Option<[u32; 2]>,
    pub(crate) camera: Option<Camera>,
    /// Whether the solver makes pictures by itself.
    pub(crate) volume: bool,
}

impl Plan {
    /// The number of the frame that a step has, if it has one.
    fn frame_of(&self, step: u64) -> Option<u64> {
        let has_one = step.is_multiple_of(self.output.every) || step == self.steps;
        has_one.then(|| step.div_ceil(self.output.every))
    }
}
