//! `welter check`: what it says of surfaces that can be checked.

use crate::harness::{Bench, TETRAHEDRON, real_meshes};
use serde_json::{Value, json};

/// The keys of one file that scripts rely on.
const KEYS: [&str; 19] = [
    "file",
    "vertices",
    "triangles",
    "components",
    "closed",
    "oriented",
    "edge_manifold",
    "vertex_manifold",
    "euler_characteristic",
    "genus",
    "volume",
    "area",
    "bounding_box",
    "degenerate_triangles",
    "duplicate_vertices",
    "non_finite_vertices",
    "self_intersecting_pairs",
    "inside_out_components",
    "seconds",
];

/// The findings on one file that exits with 0.
fn findings(bench: &Bench, line: &str) -> Value {
    let (object, ran) = bench.json(line);
    assert_eq!(ran.exit, Some(0), "{line}: {}", ran.err);
    object["files"][0].clone()
}

#[test]
fn a_tetrahedron_has_every_key_of_the_contract() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let file = findings(&bench, "check t.obj");
    for key in KEYS {
        assert!(!file[key].is_null(), "{key}");
    }
    assert_eq!(
        (
            &file["vertices"],
            &file["triangles"],
            &file["components"],
            &file["genus"],
            &file["euler_characteristic"]
        ),
        (&json!(4), &json!(4), &json!(1), &json!(0), &json!(2))
    );
    assert!((file["volume"].as_f64().unwrap() - 1.0 / 6.0).abs() < 1e-15);
    assert_eq!(file["bounding_box"], json!([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]));
    assert!(file.get("pairs").is_none(), "only with --pairs");
}

#[test]
fn the_verdict_of_a_tetrahedron() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let ran = bench.run("check t.obj").ok();
    assert_eq!(ran.err, "");
    assert_eq!(
        ran.out,
        "t.obj\n\
         \x20 vertices                      4     closed                   yes\n\
         \x20 triangles                     4     oriented                 yes\n\
         \x20 components                    1     edge-manifold            yes\n\
         \x20 genus                         0     vertex-manifold          yes\n\
         \x20 Euler characteristic          2     degenerate triangles       0\n\
         \x20 area                    2.36603     duplicate vertices         0\n\
         \x20 volume                 0.166667     duplicate triangles        0\n\
         \x20 inside-out components         0     self-intersecting pairs    0\n\
         \x20 bounding box  (0, 0, 0) .. (1, 1, 1)\n\
         t.obj: closed, consistently oriented, free of self-intersection\n"
    );
}

#[test]
fn an_open_mesh_is_reported_not_refused() {
    let bench = Bench::new();
    bench.file("open.obj", TETRAHEDRON.replace("f 2 3 4\n", ""));
    let file = findings(&bench, "check open.obj");
    assert_eq!(
        (&file["closed"], &file["oriented"], &file["boundary_edges"]),
        (&json!(false), &json!(true), &json!(3))
    );
    assert!(file["volume"].is_null(), "an open surface bounds no volume");
    let ran = bench.run("check open.obj").ok();
    assert!(ran.out.contains("open (3 boundary edges), consistently oriented"), "{}", ran.out);
}

#[test]
fn a_moebius_band_is_not_consistently_oriented() {
    let bench = Bench::new();
    // A band of five squares with a half twist.
    let mut text = String::new();
    for k in 0..5 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 5.0).sin_cos();
        let (up, out) = (f64::from(k) * std::f64::consts::PI / 5.0).sin_cos();
        for side in [-0.3, 0.3] {
            text += &format!("v {} {} {}\n", (1.0 + side * out) * cos, (1.0 + side * out) * sin, side * up);
        }
    }
    for k in 0..5 {
        let [a, b] = [2 * k + 1, 2 * k + 2];
        let [c, d] = if k == 4 { [2, 1] } else { [a + 2, b + 2] };
        text += &format!("f {a} {c} {b}\nf {b} {c} {d}\n");
    }
    bench.file("moebius.obj", text);
    let file = findings(&bench, "check moebius.obj");
    assert_eq!(file["oriented"], false);
    assert_eq!(file["inconsistent_edges"], 1);
    assert_eq!((&file["closed"], &file["boundary_loops"]), (&json!(false), &json!(1)));
    assert_eq!(file["euler_characteristic"], 0);
    bench.fails("check moebius.obj --require oriented", "W3022", 3);
}

