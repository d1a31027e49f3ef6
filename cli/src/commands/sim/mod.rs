//! `welter sim`: smoke that is released over time and carried by a flow.

mod bounds;
mod flows;
mod frames;
mod rendering;
mod report;
mod scene;
mod simulation;
mod solid_surfaces;
mod solids;
mod summary;

use crate::codes::Code;
use crate::commands::track::{Replayed, replayed};
use crate::console::Seconds;
use crate::failure::{Failure, shell_word, shown};
use crate::machine;
use crate::run::{Outcome, Run};
use crate::runs::failed_step::FailedStep;
use crate::runs::{Plan, RunFolder, Start, Words, drive, resume_line};
use crate::scene::Scene;
use frames::FrameRange;
pub(crate) use report::report;
use scene::SimScene;
use serde_json::{Map, Value, json};
use simulation::Smoke;
use std::path::{Path, PathBuf};

/// The name of the solver, in run folders.
pub(crate) const SOLVER: &str = "sim";

/// Release smoke over time, and carry it with a flow
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A scene (TOML) has the tables [[emissions]], [[flows]] and [time]:

  [[emissions]]
  shape = \"sphere\"             # welter shape --list, or \"sheet\"; or: file = \"puff.ply\"
  scale = 0.3
  edge_length = 0.08
  interval = 0.25              # from release to release; and: start, count, path = [[time, x, y, z], ...]
  [[flows]]
  kind = \"ring\"
  center = [0, 0, 0.3]
  radius = 0.6
  [time]
  step = 0.04
  end = 4                      # or: steps = 100

Kinds of [[flows]] and their keys:
  ring        center, axis, radius, core, circulation       wind      velocity, origin
  filament    vertices, closed, core, circulation           source    center, radius, expansion, extent,
  curl-noise  seed, wavelength, speed, period, octaves,               [flows.noise]
              gain, waves, potential = \"spatial\" | \"planar\"
  (of all: amplitude, or amplitude_keys = [[time, amplitude], ...], or [flows.pulse] start, rise, top, fall, period;
  path = [[time, x, y, z], ...])
[[solids]], which all flows but sources go around: kind = \"ball\", \"box\", \"torus\", \"capsule\", \"cylinder\",
  \"half-space\" with its keys, ramp_width, anchor, path; in pictures drawn = true, albedo
[smoke]: scheme, most_triangles, over_budget = \"coarsen\" | \"stop-splitting\", coarsening
[improvement], [topology], [integration] (collisions): each has enabled; `--dry-run` tells every key
[output]: every, checkpoint_every (steps), pictures = true, size = [800, 600]

