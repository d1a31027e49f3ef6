//! Reads MEDIT: keyword by keyword. Cells may come before vertices; their corners are checked at the end of the file.

use std::io::Read;

use super::REFERENCE;
use super::write::keyword;
use crate::DVec3;
use crate::io::error::{Place, ReadError, shown};
use crate::io::source::Source;
use crate::io::tokens;
use crate::io::volume_builder::VolumeBuilder;
use crate::io::words::Words;
use crate::io::{CellKind, DataField, FieldValues, Limits, ReadReport, VolumeData};

/// Keywords of sections that are passed over. Others are too, under one name.
const PASSED_OVER: [&str; 14] = [
    "Edges",
    "Prisms",
    "Pyramids",
    "Corners",
    "Ridges",
    "RequiredVertices",
    "RequiredEdges",
    "RequiredTriangles",
    "RequiredQuadrilaterals",
    "Normals",
    "NormalAtVertices",
    "Tangents",
    "TangentAtVertices",
    "SubDomainFromMesh",
];

/// The reader's state.
struct Reader<R> {
    words: Words<R>,
    builder: VolumeBuilder,
    dimension: u64,
    vertices_read: bool,
    vertex_references: Vec<i64>,
    cell_references: Vec<i64>,
    /// The largest corner and where it first stood.
    largest: Option<(u32, Place)>,
}

pub(super) fn read(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    const EXPECTED: &str = "MEDIT text";
    let mut source = Source::new(input);
    source.begin_text(EXPECTED)?;
    let mut reader = Reader {
        words: Words::new(source, Some(b'#')),
        builder: VolumeBuilder::new(limits),
        dimension: 3,
        vertices_read: false,
        vertex_references: Vec::new(),
        cell_references: Vec::new(),
        largest: None,
    };
    match reader.words.word()? {
        None => return Err(ReadError::Empty { expected: EXPECTED.to_owned() }),
        Some(b"MeshVersionFormatted") => {}
        Some(other) => {
            let found = shown(other);
            let expected = "`MeshVersionFormatted`, the first word of a MEDIT file".to_owned();
            return Err(ReadError::Unexpected { at: reader.words.place(), expected, found });
        }
    }
    reader.words.count(|| "a version of the format".to_owned())?;
    while reader.section()? {}
    reader.finish()
}

impl<R: Read> Reader<R> {
    /// Reads a section; whether there may be another.
    fn section(&mut self) -> Result<bool, ReadError> {
        let word = self.words.required(|| "`End`".to_owned())?;
        let word = tokens::name(word);
        let at = self.words.place();
        if let Some(kind) =
            CellKind::ALL.into_iter().find(|&kind| keyword(kind) == word || old_keyword(kind, &word))
        {
            self.cells(kind)?;
            return Ok(true);
        }
        match word.as_str() {
            "End" => return Ok(false),
            "Dimension" => {
                self.dimension = self.words.count(|| "the dimension".to_owned())?;
                if !matches!(self.dimension, 2 | 3) || self.vertices_read {
                    let expected = "dimension 2 or 3, before the vertices".to_owned();
                    let found = self.dimension.to_string();
                    return Err(ReadError::Unexpected { at: self.words.place(), expected, found });
                }
            }
            "Vertices" => self.vertices()?,
            _ if word.starts_with(|c: char| c.is_ascii_alphabetic()) => self.pass_over(&word, at)?,
            _ => {
                return Err(ReadError::unexpected(
                    at,
                    "a keyword such as `Vertices` or `End`",
                    word.as_bytes(),
                ));
            }
        }
        Ok(true)
    }

    fn vertices(&mut self) -> Result<(), ReadError> {
        let at = self.words.place();
        if std::mem::replace(&mut self.vertices_read, true) {
            return Err(ReadError::unexpected(at, "one section of vertices", b"Vertices"));
        }
        let count = self.words.count(|| "the number of vertices".to_owned())?;
        self.builder.check_vertices(count, self.words.place())?;
        for row in 1..=count {
            let mut coordinate = |name| {
                self.words.float(|| format!("the {name} coordinate of vertex {row} of the {count} declared"))
            };
            let (x, y) = (coordinate('x')?, coordinate('y')?);
            let z = if self.dimension == 3 { coordinate('z')? } else { 0.0 };
            let reference =
                self.words.integer(|| format!("the reference of vertex {row} of the {count} declared"))?;
            self.builder.vertex(DVec3::new(x, y, z), self.words.place())?;
            self.vertex_references.push(reference);
        }
        Ok(())
    }

    fn cells(&mut self, kind: CellKind) -> Result<(), ReadError> {
        let count = self.words.count(|| format!("the number of {}", keyword(kind)))?;
        self.builder.check_cells(count, self.words.place())?;
        for row in 1..=count {
            let mut corners = [0; 8];
            for (place, corner) in corners[..kind.corners()].iter_mut().enumerate() {
                let expected = || format!("corner {} of {kind} {row} of the {count} declared", place + 1);
                let number = self.words.integer(expected)?;
                *corner = self.corner(number)?;
            }
            let reference =
                self.words.integer(|| format!("the reference of {kind} {row} of the {count} declared"))?;
            self.builder.cell(kind, &corners[..kind.corners()], self.words.place())?;
            self.cell_references.push(reference);
        }
        Ok(())
    }

    /// The vertex of a number, which may be yet to come.
    fn corner(&mut self, number: i64) -> Result<u32, ReadError> {
        let at = self.words.place();
        let Some(index) = number.checked_sub(1).and_then(|index| u32::try_from(index).ok()) else {
            return Err(self.out_of_range(number, at));
        };
        if self.largest.is_none_or(|(largest, _)| largest < index) {
            self.largest = Some((index, at));
        }
        Ok(index)
    }

    fn out_of_range(&self, index: i64, at: Place) -> ReadError {
        let vertices = self.builder.vertices() as u64;
        ReadError::IndexOutOfRange { at, index, vertices, base: 1, declared: false }
    }

    /// Passes over the numbers behind a keyword.
    fn pass_over(&mut self, keyword: &str, at: Place) -> Result<(), ReadError> {
        let known = PASSED_OVER.iter().find(|known| **known == keyword);
        self.builder.ignore(known.map_or("sections of other kinds".to_owned(), |k| format!("`{k}`")), at);
        while self.words.next_is(|word| tokens::float(word).is_some())? {
            self.words.word()?;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<(VolumeData, ReadReport), ReadError> {
        if let Some(line) = self.words.filled_line()? {
            let found = shown(line);
            let at = self.words.place();
            return Err(ReadError::TrailingData { at, after: "keyword, `End`".to_owned(), found });
        }
        if let Some((index, at)) =
            self.largest.filter(|&(index, _)| index as usize >= self.builder.vertices())
        {
            return Err(self.out_of_range(i64::from(index) + 1, at));
        }
        let field = |numbers: Vec<i64>| {
            let wanted = numbers.iter().any(|&number| number != 0);
            wanted.then(|| DataField::new(REFERENCE, 1, FieldValues::of_integers(numbers)))
        };
        self.builder.data.point_fields.extend(field(self.vertex_references));
        self.builder.add_cell_fields(field(self.cell_references).into_iter().collect());
        Ok(self.builder.finish())
    }
}

/// A misspelling that some writers have.
fn old_keyword(kind: CellKind, word: &str) -> bool {
    kind == CellKind::Hexahedron && word == "Hexaedra"
}
