//! `welter track`: moves a surface through a scene, and keeps it from intersecting itself.

mod exact;
mod flow;
mod replay;
mod report;
mod scene;
mod simulation;
mod step_failure;
mod summary;
mod surface;

pub(crate) use replay::{Replayed, replay, replayed};
pub(crate) use report::report;
pub(crate) use scene::{TimeSpec, read_improvement, read_integration, read_output, read_time, read_topology};
pub(crate) use step_failure::tracker_failure;
pub(crate) use surface::SurfaceSpec;

use crate::codes::Code;
use crate::failure::{Failure, shown};
use crate::run::{Outcome, Run};
use crate::runs::{Request, ToRun, Words};
use exact::ExactError;
use scene::TrackScene;
use serde_json::{Map, Value};
use simulation::Track;
use std::path::Path;

/// The name of the solver, in run folders.
pub(crate) const SOLVER: &str = "track";

/// Move a surface through a scene, and keep it from intersecting itself
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A scene (TOML) has the tables [surface], [flow] and [time]:

  exact = \"initial\"            # what is known of the end: none, initial, offset (of spheres)
  [surface]
  shape = \"sphere\"             # welter shape --list, or \"sheet\"; or: file = \"part.ply\"
  scale = 0.15
  translate = [0.35, 0.35, 0.35]
  edge_length = 0.02
  [flow]
  kind = \"enright\"
  [time]
  step = 0.02
  end = 3                      # or: steps = 150

Several shapes: [[surface.parts]] with shape or file, scale, translate.
Kinds of [flow] and their keys:
  enright         period, size                     rotation   center, angular_velocity
  curl-noise      seed, wavelength, speed,         shear      center, direction, gradient
                  period, octaves, gain, waves, potential = \"spatial\" | \"planar\"
  (of these: scheme = \"rk4\" | \"euler\", origin; mean-curvature has a scheme too)
  normal          speed, or schedule = [[time, speed], ...]; front = \"entropy\" | \"sharp\"
  mean-curvature  speed, safety, stiffness         jitter     amplitude_rel, seed
[output]: every, checkpoint_every, check_every (steps), pictures = true, size = [800, 600]
[improvement], [topology], [integration]: `--dry-run` tells every key with its default.

DIR gets surface/frame_0000.ply and so on, paraview/surface.pvd, stats.jsonl (a line a step), report.html,
run.json, and checkpoints: Ctrl-C stops, --resume goes on with the same bits as if nothing had happened.

Examples:
  welter track examples/track/enright.toml -o enright
  welter track examples/track/enright.toml -o fine --set surface.edge_length=0.01 --set time.step=0.01
  welter track examples/track/enright.toml -o enright --resume")]
pub(crate) struct Args {
    #[command(flatten)]
    request: Request,
    /// Stop after this step of the scene; --resume goes on
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let (request, console) = (&args.request, &run.console);
    let (scene, resolved) = TrackScene::read(&request.read()?, run.seed)?;
    scene.surface.require_memory(&request.scene)?;
    let to_run = ToRun { solver: SOLVER, scene: resolved, steps: scene.time.steps, output: scene.output };
    let Some(mut begun) = request.begin(to_run, run)? else { return Ok(0) };
    let title = begun.title();
    let mut track = match &begun.folder.from {
        Some(from) => Track::resumed(&scene, title, &from.state).map_err(|error| {
            Failure::new(Code::OwnBug, format!("a whole checkpoint cannot be gone on from: {error}"))
                .subject(shown(begun.output()))
        })?,
        None => {
            let build = || scene.surface.build(&console.progress);
            let mesh = console.stage(&mut begun.seconds, "building", build)?;
            Track::new(&scene, title, &mesh)?
        }
    };
    begun.finish(&mut track, args.steps.unwrap_or(u64::MAX), in_words, run)
}

/// The result for people.
fn in_words(scene: &Path, output: &Path, result: &Map<String, Value>) -> String {
    let mut words = Words::of(scene, result, &["steps"]);
    let triangles = ["initial", "final", "min", "max"].map(|key| words.count(&format!("/triangles/{key}")));
    let [initial, last, min, max] = triangles;
    words.row("triangles", &format!("{initial} at the beginning, {last} at the end, {min} to {max} between"));
    if let (Some(before), Some(after)) = (words.number("/volume/initial"), words.number("/volume/final")) {
        let relative = words
            .number("/volume/relative_error")
            .map_or(String::new(), |r| format!(" (relative change {r})"));
        words.row("volume", &format!("{before} to {after}{relative}"));
    }
    words.row("components", &words.count("/components"));
    words.counts("operations", "/operations", &OPERATIONS.map(|name| (name, name)));
    let zones = [("impulses", "impulses"), ("impact_zones", "impact zones"), ("rigid_zones", "rigid zones")];
    words.counts("collisions", "/collisions", &zones);
    let [most, checked] = ["max", "checked_steps"].map(|key| words.count(&format!("/intersections/{key}")));
    words.row(
        "intersections",
        &format!("{most} pairs of triangles at most, in {checked} steps checked on their own"),
    );
    if let Some(seconds) = words.number("/seconds_per_step/total") {
        words.row("seconds a step", &seconds);
    }
    if result["error"].is_object() {
        words.row("error", &ExactError::in_words(&result["error"]));
    }
    words.end(output)
}

/// What is told of changes of the surface.
const OPERATIONS: [&str; 5] = ["splits", "flips", "collapses", "merges", "separations"];
