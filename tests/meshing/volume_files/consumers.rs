//! What other programs read of files written here: meshio in every run of `./test.sh`; VTK, PyVista and Gmsh with `--consumers`.
//!
//! They are Python packages, installed by `./test.sh` into environments of their own. Where one is missing, its test says that it was
//! not run, or fails if the variable that `./test.sh` sets demands it.

use super::{FORMS, Form};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use welter_kit::generate::volumes::stacked_cells;
use welter_meshing::grid::Grid3;
use welter_meshing::io::{
    CellGroup, DataArray, DataField, FieldValues, MshVersion, TimedFile, VolumeData, VtkEncoding, write_pvd,
    write_vti, write_vtp,
};
use welter_meshing::shapes::by_name;

/// The corners of a hexahedron in the order of VTK, Gmsh and MEDIT, after their pictures of it.
const AROUND: [usize; 8] = [0b000, 0b001, 0b011, 0b010, 0b100, 0b101, 0b111, 0b110];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The Python of an environment that `./test.sh` makes under `target`, or that a variable names.
fn python(folder: &str, variable: &str, how: &str) -> Option<PathBuf> {
    let named = std::env::var_os(variable).map(PathBuf::from);
    let python = named.unwrap_or_else(|| root().join("target").join(folder).join("bin/python"));
    if python.exists() {
        return Some(python);
    }
    let missing = format!("{} is missing: {how} makes it, or {variable} names a Python", python.display());
    assert!(std::env::var_os(format!("{variable}_REQUIRED")).is_none(), "{missing}");
    println!("NOT RUN: {missing}");
    None
}

/// What a script prints of files: one JSON value for each.
fn described(python: &Path, script: &str, files: &[(String, Vec<u8>)]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(python);
    command.arg(root().join("tests/consumers").join(script)).current_dir(folder.path());
    for (name, file) in files {
        std::fs::write(folder.path().join(name), file).unwrap();
        command.arg(name);
    }
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{script} failed: {errors}");
    let text = String::from_utf8(output.stdout).unwrap();
    // Libraries print lines of their own, if only empty ones.
    let objects = text.lines().filter(|line| line.starts_with('{'));
    let values: Vec<Value> = objects.map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(values.len(), files.len(), "{script}: {text} {errors}");
    values
}

fn bits<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    numbers.into_iter().map(|number| number.to_bits()).collect()
}

fn position_bits(mesh: &VolumeData) -> Vec<u64> {
    mesh.positions.iter().flat_map(|p| p.to_array()).map(f64::to_bits).collect()
}

fn integers(value: &Value) -> Vec<u64> {
    value.as_array().unwrap().iter().map(|number| number.as_u64().unwrap()).collect()
}

/// The numbers of a field as f64.
fn reals(values: &FieldValues<'_>) -> Vec<f64> {
    match values {
        FieldValues::Float64(values) => values.to_vec(),
        FieldValues::Int32(values) => values.iter().map(|&v| f64::from(v)).collect(),
        FieldValues::Int64(values) => values.iter().map(|&v| v as f64).collect(),
        FieldValues::UInt8(values) => values.iter().map(|&v| f64::from(v)).collect(),
        other => panic!("{other:?}"),
    }
}

