//! Reads VTU: the XML once from front to end, then the appended numbers in the order of their offsets.

use std::io::Read;

use super::cells;
use super::elements::{ArrayReader, DataArrayElement, skip_element};
use super::groups::FieldData;
use super::piece::{Piece, each_child};
use super::xml::{self, Tag};
use crate::io::error::ReadError;
use crate::io::source::Source;
use crate::io::volume_builder::VolumeBuilder;
use crate::io::{Limits, ReadReport, VolumeData};

pub(super) fn read(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    let mut source = Source::new(input);
    let source = &mut source;
    source.begin_text("VTU, an XML file of VTK")?;
    let mut builder = VolumeBuilder::new(limits);
    let root = match xml::next_tag(source)? {
        Some(tag) if tag.name == "VTKFile" && !tag.closes => tag,
        None => return Err(ReadError::Empty { expected: "VTU, an XML file of VTK".to_owned() }),
        Some(tag) => {
            let expected = "`<VTKFile>`, the first tag of a VTU file".to_owned();
            return Err(ReadError::Unexpected { at: tag.at, expected, found: tag.shown() });
        }
    };
    let arrays = layout(&root)?;
    let mut piece = None;
    let mut field_data = FieldData::default();
    each_child(source, &root, |source, tag| match tag.name.as_str() {
        "UnstructuredGrid" => each_child(source, tag, |source, child| {
            if child.name == "FieldData" {
                return field_data.read(source, child, arrays, &mut builder);
            }
            if child.name != "Piece" {
                builder.ignore("other XML elements", child.at);
                return skip_element(source, child);
            }
            if piece.is_some() {
                return Err(ReadError::Unsupported { at: child.at, what: "a second piece".to_owned() });
            }
            piece = Some(Piece::read(source, child, arrays, &mut builder)?);
            Ok(())
        }),
        "AppendedData" => {
            let mut all = field_data.appended();
            all.extend(piece.as_mut().map(Piece::appended).unwrap_or_default());
            appended(source, tag, arrays, all)
        }
        _ => {
            builder.ignore("other XML elements", tag.at);
            skip_element(source, tag)
        }
    })?;
    if let Some(tag) = xml::next_tag(source)? {
        let (after, found) = ("tag, `</VTKFile>`".to_owned(), tag.shown());
        return Err(ReadError::TrailingData { at: tag.at, after, found });
    }
    let piece = piece
        .ok_or_else(|| ReadError::Truncated { at: source.byte(), expected: "a `<Piece>`".to_owned() })?;
    field_data.into_groups(&piece.cell_data, &mut builder);
    cells::assemble(piece, builder)
}

/// What the first tag says of the file.
fn layout(root: &Tag) -> Result<ArrayReader, ReadError> {
    let at = root.at;
    let kind = root.attribute("type").unwrap_or_default();
    if kind != "UnstructuredGrid" {
        let expected = "`UnstructuredGrid` as `type` of the file";
        return Err(ReadError::unexpected(at, expected, kind.as_bytes()));
    }
    let compressed = match root.attribute("compressor").unwrap_or_default() {
        "" => false,
        "vtkZLibDataCompressor" => true,
        other => {
            let what = format!("compression by {}", crate::io::error::shown(other.as_bytes()));
            return Err(ReadError::Unsupported { at, what });
        }
    };
    let big_endian = match root.attribute("byte_order").unwrap_or("LittleEndian") {
        "LittleEndian" => false,
        "BigEndian" => true,
        other => {
            let expected = "`LittleEndian` or `BigEndian` as `byte_order`";
            return Err(ReadError::unexpected(at, expected, other.as_bytes()));
        }
    };
    let header = match root.attribute("header_type").unwrap_or("UInt32") {
        "UInt32" => 4,
        "UInt64" => 8,
        other => {
            return Err(ReadError::unexpected(at, "`UInt32` or `UInt64` as `header_type`", other.as_bytes()));
        }
    };
    Ok(ArrayReader { big_endian, header, compressed })
}

/// Reads the numbers behind the XML.
fn appended<R: Read>(
    source: &mut Source<R>,
    tag: &Tag,
    reader: ArrayReader,
    mut arrays: Vec<(u64, &mut DataArrayElement)>,
) -> Result<(), ReadError> {
    let base64 = match tag.attribute("encoding").unwrap_or("base64") {
        "raw" => false,
        "base64" => true,
        other => {
            return Err(ReadError::unexpected(tag.at, "`raw` or `base64` as `encoding`", other.as_bytes()));
        }
    };
    xml::skip_blank(source)?;
    let at = source.byte();
    let first = source.take(1, || "`_`, the beginning of appended data".to_owned())?;
    if first != b"_" {
        return Err(ReadError::unexpected(at, "`_`, the beginning of appended data", first));
    }
    let begin = source.offset();
    arrays.sort_by_key(|(offset, _)| *offset);
    for (offset, array) in arrays {
        let gap = begin.checked_add(offset).and_then(|from| from.checked_sub(source.offset()));
        let Some(gap) = gap else {
            let expected = "an offset behind the array before it".to_owned();
            return Err(ReadError::Unexpected { at: array.at, expected, found: offset.to_string() });
        };
        source.skip(gap, || format!("the numbers of array {:?}", array.name))?;
        reader.appended(source, array, base64)?;
    }
    source.skip_past(b"</AppendedData>")
}
