//! Readers of files of volumetric meshes on any bytes.

use super::trickle::Trickle;
use std::io::Read;
use welter_meshing::io::{
    DataField, Encoding, FieldValues, Limits, MeditOptions, MshOptions, MshVersion, ReadError, ReadReport,
    VolumeData, VtkEncoding, WriteError, WriteReport, read_medit, read_msh, read_vtu, write_medit, write_msh,
    write_vtu,
};

/// The VTU reader, in all three encodings.
pub fn read_vtu_volume(bytes: &[u8]) {
    let Some(mesh) = read(bytes, |input| read_vtu(input, &Limits::default())) else { return };
    for encoding in [VtkEncoding::Appended, VtkEncoding::Base64, VtkEncoding::Ascii] {
        let write = |file: &mut Vec<u8>| mesh.with_view(|view| write_vtu(file, view, encoding));
        let again = written(&mesh, write, |input| read_vtu(input, &Limits::default()));
        let Some((again, report)) = again else { continue };
        let as_text = encoding == VtkEncoding::Ascii;
        // Names of groups may have control characters, which no attribute can hold.
        let (mesh, again) = if report.dropped.is_empty() {
            (mesh.clone(), again)
        } else {
            (cells_alone(&mesh), cells_alone(&again))
        };
        assert!(same(&mesh, &again, as_text), "{encoding:?}: {mesh:?} {again:?}");
    }
}

/// The MSH reader, of both versions, text and binary.
pub fn read_msh_volume(bytes: &[u8]) {
    let Some(mesh) = read(bytes, |input| read_msh(input, &Limits::default())) else { return };
    let tags = mesh.cell_fields.iter().any(|field| field.name == "gmsh:physical").then_some("gmsh:physical");
    for version in [MshVersion::V2, MshVersion::V4] {
        for encoding in [Encoding::Ascii, Encoding::Binary] {
            let options = MshOptions { version, encoding, tags };
            let write = |file: &mut Vec<u8>| mesh.with_view(|view| write_msh(file, view, &options));
            // Tags may be negative, and names of fields such as no writer takes.
            let Some((again, report)) = written(&mesh, write, |input| read_msh(input, &Limits::default()))
            else {
                continue;
            };
            let whole = report.dropped.is_empty() && again.cell_fields.len() == mesh.cell_fields.len();
            let (mesh, again) =
                if whole { (mesh.clone(), again) } else { (cells_alone(&mesh), cells_alone(&again)) };
            assert!(same(&mesh, &again, encoding == Encoding::Ascii), "{options:?}: {mesh:?} {again:?}");
        }
    }
}

