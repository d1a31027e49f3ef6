//! The table of error codes.

use crate::harness::Bench;

/// Every source file of these tests: where codes are tried.
const TESTS: [&str; 18] = [
    include_str!("bad_input.rs"),
    include_str!("ccd.rs"),
    include_str!("check.rs"),
    include_str!("convert.rs"),
    include_str!("demo.rs"),
    include_str!("doctor.rs"),
    include_str!("interrupt.rs"),
    include_str!("isosurface.rs"),
    include_str!("mesh.rs"),
    include_str!("mesh_of_curves.rs"),
    include_str!("new.rs"),
    include_str!("outputs.rs"),
    include_str!("render.rs"),
    include_str!("shape.rs"),
    include_str!("track.rs"),
    include_str!("track_runs.rs"),
    include_str!("usage.rs"),
    include_str!("view.rs"),
];

/// Codes that no command line can bring about on a healthy machine, and where they are tried instead.
const ELSEWHERE: [&str; 5] = [
    "W1002", // a wrong answer of a predicate: unit test of `doctor`
    "W4009", // a disk that does not deliver: unit test of `input`
    "W6002", // more than 2^32 elements: unit test of `input`
    "W6005", // a quarter of a gigabyte of frames: unit test of `view`
    "W9003", // a wrong mesh: unit test of `mesh`
];

#[test]
fn every_code_is_tried_by_a_test() {
    let (object, _) = Bench::new().json("doctor --codes");
    for code in object["codes"].as_array().unwrap() {
        let id = code["code"].as_str().unwrap();
        let tried = TESTS.iter().any(|source| source.contains(id));
        assert!(tried || ELSEWHERE.contains(&id), "{id} is tried nowhere");
    }
}

#[test]
fn every_code_tried_is_in_the_table() {
    let table = Bench::new().run("doctor --codes").ok().out;
    for source in TESTS {
        for (at, _) in source.match_indices("\"W") {
            let id = &source[at + 1..at + 6];
            assert!(table.contains(id), "{id} is not in the table");
        }
    }
}
