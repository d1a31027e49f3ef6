//! Runs of `welter track` that are stopped, killed, spoiled and gone on with: the same bytes as if nothing had happened.

use crate::harness::{Bench, Ran};
use crate::track::BALL;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// A ball that is drawn out by noise for as long as one likes.
fn long() -> String {
    BALL.replace("\"rotation\"", "\"curl-noise\"").replace("steps = 5", "steps = 100000")
}

/// What a run wrote, without what depends on the clock, on the command line and on which older checkpoint is kept.
fn content(bench: &Bench, run: &str) -> BTreeMap<String, Vec<u8>> {
    fn walk(folder: &Path, top: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, top, files);
            } else {
                let name = path.strip_prefix(top).unwrap().display().to_string();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    let mut files = BTreeMap::new();
    walk(&bench.path(run), &bench.path(run), &mut files);
    let last = files.keys().rfind(|name| name.starts_with("checkpoint/")).unwrap().clone();
    files.retain(|name, _| !name.starts_with("checkpoint/") || *name == last);
    // Times of the clock, and the page that draws them.
    for name in ["log.txt", "report.html"] {
        assert!(files.remove(name).is_some(), "{name}");
    }
    let without = |text: &[u8], keys: &[&str]| {
        let mut value: Value = serde_json::from_slice(text).unwrap();
        keys.iter().for_each(|key| {
            value.as_object_mut().unwrap().remove(*key);
        });
        value.to_string()
    };
    let lines =
        files["stats.jsonl"].split_inclusive(|&b| b == b'\n').map(|line| without(line, &["seconds"]) + "\n");
    let lines: String = lines.collect();
    files.insert("stats.jsonl".into(), lines.into_bytes());
    for (name, keys) in
        [("report.json", &["seconds_per_step"][..]), ("run.json", &["command", "started", "updated"])]
    {
        let text = without(&files[name], keys);
        files.insert(name.into(), text.into_bytes());
    }
    files
}

