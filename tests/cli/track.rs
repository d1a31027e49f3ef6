//! `welter track`: scenes, results, and what is refused.

use crate::harness::{Bench, permissions_bind};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A ball of some 300 triangles that turns by a twentieth in five steps.
pub(crate) const BALL: &str = "exact = \"none\"\n[surface]\nshape = \"sphere\"\nedge_length = 0.4\n[flow]\n\
    kind = \"rotation\"\n[time]\nstep = 0.01\nsteps = 5\n[output]\nevery = 2\ncheckpoint_every = 2\n";

/// The scenes that are shipped.
fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/track");
    let mut scenes: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.sort();
    scenes
}

fn number(object: &Value, path: &str) -> f64 {
    object.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {object:#}"))
}

#[test]
fn the_result_has_every_key_of_the_contract() {
    let bench = Bench::new();
    bench.file(
        "a.toml",
        BALL.replace("\"none\"", "\"initial\"").replace("step = 0.01\nsteps = 5", "step = 0.05\nsteps = 20"),
    );
    let (object, ran) = bench.json("track a.toml -o run");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for (group, keys) in [
        ("triangles", "initial min max final"),
        ("volume", "initial final relative_error"),
        ("operations", "splits flips collapses smoothed merges separations refused"),
        ("collisions", "repulsions impulses impact_zones rigid_zones dt_halvings"),
        ("intersections", "checked_steps max final"),
        ("seconds_per_step", "improvement topology velocity collisions compaction check total"),
        ("error", "linf l1 hausdorff"),
    ] {
        for key in keys.split(' ') {
            assert!(object[group][key].is_number(), "{group}.{key} in {object:#}");
        }
    }
    assert_eq!(
        (&object["steps"], &object["components"], &object["genus"]),
        (&20.into(), &1.into(), &0.into())
    );
    assert_eq!((number(&object, "/time"), &object["status"]), (1.0, &"finished".into()));
    assert_eq!(
        (&object["intersections"]["checked_steps"], &object["intersections"]["max"]),
        (&20.into(), &0.into())
    );
    // A full turn: the ball is where it was, up to remeshing and the error of the steps.
    assert!(number(&object, "/volume/relative_error").abs() < 0.05, "{object:#}");
    assert!(number(&object, "/error/hausdorff") < 0.1 && number(&object, "/error/l1") > 0.0, "{object:#}");
    // The report for scripts is the same object, apart from what only this process knows.
    let report: Value = serde_json::from_slice(&bench.read("run/report.json")).unwrap();
    for (key, value) in report.as_object().unwrap() {
        assert_eq!(value, &object[key], "{key}");
    }
    let lines = String::from_utf8(bench.read("run/stats.jsonl")).unwrap();
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 21);
    assert!(lines.iter().enumerate().all(|(step, line)| line["step"] == step));
    let frames: Vec<u64> = lines.iter().filter_map(|line| line["frame"].as_u64()).collect();
    assert_eq!(frames, (0..=10).collect::<Vec<_>>(), "after every second step");
}

#[test]
fn frames_are_surfaces_and_the_first_is_the_beginning() {
    let bench = Bench::new();
    let pictures = format!("{BALL}pictures = true\nsize = [60, 40]\n");
    bench.file("a.toml", pictures);
    let ran = bench.run("track a.toml -o run").ok();
    assert!(ran.out.contains("finished after 5 steps"), "{}", ran.out);
    bench.run("shape sphere --size 0.4 -o sphere.ply").ok();
    assert!(bench.read("run/surface/frame_0000.ply") == bench.read("sphere.ply"));
    let (checked, _) = bench.json("check run/surface/frame_0003.ply");
    assert_eq!(checked["files"][0]["self_intersecting_pairs"], 0);
    assert_eq!(checked["files"][0]["closed"], true);
    let list = String::from_utf8(bench.read("run/paraview/surface.pvd")).unwrap();
    for (time, frame) in [("0", 0), ("0.02", 1), ("0.04", 2), ("0.05", 3)] {
        let entry = format!("timestep=\"{time}\" part=\"0\" file=\"surface_{frame:04}.vtp\"");
        assert!(list.contains(&entry), "{entry} in {list}");
        assert!(bench.read(&format!("run/paraview/surface_{frame:04}.vtp")).starts_with(b"<?xml"));
        assert!(bench.read(&format!("run/preview/frame_{frame:04}.png")).starts_with(b"\x89PNG"));
    }
    let page = String::from_utf8(bench.read("run/report.html")).unwrap();
    assert_eq!((page.matches("<svg").count(), page.matches("data:image/png").count()), (5, 2));
}

