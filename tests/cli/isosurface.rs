//! `welter isosurface`.

use crate::harness::Bench;
use serde_json::Value;
use std::path::{Path, PathBuf};

const BALL: &str = "[grid]\ncells = 16\n[field]\nkind = \"ball\"\nradius = 1\n";

/// The scenes that are shipped.
fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/isosurface")
}

fn number(object: &Value, key: &str) -> f64 {
    object[key].as_f64().unwrap_or_else(|| panic!("{key} in {object:#}"))
}

#[test]
fn a_ball_is_what_it_is() {
    let bench = Bench::new();
    bench.file("ball.toml", BALL);
    let (object, ran) = bench.json("isosurface ball.toml -o ball.ply");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!((object["input"].as_str(), object["output"].as_str()), (Some("ball.toml"), Some("ball.ply")));
    // The box of the ball, and two cells on each side.
    assert_eq!(object["grid"], serde_json::json!([20, 20, 20]));
    assert_eq!(object["cells"], 8000);
    assert_eq!((&object["components"], &object["euler_characteristic"]), (&1.into(), &2.into()));
    let (vertices, triangles) = (number(&object, "vertices"), number(&object, "triangles"));
    assert_eq!(2.0 * vertices, triangles + 4.0);
    let pi = std::f64::consts::PI;
    assert!((number(&object, "volume") / (4.0 / 3.0 * pi) - 1.0).abs() < 0.01);
    assert!((number(&object, "area") / (4.0 * pi) - 1.0).abs() < 0.01);
    assert!(number(&object["seconds"], "total") > 0.0);
    let (checked, _) = bench.json("check ball.ply");
    assert_eq!(checked["files"][0]["triangles"], object["triangles"]);
    assert_eq!(checked["files"][0]["self_intersecting_pairs"], 0);
}

#[test]
fn triangles_can_be_made_near_equilateral() {
    let bench = Bench::new();
    let scene = |surface: &str| format!("{BALL}[surface]\nlevel = 0.1\n{surface}");
    bench.file("plain.toml", scene("")).file("good.toml", scene("triangles = \"equilateral\""));
    let (plain, _) = bench.json("isosurface plain.toml -o plain.ply");
    let (good, ran) = bench.json("isosurface good.toml -o good.ply");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert!(number(&plain, "smallest_angle") < 10.0 && number(&good, "smallest_angle") > 20.0, "{good:#}");
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 1.1_f64.powi(3);
    assert!((number(&good, "volume") / volume - 1.0).abs() < 0.01, "{good:#}");
    assert_eq!(good["euler_characteristic"], 2);
    bench.file("open.toml", scene("triangles = \"equilateral\"\nwall = \"open\""));
    bench.fails("isosurface open.toml -o open.ply", "W5004", 5);
}

/// Every example, its surface checked, its slice drawn, its samples written.
#[test]
fn the_examples_that_are_shipped_work() {
    let bench = Bench::new();
    // Handles of the surface: what can be said beforehand.
    for (name, components, genus) in
        [("blobs", 1, None), ("gyroid", 1, None), ("offset", 1, Some(1)), ("text", 1, Some(0))]
    {
        let scene = examples().join(format!("{name}.toml"));
        let line = format!(
            "isosurface {} -o {name}.ply --field {name}.vti --slice z=0 --slice-picture {name}.png",
            scene.display()
        );
        let (object, ran) = bench.json(&line);
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        assert_eq!(object["components"], components, "{name}: {object:#}");
        let euler = object["euler_characteristic"].as_i64().unwrap();
        assert!(genus.is_none_or(|genus| euler == 2 * components - 2 * genus), "{name}: {euler}");
        assert!(bench.read(&format!("{name}.png")).starts_with(b"\x89PNG"), "{name}");
        let field = bench.read(&format!("{name}.vti"));
        let cells = object["grid"].as_array().unwrap();
        let nodes: u64 = cells.iter().map(|n| n.as_u64().unwrap() + 1).product();
        assert!(field.len() as u64 > 8 * nodes, "{name}");
        let extent = format!(" WholeExtent=\"0 {} 0 {} 0 {}\"", cells[0], cells[1], cells[2]);
        assert!(field[..400].windows(extent.len()).any(|w| w == extent.as_bytes()), "{name}: {extent}");
    }
    let count = std::fs::read_dir(examples()).unwrap();
    let scenes =
        count.filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|e| e == "toml"));
    assert_eq!(scenes.count(), 4, "every example is tried here");
}

