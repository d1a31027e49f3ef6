//! `welter mesh`.

use crate::harness::{Bench, TETRAHEDRON};
use serde_json::{Value, json};
use std::io::Read;
use std::path::Path;
use welter_meshing::DVec3;
use welter_meshing::io::{FieldValues, Limits, VolumeData, read_medit, read_msh, read_vtu};

/// A box of edge 1 as OBJ, from a corner on, its triangles counted from `first`; turned inward if asked for.
fn cube(corner: f64, side: f64, first: usize, inward: bool) -> String {
    let mut text = String::new();
    for c in 0..8 {
        let at = |axis: usize| corner + if c >> axis & 1 == 1 { side } else { 0.0 };
        text.push_str(&format!("v {} {} {}\n", at(0), at(1), at(2)));
    }
    let names = ["left", "right", "front", "back", "bottom", "top"];
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    for (name, mut side) in names.into_iter().zip(sides) {
        if inward {
            side.reverse();
        }
        let [a, b, c, d] = side.map(|corner| first + corner);
        text.push_str(&format!("g {name}\nf {a} {b} {c}\nf {a} {c} {d}\n"));
    }
    text
}

fn vtu(bench: &Bench, name: &str) -> VolumeData {
    read_vtu(&bench.read(name)[..], &Limits::default()).unwrap().0
}

fn integers(mesh: &VolumeData, name: &str) -> Vec<i32> {
    let field = mesh.cell_fields.iter().find(|field| field.name == name);
    match &field.unwrap_or_else(|| panic!("no field {name}")).values {
        FieldValues::Int32(values) => values.to_vec(),
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn two_boxes_that_overlap_are_two_meshes() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.ply").ok();
    let (object, ran) = bench.json("mesh a.ply -o a.vtu -r 8");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for (key, value) in [
        ("input", json!("a.ply")),
        ("output", json!("a.vtu")),
        ("components", json!(2)),
        ("euler_characteristic", json!(2)),
        ("betti", json!([2, 0, 0])),
        ("regions", json!(3)),
        ("copies", json!(4)),
        ("sheets", json!(2)),
        ("refinements", json!(0)),
        ("tetrahedra", json!(0)),
        ("ambiguous", json!(false)),
        ("surface_volume", json!(16.0)),
        ("groups", json!(["surface"])),
    ] {
        assert_eq!(object[key], value, "{key} of {object:#}");
    }
    for key in ["winding_copies", "euler", "embedding"] {
        assert_eq!(object["verification"][key], true, "{key} of {object:#}");
    }
    assert_eq!(object["verification"]["details"], json!([]));
    assert!(object["cell_size"].as_f64().unwrap() > 0.3 && object["grid"].as_array().unwrap().len() == 3);
    assert!(object["seconds"]["total"].as_f64().unwrap() > 0.0);
    assert!(object["peak_rss_bytes"].as_u64().is_none_or(|bytes| bytes > 1 << 20));

    let mesh = vtu(&bench, "a.vtu");
    assert_eq!(json!(mesh.hexahedra.len()), object["hexahedra"]);
    assert_eq!(json!(mesh.positions.len()), object["vertices"]);
    assert!(mesh.quadrilaterals.is_empty(), "a VTU file has the volume alone");
    assert_eq!(integers(&mesh, "copy").iter().max(), Some(&1));
    assert_eq!(integers(&mesh, "component").iter().max(), Some(&1));
    let regions = integers(&mesh, "region");
    assert_eq!(regions.len(), mesh.hexahedra.len());
}

#[test]
fn people_are_told_what_scripts_are() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    let ran = bench.run("mesh a.obj -o a.vtu -r 5 --no-verify").ok();
    for words in ["hexahedra", "components", "Betti numbers", "1 0 0", "verified                 no"] {
        assert!(ran.out.contains(words), "{words}: {}", ran.out);
    }
    assert!(ran.err.contains("note: a.vtu written"), "{}", ran.err);
    let (object, _) = bench.json("mesh a.obj -o a.vtu -r 5 --no-verify --force");
    assert_eq!(object["verification"], Value::Null);
    assert_eq!(object["betti"], json!([1, 0, 0]));
    let (object, _) = bench.json("mesh a.obj -o a.vtu -r 5 --no-betti --force");
    assert_eq!((&object["betti"], &object["components"]), (&Value::Null, &1.into()), "{object:#}");
    let quiet = bench.run("mesh a.obj -o a.vtu -r 5 --force --quiet").ok();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
    let chosen = bench.run("mesh a.obj -o a.vtu --force --no-verify").ok();
    assert!(chosen.err.contains("63 cells along the shortest side"), "{}", chosen.err);
}

