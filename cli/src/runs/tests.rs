//! The machinery with a solver of a few lines: every file of a run that was stopped is that of one that was not.

use super::resolved::{Resolved, Value as Setting};
use super::state::Reader;
use super::*;
use crate::codes::Code;
use crate::console::{Console, Seconds};
use crate::failure::Failure;
use crate::progress::{Progress, ProgressMode};
use crate::run::Run;
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Instant;
use welter_meshing::DVec3;
use welter_meshing::surface::TriangleSoup;

/// A tetrahedron whose corners go where a generator of numbers says.
#[derive(Clone)]
struct Wander {
    step: f64,
    time: f64,
    corners: Vec<DVec3>,
    random: u64,
    /// What happens in the step that begins at a state of so many steps.
    happens: Option<(u64, Happening)>,
}

#[derive(Clone, Copy)]
enum Happening {
    Cancelled,
    Failure,
    Panic,
    /// While the picture of the state after so many steps is made.
    PictureCancelled,
}

impl Wander {
    fn new(step: f64) -> Self {
        Self {
            step,
            time: 0.0,
            corners: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            random: 7,
            happens: None,
        }
    }

    fn with(state: &[u8], step: f64) -> Self {
        let mut reader = Reader(state);
        let (time, random) =
            (reader.number().expect("as it should be"), reader.whole().expect("as it should be"));
        let corners = reader.points().expect("as it should be");
        reader.end().expect("as it should be");
        Self { time, corners, random, ..Self::new(step) }
    }

    fn mesh(&self) -> TriMesh {
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        TriMesh::new(TriangleSoup { positions: self.corners.clone(), triangles, ..Default::default() })
            .expect("as it should be")
    }

    fn facts(&self) -> Map<String, Value> {
        let facts = json!({ "volume": self.corners[1].x, "triangles": 4, "seconds": { "total": 0.0 } });
        facts.as_object().expect("as it should be").clone()
    }
}

impl Simulation for Wander {
    fn step(&mut self, monitor: &Monitor<'_>) -> Result<Map<String, Value>, StepProblem> {
        let done = (self.time / self.step).round() as u64;
        match self.happens.filter(|(at, _)| *at == done) {
            Some((_, Happening::Cancelled)) => return Err(StepProblem::Cancelled),
            Some((_, Happening::Failure)) => {
                self.corners.clear();
                let failure = Failure::new(Code::StepFailed, "it was to fail");
                return Err(StepProblem::Failed(Box::new(StepFailure {
                    failure,
                    stage: "wandering",
                    details: json!([1, 2]),
                })));
            }
            Some((_, Happening::Panic)) => panic!("it was to panic"),
            Some((_, Happening::PictureCancelled)) | None => {}
        }
        monitor.check().map_err(|_| StepProblem::Cancelled)?;
        for corner in &mut self.corners {
            for k in 0..3 {
                self.random = self.random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                corner[k] += (self.random >> 40) as f64 * 1e-9 / 3.0;
            }
        }
        self.time += self.step;
        Ok(self.facts())
    }