#[track_caller]
fn same(bench: &Bench, a: &str, b: &str) {
    let (a, b) = (content(bench, a), content(bench, b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    a.iter().for_each(|(name, bytes)| assert!(*bytes == b[name], "{name} differs"));
}

fn lines(bench: &Bench, run: &str) -> usize {
    std::fs::read(bench.path(run).join("stats.jsonl"))
        .map_or(0, |text| text.iter().filter(|&&b| b == b'\n').count())
}

/// A run that goes on until somebody stops it, some steps after its start.
fn under_way(bench: &Bench, args: &[&str], run: &str, steps: usize) -> Child {
    let child = bench.command(args).spawn().unwrap();
    let start = Instant::now();
    while lines(bench, run) <= steps {
        assert!(start.elapsed() < Duration::from_secs(60), "no steps were made");
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

fn signal(child: &Child, name: &str) {
    let kill = format!("kill -{name} {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
}

#[test]
fn a_run_that_was_stopped_gives_the_same_bytes_for_any_number_of_threads() {
    let bench = Bench::new();
    bench.file("a.toml", long());
    bench.run("track a.toml -o whole --steps 12 -j 1").ok();
    bench.run("track a.toml -o parts --steps 5 -j 3").ok();
    for steps in [5, 7, 12] {
        bench.run(&format!("track a.toml -o parts --resume --steps {steps} -j 2")).ok();
    }
    same(&bench, "whole", "parts");
    // Not even the name of the scene counts, nor whether a value comes from the file.
    bench.file("b.toml", long().replace("step = 0.01", "step = 0.5"));
    bench.run("track b.toml -o set --steps 3 --set time.step=0.01").ok();
    bench.run("track a.toml -o set --steps 12 --resume").ok();
    same(&bench, "whole", "set");
}

#[test]
fn ctrl_c_leaves_a_checkpoint_and_the_run_goes_on() {
    let bench = Bench::new();
    bench.file("a.toml", long());
    let child = under_way(&bench, &["track", "a.toml", "-o", "run", "--json"], "run", 3);
    signal(&child, "INT");
    let ran = Ran::of(child.wait_with_output().unwrap());
    assert_eq!(ran.exit, Some(130), "{}", ran.err);
    let object: Value = serde_json::from_str(&ran.out).unwrap();
    let error = &object["error"];
    assert_eq!(error["code"], "W0130");
    assert_eq!(error["help"], "welter track a.toml -o run --resume");
    let record: Value = serde_json::from_slice(&bench.read("run/run.json")).unwrap();
    let step = record["steps"].as_u64().unwrap();
    assert_eq!((&record["status"], lines(&bench, "run") as u64), (&"interrupted".into(), step + 1));
    assert_eq!(error["where"][0], format!("checkpoint after step {step} of 100000"));
    assert!(bench.exists(&format!("run/checkpoint/step_{step:08}.bin")) && !bench.exists("run/lock"));
    assert!(bench.exists("run/report.html") && bench.exists("run/paraview/surface.pvd"));

    let steps = step + 5;
    bench.run(&format!("track a.toml -o run --resume --steps {steps}")).ok();
    bench.run(&format!("track a.toml -o whole --steps {steps}")).ok();
    same(&bench, "whole", "run");
}

#[test]
fn a_run_that_was_killed_goes_on_from_its_last_whole_checkpoint() {
    let bench = Bench::new();
    bench.file("a.toml", long());
    let child = under_way(&bench, &["track", "a.toml", "-o", "run"], "run", 5);
    // Nobody else may write it as long as it runs.
    let error = bench.fails("track a.toml -o run --resume", "W7006", 7);
    assert!(error["where"][0].as_str().unwrap().contains(&child.id().to_string()), "{error:#}");
    bench.fails("track a.toml -o run --force", "W7006", 7);
    signal(&child, "KILL");
    child.wait_with_output().unwrap();
    assert!(bench.exists("run/lock"), "nobody was there to remove it");
    // Its newest checkpoint is damaged as well.
    let folder = bench.path("run/checkpoint");
    let mut checkpoints: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    checkpoints.sort();
    let newest = checkpoints.last().unwrap();
    let mut bytes = std::fs::read(newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(newest, bytes).unwrap();

    let steps = lines(&bench, "run") + 4;
    let ran = bench.run(&format!("track a.toml -o run --resume --steps {steps}")).ok();
    for told in ["is taken over", "damaged: the checksum is another one; passed over", "goes on after step"] {
        assert!(ran.err.contains(told), "{told} in {}", ran.err);
    }
    bench.run(&format!("track a.toml -o whole --steps {steps}")).ok();
    same(&bench, "whole", "run");
}

#[test]
fn a_full_disk_stops_a_run_and_spoils_nothing() {
    let bench = Bench::new();
    bench.file("a.toml", long());
    // Files of at most 40 blocks of 512 bytes; the signal that comes with it is ignored, so that writing fails as on a full disk.
    let limited = format!(
        "trap '' XFSZ; ulimit -f 40; exec {} track a.toml -o run --json",
        env!("CARGO_BIN_EXE_welter")
    );
    let mut shell = Command::new("sh");
    let ran = Ran::of(shell.args(["-c", &limited]).current_dir(bench.path("")).output().unwrap());
    assert_eq!(ran.exit, Some(7), "{}{}", ran.out, ran.err);
    let object: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(object["error"]["code"], "W7004", "{object:#}");
    assert!(object["error"]["help"].as_str().unwrap().contains("--resume"), "{object:#}");
    let record: Value = serde_json::from_slice(&bench.read("run/run.json")).unwrap();
    assert_eq!(record["status"], "failed");
    let folders = ["run", "run/surface", "run/paraview", "run/checkpoint"];
    let parts = folders.iter().flat_map(|folder| std::fs::read_dir(bench.path(folder)).unwrap());
    let parts =
        parts.filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(parts.count(), 0, "no unfinished file is left");
    let reached = lines(&bench, "run");
    assert!(reached > 2, "{reached} lines");
    bench.run(&format!("track a.toml -o run --resume --steps {}", reached + 2)).ok();
    bench.run(&format!("track a.toml -o whole --steps {}", reached + 2)).ok();
    same(&bench, "whole", "run");
}

#[test]
fn runs_are_replaced_or_gone_on_with_only_when_asked() {
    let bench = Bench::new();
    bench.file("a.toml", BALL);
    let ran = bench.run("track a.toml -o run --resume").ok();
    assert!(ran.err.contains("a new one begins"), "{}", ran.err);
    bench.fails("track a.toml -o run", "W7003", 7);
    let error = bench.fails("track a.toml -o run --resume --set time.steps=6", "W5009", 5);
    let told: Vec<&str> =
        error["where"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect();
    assert_eq!(told, ["then: [time] steps = 5", "now:  [time] steps = 6"]);
    // Nothing is left to do, and the result is told once more.
    let (again, _) = bench.json("track a.toml -o run --resume");
    assert_eq!((&again["status"], &again["steps"]), (&"finished".into(), &5.into()));
    bench.run("track a.toml -o run --force --set output.every=5").ok();
    assert!(bench.exists("run/surface/frame_0001.ply") && !bench.exists("run/surface/frame_0002.ply"));
}

#[test]
fn a_step_that_fails_can_be_run_alone() {
    let bench = Bench::new();
    // A step far beyond what is stable, in one part: the time left cannot be reached.
    let scene = BALL
        .replace("\"rotation\"", "\"mean-curvature\"")
        .replace("steps = 5", "steps = 5\nmost_substeps = 2")
        .replace("step = 0.01", "step = 0.2");
    bench.file("a.toml", scene);
    let error = bench.fails("track a.toml -o run --force", "W8003", 8);
    assert!(error["what"].as_str().unwrap().starts_with("step 1, time: "), "{error:#}");
    assert_eq!(error["help"], "welter replay run/failure/step_00000001.bin   # runs this step alone");
    assert!(bench.read("run/failure/before.ply") == bench.read("run/surface/frame_0000.ply"));
    let record: Value = serde_json::from_slice(&bench.read("run/run.json")).unwrap();
    assert_eq!(record["status"], "failed");

    // The file needs nothing beside it.
    bench.file("alone.bin", bench.read("run/failure/step_00000001.bin"));
    let (object, ran) = bench.json("replay alone.bin");
    assert_eq!((ran.exit, &object["reproduced"]), (Some(8), &true.into()), "{object:#}");
    assert_eq!((&object["step"], &object["failed"]["stage"]), (&1.into(), &"time".into()));
    assert!(bench.run("replay alone.bin").out.contains("step 1 fails as it did"));
}

#[test]
fn the_step_after_a_checkpoint_can_be_run_alone() {
    let bench = Bench::new();
    bench.file("a.toml", BALL);
    bench.run("track a.toml -o run --steps 2").ok();
    let (object, ran) = bench.json("replay run/checkpoint/step_00000002.bin");
    assert_eq!((ran.exit, &object["step"], &object["reproduced"]), (Some(0), &3.into(), &Value::Null));
    bench.run("track a.toml -o run --resume").ok();
    let stats = String::from_utf8(bench.read("run/stats.jsonl")).unwrap();
    let line: Value = serde_json::from_str(stats.lines().nth(3).unwrap()).unwrap();
    assert_eq!(object["completed"]["area"], line["area"]);

    bench.fails("replay run/checkpoint/step_00000005.bin", "W4013", 4);
    bench.fails("replay a.toml", "W4013", 4);
    bench.fails("replay none.bin", "W4001", 4);
    let bytes = bench.read("run/checkpoint/step_00000004.bin");
    bench.file("cut.bin", &bytes[..bytes.len() - 1]);
    bench.fails("replay cut.bin", "W4013", 4);
}