/// The MEDIT reader.
pub fn read_medit_volume(bytes: &[u8]) {
    let Some(mesh) = read(bytes, |input| read_medit(input, &Limits::default())) else { return };
    let of = |fields: &[DataField<'_>]| (!fields.is_empty()).then_some("medit:ref");
    let options =
        MeditOptions { vertex_references: of(&mesh.point_fields), cell_references: of(&mesh.cell_fields) };
    let write = |file: &mut Vec<u8>| mesh.with_view(|view| write_medit(file, view, &options));
    let (again, report) = written(&mesh, write, |input| read_medit(input, &Limits::default()))
        .expect("what MEDIT holds can be written as MEDIT");
    assert_eq!(report.dropped, [], "{mesh:?}");
    assert!(same(&mesh, &again, true), "{mesh:?} {again:?}");
}

/// Reads any bytes: no panic, nothing larger than the file can hold, fields and corners that fit, and the same however the bytes arrive.
fn read(
    bytes: &[u8],
    read: impl Fn(&mut dyn Read) -> Result<(VolumeData, ReadReport), ReadError>,
) -> Option<VolumeData> {
    let whole = read(&mut &bytes[..]);
    for step in [1, 7] {
        let pieces = read(&mut Trickle { rest: bytes, step });
        match (&whole, &pieces) {
            (Ok((mesh, report)), Ok((again, reported))) => {
                assert!(same(mesh, again, false), "{mesh:?} {again:?}");
                assert_eq!(report, reported);
            }
            (Err(error), Err(again)) => assert_eq!(error.to_string(), again.to_string()),
            _ => panic!("whole: {whole:?}, in pieces: {pieces:?}"),
        }
    }
    let (mesh, _) = whole.ok()?;
    let (vertices, cells) = (mesh.positions.len(), mesh.cell_count());
    assert!(vertices <= bytes.len() && cells <= bytes.len(), "more than the file holds");
    let corners = mesh.hexahedra.as_flattened().iter().chain(mesh.tetrahedra.as_flattened());
    let corners = corners.chain(mesh.quadrilaterals.as_flattened()).chain(mesh.triangles.as_flattened());
    assert!(corners.into_iter().all(|&corner| (corner as usize) < vertices), "a corner that is no vertex");
    for (fields, places) in [(&mesh.point_fields, vertices), (&mesh.cell_fields, cells)] {
        for field in fields {
            assert_eq!(field.values.len(), places * field.components, "{}", field.name);
            (0..field.components).for_each(|k| _ = field.range(k));
        }
    }
    // What is asked of meshes holds for any.
    assert!(mesh.part_count() <= vertices.min(cells));
    let sides = 12 * mesh.hexahedra.len() + 4 * mesh.tetrahedra.len();
    assert!(mesh.boundary().triangles.len() <= sides + 2 * cells);
    assert!(mesh.tagged_cells(|_| true).iter().all(|tagged| tagged.cells <= cells));
    Some(mesh)
}

/// What was written, read again, with the report of the writer; none if the writer refuses the mesh.
fn written(
    mesh: &VolumeData,
    write: impl FnOnce(&mut Vec<u8>) -> Result<WriteReport, WriteError>,
    read: impl FnOnce(&[u8]) -> Result<(VolumeData, ReadReport), ReadError>,
) -> Option<(VolumeData, WriteReport)> {
    let mut file = Vec::new();
    let report = write(&mut file).ok()?;
    match read(&file) {
        Ok((again, _)) => Some((again, report)),
        Err(error) => panic!("what was written cannot be read: {error}: {mesh:?}"),
    }
}

/// Vertices and cells without what belongs to them.
fn cells_alone(mesh: &VolumeData) -> VolumeData {
    VolumeData { point_fields: Vec::new(), cell_fields: Vec::new(), groups: Vec::new(), ..mesh.clone() }
}

/// Equal bit for bit, so that NaN equals itself; in text all NaN are equal.
fn same(a: &VolumeData, b: &VolumeData, as_text: bool) -> bool {
    let bits = |x: f64| if as_text && x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
    let positions = |mesh: &VolumeData| -> Vec<u64> {
        mesh.positions.iter().flat_map(|p| p.to_array()).map(bits).collect()
    };
    let fields = |fields: &[DataField<'static>], others: &[DataField<'static>]| {
        fields.len() == others.len()
            && fields.iter().zip(others).all(|(field, other)| {
                let values = match (&field.values, &other.values) {
                    (FieldValues::Float64(a), FieldValues::Float64(b)) => {
                        a.len() == b.len() && a.iter().zip(b.iter()).all(|(&a, &b)| bits(a) == bits(b))
                    }
                    (a, b) => a == b,
                };
                values && (&field.name, field.components) == (&other.name, other.components)
            })
    };
    // Those of one name are together in a VTU file, wherever they were.
    let groups = |mesh: &VolumeData| {
        let mut groups = mesh.groups.clone();
        groups.sort_by(|a, b| (&a.field, a.dimension, a.tag).cmp(&(&b.field, b.dimension, b.tag)));
        groups
    };
    positions(a) == positions(b)
        && (&a.hexahedra, &a.tetrahedra) == (&b.hexahedra, &b.tetrahedra)
        && (&a.quadrilaterals, &a.triangles) == (&b.quadrilaterals, &b.triangles)
        && fields(&a.point_fields, &b.point_fields)
        && fields(&a.cell_fields, &b.cell_fields)
        && groups(a) == groups(b)
}