#[test]
fn every_kind_of_field_can_be_written_down() {
    let bench = Bench::new();
    bench.run("shape sphere --size 0.5 -o sphere.off").ok();
    let fields = [
        "kind = \"box\", min = [-1, -1, -1], max = [1, 1, 1], rounding = 0.2",
        "kind = \"torus\", radius = 1, tube_radius = 0.4, axis = \"x\"",
        "kind = \"capsule\", ends = [[0, 0, -1], [0, 0, 1]], radius = 0.5",
        "kind = \"cylinder\", ends = [[0, 0, -1], [0, 0, 1]], radius = 0.5, translate = [1, 2, 3]",
        "kind = \"ellipsoid\", semi_axes = [1, 0.6, 0.5], scale = 2.0",
        "kind = \"text\", words = \"a\", height = 2, pen_radius = 0.3, depth = 0.6, caps = \"rounded\"",
        "kind = \"mesh\", file = \"sphere.off\", inside = \"nonzero\"",
        "kind = \"intersection\", parts = [{ kind = \"half-space\", normal = [0, 0, 1] }, { kind = \"ball\", radius = 1 }]",
        "kind = \"difference\", from = { kind = \"ball\", radius = 1 }, removed = { kind = \"constant\", value = 1 }",
        "kind = \"shell\", thickness = 0.5, field = { kind = \"ball\", radius = 1 }",
        "kind = \"affine\", matrix = [[1, 0, 0], [0.5, 1, 0], [0, 0, 2]], field = { kind = \"ball\", radius = 1 }",
        "kind = \"complement\", field = { kind = \"complement\", field = { kind = \"ball\", radius = 1 } }",
        "kind = \"displaced\", amplitude = 0.1, octaves = 2, field = { kind = \"ball\", radius = 1 }",
        "kind = \"noise\", wavelength = 1.0, seed = 3, gain = 0.5, lacunarity = 2",
        "kind = \"gyroid\", period = 1.5, thickness = 0.3",
    ];
    for (k, field) in fields.into_iter().enumerate() {
        let bounds = if k >= 11 && k != 12 { "bounds = [[-2, -2, -2], [2, 2, 2]]\n" } else { "" };
        bench.file("a.toml", format!("field = {{ {field} }}\n[grid]\ncells = 12\n{bounds}"));
        let ran = bench.run("isosurface a.toml -o a.ply --force");
        assert_eq!(ran.exit, Some(0), "{field}: {}", ran.err);
        bench.run("check a.ply --require closed").ok();
    }
}

#[test]
fn samples_alone_and_open_surfaces_can_be_asked_for() {
    let bench = Bench::new();
    bench.file("ball.toml", BALL);
    let (object, _) = bench.json("isosurface ball.toml -o a.vti --ascii");
    assert!(object.get("triangles").is_none(), "{object:#}");
    let text = String::from_utf8(bench.read("a.vti")).unwrap();
    assert!(text.contains("Name=\"field\" NumberOfComponents=\"1\" format=\"ascii\""));
    let open = "[grid]\nbounds = [[-1, -1, 0], [1, 1, 1]]\nspacing = 0.125\n[surface]\nwall = \"open\"\n\
                level = -0.2\ncrossing = \"linear\"\n[field]\nkind = \"ball\"\nradius = 1\n";
    bench.file("open.toml", open);
    let (object, _) = bench.json("isosurface open.toml -o open.obj");
    assert_eq!((&object["volume"], &object["euler_characteristic"]), (&Value::Null, &1.into()));
    let half = 2.0 * std::f64::consts::PI * 0.64;
    assert!((number(&object, "area") / half - 1.0).abs() < 0.02);
    bench.file("capped.toml", open.replace("\"open\"", "\"cap\""));
    let (object, _) = bench.json("isosurface capped.toml -o capped.obj");
    assert_eq!(object["euler_characteristic"], 2);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let bench = Bench::new();
    let scene = examples().join("blobs.toml");
    for threads in [1, 3] {
        let outputs =
            format!("-o {threads}.ply --field {threads}.vti --slice x=0 --slice-picture {threads}.png");
        bench.run(&format!("isosurface {} {outputs} -j {threads}", scene.display())).ok();
    }
    for extension in ["ply", "vti", "png"] {
        assert!(
            bench.read(&format!("1.{extension}")) == bench.read(&format!("3.{extension}")),
            "{extension}"
        );
    }
}

