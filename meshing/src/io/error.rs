//! What can be wrong with a file, and where: [`ReadError`], [`WriteError`], [`Place`].

use super::CellKind;
use std::{fmt, io};

/// A place in a file: a line of text or a byte of binary data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// Line, counted from 1. Lines end at `\n`, `\r\n` or `\r`.
    Line(u64),
    /// Byte, counted from 0.
    Byte(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Why a file could not be read. Nothing of the file is returned beside it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file has no bytes, or nothing but white space where text is due.
    #[error("the file is empty, expected {expected}")]
    Empty {
        /// What such a file begins with.
        expected: String,
    },
    /// The file is in an encoding that no reader here takes, known by its first bytes.
    #[error("the file is {found}, expected {expected}")]
    Encoding {
        /// The encoding: `UTF-16 text`, `UTF-32 text`, `gzip data`, `a zip archive`.
        found: &'static str,
        /// What the format takes.
        expected: &'static str,
    },
    /// Something else stands where the format demands `expected`.
    #[error("{at}: expected {expected}, found {found}")]
    Unexpected {
        /// Where it stands.
        at: Place,
        /// What the format demands there.
        expected: String,
        /// What stands there, shortened and with unprintable characters escaped.
        found: String,
    },
    /// The file ends too early.
    #[error("{at}: the file ends here, expected {expected}")]
    Truncated {
        /// The last line, or the byte after the last.
        at: Place,
        /// What is missing.
        expected: String,
    },
    /// A face or cell names a vertex that the file does not have.
    #[error("{at}: vertex index {index} is out of range, the file {has} {vertices} vertices and counts from {base}",
            has = if *.declared { "declares" } else { "has" })]
    IndexOutOfRange {
        /// Where the face stands.
        at: Place,
        /// The index as written in the file.
        index: i64,
        /// The number of vertices: declared by a header, or given before this face for relative indices.
        vertices: u64,
        /// The index of the first vertex in this format.
        base: u32,
        /// Whether `vertices` is what a header declares.
        declared: bool,
    },
    /// The file goes on after the last element that it declares.
    #[error("{at}: the file goes on with {found} after the last {after}")]
    TrailingData {
        /// Where the surplus begins.
        at: Place,
        /// The last thing declared.
        after: String,
        /// How the surplus begins.
        found: String,
    },
    /// Well-formed, but of a kind that is not read.
    #[error("{at}: {what} is not supported")]
    Unsupported {
        /// Where it stands.
        at: Place,
        /// What it is.
        what: String,
    },
    /// More vertices, triangles or cells than [`super::Limits`] allow.
    #[error("{at}: more than {limit} {what}")]
    OverLimit {
        /// Where the limit was passed.
        at: Place,
        /// `vertices`, `triangles` or `cells`.
        what: &'static str,
        /// The limit.
        limit: u64,
    },
    /// A line longer than any sane file has; binary data taken for text.
    #[error("{at}: the line is longer than {limit} bytes")]
    LineTooLong {
        /// The line.
        at: Place,
        /// The limit in bytes.
        limit: usize,
    },
    /// The underlying reader failed.
    #[error("byte {at}: cannot read on: {source}", at = .offset)]
    Io {
        /// Bytes read before the failure.
        offset: u64,
        /// The failure.
        source: io::Error,
    },
}

impl ReadError {
    /// The place of the fault, where it has one.
    #[must_use]
    pub fn place(&self) -> Option<Place> {
        match self {
            Self::Empty { .. } | Self::Encoding { .. } => None,
            Self::Io { offset, .. } => Some(Place::Byte(*offset)),
            Self::Unexpected { at, .. }
            | Self::Truncated { at, .. }
            | Self::IndexOutOfRange { at, .. }
            | Self::TrailingData { at, .. }
            | Self::Unsupported { at, .. }
            | Self::OverLimit { at, .. }
            | Self::LineTooLong { at, .. } => Some(*at),
        }
    }

    /// `expected` but `found` these bytes.
    pub(super) fn unexpected(at: Place, expected: impl Into<String>, found: &[u8]) -> Self {
        Self::Unexpected { at, expected: expected.into(), found: shown(found) }
    }
}