    fn initial(&self) -> Map<String, Value> {
        self.facts()
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn frame(&self) -> Frame {
        let arrays = vec![("height", self.corners.iter().map(|c| c.z).collect())];
        Frame {
            mesh: self.mesh(),
            arrays,
            title: "wander".into(),
            caption: vec![format!("time {}", self.time)],
        }
    }

    fn pictures(&self, number: u64, _monitor: &Monitor<'_>) -> Result<Pictures, PictureProblem> {
        let done = (self.time / self.step).round() as u64;
        if let Some((at, Happening::PictureCancelled)) = self.happens
            && at == done
        {
            return Err(PictureProblem::Cancelled);
        }
        let told = json!({ "random": self.random, "number": number });
        let told = told.as_object().expect("as it should be").clone();
        let files = vec![("composite", self.time.to_le_bytes().to_vec()), ("planes", vec![7; 9])];
        Ok(Pictures { files, told, seconds: Map::new() })
    }

    fn save(&self, state: &mut Writer) {
        state.number(self.time);
        state.whole(self.random);
        state.points(&self.corners);
    }

    fn mesh_of(&self, state: &[u8]) -> Option<TriMesh> {
        Some(Self::with(state, self.step).mesh())
    }

    fn conclude(&self, lines: &[&Value], complete: bool) -> Map<String, Value> {
        let sum: f64 = lines.iter().map(|line| line["volume"].as_f64().expect("as it should be")).sum();
        json!({ "steps": lines.len() - 1, "sum": sum, "complete": complete })
            .as_object()
            .expect("as it should be")
            .clone()
    }
}

fn quiet() -> Run {
    let progress = Progress::new(ProgressMode::None, true);
    let console = Console { json: false, verbose: 0, quiet: true, progress, started: Instant::now() };
    Run { console, force: false, threads: 1, seed: 0 }
}

fn plan(step: f64) -> Plan {
    Plan {
        solver: "wander",
        resume: "welter wander --resume".into(),
        scene: Resolved(vec![("step".to_owned(), Setting::Number(step))]),
        steps: 11,
        last: 11,
        output: OutputPlan {
            every: 3,
            checkpoint_every: 4,
            pictures: Some([40, 30]),
            camera: None,
            volume: true,
        },
    }
}

/// Runs to the end of the plan, or until something happens.
fn go(
    folder: &Path,
    start: Start,
    plan: &Plan,
    happens: Option<(u64, Happening)>,
) -> Result<Map<String, Value>, Box<Failure>> {
    let step = match plan.scene.0[0].1 {
        Setting::Number(step) => step,
        _ => unreachable!("the plan is that above"),
    };
    let mut opened = RunFolder::open(folder, start, plan.solver, &plan.scene.to_toml(), &quiet())?;
    let mut simulation = match &opened.from {
        Some(from) => Wander::with(&from.state, step),
        None => Wander::new(step),
    };
    simulation.happens = happens;
    drive(&mut simulation, plan, &mut opened, &quiet(), &mut Seconds::default())
}

/// Every file of a folder; of the record, what does not depend on the clock and the command line.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(folder: &Path, top: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(folder).expect("as it should be") {
            let path = entry.expect("as it should be").path();
            if path.is_dir() {
                walk(&path, top, files);
            } else {
                let name = path.strip_prefix(top).expect("as it should be").display().to_string();
                files.insert(name, fs::read(&path).expect("as it should be"));
            }
        }
    }
    let mut all = BTreeMap::new();
    walk(folder, folder, &mut all);
    all.remove("log.txt");
    let text = |name: &str| {
        String::from_utf8(fs::read(folder.join(name)).expect("as it should be")).expect("as it should be")
    };
    let mut record: Value = serde_json::from_str(&text("run.json")).expect("as it should be");
    for key in ["started", "updated", "command"] {
        assert!(record.as_object_mut().expect("as it should be").remove(key).is_some(), "{key}");
    }
    all.insert("run.json".into(), record.to_string().into_bytes());
    // The page names its folder.
    let page = text("report.html").replace(&folder.display().to_string(), "FOLDER");
    all.insert("report.html".into(), page.into_bytes());
    all
}