/// Each fault of a scene, the line that is told, and a word of the help.
#[test]
fn faults_of_scenes_are_told_with_their_line() {
    let bench = Bench::new();
    for (text, code, line, help) in [
        ("[field]\nkind = = 1", "W5001", 2, "toml"),
        ("[field]\nkind = \"ball\"\nradius = 1\ncentre = [0, 0, 0]", "W5002", 4, "`center`"),
        ("[gird]\ncells = 4", "W5002", 1, "`grid`"),
        ("[grid]\ncells = 4", "W5003", 1, "field"),
        ("[grid]\n[field]\nkind = \"ball\"", "W5003", 2, "radius"),
        ("[field]\nkind = \"bal\"\nradius = 1", "W5004", 2, "\"ball\""),
        ("[field]\nkind = \"ball\"\nradius = -1", "W5004", 3, ""),
        ("[field]\nkind = \"ball\"\nradius = \"big\"", "W5004", 3, ""),
        ("[grid]\ncells = 4\nspacing = 0.1\n[field]\nkind = \"ball\"\nradius = 1", "W5004", 2, ""),
        ("[surface]\ntriangles = \"good\"\n[field]\nkind = \"ball\"\nradius = 1", "W5004", 2, ""),
        ("[field]\nkind = \"text\"\nwords = \" \"", "W5004", 3, ""),
        ("[field]\nkind = \"ball\"\nradius = 1\nrotate = { axis = [0, 0, 0], degrees = 1 }", "W5004", 4, ""),
        ("[field]\nkind = \"union\"\nparts = []", "W5004", 1, ""),
        ("[field]\nkind = \"gyroid\"\nperiod = 1", "W5005", 1, "bounds"),
        ("[grid]\n[field]\nkind = \"ball\"\nradius = 1\ntranslate = [1e70, 0, 0]", "W5006", 1, "origin"),
        ("[grid]\nspacing = 1e-9\n[field]\nkind = \"ball\"\nradius = 1", "W5006", 1, "larger spacing"),
    ] {
        bench.file("a.toml", text);
        let error = bench.fails("isosurface a.toml -o a.ply", code, 5);
        assert_eq!(error["where"][0], format!("a.toml:{line}"), "{text}: {error:#}");
        assert!(error["help"].as_str().unwrap().contains(help), "{text}: {error:#}");
    }
    let grid = "[grid]\ncells = 4\nbounds = [[0, 0, 0], [1, 1, 1]]\n[field]\nkind = \"constant\"\nvalue = ";
    bench.file("a.toml", format!("{grid}nan"));
    bench.fails("isosurface a.toml -o a.ply", "W5007", 5);
    bench.file("a.toml", format!("{grid}inf"));
    bench.fails("isosurface a.toml -o a.ply", "W5008", 5);
    assert_eq!(bench.names(), ["a.toml"], "nothing was written");
}

#[test]
fn what_is_wrong_outside_of_the_scene_is_told_too() {
    let bench = Bench::new();
    bench.file("ball.toml", BALL);
    bench.fails("isosurface bal.toml -o a.ply", "W4001", 4);
    bench.fails("isosurface . -o a.ply", "W4003", 4);
    bench.fails("isosurface ball.toml -o a.docx", "W4002", 4);
    bench.fails("isosurface ball.toml -o a.ply --field a.txt", "W4002", 4);
    bench.fails("isosurface ball.toml -o a.ply --slice z=0", "W2001", 2);
    bench.fails("isosurface ball.toml -o a.ply --max-memory 1000", "W6001", 6);
    bench.file("mesh.toml", "[field]\nkind = \"mesh\"\nfile = \"a.off\"\n");
    bench.fails("isosurface mesh.toml -o a.ply", "W4001", 4);
    bench.file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    bench.fails("isosurface mesh.toml -o a.ply", "W3021", 3);
    bench.fails("isosurface mesh.toml -o a.off --force", "W2005", 2);
    bench.file("bad.toml", b"[field]\nkind = \"\xff\"");
    bench.fails("isosurface bad.toml -o a.ply", "W4008", 4);
    let taken = bench.run("isosurface ball.toml -o - --to obj --json");
    assert_eq!(taken.exit, Some(2));
}

#[test]
fn ctrl_c_ends_it_without_a_trace() {
    let bench = Bench::new();
    let words = "welter ".repeat(200);
    bench.file("long.toml", format!("[grid]\ncells = 40\n[field]\nkind = \"text\"\nwords = \"{words}\"\n"));
    let child = bench.command(&["isosurface", "long.toml", "-o", "a.ply"]).spawn().unwrap();
    bench.interrupt_writing(child, 1);
    assert_eq!(bench.names(), ["long.toml"]);
}
