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
use crate::failure::{Failure, shell_word, shown};
use crate::run::{Outcome, Run};
use crate::runs::failed_step::FailedStep;
use crate::runs::{Request, ToRun, Words};
use crate::scene::Scene;
use frames::FrameRange;
pub(crate) use report::report;
use scene::SimScene;
use serde_json::{Map, Value};
use simulation::Smoke;
use std::path::Path;

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
[[solids]], which all flows but sources go around, and no vertex enters: kind = \"ball\", \"box\", \"torus\",
  \"capsule\", \"cylinder\", \"half-space\" with its keys, ramp_width, anchor, path; in pictures drawn = true, albedo
[smoke]: scheme, most_triangles, over_budget = \"coarsen\" | \"stop-splitting\", coarsening
[improvement], [topology], [integration] (collisions): each has enabled; `--dry-run` tells every key
[output]: every, checkpoint_every (steps), pictures = true, size = [800, 600]

Pictures of the smoke as a volume, lit and shadowed, of every frame:
  [render]
  extinction = 12.0            # one over the length after which 1/e of the light is left
  size = [960, 540]            # and: first_frame, last_frame, every_frame, albedo, background, interior, shadow_resolution, ...
  traced_triangles = 16        # with up to so many in a column of the shadow texture, shadows are exact where it is too coarse; 0: never
  layer_thickness = 0.2        # of open sheets, which are drawn as layers; along layer_direction, or against the normals
  [render.camera]              # the same in all frames: eye and target; or azimuth, elevation, fill around box = [[...], [...]],
  azimuth = 30.0               #   without which all emissions, flows and solids are in the picture; up, field_of_view
  [render.light]               # direction (the way it travels), radiance, ambient
  [render.age_blur]            # spread_rel, most_rel: old smoke is soft
  [render.planes]              # alpha, scatter, age, backdrop, composite: each [], [\"png\"], [\"exr\"] or both
  composite = [\"png\", \"exr\"]  # PNG: sRGB, clipped to 0..1 (png_colors = \"8-bit\" | \"16-bit\"); EXR: linear (exr_numbers = \"32-bit\" | \"16-bit\",
                               #   where channels with numbers above 65504 stay at 32)
In PNG, alpha, scatter and age are 16 bits of grey: 1 is white, and of ages age_white, the end of the scene by default.

DIR gets surface/frame_0000.ply and so on, paraview/surface.pvd (with ages), stats.jsonl (a line a step), report.html,
volume/composite_0000.png, volume/planes_0000.exr, run.json, and checkpoints: Ctrl-C stops, --resume goes on with the same bits as if nothing had happened.

Examples:
  welter sim examples/sim/plume.toml -o plume
  welter sim examples/sim/plume.toml -o plume --frames ..10
  welter sim examples/sim/plume.toml -o plume --resume")]
pub(crate) struct Args {
    #[command(flatten)]
    request: Request,
    /// The frames to make, such as 0..20 or ..20: stop after the last; --resume goes on from the first
    #[arg(long, value_name = "A..B")]
    frames: Option<FrameRange>,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let (request, console) = (&args.request, &run.console);
    let (scene, resolved) = SimScene::read(&request.read()?, run.seed)?;
    scene.require_memory(&request.scene)?;
    let (steps, every) = (scene.time.steps, scene.output.every);
    let to_run = ToRun { solver: SOLVER, scene: resolved, steps, output: scene.output };
    let Some(mut begun) = request.begin(to_run, run)? else { return Ok(0) };
    let frames = args.frames.unwrap_or_default();
    frames.require_reached(begun.folder.from.as_ref().map_or(0, |from| from.step), every)?;
    let title = begun.title();
    let mut smoke = match &begun.folder.from {
        Some(from) => Smoke::resumed(&scene, title, &from.state, &console.progress)?,
        None => {
            let build = || Smoke::new(&scene, title, &console.progress);
            console.stage(&mut begun.seconds, "building", build)?
        }
    };
    begun.finish(&mut smoke, frames.last_step(every), in_words, run)
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
    // Of releases that are merged, where there are any that met smoke.
    let merged =
        ["united/joined", "united/within", "refused/sheet", "refused/inside_out", "refused/degenerate"]
            .map(|key| words.count(&format!("/releases/{key}")));
    if merged.iter().any(|count| count != "0") {
        let [joined, within, sheet, inside_out, degenerate] = merged;
        let met = format!("{joined} joined to smoke, {within} within smoke that was there");
        let refused = format!("refused: {sheet} at sheets, {inside_out} inside out, {degenerate} degenerate");
        words.row("merged releases", &format!("{met}; {refused}"));
    }
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
