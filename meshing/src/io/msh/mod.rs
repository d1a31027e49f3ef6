//! Gmsh meshes (`.msh`) \[Geuzaine09\], versions 2.2 and 4.1, text and binary: [`write_msh`], [`read_msh`].
//!
//! # What it promises
//! * Written and read again, positions and cells are the same bit for bit (in text NaN loses its payload), and so are fields of real
//!   numbers with 1, 3 or 9 components, and tags with their names.
//! * The same bytes for the same mesh. Nothing is written before it is checked, and the file is never held in memory.
//! * Reading takes both byte orders, node and element numbers in any order and with gaps, and cells in any order of kinds. Lines, points,
//!   prisms, pyramids and cells of higher order are passed over and reported, and so are sections that hold no mesh.
//! * Malformed input is a [`ReadError`] with the line (text) or byte (binary). Memory is proportional to the data that arrived.
//!
//! # What it does not promise
//! * Integer types: data in this format are f64. The report of the writer names each field that changes.
//! * Names of more than 127 bytes, with quotation marks or control characters: they are written shortened or with others, no two alike.
//! * The surfaces, curves and points that bound a volume: entities are written without their boundary, and all nodes stand in one of them.
//!
//! # Method
//! Tags become physical groups, of the names of the mesh's groups. Cells of a tag belong to an entity of the same number, cells of tag 0 to the first entity that has no tag.
//! Version 4.1 keeps entities in a section of their own and cells in blocks of one entity: each run of cells of one kind and tag is a
//! block. Linear time, but for sorting numbers with gaps: O(n log n).

mod data;
mod entities;
mod ids;
mod input;
mod names;
mod output;
mod read;
mod read_data;
mod read_four;
mod read_two;
mod types;
mod write_data;
mod write_four;
mod write_two;

use std::io::{Read, Write};

use super::{Encoding, Limits, ReadError, ReadReport, VolumeData, VolumeView, WriteError, WriteReport};

/// The names of the fields that hold physical tags, and numbers of entities, when read.
pub(super) const PHYSICAL: &str = "gmsh:physical";
pub(super) const GEOMETRICAL: &str = "gmsh:geometrical";

/// A version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MshVersion {
    /// Version 2.2: what most programs read.
    V2,
    /// Version 4.1: what Gmsh writes.
    #[default]
    V4,
}

/// How to write MSH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MshOptions<'a> {
    /// The version. Default: 4.1.
    pub version: MshVersion,
    /// Text or little-endian binary. Default: binary.
    pub encoding: Encoding,
    /// Name of the field of integers on cells that becomes their physical tags, from 0 (none) to 2^31 - 2. Default: no tags.
    pub tags: Option<&'a str>,
}

impl Default for MshOptions<'_> {
    fn default() -> Self {
        Self { version: MshVersion::V4, encoding: Encoding::Binary, tags: None }
    }
}

/// Writes a volumetric mesh as an MSH file. Quadrilaterals and triangles are its two-dimensional elements. The report names fields that
/// the format cannot hold.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError::Corner`], [`WriteError::ArrayLength`], [`WriteError::ArrayName`], [`WriteError::CellGroup`], [`WriteError::NoTags`],
/// [`WriteError::Tag`], [`WriteError::TooMany`], or the writer failed.
///
/// ```
/// use welter_meshing::{DVec3, io::{DataField, Encoding, Limits, MshOptions, MshVersion, VolumeData, read_msh, write_msh}};
/// let mesh = VolumeData {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     tetrahedra: vec![[0, 1, 2, 3]],
///     cell_fields: vec![DataField::new("body", 1, vec![7_i32])],
///     ..VolumeData::default()
/// };
/// let options = MshOptions { version: MshVersion::V2, encoding: Encoding::Ascii, tags: Some("body") };
/// let mut file = Vec::new();
/// let report = mesh.with_view(|view| write_msh(&mut file, view, &options))?;
/// assert_eq!(report.dropped[0].to_string(), "field \"body\": written as tags");
/// let (read, _) = read_msh(&file[..], &Limits::default())?;
/// assert_eq!(read.cell_fields, [DataField::new("gmsh:physical", 1, vec![7_i32])]);
/// assert!(String::from_utf8(file)?.contains("$Elements\n1\n1 4 2 7 7 1 2 3 4\n$EndElements"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_msh(
    mut output: impl Write,
    mesh: &VolumeView<'_>,
    options: &MshOptions<'_>,
) -> Result<WriteReport, WriteError> {
    mesh.check()?;
    let tags = entities::Tags::new(mesh, options.tags)?;
    if options.version == MshVersion::V2 {
        write_two::check(mesh)?;
    }
    let names = names::Names::new(mesh.groups, options.tags)?;
    let mut dropped = data::dropped(mesh, options.tags);
    dropped.extend(names.dropped());
    let mut out = output::Output::new(&mut output, options.encoding);
    match options.version {
        MshVersion::V2 => write_two::write(&mut out, mesh, &tags, &names)?,
        MshVersion::V4 => write_four::write(&mut out, mesh, &tags, &names)?,
    }
    write_data::write(&mut out, mesh, options.tags)?;
    output.flush()?;
    Ok(WriteReport { dropped })
}

/// Reads an MSH file, and says what it held besides.
///
/// Physical tags that are not all 0 become the field `gmsh:physical` on cells, the first where there are several. Numbers of entities
/// become the field `gmsh:geometrical` where they say more: where one is not the physical tag, or where cells without tag are of several.
/// Names of physical groups become groups of the field `gmsh:physical`.
/// Of data with several time steps the first is read. Places without a value are NaN, if at least one in 16 has one.
///
/// `input` is read to its end in large blocks and needs no buffer of its own.
///
/// # Errors
/// [`ReadError`]: malformed, truncated, empty, of another version, over the limits, or the reader failed.
///
/// ```
/// use welter_meshing::io::{Limits, read_msh};
/// let file = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n7 0 1 0\n$EndNodes\n\
///     $Elements\n1\n1 2 2 0 1 1 2 7\n$EndElements\n";
/// let (mesh, _) = read_msh(&file[..], &Limits::default())?;
/// assert_eq!(mesh.triangles, [[0, 1, 2]]);
/// # Ok::<(), welter_meshing::io::ReadError>(())
/// ```
pub fn read_msh(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    read::read(input, limits)
}
