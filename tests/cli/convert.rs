//! `welter convert`.

use crate::harness::{Bench, Ran, TETRAHEDRON};
use std::io::Write;
use std::process::Stdio;

#[test]
fn every_format_and_back_keeps_the_surface() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o start.obj").ok();
    let start = bench.json("info start.obj").0;
    for (k, line) in ["start.obj -o a.ply", "a.ply -o b.off", "b.off -o c.ply --ascii", "c.ply -o end.obj"]
        .into_iter()
        .enumerate()
    {
        let ran = bench.run(&format!("convert {line}")).ok();
        assert!(k > 1 || !ran.err.contains("dropped"), "{}", ran.err);
    }
    let end = bench.json("info end.obj").0;
    for key in ["vertices", "triangles", "bounding_box"] {
        assert_eq!(start["files"][0][key], end["files"][0][key], "{key}");
    }
}

#[test]
fn what_a_format_cannot_hold_is_told() {
    let bench = Bench::new();
    bench.file("t.obj", format!("g lower\n{TETRAHEDRON}"));
    let (object, ran) = bench.json("convert t.obj -o t.off");
    assert_eq!(object["files"][0]["dropped"].as_array().unwrap().len(), 1, "{object:#}");
    assert!(ran.err.contains("note: t.off: 1 groups not written"), "{}", ran.err);
}

#[test]
fn a_sequence_keeps_its_numbers() {
    let bench = Bench::new();
    for name in ["f_0007.obj", "f_0008.obj", "f_0010.obj", "f_12.obj", "g_0001.obj"] {
        bench.file(name, TETRAHEDRON);
    }
    bench.run_args(&["convert", "f_%04d.obj", "-o", "p_%02d.ply"]).ok();
    bench.run_args(&["convert", "f_%04d.obj", "-o", "q_{}.off"]).ok();
    let made: Vec<String> = bench.names().into_iter().filter(|name| !name.ends_with(".obj")).collect();
    assert_eq!(made, ["p_07.ply", "p_08.ply", "p_10.ply", "q_0007.off", "q_0008.off", "q_0010.off"]);
}

#[test]
fn sequences_on_one_side_only_without_files_or_with_a_number_twice_fail() {
    let bench = Bench::new();
    bench.file("f_1.obj", TETRAHEDRON).file("f_01.obj", TETRAHEDRON);
    bench.fails("convert f_%04d.obj -o one.ply", "W2004", 2);
    bench.fails("convert f_1.obj -o p_{}.ply", "W2004", 2);
    bench.fails("convert f_{}.obj -o p_{}.ply", "W2004", 2);
    bench.fails("convert h_{}.obj -o p_{}.ply", "W4011", 4);
}

#[test]
fn no_frame_is_written_when_one_output_exists() {
    let bench = Bench::new();
    bench.file("f_1.obj", TETRAHEDRON).file("f_2.obj", TETRAHEDRON).file("p_2.ply", "mine");
    bench.fails("convert f_{}.obj -o p_{}.ply", "W7003", 7);
    assert!(!bench.exists("p_1.ply"));
    assert_eq!(bench.read("p_2.ply"), b"mine");
}

#[test]
fn defects_can_be_left_out() {
    let bench = Bench::new();
    bench.file("bad.obj", format!("{TETRAHEDRON}v nan 0 0\nf 1 1 2\nf 1 2 5\n"));
    let (object, _) = bench.json("convert bad.obj -o good.ply --drop-defects");
    assert_eq!(object["files"][0]["triangles"], 4);
    assert_eq!(object["files"][0]["vertices"], 4);
    assert_eq!(object["files"][0]["dropped"].as_array().unwrap().len(), 2);
}

#[test]
fn standard_input_and_output_take_surfaces() {
    let bench = Bench::new();
    let mut child = bench
        .command(&["convert", "-", "--from", "obj", "-o", "-", "--to", "off"])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(TETRAHEDRON.as_bytes()).unwrap();
    let ran = Ran::of(child.wait_with_output().unwrap()).ok();
    assert!(ran.out.starts_with("OFF"), "{}", ran.out);
}