#[test]
fn pairs_are_listed_sorted_and_number_what_is_counted() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.obj").ok();
    let file = findings(&bench, "check a.obj --pairs");
    let pairs: Vec<[u32; 2]> = serde_json::from_value(file["pairs"].clone()).unwrap();
    assert_eq!(file["self_intersecting_pairs"], pairs.len());
    assert!(!pairs.is_empty() && pairs.is_sorted() && pairs.iter().all(|[i, j]| i < j));
    let text = bench.run("check a.obj --pairs").ok().out;
    let listed: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("a.obj: ")).skip(1).collect();
    assert_eq!(listed.len(), pairs.len());
    assert_eq!(listed[0], format!("{} {}", pairs[0][0], pairs[0][1]));
}

#[test]
fn the_offending_triangles_are_saved_in_colour() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.obj").ok();
    let (object, _) = bench.json("check a.obj --pairs --save-bad bad.ply");
    let pairs: Vec<[u32; 2]> = serde_json::from_value(object["files"][0]["pairs"].clone()).unwrap();
    let mut ids: Vec<u32> = pairs.into_iter().flatten().collect();
    ids.sort_unstable();
    ids.dedup();
    let saved = bench.json("info bad.ply").0;
    assert_eq!(saved["files"][0]["triangles"], ids.len());
    assert_eq!(saved["files"][0]["triangle_colors"], true);
    assert_eq!(object["save_bad"]["triangles"], ids.len());
    bench.fails("check a.obj --save-bad bad.ply", "W7003", 7);
    bench.fails("check a.obj a.obj --save-bad worse.ply", "W2001", 2);
    bench.fails("check a.obj --save-bad -", "W2006", 2);
}

#[test]
fn a_surface_without_fault_saves_no_triangle() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let (object, ran) = bench.json("check t.obj --save-bad bad.ply");
    assert_eq!((ran.exit, &object["save_bad"]["triangles"]), (Some(0), &json!(0)));
    assert_eq!(bench.json("info bad.ply").0["files"][0]["triangles"], 0);
}

#[test]
fn require_makes_a_gate() {
    let bench = Bench::new();
    bench.file("good.obj", TETRAHEDRON).file("open.obj", TETRAHEDRON.replace("f 2 3 4\n", ""));
    bench.run("shape ring-overlap -o ring.obj --size 0.2").ok();
    bench.run("check good.obj --require closed,oriented,manifold,embedded").ok();
    bench.fails("check open.obj --require closed", "W3021", 3);
    bench.fails("check good.obj open.obj --require embedded", "W3021", 3);
    bench.fails("check ring.obj --require embedded", "W3024", 3);
    // Two tetrahedra that share an edge: four triangles on it.
    bench.file("edge.obj", format!("{TETRAHEDRON}v -1 0 0\nv 0 -1 0\nf 1 4 5\nf 1 5 6\nf 1 6 4\nf 4 6 5\n"));
    bench.run("check edge.obj --require closed,oriented").ok();
    bench.fails("check edge.obj --require manifold", "W3023", 3);
}

#[test]
fn quiet_says_nothing_but_errors() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let ran = bench.run("check t.obj -q").ok();
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
    assert!(bench.run("check -q nothing.obj").err.starts_with("error[W4001]"));
}

#[test]
fn with_json_text_for_people_is_on_standard_error() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let (_, ran) = bench.json("check t.obj");
    assert!(ran.err.contains("t.obj: closed, consistently oriented"), "{}", ran.err);
    assert!(bench.json("check -q t.obj").1.err.is_empty());
}

#[test]
fn verbose_tells_the_stages_and_their_seconds() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let ran = bench.run("check -v t.obj").ok();
    for stage in ["reading", "topology", "self-intersections", "total"] {
        assert!(
            ran.err.lines().any(|line| line.starts_with(stage) && line.ends_with(" s")),
            "{stage}: {}",
            ran.err
        );
    }
}

