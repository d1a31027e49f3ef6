//! `welter mesh` of closed curves in the plane.

use crate::harness::{Bench, TETRAHEDRON};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;
use welter_meshing::io::{FieldValues, Limits, VolumeData, read_medit, read_msh, read_vtu};

/// Closed curves as OBJ, each one line, at a height.
fn obj(loops: &[Vec<[f64; 2]>], z: f64) -> String {
    let (mut text, mut first) = (String::new(), 1);
    for points in loops {
        for [x, y] in points {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        let numbers: Vec<String> =
            (0..=points.len()).map(|k| (first + k % points.len()).to_string()).collect();
        writeln!(text, "l {}", numbers.join(" ")).unwrap();
        first += points.len();
    }
    text
}

fn circle(x: f64, radius: f64) -> Vec<[f64; 2]> {
    let at = |k: u32| TAU * f64::from(k) / 40.0;
    (0..40).map(|k| [x + radius * at(k).cos(), radius * at(k).sin()]).collect()
}

fn two_circles() -> String {
    obj(&[circle(0.0, 1.0), circle(1.0, 1.0)], 2.5)
}

fn eight() -> Vec<[f64; 2]> {
    let at = |k: u32| TAU * f64::from(k) / 40.0;
    (0..40).map(|k| [at(k).sin(), (2.0 * at(k)).sin()]).collect()
}

fn integers(mesh: &VolumeData, name: &str) -> Vec<i32> {
    let field = mesh.cell_fields.iter().find(|field| field.name == name);
    match &field.unwrap_or_else(|| panic!("no field {name}")).values {
        FieldValues::Int32(values) => values.to_vec(),
        other => panic!("{name}: {other:?}"),
    }
}

/// The area of cells, each of which turns counterclockwise.
fn area<const N: usize>(mesh: &VolumeData, cells: &[[u32; N]]) -> f64 {
    let of = |cell: &[u32; N]| {
        let p = cell.map(|v| mesh.positions[v as usize]);
        let area: f64 = (0..N).map(|k| 0.5 * p[k].truncate().perp_dot(p[(k + 1) % N].truncate())).sum();
        assert!(area > 0.0, "{p:?}");
        area
    };
    cells.iter().map(of).sum()
}

#[test]
fn two_circles_that_overlap_are_two_sheets() {
    let bench = Bench::new();
    bench.file("a.obj", two_circles());
    let (object, ran) = bench.json("mesh a.obj -o a.vtu -r 20");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for (key, value) in [
        ("input", json!("a.obj")),
        ("output", json!("a.vtu")),
        ("dimension", json!(2)),
        ("curves", json!(2)),
        ("components", json!(2)),
        ("euler_characteristic", json!(2)),
        ("regions", json!(3)),
        ("copies", json!(4)),
        ("sheets", json!(2)),
        ("refinements", json!(0)),
        ("hexahedra", json!(0)),
        ("tetrahedra", json!(0)),
        ("triangles", json!(0)),
        ("ambiguous", json!(false)),
        ("dropped", json!([])),
        ("picture", Value::Null),
    ] {
        assert_eq!(object[key], value, "{key} of {object:#}");
    }
    for key in ["winding_copies", "euler", "embedding"] {
        assert_eq!(object["verification"][key], true, "{key} of {object:#}");
    }
    assert!(object["verification"]["cells"].as_u64().unwrap() > 100);
    let [covered, within] = ["area", "curve_area"].map(|key| object[key].as_f64().unwrap());
    assert!((6.2..6.3).contains(&within) && covered > within, "{object:#}");

    let mesh = read_vtu(&bench.read("a.vtu")[..], &Limits::default()).unwrap().0;
    assert_eq!(json!(mesh.quadrilaterals.len()), object["quadrilaterals"]);
    assert_eq!(json!(mesh.positions.len()), object["vertices"]);
    assert_eq!(mesh.cell_count(), mesh.quadrilaterals.len());
    assert!(mesh.positions.iter().all(|p| p.z == 2.5));
    assert!((area(&mesh, &mesh.quadrilaterals) - covered).abs() < 1e-12 * covered);
    for (field, most) in [("copy", 1), ("component", 1), ("region", 2)] {
        assert!(integers(&mesh, field).iter().max() >= Some(&most), "{field}");
    }
    // As many quadrilaterals of the one component as of the other: the circles are equal, the grid is not quite.
    let first = integers(&mesh, "component").iter().filter(|&&component| component == 0).count();
    assert!((0.45..0.55).contains(&(first as f64 / mesh.quadrilaterals.len() as f64)));

    let people = bench.run("mesh a.obj -o a.vtu -r 20 --force").ok();
    for words in ["quadrilaterals", "curves", "sheets over one another  2", "copies match winding numbers"] {
        assert!(people.out.contains(words), "{words}: {}", people.out);
    }
    assert!(people.err.contains("note: a.vtu written"), "{}", people.err);
    let unverified = bench.run("mesh a.obj -o a.vtu -r 20 --force --no-verify").ok();
    assert!(unverified.out.contains("verified                 no"), "{}", unverified.out);
}

#[test]
fn triangles_and_every_format_hold_the_same_area() {
    let bench = Bench::new();
    bench.file("a.obj", two_circles());
    for options in [
        "a.vtu",
        "a.vtu --ascii",
        "a.msh",
        "a.msh --msh 2",
        "a.msh --msh 2 --ascii",
        "a.msh --ascii",
        "a.mesh",
    ] {
        for cells in ["--hex", "--tet"] {
            let (object, ran) = bench.json(&format!("mesh a.obj -r 12 --force {cells} -o {options}"));
            assert_eq!(ran.exit, Some(0), "{}", ran.err);
            let name = options.split(' ').next().unwrap();
            let bytes = bench.read(name);
            let read = match name {
                "a.vtu" => read_vtu(&bytes[..], &Limits::default()),
                "a.msh" => read_msh(&bytes[..], &Limits::default()),
                _ => read_medit(&bytes[..], &Limits::default()),
            };
            let mesh = read.unwrap().0;
            let (count, sum) = match cells {
                "--hex" => (mesh.quadrilaterals.len(), area(&mesh, &mesh.quadrilaterals)),
                _ => (mesh.triangles.len(), area(&mesh, &mesh.triangles)),
            };
            let key = if cells == "--hex" { "quadrilaterals" } else { "triangles" };
            assert_eq!((json!(count), mesh.cell_count()), (object[key].clone(), count), "{options}");
            assert_eq!(json!(mesh.positions.len()), object["vertices"], "{options}");
            if cells == "--hex" {
                let covered = object["area"].as_f64().unwrap();
                assert!((sum - covered).abs() < 1e-12 * covered, "{options}: {sum}");
            }
            let field = match name {
                "a.vtu" => "component",
                "a.msh" => "gmsh:physical",
                _ => "medit:ref",
            };
            let tags = integers(&mesh, field);
            let first = i32::from(name != "a.vtu");
            assert_eq!([tags.iter().min(), tags.iter().max()], [Some(&first), Some(&(first + 1))]);
            if name == "a.msh" {
                let names: Vec<(usize, i32, &str)> =
                    mesh.groups.iter().map(|group| (group.dimension, group.tag, &*group.name)).collect();
                assert_eq!(names, [(2, 1, "component 1"), (2, 2, "component 2")]);
            }
        }
    }
}

#[test]
fn the_example_is_one_sheet_over_itself() {
    let bench = Bench::new();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/mesh/band.obj");
    bench.file("band.obj", std::fs::read(file).unwrap());
    let line = "mesh band.obj -o band.vtu --picture band.png --picture-size 320x240 --force -r 30";
    let (object, ran) = bench.json(line);
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for (key, value) in [("components", 1), ("euler_characteristic", 1), ("sheets", 2)] {
        assert_eq!(object[key], value, "{key} of {object:#}");
    }
    assert_eq!(object["picture"], "band.png");
    let picture = bench.read("band.png");
    assert!(picture.starts_with(b"\x89PNG"));
    let mesh = bench.read("band.vtu");
    for threads in [1, 3] {
        bench.run(&format!("{line} -j {threads}")).ok();
        assert!(bench.read("band.vtu") == mesh && bench.read("band.png") == picture, "{threads} threads");
    }
    // Lines of two vertices each, and from standard input.
    let text = String::from_utf8(bench.read("band.obj")).unwrap();
    let (vertices, curve) = text.split_once("\nl ").unwrap();
    let numbers: Vec<&str> = curve.split_whitespace().collect();
    let pieces: Vec<String> = numbers.windows(2).map(|pair| format!("l {} {}\n", pair[0], pair[1])).collect();
    bench.file("pieces.obj", format!("{vertices}\n{}", pieces.concat()));
    let input = std::fs::File::open(bench.path("pieces.obj")).unwrap();
    let args = ["mesh", "-", "--from", "obj", "-o", "-", "--to", "vtu", "-r", "30"];
    let output = bench.command(&args).stdin(input).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout == mesh);
}

