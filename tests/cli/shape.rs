//! `welter shape`.

use crate::harness::Bench;

#[test]
fn the_list_names_the_shapes_of_the_contract() {
    let (object, _) = Bench::new().json("shape --list");
    let names: Vec<&str> =
        object["shapes"].as_array().unwrap().iter().map(|shape| shape["name"].as_str().unwrap()).collect();
    for name in [
        "sphere",
        "torus",
        "dumbbell",
        "ring-overlap",
        "figure-eight",
        "double-moebius",
        "two-boxes",
        "nested-boxes",
        "helix-overlap",
        "trefoil-overlap",
    ] {
        assert!(names.contains(&name), "{name}");
    }
}

#[test]
fn every_listed_shape_can_be_written() {
    let bench = Bench::new();
    let (object, _) = bench.json("shape --list");
    for shape in object["shapes"].as_array().unwrap() {
        let name = shape["name"].as_str().unwrap();
        let (written, ran) = bench.json(&format!("shape {name} -o {name}.ply"));
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        assert!(written["triangles"].as_u64().unwrap() > 0);
        assert!(bench.exists(&format!("{name}.ply")));
    }
}

#[test]
fn a_smaller_size_makes_more_triangles() {
    let bench = Bench::new();
    let triangles = |line: &str| bench.json(line).0["triangles"].as_u64().unwrap();
    assert!(triangles("shape torus -o a.ply --size 0.1") > triangles("shape torus -o b.ply --size 0.4"));
}

#[test]
fn standard_output_takes_a_shape() {
    let ran = Bench::new().run("shape box -o - --to obj").ok();
    assert!(ran.out.lines().any(|line| line.starts_with("v ")), "{}", ran.out);
    assert!(ran.err.contains("note: -: box"), "{}", ran.err);
}

#[test]
fn mistakes_are_told() {
    let bench = Bench::new();
    let error = bench.fails("shape tours -o a.ply", "W2002", 2);
    assert!(error["help"].as_str().unwrap().contains("torus"));
    bench.fails("shape torus -o a.ply --size -1", "W2003", 2);
    bench.fails("shape torus -o a.ply --size nan", "W2003", 2);
    bench.fails("shape torus -o a.ply --size 1e-9", "W2003", 2);
    bench.fails("shape torus", "W2001", 2);
    bench.fails("shape torus -o a.docx", "W4002", 4);
    assert_eq!(bench.run("shape torus -o -").exit, Some(4), "no format is known for a stream");
    assert_eq!(bench.names(), [""; 0], "nothing was written");
}

#[test]
fn standard_output_cannot_take_both_the_shape_and_the_object() {
    let ran = Bench::new().run("shape box -o - --to obj --json");
    assert_eq!(ran.exit, Some(2));
    assert!(ran.err.contains("error[W2006]"), "{}", ran.err);
}

#[test]
fn words_become_a_surface() {
    let bench = Bench::new();
    let args = ["shape", "text", "--text", "Hi\nyou", "--size", "0.1", "-o", "a.ply"];
    bench.run_args(&args).ok();
    let (object, _) = bench.json("check a.ply");
    let file = &object["files"][0];
    // H, the two parts of i, and the three letters below.
    assert_eq!((file["components"].as_u64(), file["closed"].as_bool()), (Some(6), Some(true)), "{file:#}");
    bench.fails("shape torus --text a -o b.ply", "W2001", 2);
    let blank = ["shape", "text", "--text", " ", "-o", "b.ply"];
    let ran = bench.run_args(&blank);
    assert_eq!(ran.exit, Some(2));
    assert!(ran.err.contains("error[W2008]: text: the text has no visible character"), "{}", ran.err);
}