/// Every example, coarser and for a few steps.
#[test]
fn the_examples_that_are_shipped_work() {
    let bench = Bench::new();
    let scenes = examples();
    assert_eq!(scenes.len(), 8);
    for scene in scenes {
        let name = scene.file_stem().unwrap().to_str().unwrap().to_owned();
        let text = std::fs::read_to_string(&scene).unwrap();
        let edge: f64 =
            text.split("\nedge_length = ").nth(1).unwrap().split('\n').next().unwrap().parse().unwrap();
        let coarse = format!("surface.edge_length={}", 2.0 * edge);
        let line = format!(
            "track {} -o {name} --steps 3 --set output.pictures=false --set {coarse}",
            scene.display()
        );
        let (object, ran) = bench.json(&line);
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        assert_eq!((&object["status"], &object["steps"]), (&"stopped".into(), &3.into()), "{name}");
        assert_eq!(object["intersections"]["max"], 0, "{name}");
        assert!(number(&object, "/triangles/initial") > 100.0, "{name}: {object:#}");
    }
}

/// A scene is told with every value that holds, and what is told is a scene.
#[test]
fn a_dry_run_tells_the_scene_and_writes_nothing() {
    let bench = Bench::new();
    bench.file("a.toml", BALL);
    let ran =
        bench.run("track a.toml --dry-run --set improvement.max_edge_rel=1.25 --set flow.scheme=euler").ok();
    assert!(
        ran.out.contains("max_edge_rel = 1.25\n") && ran.out.contains("scheme = \"euler\"\n"),
        "{}",
        ran.out
    );
    assert_eq!(bench.names(), ["a.toml"]);
    bench.file("b.toml", &ran.out);
    assert_eq!(bench.run("track b.toml --dry-run").ok().out, ran.out);
    let (object, _) = bench.json("track a.toml --dry-run");
    assert_eq!((&object["steps"], &object["scene"]["time"]["step"]), (&5.into(), &0.01.into()));
}

#[test]
fn the_seed_of_the_command_line_is_for_scenes_that_give_none() {
    let bench = Bench::new();
    bench.file("a.toml", BALL.replace("\"rotation\"", "\"jitter\""));
    let scene = |options: &str| bench.run(&format!("track a.toml --dry-run{options}")).ok().out;
    assert!(scene(" --seed 9").contains("seed = 9\n") && scene("").contains("seed = 0\n"));
    assert!(scene(" --seed 9 --set flow.seed=4").contains("seed = 4\n"));
}

#[test]
fn surfaces_of_several_parts_and_of_files_are_built() {
    let bench = Bench::new();
    bench.run("shape box --size 0.5 -o box.ply").ok();
    let parts = "[surface]\nedge_length = 0.5\n[[surface.parts]]\nshape = \"sphere\"\n[[surface.parts]]\n\
        file = \"box.ply\"\ntranslate = [5, 0, 0]\nscale = 0.5\n[flow]\nkind = \"shear\"\n[time]\nstep = 0.01\nsteps = 1\n";
    bench.file("a.toml", parts);
    let (object, ran) = bench.json("track a.toml -o run");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(object["components"], 2);
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((number(&object, "/volume/initial") / (ball + 1.0) - 1.0).abs() < 0.1, "{object:#}");
    // The resolved scene names the file and its content: another content is another scene.
    let scene = String::from_utf8(bench.read("run/scene.toml")).unwrap();
    assert!(scene.contains("checksum = \"crc32:"), "{scene}");
    bench.file("b.toml", &scene);
    bench.run("track b.toml --dry-run").ok();
    bench.run("shape box --size 1 -o box.ply --force").ok();
    let error = bench.fails("track b.toml -o other", "W5004", 5);
    assert!(error["what"].as_str().unwrap().contains("checksum"), "{error:#}");
    bench.fails("track a.toml -o run --resume", "W5009", 5);
}