/// The weighted vertices of a cell give the position of the vertex of the surface back.
#[test]
fn the_hosts_hold_the_surface() {
    let bench = Bench::new();
    bench.run("shape ring-overlap -o a.ply --size 0.2").ok();
    let (surface, _) = welter_meshing::io::read_reported(
        welter_meshing::io::Format::Ply,
        &bench.read("a.ply")[..],
        &Limits::default(),
    )
    .unwrap();
    for (option, corners) in [("--hex", 8), ("--tet", 4)] {
        bench.run(&format!("mesh a.ply -o a.vtu -r 10 {option} --hosts hosts.csv --force")).ok();
        let mesh = vtu(&bench, "a.vtu");
        let text = String::from_utf8(bench.read("hosts.csv")).unwrap();
        let mut lines = text.lines();
        let heads = lines.next().unwrap();
        assert!(heads.starts_with("vertex,") && heads.split(',').count() == 2 + 2 * corners, "{heads}");
        let mut count = 0;
        for line in lines {
            let words: Vec<&str> = line.split(',').collect();
            let [vertex, cell] = [0, 1].map(|k| words[k].parse::<usize>().unwrap());
            let ids: Vec<u32> = words[2..2 + corners].iter().map(|word| word.parse().unwrap()).collect();
            let weights: Vec<f64> = words[2 + corners..].iter().map(|word| word.parse().unwrap()).collect();
            assert_eq!(weights.len(), corners);
            assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)), "{line}");
            let known: &[u32] = if corners == 8 { &mesh.hexahedra[cell] } else { &mesh.tetrahedra[cell] };
            assert_eq!(known, ids, "{line}");
            let sum = ids.iter().zip(&weights).map(|(&id, &w)| mesh.positions[id as usize] * w);
            let position: DVec3 = sum.sum();
            assert!(position.abs_diff_eq(surface.positions[vertex], 1e-14), "{line}: {position}");
            count += 1;
        }
        assert_eq!(count, surface.positions.len());
    }
}