#[test]
fn curves_that_bound_no_area_are_told_with_their_place() {
    let bench = Bench::new();
    bench.file("eight.obj", obj(&[eight()], 0.0));
    let error = bench.fails("mesh eight.obj -o a.vtu -r 20", "W3025", 3);
    assert!(error["what"].as_str().unwrap().contains("wind -1 times"), "{error:#}");
    assert!(error["where"][0].as_str().unwrap().contains("nodes of the grid"), "{error:#}");
    assert!(error["help"].as_str().unwrap().contains("reverse"), "{error:#}");
    // Around twice.
    let point = |k: u32| {
        let a = TAU * f64::from(k) / 60.0;
        [(1.0 + 2.0 * a.cos()) * a.cos(), (1.0 + 2.0 * a.cos()) * a.sin()]
    };
    bench.file("twice.obj", obj(&[(0..60).map(point).collect()], 0.0));
    let error = bench.fails("mesh twice.obj -o a.vtu -r 20", "W3026", 3);
    assert!(error["what"].as_str().unwrap().contains("turn around 2 times"), "{error:#}");

    // A disc with two eights: as a whole they turn around as a disc does, yet no surface is bounded by them.
    let eights = [-2.0, 2.0].map(|x| eight().into_iter().map(|[p, q]| [p + x, q]).collect());
    bench.file("eights.obj", obj(&[vec![circle(0.0, 5.0)], eights.to_vec()].concat(), 0.0));
    let error = bench.fails("mesh eights.obj -o a.vtu -r 40 --max-refinements 1", "W8001", 8);
    assert!(
        error["help"].as_str().unwrap().contains("no cells help where the curves bound no area"),
        "{error:#}"
    );

    bench.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n");
    let error = bench.fails("mesh open.obj -o a.vtu", "W3021", 3);
    assert_eq!(error["where"][0], "vertex 1, at (0, 0, 0), where 0 lines end and 1 begin", "{error:#}");
    bench.file("against.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\nl 1 3\n");
    let error = bench.fails("mesh against.obj -o a.vtu", "W3021", 3);
    assert!(error["what"].as_str().unwrap().contains("against each other"), "{error:#}");
    bench.file("tilted.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nl 1 2 3 1\n");
    let error = bench.fails("mesh tilted.obj -o a.vtu", "W3027", 3);
    assert_eq!(error["where"][1], "vertex 3, at (0, 1, 0.5)", "{error:#}");
    bench.file("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nl 1 2 3 1\n");
    bench.fails("mesh nan.obj -o a.vtu", "W3012", 3);
    bench.file("back.obj", "v 0 0 0\nv 1 0 0\nl 1 2 1\n");
    bench.fails("mesh back.obj -o a.vtu", "W3026", 3);
    bench.file("beyond.obj", "v 0 0 0\nv 1 0 0\nl 1 2 3 1\n");
    bench.fails("mesh beyond.obj -o a.vtu", "W3010", 3);
    let names = bench.names();
    assert!(!names.iter().any(|name| name == "a.vtu" || name.ends_with(".part")), "{names:?}");
}