fn same(a: &Path, b: &Path) {
    let (a, b) = (files(a), files(b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    a.iter().for_each(|(name, bytes)| assert!(*bytes == b[name], "{name} differs"));
}

#[test]
fn a_run_has_its_frames_lines_and_checkpoints() {
    let bench = tempfile::tempdir().expect("as it should be");
    let folder = bench.path().join("run");
    let ended = go(&folder, Start::Anew(false), &plan(0.1), None).expect("as it should be");
    assert_eq!((&ended["status"], &ended["steps"]), (&json!("finished"), &json!(11)));
    let names: Vec<String> = files(&folder).into_keys().collect();
    let mut expected: Vec<String> = ["report.html", "report.json", "run.json", "scene.toml", "stats.jsonl"]
        .into_iter()
        .chain(["checkpoint/step_00000008.bin", "checkpoint/step_00000011.bin", "paraview/surface.pvd"])
        .map(str::to_owned)
        .collect();
    for k in 0..5 {
        let frames = [
            format!("surface/frame_{k:04}.ply"),
            format!("paraview/surface_{k:04}.vtp"),
            format!("preview/frame_{k:04}.png"),
            format!("volume/composite_{k:04}.png"),
            format!("volume/planes_{k:04}.exr"),
        ];
        expected.extend(frames);
    }
    expected.sort();
    assert_eq!(names, expected);
    let lines = stats::read(&folder);
    assert_eq!(lines.len(), 12);
    let frames: Vec<u64> = lines
        .iter()
        .filter(|l| l.value["frame"].is_u64())
        .map(|l| l.value["step"].as_u64().expect("as it should be"))
        .collect();
    assert_eq!(frames, [0, 3, 6, 9, 11]);
    let list = fs::read_to_string(folder.join("paraview/surface.pvd")).expect("as it should be");
    for (time, name) in [("0", "surface_0000.vtp"), ("1.1", "surface_0004.vtp")] {
        assert!(list.contains(&format!("timestep=\"{time}\" part=\"0\" file=\"{name}\"")), "{list}");
    }
    assert_eq!(fs::read_to_string(folder.join("scene.toml")).expect("as it should be"), "step = 0.1\n");
    assert!(
        fs::read(folder.join("preview/frame_0004.png")).expect("as it should be").starts_with(b"\x89PNG")
    );
    assert!(
        fs::read_to_string(folder.join("report.html")).expect("as it should be").matches("<svg").count() >= 2
    );
    assert_eq!(record::read(&folder).expect("as it should be")["status"], "finished");
}

#[test]
fn a_run_that_was_stopped_anywhere_gives_the_same_bytes() {
    let bench = tempfile::tempdir().expect("as it should be");
    let whole = bench.path().join("whole");
    go(&whole, Start::Anew(false), &plan(0.1), None).expect("as it should be");
    for at in 0..11 {
        let folder = bench.path().join(format!("cancelled_{at}"));
        let failure = go(&folder, Start::Resume, &plan(0.1), Some((at, Happening::Cancelled))).unwrap_err();
        assert_eq!(failure.code, Code::Interrupted);
        assert!(
            failure.help.ends_with("--resume") && failure.places[0].contains(&format!("step {at}")),
            "{failure:?}"
        );
        assert_eq!(record::read(&folder).expect("as it should be")["status"], "interrupted");
        go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
        // The checkpoint of the interruption may stand in the place of an older one.
        let extra = folder.join(format!("checkpoint/step_{at:08}.bin"));
        if at > 8 {
            fs::remove_file(extra).expect("as it should be");
            fs::copy(whole.join("checkpoint/step_00000008.bin"), folder.join("checkpoint/step_00000008.bin"))
                .expect("as it should be");
        }
        same(&whole, &folder);
    }
    // Stopped while a picture was made: the step before it is made again.
    for at in [3, 6, 9, 11] {
        let folder = bench.path().join(format!("picture_{at}"));
        let happens = Some((at, Happening::PictureCancelled));
        let failure = go(&folder, Start::Resume, &plan(0.1), happens).unwrap_err();
        assert_eq!(failure.code, Code::Interrupted);
        assert!(failure.places[0].contains(&format!("step {} of", at - 1)), "{failure:?}");
        assert!(!folder.join(format!("volume/composite_{:04}.png", at.div_ceil(3))).exists());
        go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
        let extra = folder.join(format!("checkpoint/step_{:08}.bin", at - 1));
        if at > 9 {
            fs::remove_file(extra).expect("as it should be");
            fs::copy(whole.join("checkpoint/step_00000008.bin"), folder.join("checkpoint/step_00000008.bin"))
                .expect("as it should be");
        }
        same(&whole, &folder);
    }
    // Stopped on purpose, and asked to go on when there is nothing left to do.
    let folder = bench.path().join("stopped");
    let ended =
        go(&folder, Start::Anew(false), &Plan { last: 4, ..plan(0.1) }, None).expect("as it should be");
    assert_eq!(ended["status"], "stopped");
    go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
    go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
    same(&whole, &folder);
}

#[test]
fn what_a_killed_process_leaves_is_mended() {
    let bench = tempfile::tempdir().expect("as it should be");
    let whole = bench.path().join("whole");
    go(&whole, Start::Anew(false), &plan(0.1), None).expect("as it should be");
    let folder = bench.path().join("killed");
    go(&folder, Start::Anew(false), &Plan { last: 9, ..plan(0.1) }, None).expect("as it should be");
    // As if it had died in step 10: beyond its checkpoint, a line torn, a file half written, its lock there.
    fs::remove_file(folder.join("checkpoint/step_00000009.bin")).expect("as it should be");
    let mut lines = fs::read(folder.join("stats.jsonl")).expect("as it should be");
    lines.truncate(lines.len() - 5);
    fs::write(folder.join("stats.jsonl"), lines).expect("as it should be");
    fs::write(folder.join("paraview/.welter-1-0.part"), "half").expect("as it should be");
    fs::write(folder.join("surface/frame_0004.ply"), "ply\n").expect("as it should be");
    fs::write(folder.join("lock"), "process 1, since then\n").expect("as it should be");
    go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
    same(&whole, &folder);
    // The newest checkpoint damaged, then both.
    for count in 1..=2 {
        for name in ["checkpoint/step_00000011.bin", "checkpoint/step_00000008.bin"].iter().take(count) {
            let mut bytes = fs::read(folder.join(name)).expect("as it should be");
            let middle = bytes.len() / 2;
            bytes[middle] ^= 0x10;
            fs::write(folder.join(name), bytes).expect("as it should be");
        }
        go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
        same(&whole, &folder);
    }
}

#[test]
fn a_step_that_fails_keeps_what_was_before_it() {
    let bench = tempfile::tempdir().expect("as it should be");
    let folder = bench.path().join("run");
    let failure = go(&folder, Start::Anew(false), &plan(0.1), Some((6, Happening::Failure))).unwrap_err();
    assert_eq!(
        (failure.code, failure.what.as_str()),
        (Code::StepFailed, "step 7, wandering: it was to fail")
    );
    assert!(failure.help.contains("welter replay"), "{}", failure.help);
    assert_eq!(record::read(&folder).expect("as it should be")["status"], "failed");
    let replay =
        failed_step::FailedStep::read(&folder.join("failure/step_00000007.bin")).expect("as it should be");
    assert_eq!((replay.before.step, replay.before.scene.as_str()), (6, "step = 0.1\n"));
    let told = replay.failure.expect("as it should be");
    assert_eq!((&told["stage"], &told["details"]), (&json!("wandering"), &json!([1, 2])));
    assert_eq!(told["error"]["code"], Code::StepFailed.id());
    // The surface before is that of frame 2, after step 6.
    let [before, frame] = ["failure/before.ply", "surface/frame_0002.ply"]
        .map(|name| fs::read(folder.join(name)).expect("as it should be"));
    assert!(before == frame);
    // Mended, the run goes on from there, and leaves no trace of the failure.
    go(&folder, Start::Resume, &plan(0.1), None).expect("as it should be");
    let whole = bench.path().join("whole");
    go(&whole, Start::Anew(false), &plan(0.1), None).expect("as it should be");
    same(&whole, &folder);
}

#[test]
fn a_panic_leaves_a_file_that_reproduces_it() {
    let bench = tempfile::tempdir().expect("as it should be");
    let folder = bench.path().join("run");
    let went =
        std::panic::catch_unwind(|| go(&folder, Start::Anew(false), &plan(0.1), Some((2, Happening::Panic))));
    assert!(went.is_err());
    let replay =
        failed_step::FailedStep::read(&folder.join("failure/step_00000003.bin")).expect("as it should be");
    assert_eq!(
        (replay.before.step, &replay.failure.expect("as it should be")["error"]["code"]),
        (2, &json!(Code::OwnBug.id()))
    );
    assert_eq!(record::read(&folder).expect("as it should be")["status"], "failed");
    assert!(!folder.join("lock").exists());
}

#[test]
fn folders_of_something_else_and_of_other_runs_are_refused() {
    let bench = tempfile::tempdir().expect("as it should be");
    let folder = bench.path().join("run");
    let code = |start, plan: &Plan| {
        go(&folder, start, plan, None).map(|ended| ended["status"].clone()).map_err(|f| f.code)
    };
    assert_eq!(code(Start::Anew(false), &plan(0.1)), Ok(json!("finished")));
    assert_eq!(code(Start::Anew(false), &plan(0.1)), Err(Code::OutputExists));
    assert_eq!(code(Start::Resume, &plan(0.2)), Err(Code::SceneDiffers));
    assert_eq!(code(Start::Resume, &Plan { solver: "other", ..plan(0.1) }), Err(Code::SceneDiffers));
    // Replaced, with fewer frames: none of the old ones is left.
    let short = Plan { steps: 2, last: 2, ..plan(0.3) };
    assert_eq!(code(Start::Anew(true), &short), Ok(json!("finished")));
    for name in ["surface", "paraview", "preview"] {
        let list = usize::from(name == "paraview");
        assert_eq!(fs::read_dir(folder.join(name)).expect("as it should be").count(), 2 + list);
    }
    assert_eq!(fs::read_dir(folder.join("volume")).expect("as it should be").count(), 4);

    let other = bench.path().join("other");
    fs::create_dir(&other).expect("as it should be");
    fs::write(other.join("thesis.tex"), "years of work").expect("as it should be");
    for start in [Start::Anew(false), Start::Anew(true), Start::Resume] {
        assert_eq!(go(&other, start, &plan(0.1), None).unwrap_err().code, Code::NotARun);
    }
    assert_eq!(fs::read_dir(&other).expect("as it should be").count(), 1);
    let file = bench.path().join("file");
    fs::write(&file, "").expect("as it should be");
    assert_eq!(go(&file, Start::Anew(false), &plan(0.1), None).unwrap_err().code, Code::OutputExists);
    let missing = bench.path().join("no/folder");
    assert_eq!(go(&missing, Start::Anew(false), &plan(0.1), None).unwrap_err().code, Code::FolderMissing);
}