#[test]
fn tetrahedra_fill_the_same_volume() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    let (object, ran) = bench.json("mesh a.obj -o a.mesh --tet -r 4");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    let mesh = read_medit(&bench.read("a.mesh")[..], &Limits::default()).unwrap().0;
    assert_eq!(json!(mesh.tetrahedra.len()), object["tetrahedra"]);
    assert!(mesh.hexahedra.is_empty() && mesh.quadrilaterals.is_empty());
    let corners = |ids: &[u32]| -> Vec<DVec3> { ids.iter().map(|&v| mesh.positions[v as usize]).collect() };
    let volume = |p: &[DVec3]| (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
    let volumes: Vec<f64> = mesh.tetrahedra.iter().map(|tetrahedron| volume(&corners(tetrahedron))).collect();
    assert!(volumes.iter().all(|&v| v > 0.0));
    let total: f64 = volumes.iter().sum();
    assert!((total / object["volume"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    // The triangles are the boundary of that: they enclose the same volume.
    let enclosed = mesh.triangles.iter().map(|triangle| {
        let p = corners(triangle);
        p[0].dot(p[1].cross(p[2])) / 6.0
    });
    assert!((enclosed.sum::<f64>() / total - 1.0).abs() < 1e-12);
}

#[test]
fn groups_of_the_surface_are_tags_of_the_boundary() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    for options in ["", " --msh 2", " --msh 2 --ascii", " --ascii", " --tet"] {
        let (object, ran) = bench.json(&format!("mesh a.obj -o a.msh -r 6 --force{options}"));
        assert_eq!(ran.exit, Some(0), "{}", ran.err);
        assert_eq!(object["groups"], json!(["left", "right", "front", "back", "bottom", "top"]));
        let mesh = read_msh(&bench.read("a.msh")[..], &Limits::default()).unwrap().0;
        let tags = integers(&mesh, "gmsh:physical");
        let volumes = mesh.hexahedra.len() + mesh.tetrahedra.len();
        assert!(tags[..volumes].iter().all(|&tag| tag == 1), "the component, from 1 on");
        let faces: Vec<&[u32]> = mesh
            .quadrilaterals
            .iter()
            .map(|face| &face[..])
            .chain(mesh.triangles.iter().map(|face| &face[..]))
            .collect();
        assert_eq!(faces.len(), tags.len() - volumes);
        assert!(!faces.is_empty());
        for (face, &tag) in faces.iter().zip(&tags[volumes..]) {
            let sum: DVec3 = face.iter().map(|&v| mesh.positions[v as usize]).sum();
            let middle = sum / face.len() as f64 - DVec3::splat(0.5);
            // Away from edges of the box it is plain on which of its sides a face is.
            let axis = (0..3).max_by(|&a, &b| middle[a].abs().total_cmp(&middle[b].abs())).unwrap();
            if (0..3).any(|other| other != axis && middle[other].abs() > 0.4) {
                continue;
            }
            let side = 2 * axis as i32 + i32::from(middle[axis] > 0.0);
            assert_eq!(tag, side + 1, "{options}: {middle}");
        }
    }
    bench.run("mesh a.obj -o a.vtu -r 6 --boundary").ok();
    let mesh = vtu(&bench, "a.vtu");
    assert!(!mesh.quadrilaterals.is_empty());
    assert_eq!(integers(&mesh, "tag").iter().max(), Some(&6));
}

#[test]
fn names_of_groups_are_kept() {
    let bench = Bench::new();
    let long = "o".repeat(200);
    let text = cube(0.0, 1.0, 1, false)
        .replace("g left", "g links, Ärmel <1>")
        .replace("g front", "g \"quoted\"")
        .replace("g back", &format!("g {long}"))
        .replace("g top", "g");
    bench.file("a.obj", text + &cube(2.0, 1.0, 9, false));
    let names = [
        "links, Ärmel <1>",
        "right",
        "\"quoted\"",
        &long,
        "bottom",
        "left",
        "front",
        "back",
        "top",
        "surface",
    ];
    let groups = |mesh: &VolumeData, dimension: usize| -> Vec<(i32, String)> {
        let of = mesh.groups.iter().filter(|group| group.dimension == dimension);
        of.map(|group| (group.tag, group.name.clone())).collect()
    };
    let numbered = |names: &[&str]| -> Vec<(i32, String)> {
        (1..).zip(names).map(|(number, name)| (number, (*name).to_owned())).collect()
    };
    let (object, ran) = bench.json("mesh a.obj -o a.vtu -r 4 --boundary");
    assert_eq!((&object["groups"], &object["dropped"]), (&json!(names), &json!([])), "{}", ran.err);
    let mesh = vtu(&bench, "a.vtu");
    assert_eq!(groups(&mesh, 2), numbered(&names));
    assert_eq!(groups(&mesh, 3), numbered(&["component 1", "component 2"]));
    let known: Vec<i32> = mesh.groups.iter().map(|group| group.tag).collect();
    assert!(integers(&mesh, "tag").iter().all(|tag| known.contains(tag)));

    let mut as_msh = names;
    (as_msh[2], as_msh[3]) = ("'quoted'", &long[..127]);
    for options in ["", " --msh 2", " --msh 2 --ascii", " --ascii --tet"] {
        let (object, ran) = bench.json(&format!("mesh a.obj -o a.msh -r 4 --force{options}"));
        let mesh = read_msh(&bench.read("a.msh")[..], &Limits::default()).unwrap().0;
        assert_eq!(groups(&mesh, 2), numbered(&as_msh), "{options}");
        assert_eq!(groups(&mesh, 3), numbered(&["component 1", "component 2"]), "{options}");
        assert!(
            object["dropped"].as_array().unwrap().contains(&json!("2 group names changed")),
            "{}",
            ran.err
        );
    }
    let (object, _) = bench.json("mesh a.obj -o a.mesh -r 4");
    let lost = json!("names of 12 groups not written");
    assert!(object["dropped"].as_array().unwrap().contains(&lost), "{object:#}");
}

#[test]
fn coarser_cells_come_of_finer_ones() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    let (fine, _) = bench.json("mesh a.obj -o a.vtu -r 8");
    let (coarse, _) = bench.json("mesh a.obj -o b.vtu -r 8 --coarsen 1");
    assert_eq!(coarse["coarsenings"], 1);
    assert_eq!(coarse["cell_size"].as_f64(), fine["cell_size"].as_f64().map(|h| 2.0 * h));
    assert!(coarse["hexahedra"].as_u64() < fine["hexahedra"].as_u64());
    assert_eq!(coarse["verification"]["embedding"], true, "{coarse:#}");
    // Not further than the topology allows, and that is told.
    bench.run("shape box-with-void -o v.ply").ok();
    let (void, ran) = bench.json("mesh v.ply -o v.vtu -r 8 --coarsen 6");
    assert_eq!(void["betti"], json!([1, 0, 1]), "{void:#}");
    assert!(void["coarsenings"].as_u64().unwrap() < 6);
    assert!(ran.err.contains("would change the topology"), "{}", ran.err);
}

#[test]
fn cells_wider_than_the_body_is_thick_are_told() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    // The mesh has (0.5 / 0.1)^3 or more times the volume of a cube of side 0.1.
    bench.file("small.obj", cube(0.0, 0.1, 1, false));
    let wide = "times the volume of the surface";
    assert!(bench.run("mesh small.obj -o b.vtu -s 0.5").ok().err.contains(wide));
    assert!(!bench.run("mesh a.obj -o a.vtu -s 0.1").ok().err.contains(wide));
}

