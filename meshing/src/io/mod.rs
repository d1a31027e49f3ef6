//! Readers and writers over `Read` and `Write`: of surface files, OBJ, PLY, STL and OFF; of volumetric meshes, VTU, MSH and MEDIT; and a
//! writer of grids: VTI; of surfaces with values at their vertices: VTP; and of lists of files over time: PVD.
//!
//! **Promises.**
//! * Every finite coordinate of a text file becomes the nearest f64, and what [`write()`] writes as text or as PLY comes
//!   back bit for bit. Infinite and NaN coordinates are read as they are (a NaN without sign and payload);
//!   `TriMesh::new` names their vertices.
//! * Vertices are those of the file, in its order, none lost, merged or duplicated. STL has no vertices of its own: its
//!   corners are welded where their coordinates are equal (`-0 == 0`; NaN equals nothing).
//! * Polygons become triangles of the same orientation, without overlap where the polygon is simple (see `polygon.rs`).
//! * Malformed input is a [`ReadError`] with line or byte, what was expected and what was found. An index out of range is
//!   refused here, where its line is known. Repeated indices are kept: `TriMesh::new` reports them.
//! * No panic on any input. Memory is proportional to the data that arrived, not to the counts that a header declares;
//!   the text is streamed through one buffer of 256 KiB (a longer line needs its own length, 16 MiB at most).
//! * What a soup cannot hold is named: by [`read_reported`] when reading, by [`WriteReport`] when writing.
//!
//! **Does not promise.** Materials, normals, texture coordinates and vertex colours are not kept. That the result is a
//! mesh of any kind: see `surface`. Progress and cancellation: a reader or writer around the file can count bytes, and fail.
//!
//! **Method.** \[Murray96\] (OBJ), \[Turk94\] (PLY), \[Burns93\] (STL), \[Phillips93\] (OFF), \[Schroeder06\] (VTU, VTI, VTP),
//! \[Geuzaine09\] (MSH), \[Frey01\] (MEDIT). One pass, linear time, except polygons that are not convex.

mod builder;
mod cell_group;
mod data_field;
mod error;
mod medit;
mod msh;
mod obj;
mod off;
mod ply;
mod polygon;
mod pvd;
mod source;
mod stl;
pub(crate) mod text;
mod tokens;
mod view;
mod volume_builder;
mod volume_data;
mod volume_shape;
mod vti;
mod vtk;
mod vtp;
mod vtu;
mod words;

pub use cell_group::CellGroup;
pub use data_field::{DataField, FieldValues};
pub use error::{Place, ReadError, WriteError};
pub use medit::{MeditOptions, read_medit, write_medit};
pub use msh::{MshOptions, MshVersion, read_msh, write_msh};
pub use pvd::{TimedFile, write_pvd};
pub use view::SurfaceData;
pub use volume_data::{CellKind, VolumeData, VolumeView};
pub use volume_shape::TaggedCells;
pub use vti::{DataArray, write_vti};
pub use vtk::VtkEncoding;
pub use vtp::write_vtp;
pub use vtu::{read_vtu, write_vtu};

use crate::DVec3;
use crate::surface::TriangleSoup;
use std::fmt;
use std::io::{Read, Write};

/// A file format for surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Format {
    /// Wavefront OBJ, text.
    Obj,
    /// Polygon file format, text or binary of either byte order.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
    /// Geomview object file format, text.
    Off,
}

impl Format {
    /// Every format, in alphabetical order.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Off, Self::Ply, Self::Stl];

    /// The format that a file name extension stands for, in any case, without the dot.
    ///
    /// ```
    /// use welter_meshing::io::Format;
    /// assert_eq!(Format::of_extension("PLY"), Some(Format::Ply));
    /// assert_eq!(Format::of_extension("docx"), None);
    /// ```
    #[must_use]
    pub fn of_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// Its usual extension, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Off => "off",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Off => "OFF",
        })
    }
}

/// How much a file may hold before it is refused with [`ReadError::OverLimit`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most vertices; the default, 2^32 - 1, is what 32-bit indices can name.
    pub max_vertices: u32,
    /// Most triangles; the default is 2^32 - 1.
    pub max_triangles: u32,
    /// Most cells of a volumetric mesh, with those that are passed over; the default is 2^32 - 1.
    pub max_cells: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_vertices: u32::MAX, max_triangles: u32::MAX, max_cells: u32::MAX }
    }
}

/// What a file held that a [`TriangleSoup`] or a [`VolumeData`] cannot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct ReadReport {
    /// Each kind of content passed over, in the order of first appearance.
    pub ignored: Vec<Ignored>,
}

