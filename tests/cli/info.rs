//! `welter info`.

use crate::harness::{Bench, TETRAHEDRON};
use serde_json::{Value, json};

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

#[test]
fn volumetric_meshes_are_described() {
    let bench = Bench::new();
    bench.run("shape two-boxes -o a.ply").ok();
    let (meshed, _) = bench.json("mesh a.ply -o a.vtu -r 6 --boundary --no-verify");
    bench.run("mesh a.ply -o a.msh -r 6 --tet --no-verify").ok();
    bench.run("mesh a.ply -o a.mesh -r 6 --no-verify").ok();
    let (object, ran) = bench.json("info a.vtu");
    let file = &object["files"][0];
    for key in ["hexahedra", "vertices"] {
        assert_eq!(file[key], meshed[key], "{key}");
    }
    let number = |key: &str| file[key].as_u64().unwrap();
    assert_eq!(
        (&file["format"], number("parts"), number("tetrahedra"), number("triangles")),
        (&"vtu".into(), 2, 0, 0)
    );
    assert_eq!(file["bytes"].as_u64(), Some(bench.read("a.vtu").len() as u64));
    let copy = &file["cell_fields"][0];
    assert_eq!(copy, &json!({ "name": "copy", "type": "int32", "components": 1, "ranges": [[0.0, 1.0]] }));
    assert_eq!(file["point_fields"], json!([]));
    let [faces, first, second] = [0, 1, 2].map(|k| file["groups"][k].clone());
    assert_eq!(
        (&faces["name"], &faces["dimension"], &faces["tag"]),
        (&"surface".into(), &2.into(), &1.into())
    );
    assert_eq!(faces["cells"], file["quadrilaterals"]);
    let cells = [&first, &second].map(|group| group["cells"].as_u64().unwrap());
    assert_eq!(cells.iter().sum::<u64>(), number("hexahedra"));
    assert_eq!(second["name"], "component 2");
    let low = file["bounding_box"][0].as_array().unwrap().iter().zip(meshed["origin"].as_array().unwrap());
    assert!(low.into_iter().all(|(low, origin)| low.as_f64() >= origin.as_f64()), "{file:#}");
    for words in [
        "format         VTU",
        "hexahedra      ",
        "quadrilaterals ",
        "parts          2",
        "\"copy\", int32, 0 .. 1",
        "\"surface\", ",
        "(tag = 1)",
    ] {
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
    }
    // MEDIT has no names, but tags.
    let (object, ran) = bench.json("info a.mesh");
    assert_eq!(object["files"][0]["groups"][0]["name"], Value::Null, "{object:#}");
    assert_eq!(object["files"][0]["groups"].as_array().unwrap().len(), 3);
    assert!(ran.err.contains("no name, "), "{}", ran.err);
    let (object, ran) = bench.json("info .");
    assert_eq!((ran.exit, object["files"].as_array().unwrap().len()), (Some(0), 4), "{}", ran.err);
    let msh = object["files"].as_array().unwrap().iter().find(|file| file["format"] == "msh").unwrap();
    assert!(msh["tetrahedra"].as_u64() > Some(0) && msh["hexahedra"] == 0, "{msh:#}");
}

#[test]
fn malformed_volumetric_meshes_are_told_with_their_place() {
    let bench = Bench::new();
    bench.file("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 x 0\n");
    let error = bench.fails("info a.msh", "W4006", 4);
    assert_eq!(error["where"], json!(["a.msh:6"]), "{error:#}");
    assert!(!error["help"].as_str().unwrap().contains("--from"), "{error:#}");
    bench.file("a.vtu", "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">");
    let error = bench.fails("info a.vtu", "W4010", 4);
    assert!(error["help"].as_str().unwrap().contains("compressed by zlib or not at all"), "{error:#}");
    bench.file("none.mesh", "");
    bench.fails("info none.mesh", "W4005", 4);
    bench.fails("info missing.vtu", "W4001", 4);
    bench.fails("info a.vtu --max-memory 10", "W6001", 6);
    // Other commands take surfaces, and say so.
    for line in ["check a.vtu", "mesh a.msh -o b.vtu", "convert a.vtu -o b.ply"] {
        let error = bench.fails(line, "W4002", 4);
        assert!(error["what"].as_str().unwrap().contains("volumetric mesh"), "{line}: {error:#}");
        assert!(error["help"].as_str().unwrap().starts_with("welter info a."), "{line}: {error:#}");
    }
}