#[test]
fn without_overlap_the_picture_is_cut_in_the_middle() {
    let bench = Bench::new();
    // Letters share a few cells with themselves beside narrow gaps, which is no overlap.
    bench.run("shape text -o a.ply").ok();
    let (object, ran) =
        bench.json("mesh a.ply -o a.vtu -r 10 --no-betti --picture a.png --picture-size 160x120");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    let cut = object["cut"].as_str().unwrap().strip_prefix("z=").expect("across the shortest side");
    let spacing = object["cell_size"].as_f64().unwrap();
    assert!(cut.parse::<f64>().unwrap().abs() <= spacing, "{object:#}");
}

#[test]
fn a_picture_is_cut_where_it_was_asked_for() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.ply").ok();
    let line = "mesh a.ply -o a.vtu -r 6 --picture a.png --picture-size 160x120 --force";
    let mut seen = Vec::new();
    for options in ["", " --cut x=0.1", " --cut z=-0.4", " --camera 200,-30"] {
        let (object, ran) = bench.json(&format!("{line}{options}"));
        assert_eq!(ran.exit, Some(0), "{}", ran.err);
        assert_eq!(object["picture"], "a.png");
        if let Some(cut) = options.strip_prefix(" --cut ") {
            assert_eq!(object["cut"], cut);
        }
        let png = bench.read("a.png");
        assert!(png.starts_with(b"\x89PNG") && !seen.contains(&png), "{options}");
        seen.push(png);
    }
    bench.fails("mesh a.ply -o b.vtu --cut z=0", "W2001", 2);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let bench = Bench::new();
    bench.run("shape figure-eight -o a.ply --size 0.15").ok();
    for threads in [1, 3] {
        let outputs = format!("-o {threads}.msh --hosts {threads}.csv --picture {threads}.png");
        bench.run(&format!("mesh a.ply {outputs} --picture-size 160x120 -r 8 -j {threads}")).ok();
    }
    for extension in ["msh", "csv", "png"] {
        let [one, many] = [1, 3].map(|threads| bench.read(&format!("{threads}.{extension}")));
        assert!(one == many, "{extension}");
    }
}