/// A kind of content passed over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ignored {
    /// What it is, in the words of the format: "`vn` statements", "vertex property `red`".
    pub what: String,
    /// How often it was met; 1 for something declared once for all elements.
    pub count: u64,
    /// Where it was first met.
    pub first: Place,
}

/// Reads a surface.
///
/// `input` is read to its end in large blocks and needs no buffer of its own.
///
/// # Errors
/// [`ReadError`]: malformed, truncated, empty, in a foreign encoding, over the limits, or the reader failed.
///
/// ```
/// use welter_meshing::io::{self, Format, Limits};
/// let file = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
/// let soup = io::read(Format::Obj, &file[..], &Limits::default())?;
/// assert_eq!(soup.triangles, [[0, 1, 2], [0, 2, 3]]);
///
/// let error = io::read(Format::Obj, &b"v 0 0 0\nv 1 zero 0\n"[..], &Limits::default()).unwrap_err();
/// assert_eq!(error.to_string(), "line 2: expected the y coordinate of vertex 2, found `zero`");
/// # Ok::<(), io::ReadError>(())
/// ```
pub fn read(format: Format, input: impl Read, limits: &Limits) -> Result<TriangleSoup, ReadError> {
    read_reported(format, input, limits).map(|(soup, _)| soup)
}

/// Reads a surface and says what the file held besides.
///
/// # Errors
/// As [`read`].
///
/// ```
/// use welter_meshing::io::{self, Format, Limits};
/// let file = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
/// let (soup, report) = io::read_reported(Format::Obj, &file[..], &Limits::default())?;
/// assert_eq!(soup.positions.len(), 3);
/// assert_eq!(report.ignored[0].what, "`vn` statements");
/// # Ok::<(), io::ReadError>(())
/// ```
pub fn read_reported(
    format: Format,
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, ReadReport), ReadError> {
    match format {
        Format::Obj => obj::read(input, limits),
        Format::Ply => ply::read(input, limits),
        Format::Stl => stl::read(input, limits),
        Format::Off => off::read(input, limits),
    }
}

/// Lines of straight segments as a file holds them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolylineData {
    /// Where vertices are.
    pub positions: Vec<DVec3>,
    /// The vertices of each line, by index, which is in range; at least two.
    pub lines: Vec<Vec<u32>>,
}

/// Reads the `l` statements of an OBJ file, and says what it held besides, faces among that.
///
/// # Errors
/// As [`read`].
///
/// ```
/// use welter_meshing::{io::{Limits, read_obj_polylines}, volumetric::plane::ClosedPolylines};
/// let file = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\nl 3 1\n";
/// let (found, _) = read_obj_polylines(&file[..], &Limits::default())?;
/// assert_eq!(found.lines, [vec![0, 1, 2], vec![2, 0]]);
/// let curves = ClosedPolylines::joined(&found.positions, &found.lines)?;
/// assert_eq!(curves.loops(), [[0, 1, 2]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_obj_polylines(
    input: impl Read,
    limits: &Limits,
) -> Result<(PolylineData, ReadReport), ReadError> {
    obj::read_polylines(input, limits)
}

/// Reads an OBJ file with its faces and its lines: the surface, the vertices of each line, which are those of the surface by index, and what
/// the file held besides.
///
/// # Errors
/// As [`read`].
///
/// ```
/// use welter_meshing::io::{Limits, read_obj_with_lines};
/// let file = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n";
/// let (soup, lines, _) = read_obj_with_lines(&file[..], &Limits::default())?;
/// assert_eq!((soup.triangles, lines), (vec![[0, 1, 2]], vec![vec![0, 1]]));
/// # Ok::<(), welter_meshing::io::ReadError>(())
/// ```
pub fn read_obj_with_lines(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, Vec<Vec<u32>>, ReadReport), ReadError> {
    obj::read_with_lines(input, limits)
}

/// Text or binary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Text with the shortest decimals that give the same f64 back.
    Ascii,
    /// Little-endian binary. PLY keeps f64; STL has only f32.
    Binary,
}

/// How to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WriteOptions {
    /// The encoding, for formats that have both (PLY, STL); OBJ and OFF are always text. Default: binary.
    pub encoding: Encoding,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { encoding: Encoding::Binary }
    }
}

/// What of a surface or a volumetric mesh is not in the file that was written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct WriteReport {
    /// Each loss; empty where the file holds everything.
    pub dropped: Vec<Dropped>,
}

