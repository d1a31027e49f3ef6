//! Ctrl-C while the command waits for standard input: exit 130, no half-written file.

use crate::harness::{Bench, Ran};
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

fn interrupt(mut child: Child) -> Ran {
    let _held_open = child.stdin.take();
    // The shell's own `kill`: there is not always a program of that name.
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
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