#[test]
fn a_stream_is_read_and_written() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    bench.run("mesh a.obj -o a.vtu -r 4").ok();
    let input = std::fs::File::open(bench.path("a.obj")).unwrap();
    let mut child = bench
        .command(&["mesh", "-", "--from", "obj", "-o", "-", "--to", "vtu", "-r", "4"])
        .stdin(input)
        .spawn()
        .unwrap();
    let mut out = Vec::new();
    child.stdout.take().unwrap().read_to_end(&mut out).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(out == bench.read("a.vtu"));
    let nameless = bench.run("mesh a.obj -o -");
    assert!(nameless.exit == Some(4) && nameless.err.contains("--to vtu"), "{}", nameless.err);
    assert_eq!(bench.run("mesh a.obj -o - --to vtu --json").exit, Some(2));
}

#[test]
fn surfaces_that_bound_no_volume_are_told_with_their_place() {
    let bench = Bench::new();
    bench.file("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    let error = bench.fails("mesh open.off -o a.vtu", "W3021", 3);
    assert_eq!(error["where_count"], 3, "{error:#}");
    assert!(error["help"].as_str().unwrap().contains("--save-bad"), "{error:#}");
    bench.file("turned.obj", TETRAHEDRON.replace("f 1 3 2", "f 1 2 3"));
    bench.fails("mesh turned.obj -o a.vtu", "W3022", 3);
    bench.file("nan.obj", TETRAHEDRON.replace("v 1 0 0", "v nan 0 0"));
    bench.fails("mesh nan.obj -o a.vtu", "W3012", 3);
    bench.file("none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
    bench.fails("mesh none.off -o a.vtu", "W3013", 3);
    // Whole, and in part.
    bench.file("inward.obj", cube(0.0, 1.0, 1, true));
    let error = bench.fails("mesh inward.obj -o a.vtu -r 4", "W3025", 3);
    assert!(error["what"].as_str().unwrap().contains("winds -1 times"), "{error:#}");
    assert!(error["where"][0].as_str().unwrap().contains("nodes of the grid"), "{error:#}");
    assert!(error["help"].as_str().unwrap().contains("--outward"), "{error:#}");
    let (object, ran) = bench.json("mesh inward.obj -o a.vtu -r 4 --outward");
    assert_eq!((ran.exit, object["surface_volume"].as_f64()), (Some(0), Some(1.0)), "{}", ran.err);
    bench.file("part.obj", cube(0.0, 2.0, 1, false) + &cube(1.5, 1.0, 9, true));
    let error = bench.fails("mesh part.obj -o b.vtu -r 4", "W3025", 3);
    assert!(error["help"].as_str().unwrap().contains("--cut"), "{error:#}");
    let names = bench.names();
    assert!(!names.iter().any(|name| name == "b.vtu" || name.ends_with(".part")), "{names:?}");
}

#[test]
fn cells_that_no_grid_has_are_refused() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    for option in ["-s 0", "-s -1", "-s nan", "-s inf", "-r 0", "--max-refinements 17", "--coarsen 99"] {
        bench.fails(&format!("mesh a.obj -o a.vtu {option}"), "W2009", 2);
    }
    for option in ["-r 4 -s 0.1", "-r x", "-r -3", "--hex --tet", "--time-limit 0", "--time-limit soon"] {
        bench.fails(&format!("mesh a.obj -o a.vtu {option}"), "W2001", 2);
    }
    bench.fails("mesh a.obj -o a.vtu --verify --no-verify", "W2001", 2);
    // So far out that the nodes would be rounded.
    bench.file("far.obj", cube(1e15, 1.0, 1, false));
    bench.fails("mesh far.obj -o a.vtu -s 0.01", "W2009", 2);
    assert_eq!(bench.names(), ["a.obj", "far.obj"]);
}

#[test]
fn what_would_not_fit_is_refused_with_cells_that_do() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    let error = bench.fails("mesh a.obj -o a.vtu -s 1e-4 --max-memory 1000000", "W6001", 6);
    let help = error["help"].as_str().unwrap();
    let spacing = help.strip_prefix("-s ").and_then(|rest| rest.split(' ').next()).unwrap();
    bench.run(&format!("mesh a.obj -o a.vtu -s {spacing} --max-memory 1000000")).ok();
    let error = bench.fails("mesh a.obj -o b.vtu -r 63 --max-memory 100", "W6001", 6);
    assert!(error["what"].as_str().unwrap().contains("are allowed"), "{error:#}");
    bench.fails("mesh a.obj -o b.vtu -s 1e-300", "W6001", 6);

    let error = bench.fails("mesh a.obj -o b.vtu -r 20 --max-cells 1000", "W6004", 6);
    let help = error["help"].as_str().unwrap();
    let spacing = help.strip_prefix("-s ").and_then(|rest| rest.split(' ').next()).unwrap();
    bench.run(&format!("mesh a.obj -o b.vtu -s {spacing} --max-cells 1000")).ok();
    // More sheets than can be told apart.
    let nested: String = (0..129)
        .map(|k| cube(-0.001 * f64::from(k), 1.0 + 0.002 * f64::from(k), 1 + 8 * k as usize, false))
        .collect();
    bench.file("nested.obj", nested);
    bench.fails("mesh nested.obj -o c.vtu -r 3", "W6003", 6);
    assert_eq!(bench.names(), ["a.obj", "a.vtu", "b.vtu", "nested.obj"]);
}

