//! `welter doctor`, and the report of an own bug.

use crate::harness::Bench;
use serde_json::Value;

#[test]
fn every_check_passes_here() {
    let (object, ran) = Bench::new().json("doctor");
    assert_eq!(ran.exit, Some(0));
    let checks = object["checks"].as_array().unwrap();
    assert!(checks.iter().all(|check| check["ok"] == true), "{object:#}");
    assert!(checks.iter().any(|check| check["name"] == "predicates"));
    assert!(ran.err.contains("known answers reproduced"), "text for people goes to standard error");
}

#[test]
fn the_number_of_threads_is_the_one_asked_for() {
    let (object, _) = Bench::new().json("doctor -j 3");
    assert_eq!(object["threads"], 3);
}

#[test]
fn an_own_bug_leaves_a_file_that_reproduces_it() {
    let bench = Bench::new();
    bench.fails("doctor --panic", "W1001", 1);
    let record = bench.names().into_iter().find(|name| name.starts_with("welter-bug-")).unwrap();
    let record: Value = serde_json::from_slice(&bench.read(&record)).unwrap();
    assert_eq!(record["command"][1], "doctor");
    assert!(record["panic"]["place"].as_str().unwrap().contains("doctor.rs"));
    assert!(record["panic"]["backtrace"].as_str().is_some());
}