#[test]
fn progress_comes_as_lines_or_as_json() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.obj").ok();
    let plain = bench.run("check a.obj --progress plain").ok();
    assert!(plain.err.lines().any(|line| line.ends_with("100 %")), "{}", plain.err);
    let json = bench.run("check a.obj --progress json -q").ok();
    for line in json.err.lines() {
        let object: Value = serde_json::from_str(line).unwrap();
        assert!(object["stage"].is_string() && object["done"].is_u64(), "{line}");
        let [done, total] = ["done", "total"].map(|key| object[key].as_f64().unwrap());
        let left = object["seconds_left"].as_f64();
        assert_eq!(
            (left.is_some(), left == Some(0.0)),
            (done > 0.0 && total > 0.0, done == total && done > 0.0),
            "{line}"
        );
    }
    assert_eq!(bench.run("check a.obj --progress none -q").ok().err, "");
}

#[test]
fn the_same_answer_for_any_number_of_threads() {
    let bench = Bench::new();
    bench.run("shape figure-eight -o a.ply --size 0.1").ok();
    let with = |threads: &str| {
        let mut file = findings(&bench, &format!("check a.ply --pairs -j {threads}"));
        file.as_object_mut().unwrap().remove("seconds");
        file.to_string()
    };
    let one = with("1");
    assert!(one == with("2") && one == with("7"));
}

#[test]
fn shapes_are_what_their_list_says() {
    let bench = Bench::new();
    for shape in bench.json("shape --list").0["shapes"].as_array().unwrap() {
        let name = shape["name"].as_str().unwrap();
        bench.run(&format!("shape {name} -o {name}.ply --size 0.2")).ok();
        let file = findings(&bench, &format!("check {name}.ply"));
        assert_eq!(file["components"], shape["components"], "{name}");
        assert_eq!((&file["closed"], &file["oriented"]), (&json!(true), &json!(true)), "{name}");
        let intersects = file["self_intersecting_pairs"].as_u64().unwrap() > 0;
        assert_eq!(shape["self_intersecting"], intersects, "{name}");
    }
}

#[test]
fn touching_vertices_that_are_not_welded_count_by_index_only() {
    let bench = Bench::new();
    // Two triangles along one edge, each with its own vertices.
    bench.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n");
    let pairs =
        |options: &str| findings(&bench, &format!("check a.obj{options}"))["self_intersecting_pairs"].clone();
    assert_eq!((pairs(""), pairs(" --shared-by index")), (json!(0), json!(1)));
    assert_eq!(findings(&bench, "check a.obj")["duplicate_vertices"], 2);
}

#[test]
fn real_meshes_have_their_known_topology() {
    let Some(folder) = real_meshes() else {
        println!("skipped: no folder of real meshes");
        return;
    };
    // File, triangles, components, genus.
    let known = [
        ("manifold_self_intersectA.obj", 17_160, 1, 0),
        ("simpleBridge_39comp.obj", 32_014, 39, 0),
        ("openscad_nonmanifold_crash.obj", 1_442, 2, 4),
        ("manifold_offset1.obj", 4_418, 39, 0),
        ("manifold_generic_twin_right.obj", 11_656, 1, 0),
        ("comb.obj", 9_816, 1, 0),
        ("spot.obj", 5_856, 1, 0),
    ];
    let paths: Vec<String> = known.iter().map(|(name, ..)| folder.join(name).display().to_string()).collect();
    let bench = Bench::new();
    let (object, ran) = bench.json(&format!("check {}", paths.join(" ")));
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for ((name, triangles, components, genus), file) in known.iter().zip(object["files"].as_array().unwrap())
    {
        assert_eq!(
            (&file["triangles"], &file["components"], &file["genus"], &file["closed"], &file["oriented"]),
            (&json!(triangles), &json!(components), &json!(genus), &json!(true), &json!(true)),
            "{name}"
        );
    }
    let pairs = |k: usize| object["files"][k]["self_intersecting_pairs"].as_u64().unwrap();
    // As in the tests of the exact list, where rationals confirm them.
    assert_eq!([0, 1, 2, 3, 4, 5, 6].map(pairs), [338, 4_250, 7_556, 52, 64, 0, 0]);
}
