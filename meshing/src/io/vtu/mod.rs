//! VTK unstructured grids (`.vtu`) \[Schroeder06\]: volumetric meshes as ParaView and VTK read them: [`write_vtu`], [`read_vtu`].
//!
//! # What it promises
//! * Written and read again, meshes are the same bit for bit, with types and names of fields and with groups; in text NaN loses its payload.
//! * The same bytes for the same mesh. Nothing is written before indices, names and lengths are checked, and the file is never held in
//!   memory.
//! * Reading takes all three encodings, both byte orders, lengths of 32 or 64 bits and every number type of VTK: f32 becomes f64, small
//!   integers i32, u32 i64. Voxels and pixels become hexahedra and quadrilaterals; cells of other types are passed over and reported.
//! * Binary arrays may be compressed by zlib (`vtkZLibDataCompressor`), as VTK and PyVista write them by default; checksums are checked.
//! * Malformed input is a [`ReadError`] with the byte. Memory is proportional to the data that arrived, inflated.
//!
//! # What it does not promise
//! * Files of several pieces are refused, as they need a rule to merge by, and so is compression by other means than zlib. Nothing is
//!   written compressed.
//! * That VTK understands negative infinity in text: version 9.7 takes it for positive infinity, so values with infinities need one of the
//!   binary encodings.
//!
//! # Method
//! One `Piece` of points, cells and their data. A group is an array of the field data, named after the field of its tags
//! and itself (`tag:inlet`), with its tag and its dimension. Text would show better in ParaView, but meshio 5.3.5 reads no file with text in
//! it. Control characters in names become spaces, since they cannot stand there.
//! Connectivity and offsets are 32-bit integers where all fit, else 64-bit. A reader goes
//! through the XML once; appended arrays follow in the order of their offsets. Linear time, but for sorting the arrays.

mod cells;
mod elements;
mod groups;
mod numbers;
mod piece;
mod read;
mod write;
mod xml;
mod zlib;

use std::io::{Read, Write};

use super::vtk::VtkEncoding;
use super::{Limits, ReadError, ReadReport, VolumeData, VolumeView, WriteError, WriteReport};

/// Writes a volumetric mesh as a VTU file. The first field of scalars is the one that programs show at first. Fields are
/// written as they are. The report names groups of fields that the mesh does not have, and control characters in names of groups.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError::Corner`], [`WriteError::ArrayLength`], [`WriteError::ArrayName`], [`WriteError::CellGroup`], [`WriteError::TooMany`], or
/// the writer failed.
///
/// ```
/// use welter_meshing::{DVec3, io::{DataField, VolumeView, VtkEncoding, write_vtu}};
/// let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
/// let heights = [0.0, 0.0, 0.0, 1.0];
/// let position = |vertex: usize| positions[vertex];
/// let fields = [DataField::new("height", 1, &heights[..])];
/// let view = VolumeView {
///     tetrahedra: &[[0, 1, 2, 3]],
///     point_fields: &fields,
///     ..VolumeView::new(4, &position)
/// };
/// let mut file = Vec::new();
/// let report = write_vtu(&mut file, &view, VtkEncoding::Ascii)?;
/// assert!(report.dropped.is_empty());
/// assert!(String::from_utf8(file)?.contains(r#"<DataArray type="UInt8" Name="types" format="ascii">"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_vtu(
    mut output: impl Write,
    mesh: &VolumeView<'_>,
    encoding: VtkEncoding,
) -> Result<WriteReport, WriteError> {
    mesh.check()?;
    let groups = groups::GroupArrays::of(mesh);
    write::write(&mut output, mesh, &groups, encoding)?;
    output.flush()?;
    Ok(WriteReport { dropped: groups.dropped() })
}

/// Reads a VTU file, and says what it held besides.
///
/// `input` is read to its end in large blocks and needs no buffer of its own.
///
/// # Errors
/// [`ReadError`]: malformed, truncated, empty, compressed otherwise than by zlib, over the limits, or the reader failed.
///
/// ```
/// use welter_meshing::io::{Limits, read_vtu};
/// let file = br#"<VTKFile type="UnstructuredGrid">
///   <UnstructuredGrid>
///     <Piece NumberOfPoints="3" NumberOfCells="1">
///       <Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
///       <Cells>
///         <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
///         <DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
///         <DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
///       </Cells>
///     </Piece>
///   </UnstructuredGrid>
/// </VTKFile>"#;
/// let (mesh, report) = read_vtu(&file[..], &Limits::default())?;
/// assert_eq!(mesh.triangles, [[0, 1, 2]]);
/// assert!(report.ignored.is_empty());
/// # Ok::<(), welter_meshing::io::ReadError>(())
/// ```
pub fn read_vtu(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    read::read(input, limits)
}
