//! `welter report`: the report of a run, made again from what the run wrote.

use crate::harness::Bench;
use crate::track::BALL;
use std::fs;

const PUFF: &str = "[[emissions]]\nshape = \"sphere\"\nscale = 0.3\nedge_length = 0.15\n[[flows]]\nkind = \"ring\"\n\
    radius = 0.5\ncore = 0.2\n[time]\nstep = 0.04\nsteps = 3\n";

#[test]
fn a_report_that_was_lost_is_made_again_byte_for_byte() {
    let bench = Bench::new();
    bench.file("track.toml", BALL);
    bench.file("sim.toml", PUFF);
    for command in ["track", "sim"] {
        bench.run(&format!("{command} {command}.toml -o {command}")).ok();
        let names = ["report.html", "report.json"].map(|name| format!("{command}/{name}"));
        let before = names.clone().map(|name| bench.read(&name));
        names.iter().for_each(|name| fs::remove_file(bench.path(name)).unwrap());
        let (object, ran) = bench.json(&format!("report {command}"));
        assert_eq!((ran.exit, &object["status"]), (Some(0), &"finished".into()), "{}", ran.err);
        assert_eq!(names.map(|name| bench.read(&name)), before, "{command}");
        assert!(!bench.exists(&format!("{command}/lock")));
    }
}

/// A run that was stopped in the middle, as a kill leaves it: the record says that it goes on, and lines are there
/// beyond the newest checkpoint.
#[test]
fn a_run_that_could_not_tell_is_told_of_up_to_its_checkpoint() {
    let bench = Bench::new();
    bench.file("a.toml", BALL.replace("steps = 5", "steps = 50"));
    bench.run("track a.toml -o run --steps 4").ok();
    let record = String::from_utf8(bench.read("run/run.json")).unwrap();
    bench.file("run/run.json", record.replace("\"stopped\"", "\"running\""));
    let mut lines = String::from_utf8(bench.read("run/stats.jsonl")).unwrap();
    lines.push_str("{\"step\":5,\"time\":9.0}\n{\"step\":6,\"ti");
    bench.file("run/stats.jsonl", &lines);
    let (object, ran) = bench.json("report run");
    assert_eq!(
        (ran.exit, &object["status"], &object["steps"]),
        (Some(0), &"running".into(), &4.into()),
        "{}",
        ran.err
    );
    assert_eq!(bench.read("run/stats.jsonl"), lines.as_bytes(), "only the report is written");
}

#[test]
fn folders_without_a_run_are_refused() {
    let bench = Bench::new();
    bench.fails("report nowhere", "W4001", 4);
    fs::create_dir(bench.path("empty")).unwrap();
    bench.fails("report empty", "W4013", 4);
    bench.file("a.toml", BALL);
    bench.run("track a.toml -o run").ok();
    fs::remove_dir_all(bench.path("run/checkpoint")).unwrap();
    bench.fails("report run", "W4013", 4);
}
