//! `welter info`.

use crate::harness::{Bench, TETRAHEDRON};

#[test]
fn a_file_is_described() {
    let bench = Bench::new();
    bench.file("t.obj", format!("g lower\n{TETRAHEDRON}g\n"));
    let (object, ran) = bench.json("info t.obj");
    let file = &object["files"][0];
    assert_eq!(file["format"], "obj");
    assert_eq!(file["vertices"], 4);
    assert_eq!(file["triangles"], 4);
    assert_eq!(file["bounding_box"], serde_json::json!([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]));
    assert_eq!(file["groups"][0]["name"], "lower");
    assert!(ran.err.contains("bounding box  (0, 0, 0) .. (1, 1, 1)"), "{}", ran.err);
}

#[test]
fn a_folder_is_a_table_that_survives_a_bad_file() {
    let bench = Bench::new();
    bench.file("a.obj", TETRAHEDRON).file("b.obj", "v 0 0 zero\n").file("notes.txt", "not a surface");
    let (object, ran) = bench.json("info .");
    assert_eq!(ran.exit, Some(4));
    assert_eq!(object["files"][0]["triangles"], 4);
    assert_eq!(object["files"][1]["error"]["code"], "W4006");
    assert_eq!(object["files"].as_array().unwrap().len(), 2);
    assert!(ran.err.contains("./b.obj:1"), "{}", ran.err);
}

#[test]
fn non_finite_vertices_are_counted_and_kept_out_of_the_box() {
    let bench = Bench::new();
    bench.file("n.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 inf\nv 2 3 4\nf 1 2 3\n");
    let (object, _) = bench.json("info n.obj");
    assert_eq!(object["files"][0]["non_finite_vertices"], 2);
    assert_eq!(object["files"][0]["bounding_box"][1], serde_json::json!([2.0, 3.0, 4.0]));
}
