//! `welter render`.

use crate::harness::{Bench, TETRAHEDRON};

/// Width and height from the header of a PNG.
fn size(png: &[u8]) -> [u32; 2] {
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn a_picture_has_the_size_asked_for() {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    let (object, ran) = bench.json("render t.obj -o t.png --size 64x48");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!((&object["width"], &object["height"]), (&64.into(), &48.into()));
    assert_eq!(size(&bench.read("t.png")), [64, 48]);
}

#[test]
fn every_option_changes_the_picture() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.ply").ok();
    let mut seen = Vec::new();
    for options in [
        "",
        " --edges",
        " --self-intersections",
        " --cut x=0.1",
        " --camera 70,10",
        " --camera 70,10,30",
        " --up z --camera 70,10",
        " --color component",
    ] {
        bench.run(&format!("render a.ply -o a.png --force --size 120x90{options}")).ok();
        let png = bench.read("a.png");
        assert!(!seen.contains(&png), "{options}");
        seen.push(png);
    }
}

#[test]
fn flat_and_smooth_shading_differ_on_a_sphere() {
    let bench = Bench::new();
    bench.run("shape sphere -o a.ply --size 0.4").ok();
    bench.run("render a.ply -o smooth.png --size 120x90").ok();
    bench.run("render a.ply -o flat.png --size 120x90 --flat").ok();
    assert!(bench.read("smooth.png") != bench.read("flat.png"));
}

#[test]
fn mistakes_are_told() {
    let bench = Bench::new();
    bench
        .file("t.obj", TETRAHEDRON)
        .file("none.obj", "v 0 0 0\n")
        .file("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    bench.fails("render t.obj -o t.jpg", "W4002", 4);
    bench.fails("render none.obj -o t.png", "W3013", 3);
    bench.fails("render nan.obj -o t.png", "W3012", 3);
    for option in ["--size 0x5", "--size 99999x99999", "--cut w=1", "--camera up", "--color mauve"] {
        bench.fails(&format!("render t.obj -o t.png {option}"), "W2001", 2);
    }
    assert!(!bench.exists("t.png"));
}

#[test]
fn volumetric_meshes_are_drawn() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.ply").ok();
    bench.run("mesh a.ply -o a.vtu -r 6").ok();
    let mut seen = Vec::new();
    for options in ["", " --cut z=0.1", " --color component", " --edges"] {
        let (object, ran) = bench.json(&format!("render a.vtu -o a.png --force --size 120x90{options}"));
        assert_eq!(ran.exit, Some(0), "{}", ran.err);
        assert!(object["triangles"].as_u64() > Some(24), "{object:#}");
        let png = bench.read("a.png");
        assert!(size(&png) == [120, 90] && !seen.contains(&png), "{options}");
        seen.push(png);
    }
    // Hexahedra and their faces give the same boundary.
    bench.run("mesh a.ply -o b.mesh -r 6").ok();
    bench.run("render a.vtu -o a.png --force --size 120x90").ok();
    bench.run("render b.mesh -o b.png --size 120x90").ok();
    assert!(bench.read("a.png") == bench.read("b.png"));
    bench.file(
        "nan.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n$Elements\n0\n$EndElements\n",
    );
    let error = bench.fails("render nan.msh -o c.png", "W3012", 3);
    assert_eq!(error["where"], serde_json::json!(["vertex 0, counted from 0"]), "{error:#}");
    bench.file(
        "none.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n",
    );
    bench.fails("render none.msh -o c.png", "W3013", 3);
}
