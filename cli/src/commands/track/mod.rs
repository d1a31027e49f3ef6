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
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::machine;
use crate::run::{Outcome, Run};
use crate::runs::{Plan, RunFolder, Start, Words, drive, resume_line};
use crate::scene::Scene;
use exact::ExactError;
use scene::TrackScene;
use serde_json::{Map, Value, json};
use simulation::Track;
use std::path::{Path, PathBuf};

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
    /// Scene to read
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Folder for the run; made if its parent exists
    #[arg(short, long, value_name = "DIR", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// Put a value in the place of that of the scene, such as flow.period=2; may be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Stop after this step of the scene; --resume goes on
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
    /// Go on with the run in DIR
    #[arg(long)]
    resume: bool,
    /// Write nothing; tell the scene with every value that holds
    #[arg(long)]
    dry_run: bool,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let mut seconds = Seconds::default();
    let file = Scene::read(&args.scene)?.set(&args.set)?;
    let (scene, resolved) = TrackScene::read(&file, run.seed)?;
    scene.surface.require_memory(&args.scene)?;
    let (false, Some(output)) = (args.dry_run, &args.output) else {
        console.result(&resolved.to_toml())?;
        console.object(
            &json!({ "input": shown(&args.scene), "steps": scene.time.steps, "scene": resolved.to_json() }),
        )?;
        return Ok(0);
    };
    if args.resume && run.force {
        return Err(Failure::new(Code::Usage, "--resume goes on with a run, --force replaces it")
            .help("give one of them"));
    }
    let start = if args.resume { Start::Resume } else { Start::Anew(run.force) };
    let mut folder = RunFolder::open(output, start, SOLVER, &resolved.to_toml(), run)?;
    let title = args.scene.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let mut track = match &folder.from {
        Some(from) => Track::resumed(&scene, title, &from.state).map_err(|error| {
            Failure::new(Code::OwnBug, format!("a whole checkpoint cannot be gone on from: {error}"))
                .subject(shown(output))
        })?,
        None => {
            let mesh = console.stage(&mut seconds, "building", || scene.surface.build(&console.progress))?;
            Track::new(&scene, title, &mesh)?
        }
    };
    let plan = Plan {
        solver: SOLVER,
        resume: resume_line(SOLVER, &args.scene, output, &args.set, run.seed),
        scene: resolved,
        steps: scene.time.steps,
        last: args.steps.unwrap_or(u64::MAX),
        output: scene.output,
    };
    let mut object = drive(&mut track, &plan, &mut folder, run, &mut seconds)?;
    drop(folder);
    console.result(&in_words(&args.scene, output, &object))?;
    object.insert("input".into(), json!(shown(&args.scene)));
    object.insert("output".into(), json!(shown(output)));
    object.insert("peak_rss_bytes".into(), json!(machine::peak_memory()));
    console.object(&Value::Object(object))?;
    Ok(0)
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