/// Why a surface, a grid or a volumetric mesh could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, there are {vertices} vertices")]
    IndexOutOfRange {
        /// The triangle.
        triangle: usize,
        /// The index that it holds.
        index: u32,
        /// The number of vertices.
        vertices: usize,
    },
    /// A cell names a vertex that does not exist.
    #[error("{kind} {cell} names vertex {index}, there are {vertices} vertices")]
    Corner {
        /// Its kind.
        kind: CellKind,
        /// Its number among those of its kind.
        cell: usize,
        /// The index that it holds.
        index: u32,
        /// The number of vertices.
        vertices: usize,
    },
    /// Groups must be ascending, disjoint runs of existing triangles.
    #[error("group {group} (triangles {start}..{end}) is out of range or overlaps the one before")]
    Group {
        /// Index of the group.
        group: usize,
        /// First triangle of the group.
        start: u32,
        /// One past its last triangle.
        end: u32,
    },
    /// Groups of cells must be of dimension 2 or 3, with a field, dimension and tag of their own.
    #[error("group {group} ({name:?}) {why}")]
    CellGroup {
        /// Index of the group.
        group: usize,
        /// Its name.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// There must be no colours, or one a triangle.
    #[error("{colors} triangle colours for {triangles} triangles")]
    Colors {
        /// Number of colours.
        colors: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// A finite coordinate becomes infinite in single precision (binary STL).
    #[error(
        "vertex {vertex} has the coordinate {value:e}, beyond the range of binary STL (single precision)"
    )]
    BeyondSinglePrecision {
        /// The vertex.
        vertex: usize,
        /// Its coordinate.
        value: f64,
    },
    /// More elements than the format can count.
    #[error("{count} {what}: the format can hold {limit}")]
    TooMany {
        /// `vertices`, `triangles` or `cells`.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: u64,
    },
    /// An array has not as many numbers as its grid has places for.
    #[error("array {name:?} has {values} numbers, {components} for each of {places} places are needed")]
    ArrayLength {
        /// The array.
        name: String,
        /// How many numbers it has.
        values: usize,
        /// Numbers of each node or cell.
        components: usize,
        /// Number of nodes or cells.
        places: usize,
    },
    /// A time that is infinite or not a number.
    #[error("file {file:?} is of the time {time}, must be finite")]
    Time {
        /// The file.
        file: String,
        /// The time given.
        time: f64,
    },
    /// A name that cannot be that of an array.
    #[error("the array name {name:?} {why}")]
    ArrayName {
        /// The name.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// There is no field of integers of the name that was asked for as tags.
    #[error("there is no field {name:?} of one integer for each {place} to take tags from")]
    NoTags {
        /// The name.
        name: String,
        /// `vertex` or `cell`.
        place: &'static str,
    },
    /// A tag that the format cannot hold.
    #[error("{place} {number} has the tag {tag}, beyond 0 to {limit}")]
    Tag {
        /// `vertex`, `cell` or `group`.
        place: &'static str,
        /// Its number.
        number: usize,
        /// Its tag.
        tag: i64,
        /// The largest tag.
        limit: i64,
    },
    /// The underlying writer failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
}

/// Longest excerpt of a file shown in a message, in bytes: enough for any number or keyword.
pub(super) const SHOWN: usize = 40;

/// Bytes of a file as a message shows them: quoted, escaped, shortened.
pub(super) fn shown(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "nothing".to_owned();
    }
    let cut = &bytes[..bytes.len().min(SHOWN)];
    let text = match std::str::from_utf8(cut) {
        Ok(text) => text.escape_debug().to_string(),
        Err(e) if e.error_len().is_none() && e.valid_up_to() > 0 => {
            String::from_utf8_lossy(&cut[..e.valid_up_to()]).escape_debug().to_string()
        }
        Err(_) => cut.escape_ascii().to_string(),
    };
    format!("`{text}{}`", if bytes.len() > SHOWN { "..." } else { "" })
}