#[test]
fn features_too_fine_are_told_with_the_cells_to_try() {
    let bench = Bench::new();
    // A void in a box, a tenth of a cell wide.
    bench.file("a.obj", cube(0.0, 1.0, 1, false) + &cube(0.6, 0.01, 9, true));
    let line = "mesh a.obj -o a.vtu -r 5 --max-refinements 0";
    let error = bench.fails(line, "W8001", 8);
    assert!(error["help"].as_str().unwrap().contains(" -s "), "{error:#}");
    assert_eq!(bench.names(), ["a.obj"]);
}

#[test]
fn the_time_is_limited() {
    let bench = Bench::new();
    bench.run("shape ring-overlap -o a.ply").ok();
    let error = bench.fails("mesh a.ply -o a.vtu -r 40 --time-limit 0.001", "W8002", 8);
    assert!(error["help"].as_str().unwrap().starts_with("--time-limit "), "{error:#}");
    assert_eq!(bench.names(), ["a.ply"], "nothing is left");
    bench.run("mesh a.ply -o a.vtu -r 4 --time-limit 600").ok();
}

#[test]
fn outputs_are_checked_before_the_work() {
    let bench = Bench::new();
    bench.file("a.obj", cube(0.0, 1.0, 1, false));
    let error = bench.fails("mesh a.obj -o a.ply", "W4002", 4);
    assert_eq!(error["help"].as_str().map(|help| help.starts_with("-o a.vtu")), Some(true), "{error:#}");
    bench.fails("mesh a.obj -o a", "W4002", 4);
    bench.fails("mesh a.obj -o a.vtu --hosts hosts.txt", "W4002", 4);
    bench.fails("mesh a.obj -o a.vtu --picture a.jpg", "W4002", 4);
    bench.fails("mesh a.obj -o a.csv --to vtu --hosts a.csv", "W2001", 2);
    bench.fails("mesh a.obj -o a.obj --to vtu --force", "W2005", 2);
    bench.fails("mesh a.obj -o no/such/a.vtu", "W7001", 7);
    bench.fails("mesh b.obj -o a.vtu", "W4001", 4);
    bench.file("a.vtu", "mine");
    bench.fails("mesh a.obj -o a.vtu", "W7003", 7);
    assert_eq!(bench.read("a.vtu"), b"mine");
    if Path::new("/dev/full").exists() {
        bench.fails("mesh a.obj -o /dev/full --to vtu -r 4", "W7004", 7);
        let error = bench.fails("mesh a.obj -o /dev/full --to msh -r 4", "W7004", 7);
        assert!(error["what"].as_str().unwrap().contains("no space left"), "{error:#}");
    }
    assert_eq!(bench.names(), ["a.obj", "a.vtu"]);
}

#[test]
fn ctrl_c_ends_it_without_a_trace() {
    let bench = Bench::new();
    bench.run("shape ring-overlap -o a.ply").ok();
    let child = bench.command(&["mesh", "a.ply", "-o", "a.vtu", "-r", "150"]).spawn().unwrap();
    let ran = bench.interrupt_writing(child, 1);
    assert!(ran.err.contains("error[W0130]: interrupted"), "{}", ran.err);
    assert_eq!(bench.names(), ["a.ply"]);
}
