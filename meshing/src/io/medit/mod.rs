//! MEDIT meshes (`.mesh`, text) \[Frey01\]: volumetric meshes as mmg, TetGen, GetFEM and others take them: [`write_medit`], [`read_medit`].
//!
//! # What it promises
//! * Written and read again, positions and cells are the same bit for bit (NaN without its payload), and so are the references.
//! * The same bytes for the same mesh. Nothing is written before it is checked, and the file is never held in memory.
//! * Malformed input is a [`ReadError`] with the line. Memory is proportional to the data that arrived.
//!
//! # What it does not promise
//! Fields: the format has one integer for each vertex and cell, its reference, and no other; and no names for references. Sections other than vertices, hexahedra,
//! tetrahedra, quadrilaterals and triangles are passed over and reported. Binary files (`.meshb`) are not read.
//!
//! # Method
//! Keywords, each with a count and as many rows. One pass, linear time.

mod read;
mod write;

use std::io::{Read, Write};

use super::data_field::DataField;
use super::{Dropped, Limits, ReadError, ReadReport, VolumeData, VolumeView, WriteError, WriteReport};

/// The name of the fields that hold references when read.
pub(super) const REFERENCE: &str = "medit:ref";

/// How to write MEDIT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeditOptions<'a> {
    /// Name of the field of integers on vertices that becomes their references; 0 without.
    pub vertex_references: Option<&'a str>,
    /// Name of the field of integers on cells that becomes their references; 0 without.
    pub cell_references: Option<&'a str>,
}

/// Writes a volumetric mesh as MEDIT text. Fields other than the references and names of groups are dropped, and the
/// report names them.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError::Corner`], [`WriteError::ArrayLength`], [`WriteError::ArrayName`], [`WriteError::NoTags`], [`WriteError::TooMany`], or
/// the writer failed.
///
/// ```
/// use welter_meshing::{DVec3, io::{DataField, MeditOptions, VolumeData, write_medit}};
/// let mesh = VolumeData {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     tetrahedra: vec![[0, 1, 2, 3]],
///     cell_fields: vec![DataField::new("body", 1, vec![7_i32])],
///     ..VolumeData::default()
/// };
/// let options = MeditOptions { cell_references: Some("body"), ..MeditOptions::default() };
/// let mut file = Vec::new();
/// let report = mesh.with_view(|view| write_medit(&mut file, view, &options))?;
/// assert_eq!(report.dropped[0].to_string(), "field \"body\": written as tags");
/// assert!(String::from_utf8(file)?.contains("Tetrahedra\n1\n1 2 3 4 7\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_medit(
    mut output: impl Write,
    mesh: &VolumeView<'_>,
    options: &MeditOptions<'_>,
) -> Result<WriteReport, WriteError> {
    mesh.check()?;
    let vertices = references(mesh.point_fields, options.vertex_references, "vertex")?;
    let cells = references(mesh.cell_fields, options.cell_references, "cell")?;
    write::write(&mut output, mesh, vertices, cells)?;
    output.flush()?;
    let mut dropped = write::dropped(mesh, vertices, cells);
    if !mesh.groups.is_empty() {
        dropped.push(Dropped::NamesOfTags { count: mesh.groups.len() });
    }
    Ok(WriteReport { dropped })
}

/// The field that holds references.
fn references<'a>(
    fields: &'a [DataField<'a>],
    name: Option<&str>,
    place: &'static str,
) -> Result<Option<&'a DataField<'a>>, WriteError> {
    let Some(name) = name else { return Ok(None) };
    let fits =
        |field: &&DataField<'_>| field.name == name && field.components == 1 && field.values.is_integer();
    let field = fields.iter().find(fits);
    field.map(Some).ok_or_else(|| WriteError::NoTags { name: name.to_owned(), place })
}

/// Reads MEDIT text, and says what it held besides. References that are not all 0 become fields of integers of the name `medit:ref`.
///
/// Points of two dimensions are given z = 0. `input` is read to its end in large blocks and needs no buffer of its own.
///
/// # Errors
/// [`ReadError`]: malformed, truncated, empty, binary, over the limits, or the reader failed.
///
/// ```
/// use welter_meshing::io::{Limits, read_medit};
/// let file = b"MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n";
/// let (mesh, _) = read_medit(&file[..], &Limits::default())?;
/// assert_eq!(mesh.triangles, [[0, 1, 2]]);
/// let error = read_medit(&file[..file.len() - 8], &Limits::default()).unwrap_err();
/// assert_eq!(error.to_string(), "line 10: the file ends here, expected corner 3 of triangle 1 of the 1 declared");
/// # Ok::<(), welter_meshing::io::ReadError>(())
/// ```
pub fn read_medit(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    read::read(input, limits)
}
