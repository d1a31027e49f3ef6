//! `welter sim`: scenes, results, what is refused, and runs that are gone on with.

use crate::harness::Bench;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Puffs in a vortex ring, two of them in six steps.
const PUFFS: &str = "[[emissions]]\nshape = \"sphere\"\nscale = 0.3\nedge_length = 0.15\ninterval = 0.15\n[[flows]]\n\
    kind = \"ring\"\nradius = 0.5\ncore = 0.2\n[time]\nstep = 0.04\nsteps = 6\n[output]\nevery = 2\ncheckpoint_every = 2\n";

fn number(object: &Value, path: &str) -> f64 {
    object.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {object:#}"))
}

fn lines(bench: &Bench, run: &str) -> Vec<Value> {
    let text = String::from_utf8(bench.read(&format!("{run}/stats.jsonl"))).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn the_result_has_every_key_of_the_contract() {
    let bench = Bench::new();
    bench.file("a.toml", format!("{PUFFS}pictures = true\nsize = [60, 40]\n"));
    let (object, ran) = bench.json("sim a.toml -o run");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(
        (&object["frames"], &object["status"], &object["releases"]["made"]),
        (&4.into(), &"finished".into(), &2.into())
    );
    assert!((number(&object, "/time") - 0.24).abs() < 1e-12);
    for path in ["/elements/triangles", "/seconds_per_frame/total", "/seconds_per_frame/velocity"] {
        assert!(number(&object, path) > 0.0, "{path}");
    }
    assert!(object["solver"].is_string() && object.get("peak_rss_bytes").is_some());
    // Two balls, as polyhedra within them.
    let two = 2.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.3_f64.powi(3);
    assert!((number(&object, "/conserved/volume/released") / two - 1.0).abs() < 0.1, "{object:#}");
    assert!(number(&object, "/conserved/volume/relative_error").abs() < 0.01, "{object:#}");
    let lines = lines(&bench, "run");
    assert_eq!(lines.len(), 7);
    let releases: Vec<usize> = lines.iter().map(|line| line["releases"].as_array().unwrap().len()).collect();
    assert_eq!(releases, [1, 0, 0, 0, 1, 0, 0]);
    for frame in 0..4 {
        let bytes = bench.read(&format!("run/paraview/surface_{frame:04}.vtp"));
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
        assert!(head.contains("Name=\"age\""), "{head}");
        assert!(bench.read(&format!("run/surface/frame_{frame:04}.ply")).starts_with(b"ply"));
        assert!(bench.read(&format!("run/preview/frame_{frame:04}.png")).starts_with(b"\x89PNG"));
    }
    let (checked, _) = bench.json("check run/surface/frame_0003.ply");
    assert_eq!(
        (&checked["files"][0]["components"], &checked["files"][0]["closed"]),
        (&2.into(), &true.into())
    );
}

/// The scenes that are shipped, coarser and for a frame.
#[test]
fn the_examples_that_are_shipped_work() {
    let bench = Bench::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/sim");
    let mut scenes: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    assert!(scenes.len() >= 2);
    for scene in scenes {
        let name = scene.file_stem().unwrap().to_str().unwrap().to_owned();
        let line = format!("sim {} -o {name} --frames ..1 --set output.pictures=false", scene.display());
        let (object, ran) = bench.json(&line);
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        assert_eq!((&object["status"], &object["frames"]), (&"stopped".into(), &2.into()), "{name}");
        assert!(number(&object, "/conserved/volume/relative_error").abs() < 0.01, "{name}: {object:#}");
    }
}

#[test]
fn a_dry_run_tells_the_scene_and_writes_nothing() {
    let bench = Bench::new();
    bench.file("a.toml", PUFFS);
    let ran =
        bench.run("sim a.toml --dry-run --set smoke.coarsening=1.5 --set integration.enabled=true").ok();
    for line in ["coarsening = 1.5\n", "split_scheme = \"midpoint\"\n", "joining = \"separate\"\n"] {
        assert!(ran.out.contains(line), "{}", ran.out);
    }
    assert_eq!(bench.names(), ["a.toml"]);
    bench.file("b.toml", &ran.out);
    assert_eq!(bench.run("sim b.toml --dry-run").ok().out, ran.out);
}

/// Each fault of a scene, the line that is told, and a word of the help.
#[test]
fn faults_of_scenes_are_told_with_their_line() {
    let bench = Bench::new();
    let with = |before: &str, after: &str| PUFFS.replacen(before, after, 1);
    for (text, code, line, help) in [
        (with("interval", "intervall"), "W5002", 5, "`interval`"),
        (with("[output]", "[outptu]"), "W5002", 13, "`output`"),
        (with("core = 0.2", "velocity = [0, 0, 1]"), "W5002", 9, ""),
        (with("kind = \"ring\"", "kind = \"rings\""), "W5004", 7, "\"ring\""),
        (with("kind = \"ring\"", ""), "W5003", 6, "kind = "),
        (with("core = 0.2", "core = -1"), "W5004", 9, ""),
        (with("core = 0.2", "path = [[0, 1]]"), "W5004", 9, ""),
        (with("interval = 0.15", "interval = 0"), "W5004", 5, ""),
        (with("interval = 0.15", "start = -1"), "W5004", 5, ""),
        (with("interval = 0.15", "count = 3"), "W5004", 5, "interval"),
        (with("interval = 0.15", "joining = \"merged\""), "W5004", 0, ""),
        (with("shape = \"sphere\"", "shape = \"spere\""), "W5004", 2, "--list"),
        (with("[output]", "[topology]\nenabled = true\n[output]"), "W5004", 13, ""),
        (with("[output]", "[smoke]\ncoarsening = 1\n[output]"), "W5004", 14, ""),
        (with("[output]", "[[solids]]\nkind = \"ball\"\nradius = 1\n[output]"), "W5003", 13, "ramp_width"),
        ("[time]\nstep = 1\nsteps = 1\n".to_owned(), "W5004", 0, "[[emissions]]"),
    ] {
        bench.file("a.toml", &text);
        let error = bench.fails("sim a.toml -o run", code, 5);
        if line > 0 {
            assert_eq!(error["where"][0], format!("a.toml:{line}"), "{text}: {error:#}");
        }
        assert!(error["help"].as_str().unwrap().contains(help), "{text}: {error:#}");
    }
    bench.file("a.toml", PUFFS);
    bench.fails("sim a.toml", "W2001", 2);
    bench.fails("sim a.toml -o run --frames 3..1", "W2001", 2);
    bench.fails("sim a.toml -o run --frames 1..2", "W2001", 2);
    bench.fails("sim a.toml -o run --resume --force", "W2001", 2);
    assert!(!bench.exists("run/run.json"), "nothing was run");
}

/// What of a run does not depend on the clock.
fn content(bench: &Bench, run: &str) -> Vec<Vec<u8>> {
    let mut files: Vec<Vec<u8>> = (0..4)
        .flat_map(|k| [format!("surface/frame_{k:04}.ply"), format!("paraview/surface_{k:04}.vtp")])
        .map(|name| bench.read(&format!("{run}/{name}")))
        .collect();
    files.push(bench.read(&format!("{run}/paraview/surface.pvd")));
    for mut line in lines(bench, run) {
        line.as_object_mut().unwrap().remove("seconds");
        files.push(line.to_string().into_bytes());
    }
    files
}

/// Stopped in the middle and gone on with, with other threads: the same bytes.
#[test]
fn a_run_that_is_stopped_goes_on_with_the_same_bits() {
    let bench = Bench::new();
    bench.file("a.toml", format!("{PUFFS}[smoke]\nmost_triangles = 420\n[integration]\nenabled = true\n"));
    bench.run("sim a.toml -o whole -j 1").ok();
    bench.run("sim a.toml -o parts --frames ..1 -j 2").ok();
    assert!(!bench.exists("parts/surface/frame_0002.ply"));
    bench.fails("sim a.toml -o parts --frames 3.. --resume", "W2001", 2);
    bench.fails("sim a.toml -o parts --resume --set time.step=0.05", "W5009", 5);
    bench.run("sim a.toml -o parts --frames 2..2 --resume").ok();
    bench.run("sim a.toml -o parts --resume").ok();
    assert!(content(&bench, "whole") == content(&bench, "parts"));
    // A checkpoint can be run alone.
    let checkpoint = bench.path("whole/checkpoint");
    let names = std::fs::read_dir(checkpoint).unwrap().map(|e| e.unwrap().path());
    let mut names: Vec<PathBuf> = names.collect();
    names.sort();
    let (object, ran) = bench.json(&format!("replay {}", names[0].display()));
    assert_eq!((ran.exit, &object["solver"]), (Some(0), &"sim".into()), "{}", ran.err);
}
