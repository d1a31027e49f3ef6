//! Ctrl-C while the command waits for standard input: exit 130, no half-written file; and when it tells its result: nothing.

use crate::harness::{Bench, Ran};
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A conversion that waits for its input, started and with its temporary file made.
fn waiting(bench: &Bench, json: bool) -> Child {
    let mut args = vec!["convert", "-", "--from", "obj", "-o", "out.ply"];
    if json {
        args.push("--json");
    }
    let child = bench.command(&args).stdin(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while bench.names().is_empty() {
        assert!(start.elapsed() < Duration::from_secs(60), "the temporary file never came");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

/// By the shell's own `kill`: there is not always a program of that name.
fn kill(child: &Child) {
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
}

fn interrupt(mut child: Child) -> Ran {
    let _held_open = child.stdin.take();
    kill(&child);
    Ran::of(child.wait_with_output().unwrap())
}

#[test]
fn ctrl_c_is_130_and_leaves_nothing() {
    let bench = Bench::new();
    let child = waiting(&bench, false);
    assert!(bench.names()[0].ends_with(".part"), "written under a temporary name: {:?}", bench.names());
    let ran = interrupt(child);
    assert_eq!(ran.exit, Some(130), "{}", ran.err);
    assert!(ran.err.contains("error[W0130]: interrupted"), "{}", ran.err);
    assert_eq!(bench.names(), [""; 0]);
}

#[test]
fn ctrl_c_gives_one_json_object_too() {
    let bench = Bench::new();
    let ran = interrupt(waiting(&bench, true));
    assert_eq!(ran.exit, Some(130), "{}", ran.err);
    let object: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(object["error"]["code"], "W0130");
}

#[test]
fn ctrl_c_after_the_work_changes_nothing() {
    let bench = Bench::new();
    // Triangles of a hundred planes through one line, where all pairs of them intersect.
    let triangles = (0..100).map(|k| {
        let (sine, cosine) = (0.03 * f64::from(k)).sin_cos();
        let corners = [[0.0, 1.0], [1.0, -1.0], [2.0, 1.0]];
        let corners = corners.map(|[x, side]| format!("v {x} {} {}\n", side * cosine, side * sine));
        corners.concat() + &format!("f {} {} {}\n", 3 * k + 1, 3 * k + 2, 3 * k + 3)
    });
    bench.file("a.obj", triangles.collect::<String>());
    let args = ["check", "a.obj", "--pairs", "--json"];
    let whole = bench.run_args(&args);
    // More than a pipe holds: the command waits until the rest is taken.
    assert!(whole.out.len() > 1 << 17, "{} bytes", whole.out.len());
    let mut child = bench.command(&args).spawn().unwrap();
    let mut out = vec![0];
    child.stdout.as_mut().unwrap().read_exact(&mut out).unwrap();
    kill(&child);
    std::thread::sleep(Duration::from_millis(50));
    let rest = Ran::of(child.wait_with_output().unwrap());
    assert_eq!((rest.exit, rest.err.contains("W0130")), (whole.exit, false), "{}", rest.err);
    let text = String::from_utf8(out).unwrap() + &rest.out;
    let pairs =
        |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap()["files"][0]["pairs"].clone();
    assert_eq!(pairs(&text), pairs(&whole.out));
}