/// A loss on writing. Each says what was lost and how often.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dropped {
    /// The format has no groups, or a group has an empty name.
    Groups {
        /// Number of groups lost.
        count: usize,
    },
    /// Names with characters that the format cannot hold, or too long for it, were written with others or cut.
    GroupNames {
        /// Number of names changed.
        count: usize,
    },
    /// The format has no names for tags, or none for these: the tags of the groups are in the file, their names are not.
    NamesOfTags {
        /// Number of names lost.
        count: usize,
    },
    /// The format has no triangle colours.
    TriangleColors {
        /// Number of colours lost.
        count: usize,
    },
    /// Coordinates were rounded to single precision.
    CoordinatePrecision {
        /// Number of vertices that moved.
        vertices: usize,
    },
    /// The format holds only corners of triangles.
    UnusedVertices {
        /// Number of vertices in no triangle.
        count: usize,
    },
    /// The format has no vertex indices: vertices at equal coordinates become one when read.
    CoincidentVertices {
        /// Number of vertices that will be merged into another.
        count: usize,
    },
    /// The format has no vertex order: vertices are numbered by first use when read.
    VertexOrder {
        /// Number of used vertices that get another number, not counting the shift by those merged.
        vertices: usize,
    },
    /// A field of a volumetric mesh is not in the file, or not as it was.
    Field {
        /// Its name.
        name: String,
        /// What was lost of it.
        loss: FieldLoss,
    },
}

/// What a file lost of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FieldLoss {
    /// All of it: the format has no fields, or cannot hold vectors of this length.
    Everything,
    /// All of it: the format cannot write its name.
    Name,
    /// Integers were written as real numbers, each equal to its integer.
    Type,
    /// Integers were rounded to real numbers.
    Precision,
    /// Tags keep their numbers, not their name or type.
    Renamed,
}

impl fmt::Display for FieldLoss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Everything => "not written, the format has no place for it",
            Self::Name => "not written, the format has no place for its name",
            Self::Type => "integers written as real numbers",
            Self::Precision => "integers rounded to real numbers",
            Self::Renamed => "written as tags",
        })
    }
}

impl fmt::Display for Dropped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Groups { count } => write!(f, "{count} groups not written"),
            Self::GroupNames { count } => write!(f, "{count} group names changed"),
            Self::NamesOfTags { count } => write!(f, "names of {count} groups not written"),
            Self::TriangleColors { count } => write!(f, "{count} triangle colours not written"),
            Self::CoordinatePrecision { vertices } => {
                write!(f, "coordinates of {vertices} vertices rounded to single precision")
            }
            Self::UnusedVertices { count } => write!(f, "{count} unused vertices not written"),
            Self::CoincidentVertices { count } => {
                write!(f, "{count} vertices merge with another at equal coordinates")
            }
            Self::VertexOrder { vertices } => write!(f, "{vertices} vertices get another number"),
            Self::Field { name, loss } => write!(f, "field {name:?}: {loss}"),
        }
    }
}

/// Writes a surface: the same bytes for the same surface and options.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError`]: indices, groups or colours do not fit the surface, a coordinate or count does not fit the format, or
/// the writer failed. What was written by then is not a whole file; surfaces are checked before the first byte.
///
/// ```
/// use welter_meshing::io::{self, Encoding, Format, Limits, WriteOptions};
/// use welter_meshing::{DVec3, surface::TriangleSoup};
/// let soup = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y * 0.1],
///     triangles: vec![[0, 1, 2]],
///     triangle_colors: vec![[255, 0, 0]],
///     ..TriangleSoup::default()
/// };
/// let mut file = Vec::new();
/// let report = io::write(Format::Ply, &mut file, &soup, &WriteOptions { encoding: Encoding::Binary })?;
/// assert!(report.dropped.is_empty());
/// assert_eq!(io::read(Format::Ply, &file[..], &Limits::default())?, soup);
///
/// let report = io::write(Format::Obj, &mut Vec::new(), &soup, &WriteOptions::default())?;
/// assert_eq!(report.dropped[0].to_string(), "1 triangle colours not written");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write<S: SurfaceData + ?Sized>(
    format: Format,
    mut output: impl Write,
    surface: &S,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    view::check(surface)?;
    let output = &mut output;
    let report = match format {
        Format::Obj => obj::write(output, surface),
        Format::Ply => ply::write(output, surface, options.encoding),
        Format::Stl => stl::write(output, surface, options.encoding),
        Format::Off => off::write(output, surface),
    }?;
    output.flush()?;
    Ok(report)
}