/// Each fault of a scene, the line that is told, and a word of the help.
#[test]
fn faults_of_scenes_are_told_with_their_line() {
    let bench = Bench::new();
    let with = |before: &str, after: &str| BALL.replacen(before, after, 1);
    for (text, code, line, help) in [
        (with("kind = \"rotation\"", "kind = = 1"), "W5001", 6, "toml"),
        (with("edge_length", "edge_lenght"), "W5002", 4, "`edge_length`"),
        (with("[output]", "[outptu]"), "W5002", 10, "`output`"),
        (with("kind = \"rotation\"", "kind = \"rotation\"\ncentre = [0, 0, 0]"), "W5002", 7, "`center`"),
        (with("kind = \"rotation\"", "kind = \"rotation\"\nperiod = 3"), "W5002", 7, "angular_velocity"),
        (with("kind = \"rotation\"", "kind = \"rotations\""), "W5004", 6, "\"rotation\""),
        (with("kind = \"rotation\"", "kind = \"normal\""), "W5003", 5, "speed = ..."),
        (with("step = 0.01", "steq = 0.01"), "W5003", 7, "`steq`"),
        (with("step = 0.01", "step = \"short\""), "W5004", 8, ""),
        (with("step = 0.01", "step = -1"), "W5004", 8, ""),
        (with("steps = 5", "steps = 5\nend = 2"), "W5004", 10, ""),
        (with("steps = 5", ""), "W5004", 7, "steps"),
        (with("shape = \"sphere\"", "shape = \"spere\""), "W5004", 3, "--list"),
        (with("shape = \"sphere\"", ""), "W5004", 2, "shape ="),
        (with("exact = \"none\"", "exact = \"offset\""), "W5004", 1, ""),
        (with("[time]", "[improvement]\nmax_edge_rel = 0.1\n[time]"), "W5004", 7, ""),
        (with("[time]", "[integration]\nsweeps = 1.5\n[time]"), "W5004", 8, ""),
        (with("[time]", "[topology]\nenabled = \"no\"\n[time]"), "W5004", 8, ""),
        (with("every = 2", "every = 0"), "W5004", 11, ""),
    ] {
        bench.file("a.toml", &text);
        let error = bench.fails("track a.toml -o run", code, 5);
        assert_eq!(error["where"][0], format!("a.toml:{line}"), "{text}: {error:#}");
        assert!(error["help"].as_str().unwrap().contains(help), "{text}: {error:#}");
    }
    bench.file("a.toml", BALL);
    let error = bench.fails("track a.toml -o run --set time.stepp=1", "W5002", 5);
    assert_eq!(error["where"][0], "--set time.stepp=1");
    let error = bench.fails("track a.toml -o run --set time.step=soon", "W5004", 5);
    assert_eq!(error["where"][0], "--set time.step=soon");
    bench.fails("track a.toml -o run --set time.step", "W2001", 2);
    bench.fails("track a.toml -o run --set time.step.x=1", "W5004", 5);
    assert_eq!(bench.names(), ["a.toml"], "nothing was written");
}

#[test]
fn what_is_wrong_outside_of_the_scene_is_told_too() {
    let bench = Bench::new();
    bench.file("a.toml", BALL);
    bench.fails("track b.toml -o run", "W4001", 4);
    bench.fails("track a.toml", "W2001", 2);
    bench.fails("track a.toml -o -", "W7002", 7);
    bench.fails("track a.toml -o no/run", "W7001", 7);
    bench.fails("track a.toml -o run --resume --force", "W2001", 2);
    bench.fails("track a.toml -o a.toml", "W7003", 7);
    bench.fails("track a.toml -o run --set surface.edge_length=3e-4", "W6001", 6);
    bench.fails("track a.toml -o run --set surface.edge_length=1e-7", "W6002", 6);
    bench.fails(
        "track a.toml -o run --set surface.shape=two-boxes --set surface.edge_length=0.5",
        "W3024",
        3,
    );
    bench.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    bench.file("fan.toml", BALL.replace("shape = \"sphere\"", "file = \"open.obj\""));
    bench.fails("track fan.toml -o run", "W3023", 3);
    bench.file("lost.toml", BALL.replace("shape = \"sphere\"", "file = \"lost.obj\""));
    bench.fails("track lost.toml -o run", "W4001", 4);
    assert!(!bench.exists("run"), "a folder that was made for nothing is taken away");
    bench.file("results.txt", "dear to somebody");
    for start in ["", " --force", " --resume"] {
        bench.fails(&format!("track a.toml -o .{start}"), "W7007", 7);
    }
    if permissions_bind(&bench) {
        use std::os::unix::fs::PermissionsExt;
        let locked = bench.path("locked");
        std::fs::create_dir(&locked).unwrap();
        std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o500)).unwrap();
        bench.fails("track a.toml -o locked", "W7002", 7);
        bench.fails("track a.toml -o locked/run", "W7002", 7);
        std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o700)).unwrap();
    } else {
        println!("permissions do not bind this user: folders that cannot be written are not tried");
    }
}