#[test]
fn options_of_surfaces_are_refused_by_name() {
    let bench = Bench::new();
    bench.file("a.obj", two_circles());
    for (options, names) in [
        ("--outward", "--outward means"),
        ("--hosts a.csv --boundary", "--hosts, --boundary mean"),
        ("--coarsen 1", "--coarsen means"),
        ("--picture a.png --cut x=0", "--cut means"),
        ("--picture a.png --camera 0,0", "--camera means"),
    ] {
        let error = bench.fails(&format!("mesh a.obj -o a.vtu -r 9 {options}"), "W2001", 2);
        assert!(error["what"].as_str().unwrap().starts_with(names), "{error:#}");
    }
    assert_eq!(bench.names(), ["a.obj"]);
}

#[test]
fn lines_beside_triangles_are_passed_over() {
    let bench = Bench::new();
    bench.file("a.obj", format!("{TETRAHEDRON}l 1 2\nl 2 3\n"));
    let (object, ran) = bench.json("mesh a.obj -o a.vtu -r 6");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert!(object["hexahedra"].as_u64() > Some(0), "{object:#}");
    assert!(ran.err.contains("2 lines passed over"), "{}", ran.err);
}

#[test]
fn what_would_not_fit_is_refused_with_cells_that_do() {
    let bench = Bench::new();
    bench.file("a.obj", two_circles());
    let spacing = |error: &Value| {
        let help = error["help"].as_str().unwrap();
        help.strip_prefix("-s ").and_then(|rest| rest.split(' ').next()).unwrap().to_owned()
    };
    let error = bench.fails("mesh a.obj -o a.vtu -s 1e-5 --max-memory 3000000", "W6001", 6);
    assert!(error["what"].as_str().unwrap().contains("quadrilaterals"), "{error:#}");
    bench.run(&format!("mesh a.obj -o a.vtu -s {} --max-memory 3000000", spacing(&error))).ok();
    let error = bench.fails("mesh a.obj -o b.vtu -r 50 --max-cells 1000", "W6004", 6);
    bench.run(&format!("mesh a.obj -o b.vtu -s {} --max-cells 1000", spacing(&error))).ok();
    let error = bench.fails("mesh a.obj -o c.vtu -s 1e300", "W2009", 2);
    assert!(error["what"].as_str().unwrap().starts_with("spacing is 1e300,"), "{error:#}");
    assert_eq!(error["where"][0], "bounding box of 3 x 2");
    bench.fails("mesh a.obj -o c.vtu -r 0", "W2009", 2);
}

#[test]
fn it_ends_when_it_is_told_to() {
    let bench = Bench::new();
    bench.file("a.obj", two_circles());
    bench.fails("mesh a.obj -o a.vtu -r 2000 --time-limit 0.01", "W8002", 8);
    let child = bench.command(&["mesh", "a.obj", "-o", "a.vtu", "-r", "3000"]).spawn().unwrap();
    let ran = bench.interrupt_writing(child, 1);
    assert!(ran.err.contains("error[W0130]: interrupted"), "{}", ran.err);
    assert_eq!(bench.names(), ["a.obj"]);
}