/// The cells of each kind with meshio's name and in its order.
fn cells(mesh: &VolumeData) -> [(&'static str, Vec<Vec<u32>>); 4] {
    [
        ("hexahedron", mesh.hexahedra.iter().map(|cell| AROUND.map(|c| cell[c]).to_vec()).collect()),
        ("tetra", mesh.tetrahedra.iter().map(|cell| cell.to_vec()).collect()),
        ("quad", mesh.quadrilaterals.iter().map(|cell| cell.to_vec()).collect()),
        ("triangle", mesh.triangles.iter().map(|cell| cell.to_vec()).collect()),
    ]
}

/// A field as meshio found it.
fn check_field(found: &Value, field: &DataField<'_>, as_real: bool, context: &str) {
    assert_eq!(found["components"], field.components, "{context}");
    let integer: Option<Vec<i64>> = match &field.values {
        FieldValues::Int32(values) => Some(values.iter().map(|&v| v.into()).collect()),
        FieldValues::Int64(values) => Some(values.to_vec()),
        FieldValues::UInt8(values) => Some(values.iter().map(|&v| v.into()).collect()),
        _ => None,
    };
    match integer.filter(|_| !as_real) {
        Some(integer) => assert_eq!(found["values"], serde_json::json!(integer), "{context}"),
        None => {
            assert_eq!(found["real"], true, "{context}");
            assert_eq!(integers(&found["values"]), bits(&reals(&field.values)), "{context}");
        }
    }
}

/// The tag and dimension of each group by its name, behind a prefix.
fn named_pairs(mesh: &VolumeData, prefix: &str) -> Value {
    let pair = |group: &CellGroup| {
        (format!("{prefix}{}", group.name), serde_json::json!([group.tag, group.dimension]))
    };
    assert!(mesh.groups.len() > 2);
    Value::Object(mesh.groups.iter().map(pair).collect())
}

fn check_meshio(form: Form, mesh: &VolumeData, found: &Value) {
    assert_eq!(integers(&found["points"]["values"]), position_bits(mesh), "{form:?}");
    let mut blocks = found["cells"].as_array().unwrap().iter().peekable();
    for (kind, expected) in cells(mesh) {
        let mut of_kind = Vec::new();
        while let Some(block) = blocks.next_if(|block| block[0] == kind) {
            of_kind.extend(block[1].as_array().unwrap().iter().cloned());
        }
        assert_eq!(serde_json::json!(expected), Value::Array(of_kind), "{form:?} {kind}");
    }
    assert!(blocks.next().is_none(), "{form:?}");
    let context = |name: &str| format!("{form:?} {name}: {found}");
    let body = &mesh.cell_fields[0];
    let tags = match form {
        Form::Vtu(_) => "body",
        Form::Msh(..) => "gmsh:physical",
        Form::Medit => "medit:ref",
    };
    check_field(&found["cell_data"][tags], body, false, &context("body"));
    if form == Form::Medit {
        return;
    }
    // Tag and dimension by name, as meshio has them of MSH.
    let prefix = if matches!(form, Form::Vtu(_)) { "body:" } else { "" };
    assert_eq!(found["field_data"], named_pairs(mesh, prefix), "{form:?}");
    let as_real = matches!(form, Form::Msh(..));
    for field in &mesh.point_fields {
        check_field(&found["point_data"][&*field.name], field, as_real, &context(&field.name));
    }
    for field in &mesh.cell_fields[1..] {
        check_field(&found["cell_data"][&*field.name], field, as_real, &context(&field.name));
    }
}

#[test]
fn meshio_reads_what_was_written() {
    let Some(python) = python("venv", "WELTER_MESHIO_PYTHON", "./test.sh") else { return };
    let mesh_for = |form: Form| {
        let mut mesh = stacked_cells();
        if matches!(form, Form::Msh(MshVersion::V2, _)) {
            // meshio 5.3.5 cannot read data on elements of version 2.2, not even of files that it wrote itself. Gmsh can: see below.
            mesh.cell_fields.truncate(1);
        }
        mesh
    };
    let file = |form: Form| (form.name(), form.write(&mesh_for(form), Some("body")).unwrap().0);
    let files: Vec<_> = FORMS.into_iter().map(file).collect();
    for (form, found) in FORMS.into_iter().zip(described(&python, "with_meshio.py", &files)) {
        check_meshio(form, &mesh_for(form), &found);
    }
}

/// Arrays as VTK found them, with its names of types.
fn check_arrays(found: &Value, fields: &[DataField<'_>], context: &str) {
    assert_eq!(found.as_object().unwrap().len(), fields.len(), "{context}");
    for field in fields {
        let array = &found[&*field.name];
        let kinds: &[&str] = match &field.values {
            FieldValues::Float64(_) => &["double"],
            FieldValues::Int32(_) => &["int"],
            FieldValues::Int64(_) => &["long", "long long", "vtktypeint64"],
            _ => &["unsigned char"],
        };
        assert!(kinds.contains(&array["type"].as_str().unwrap()), "{context} {array}");
        assert_eq!(array["components"], field.components, "{context}");
        assert_eq!(integers(&array["values"]), bits(&reals(&field.values)), "{context} {}", field.name);
    }
}

fn all_positive(sizes: &Value, count: usize, context: &str) {
    let sizes = sizes.as_array().unwrap();
    assert_eq!(sizes.len(), count, "{context}");
    assert!(sizes.iter().all(|size| size.as_f64().unwrap() > 1e-3), "{context}: {sizes:?}");
}

fn check_vtu(mesh: &VolumeData, found: &Value, context: &str) {
    assert_eq!(integers(&found["points"]), position_bits(mesh), "{context}");
    let numbers = [12, 10, 9, 5];
    let (mut types, mut connectivity) = (Vec::new(), Vec::new());
    for ((_, cells), number) in cells(mesh).into_iter().zip(numbers) {
        types.extend(std::iter::repeat_n(number, cells.len()));
        connectivity.extend(cells.into_iter().flatten());
    }
    assert_eq!(found["types"], serde_json::json!(types), "{context}");
    assert_eq!(found["connectivity"], serde_json::json!(connectivity), "{context}");
    all_positive(&found["sizes"], types.len(), context);
    check_arrays(&found["point_data"], &mesh.point_fields, context);
    check_arrays(&found["cell_data"], &mesh.cell_fields, context);
    assert_eq!(found["pyvista_groups"], named_pairs(mesh, "body:"), "{context}");
    let fields = mesh.point_fields.iter().chain(&mesh.cell_fields).map(|field| field.name.to_string());
    let groups = mesh.groups.iter().map(|group| format!("body:{}", group.name));
    let mut names: Vec<String> = fields.chain(groups).collect();
    names.sort_unstable();
    assert_eq!(found["pyvista"], serde_json::json!([mesh.positions.len(), types.len(), names]), "{context}");
}

fn check_gmsh(mesh: &VolumeData, found: &Value, context: &str) {
    assert_eq!(integers(&found["points"]), position_bits(mesh), "{context}");
    for ((_, cells), number) in cells(mesh).into_iter().zip(["5", "4", "3", "2"]) {
        let flat: Vec<u32> = cells.into_iter().flatten().collect();
        assert_eq!(found["cells"][number], serde_json::json!(flat), "{context}");
    }
    // Volumes, and the smallest Jacobian determinants.
    all_positive(&found["sizes"]["5"], 2 * mesh.hexahedra.len(), context);
    all_positive(&found["sizes"]["4"], 2 * mesh.tetrahedra.len(), context);
    let groups = serde_json::json!({"2 1": 1, "2 5": 1, "2 6": 2, "3 1": 2, "3 2": 2, "3 3": 2});
    let mut expected = groups.clone();
    let FieldValues::Int32(tags) = &mesh.cell_fields[0].values else { panic!("tags are integers") };
    let solids = mesh.hexahedra.len() + mesh.tetrahedra.len();
    for (key, members) in expected.as_object_mut().unwrap() {
        let (dimension, tag) = key.split_once(' ').unwrap();
        let range = if dimension == "3" { &tags[..solids] } else { &tags[solids..] };
        *members = range.iter().filter(|t| t.to_string() == tag).count().into();
    }
    assert_eq!(found["groups"], groups, "{context}");
    let names: serde_json::Map<_, _> =
        mesh.groups.iter().map(|g| (format!("{} {}", g.dimension, g.tag), g.name.clone().into())).collect();
    assert_eq!(found["names"], Value::Object(names), "{context}");
    assert_eq!(expected, groups, "{context}");
    let views = found["views"].as_object().unwrap();
    assert_eq!(views.len(), mesh.point_fields.len() + mesh.cell_fields.len() - 1, "{context}");
    for (kind, fields) in [("NodeData", &mesh.point_fields[..]), ("ElementData", &mesh.cell_fields[1..])] {
        for field in fields {
            let view = &views[&*field.name];
            assert_eq!(
                (&view["kind"], &view["components"]),
                (&kind.into(), &field.components.into()),
                "{context}"
            );
            assert_eq!(integers(&view["values"]), bits(&reals(&field.values)), "{context} {}", field.name);
        }
    }
}

#[test]
fn vtk_and_gmsh_read_what_was_written() {
    let how = "./test.sh --consumers";
    let Some(python) = python("venv-consumers", "WELTER_CONSUMERS_PYTHON", how) else { return };
    let mesh = stacked_cells();
    let mut untagged = stacked_cells();
    untagged.cell_fields[0] = DataField::new("body", 1, vec![0, 2, 2, 0, 0, 3, 0, 4, 0, 4]);
    let grid = Grid3::new([0.5, -1.0, 2.0], 0.25, [3, 2, 1]).unwrap();
    let distance: Vec<f64> = (0..grid.node_count()).map(|k| 1.0 / (k as f64 + 3.0)).collect();
    let mut files = Vec::new();
    for form in FORMS.into_iter().filter(|form| *form != Form::Medit) {
        files.push((form.name(), form.write(&mesh, Some("body")).unwrap().0));
    }
    for version in [MshVersion::V2, MshVersion::V4] {
        let form = Form::Msh(version, welter_meshing::io::Encoding::Binary);
        files.push((format!("untagged-{}", form.name()), form.write(&untagged, Some("body")).unwrap().0));
    }
    for encoding in [VtkEncoding::Appended, VtkEncoding::Base64, VtkEncoding::Ascii] {
        let mut file = Vec::new();
        write_vti(&mut file, &grid, &[DataArray::scalars("distance", &distance)], &[], encoding).unwrap();
        files.push((format!("{encoding:?}.vti"), file));
    }
    let found = described(&python, "with_vtk_and_gmsh.py", &files);
    for ((name, _), found) in files.iter().zip(&found) {
        if name.ends_with(".vtu") {
            check_vtu(&mesh, found, name);
        } else if name.starts_with("untagged") {
            let groups = serde_json::json!({"2 4": 2, "3 2": 2, "3 3": 1});
            assert_eq!(found["groups"], groups, "{name}");
            assert_eq!(integers(&found["points"]), position_bits(&untagged), "{name}");
        } else if name.ends_with(".msh") {
            check_gmsh(&mesh, found, name);
        } else {
            assert_eq!(found["extent"], serde_json::json!([0, 3, 0, 2, 0, 1]), "{name}");
            assert_eq!(integers(&found["origin"]), bits(&grid.origin()), "{name}");
            assert_eq!(integers(&found["spacing"]), bits(&[0.25; 3]), "{name}");
            check_arrays(&found["point_data"], &[DataField::new("distance", 1, &distance)], name);
            let pyvista = serde_json::json!([grid.node_count(), grid.cell_count(), ["distance"]]);
            assert_eq!(found["pyvista"], pyvista, "{name}");
        }
    }
}

#[test]
fn vtk_reads_surfaces_over_time() {
    let how = "./test.sh --consumers";
    let Some(python) = python("venv-consumers", "WELTER_CONSUMERS_PYTHON", how) else { return };
    let mesh = by_name("torus", Some(0.4)).unwrap().into_mesh();
    let heights: Vec<f64> = mesh.positions().iter().map(|p| p.z / 3.0).collect();
    let kinds: Vec<f64> = (0..mesh.triangles().len()).map(|k| k as f64).collect();
    let (points, triangles) =
        ([DataArray::scalars("height", &heights)], [DataArray::scalars("kind", &kinds)]);
    let mut files = Vec::new();
    for encoding in [VtkEncoding::Appended, VtkEncoding::Base64, VtkEncoding::Ascii] {
        let mut file = Vec::new();
        write_vtp(&mut file, &mesh, &points, &triangles, encoding).unwrap();
        files.push((format!("{encoding:?}.vtp"), file));
    }
    let mut list = Vec::new();
    let times = [0.0, 0.1 + 0.2, 1e-7 + 1.0];
    let names = ["Appended.vtp", "Base64.vtp", "Ascii.vtp"];
    let timed: Vec<TimedFile<'_>> =
        times.iter().zip(names).map(|(&time, file)| TimedFile { time, file }).collect();
    write_pvd(&mut list, &timed).unwrap();
    files.push(("surface.pvd".into(), list));
    let found = described(&python, "with_vtk_and_gmsh.py", &files);
    let (vertices, count) = (mesh.positions().len(), mesh.triangles().len());
    for ((name, _), found) in files.iter().zip(&found).take(3) {
        let positions = mesh.positions().iter().flat_map(|p| p.to_array()).map(f64::to_bits);
        assert_eq!(integers(&found["points"]), positions.collect::<Vec<_>>(), "{name}");
        let corners: Vec<u64> = mesh.triangles().iter().flatten().map(|v| v.0.into()).collect();
        assert_eq!(integers(&found["triangles"]), corners, "{name}");
        assert_eq!(
            integers(&found["offsets"]),
            (0..=count as u64).map(|k| 3 * k).collect::<Vec<_>>(),
            "{name}"
        );
        check_arrays(&found["point_data"], &[DataField::new("height", 1, &heights)], name);
        check_arrays(&found["cell_data"], &[DataField::new("kind", 1, &kinds)], name);
        let area = welter_meshing::surface::measure::area(&mesh);
        assert!((found["area"].as_f64().unwrap() / area - 1.0).abs() < 1e-12, "{name}");
        assert_eq!(found["pyvista"], serde_json::json!([vertices, count, ["height", "kind"]]), "{name}");
    }
    let frames: Vec<Value> = times.iter().map(|t| serde_json::json!([t.to_bits(), count])).collect();
    assert_eq!(found[3]["frames"], Value::Array(frames));
}