Pictures of the smoke as a volume, lit and shadowed, of every frame:
  [render]
  extinction = 12.0            # one over the length after which 1/e of the light is left
  size = [960, 540]            # and: first_frame, last_frame, every_frame, albedo, background, interior, shadow_resolution, ...
  layer_thickness = 0.2        # of open sheets, which are drawn as layers; along layer_direction, or against the normals
  [render.camera]              # the same in all frames: eye and target; or azimuth, elevation, fill around box = [[...], [...]],
  azimuth = 30.0               #   without which all emissions, flows and solids are in the picture; up, field_of_view
  [render.light]               # direction (the way it travels), radiance, ambient
  [render.age_blur]            # spread_rel, most_rel: old smoke is soft
  [render.planes]              # alpha, scatter, age, backdrop, composite: each [], [\"png\"], [\"exr\"] or both
  composite = [\"png\", \"exr\"]  # PNG: sRGB, clipped to 0..1 (png_colors = \"8-bit\" | \"16-bit\"); EXR: linear (exr_numbers)
In PNG, alpha, scatter and age are 16 bits of grey: 1 is white, and of ages age_white, the end of the scene by default.

DIR gets surface/frame_0000.ply and so on, paraview/surface.pvd (with ages), stats.jsonl (a line a step), report.html,
volume/composite_0000.png, volume/planes_0000.exr, run.json, and checkpoints: Ctrl-C stops, --resume goes on with the same bits as if nothing had happened.

Examples:
  welter sim examples/sim/plume.toml -o plume
  welter sim examples/sim/plume.toml -o plume --frames ..10
  welter sim examples/sim/plume.toml -o plume --resume")]
pub(crate) struct Args {
    /// Scene to read
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Folder for the run; made if its parent exists
    #[arg(short, long, value_name = "DIR", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// Put a value in the place of that of the scene, such as time.step=0.02; may be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// The frames to make, such as 0..20 or ..20: stop after the last; --resume goes on from the first
    #[arg(long, value_name = "A..B")]
    frames: Option<FrameRange>,
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
    let (scene, resolved) = SimScene::read(&file, run.seed)?;
    scene.require_memory(&args.scene)?;
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
    let frames = args.frames.unwrap_or_default();
    frames.require_reached(folder.from.as_ref().map_or(0, |from| from.step), scene.output.every)?;
    let title = args.scene.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let mut smoke = match &folder.from {
        Some(from) => Smoke::resumed(&scene, title, &from.state, &console.progress)?,
        None => console.stage(&mut seconds, "building", || Smoke::new(&scene, title, &console.progress))?,
    };
    let plan = Plan {
        solver: SOLVER,
        resume: resume_line(SOLVER, &args.scene, output, &args.set, run.seed),
        scene: resolved,
        steps: scene.time.steps,
        last: frames.last_step(scene.output.every),
        output: scene.output,
    };
    let mut object = drive(&mut smoke, &plan, &mut folder, run, &mut seconds)?;
    drop(folder);
    console.result(&in_words(&args.scene, output, &object))?;
    object.insert("input".into(), json!(shown(&args.scene)));
    object.insert("output".into(), json!(shown(output)));
    object.insert("peak_rss_bytes".into(), json!(machine::peak_memory()));
    console.object(&Value::Object(object))?;
    Ok(0)
}

/// Runs the step after the state of a file.
pub(crate) fn replay(file: &Path, step: &FailedStep, run: &Run) -> Result<Replayed, Box<Failure>> {
    let before = &step.before;
    let (scene, _) = SimScene::read(&Scene::of(file, before.scene.as_str()), 0)?;
    if before.step >= scene.time.steps {
        let what = format!("it is of step {}, the last of its scene", before.step);
        return Err(Failure::new(Code::NoRunFile, what)
            .subject(shown(file))
            .help("name a file of an earlier step"));
    }
    let mut smoke = Smoke::resumed(&scene, String::new(), &before.state, &run.console.progress)?;
    replayed(&mut smoke, run)
}

/// The result for people.
fn in_words(scene: &Path, output: &Path, result: &Map<String, Value>) -> String {
    let mut words = Words::of(scene, result, &["steps", "frames"]);
    let [last, most] = ["triangles", "most_triangles"].map(|key| words.count(&format!("/elements/{key}")));
    words.row("triangles", &format!("{last} at the end, {most} at most"));
    words.row("components", &words.count("/components"));
    let [made, intersection, budget] = ["made", "refused/intersection", "refused/budget"]
        .map(|key| words.count(&format!("/releases/{key}")));
    words.row(
        "releases",
        &format!("{made} made, {intersection} refused for intersection, {budget} refused for budget"),
    );
    if let (Some(released), Some(volume)) =
        (words.number("/conserved/volume/released"), words.number("/conserved/volume/final"))
    {
        let relative = words
            .number("/conserved/volume/relative_error")
            .map_or(String::new(), |r| format!(" (relative change {r})"));
        words.row("volume", &format!("{released} released, {volume} at the end{relative}"));
    }
    let operations = ["splits", "flips", "collapses", "merges", "separations"].map(|name| (name, name));
    words.counts("operations", "/operations", &operations);
    if let Some(seconds) = words.number("/seconds_per_frame/total") {
        let parts = [("simulation", "simulated"), ("rendering", "rendered")].map(|(key, word)| {
            let seconds = words.number(&format!("/seconds_per_frame/{key}"))?;
            Some(format!("{word} in {seconds}"))
        });
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        words.row("seconds a frame", &format!("{seconds}: {}", parts.join(", ")));
    }
    if result["rendering"].is_object() {
        let folder = shell_word(&output.join("volume"));
        words.row("pictures", &format!("of {} frames in {folder}", words.count("/rendering/frames")));
    }
    words.end(output)
}
