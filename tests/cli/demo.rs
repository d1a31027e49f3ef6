//! `welter demo`.

use crate::harness::Bench;
use serde_json::Value;

#[test]
fn the_demo_writes_a_picture_a_surface_and_its_reports() {
    let bench = Bench::new();
    let (object, ran) = bench.json("demo --size 320x240");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    for name in [
        "ring-overlap.png",
        "ring-overlap.ply",
        "ring-overlap-mesh.png",
        "ring-overlap.vtu",
        "report.html",
        "report.json",
    ] {
        assert!(bench.exists(&format!("demo/{name}")), "{name}");
        assert!(ran.err.contains(&format!("demo/{name}")), "the person is told where: {}", ran.err);
    }
    let pairs = object["findings"]["self_intersecting_pairs"].as_u64().unwrap();
    assert!(pairs > 0);
    let report: Value = serde_json::from_slice(&bench.read("demo/report.json")).unwrap();
    assert_eq!(report["findings"]["self_intersecting_pairs"], pairs);
    // The surface that was written gives the same answer.
    let (again, _) = bench.json("check demo/ring-overlap.ply");
    assert_eq!(again["files"][0]["self_intersecting_pairs"], pairs);

    // The volume within: one ball, bent so that its ends lie over one another.
    let mesh = &object["mesh"];
    assert_eq!((&mesh["sheets"], &mesh["euler_characteristic"]), (&2.into(), &1.into()), "{mesh:#}");
    assert_eq!(mesh["verification"]["embedding"], true, "{mesh:#}");
    assert_eq!(report["mesh"], *mesh);
    let volume = bench.read("demo/ring-overlap.vtu");
    let (volume, _) =
        welter_meshing::io::read_vtu(&volume[..], &welter_meshing::io::Limits::default()).unwrap();
    assert_eq!(mesh["hexahedra"], volume.hexahedra.len());

    let png = bench.read("demo/ring-overlap.png");
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let html = String::from_utf8(bench.read("demo/report.html")).unwrap();
    assert!(html.contains("data:image/png;base64,iVBOR"), "the picture is in the page");
    assert!(!html.contains("http://") && !html.contains("https://"), "the page needs nothing else");

    // A second demo replaces the first; it gives the same bits.
    bench.run("demo --size 320x240 -j 1").ok();
    assert!(bench.read("demo/ring-overlap.png") == png);
}

#[test]
fn any_shape_can_be_shown_anywhere() {
    let bench = Bench::new();
    bench.run("demo two-boxes --size 320x240 -o here").ok();
    assert!(bench.exists("here/two-boxes.png"));
}

#[test]
fn files_of_others_are_not_overwritten_and_a_missing_parent_is_told() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("mine")).unwrap();
    bench.file("mine/report.html", "mine");
    bench.fails("demo two-boxes --size 320x240 -o mine", "W7003", 7);
    assert_eq!(bench.read("mine/report.html"), b"mine");
    assert!(!bench.exists("mine/two-boxes.png"));
    bench.fails("demo two-boxes --size 320x240 -o no/such/folder", "W7001", 7);
    bench.file("file", "x");
    bench.fails("demo two-boxes --size 320x240 -o file", "W7003", 7);
    bench.fails("demo toruss", "W2002", 2);
    assert_eq!(bench.names(), ["file", "mine"], "no empty folder is left");
}
