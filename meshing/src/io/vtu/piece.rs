//! The `Piece` of a VTU file: its arrays by their part in the mesh: [`Piece`].

use std::collections::BTreeSet;
use std::io::Read;

use super::elements::{ArrayReader, Body, DataArrayElement, required_tag, skip_element};
use super::xml::Tag;
use crate::io::error::{Place, ReadError};
use crate::io::source::Source;
use crate::io::volume_builder::VolumeBuilder;

/// The arrays of a piece.
pub(super) struct Piece {
    pub(super) at: Place,
    pub(super) points: u64,
    pub(super) cells: u64,
    pub(super) positions: Option<DataArrayElement>,
    pub(super) connectivity: Option<DataArrayElement>,
    pub(super) offsets: Option<DataArrayElement>,
    pub(super) types: Option<DataArrayElement>,
    pub(super) point_data: Vec<DataArrayElement>,
    pub(super) cell_data: Vec<DataArrayElement>,
}

impl Piece {
    /// Reads the piece that `tag` opens.
    pub(super) fn read<R: Read>(
        source: &mut Source<R>,
        tag: &Tag,
        arrays: ArrayReader,
        builder: &mut VolumeBuilder,
    ) -> Result<Self, ReadError> {
        let count = |name: &str| {
            tag.count(name)?.ok_or_else(|| ReadError::unexpected(tag.at, format!("attribute `{name}`"), b""))
        };
        let (points, cells) = (count("NumberOfPoints")?, count("NumberOfCells")?);
        builder.check_vertices(points, tag.at)?;
        builder.check_cells(cells, tag.at)?;
        let mut piece = Self {
            at: tag.at,
            points,
            cells,
            positions: None,
            connectivity: None,
            offsets: None,
            types: None,
            point_data: Vec::new(),
            cell_data: Vec::new(),
        };
        each_child(source, tag, |source, child| match child.name.as_str() {
            "PointData" => {
                let data = &mut piece.point_data;
                each_array(source, child, arrays, builder, |_| Some(points), |array| put_field(data, array))
            }
            "CellData" => {
                let data = &mut piece.cell_data;
                each_array(source, child, arrays, builder, |_| Some(cells), |array| put_field(data, array))
            }
            "Points" => {
                let positions = &mut piece.positions;
                each_array(
                    source,
                    child,
                    arrays,
                    builder,
                    |_| Some(points),
                    |array| put_once(positions, array),
                )
            }
            "Cells" => piece.cells_element(source, child, arrays, builder),
            _ => {
                builder.ignore("other XML elements", child.at);
                skip_element(source, child)
            }
        })?;
        each_field_is_named(&piece.point_data)?;
        each_field_is_named(&piece.cell_data)?;
        Ok(piece)
    }

    fn cells_element<R: Read>(
        &mut self,
        source: &mut Source<R>,
        tag: &Tag,
        arrays: ArrayReader,
        builder: &mut VolumeBuilder,
    ) -> Result<(), ReadError> {
        let places = |name: &str| matches!(name, "offsets" | "types").then_some(self.cells);
        let mut others = Vec::new();
        let (connectivity, offsets, types) = (&mut self.connectivity, &mut self.offsets, &mut self.types);
        each_array(source, tag, arrays, builder, places, |array| match array.name.as_str() {
            "connectivity" => put_once(connectivity, array),
            "offsets" => put_once(offsets, array),
            "types" => put_once(types, array),
            _ => {
                others.push(array.at);
                Ok(())
            }
        })?;
        for at in others {
            builder.ignore("faces of polyhedra", at);
        }
        Ok(())
    }

    /// The arrays whose numbers are appended, each with its offset.
    pub(super) fn appended(&mut self) -> Vec<(u64, &mut DataArrayElement)> {
        let parts = [&mut self.positions, &mut self.connectivity, &mut self.offsets, &mut self.types];
        let parts = parts.into_iter().flatten();
        let all = parts.chain(&mut self.point_data).chain(&mut self.cell_data);
        let appended = all.filter_map(|array| match array.body {
            Body::Appended(offset) => Some((offset, array)),
            Body::Read(_) => None,
        });
        appended.collect()
    }
}

fn put_once(place: &mut Option<DataArrayElement>, array: DataArrayElement) -> Result<(), ReadError> {
    if place.is_some() {
        let expected = "one array of its kind".to_owned();
        return Err(ReadError::Unexpected { at: array.at, expected, found: "another".to_owned() });
    }
    *place = Some(array);
    Ok(())
}

fn put_field(fields: &mut Vec<DataArrayElement>, array: DataArrayElement) -> Result<(), ReadError> {
    fields.push(array);
    Ok(())
}

/// Names of fields are not empty and given once.
fn each_field_is_named(fields: &[DataArrayElement]) -> Result<(), ReadError> {
    let mut names = BTreeSet::new();
    for field in fields {
        if field.name.is_empty() || !names.insert(&field.name) {
            return Err(ReadError::unexpected(
                field.at,
                "an array of a name of its own",
                field.name.as_bytes(),
            ));
        }
    }
    Ok(())
}

/// Calls `read` on each tag that opens an element inside the one that `tag` opened; `read` goes to the end of that element.
pub(super) fn each_child<R: Read>(
    source: &mut Source<R>,
    tag: &Tag,
    mut read: impl FnMut(&mut Source<R>, &Tag) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if tag.empty {
        return Ok(());
    }
    loop {
        let child = required_tag(source, &tag.name)?;
        if child.closes {
            return super::elements::expect_closes(&child, tag);
        }
        read(source, &child)?;
    }
}

/// Reads the arrays inside an element; `places` says for how many places each has numbers, where that is known.
fn each_array<R: Read>(
    source: &mut Source<R>,
    tag: &Tag,
    arrays: ArrayReader,
    builder: &mut VolumeBuilder,
    places: impl Fn(&str) -> Option<u64>,
    mut put: impl FnMut(DataArrayElement) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    each_child(source, tag, |source, child| {
        if child.name != "DataArray" && child.name != "Array" {
            builder.ignore("other XML elements", child.at);
            return skip_element(source, child);
        }
        let name = child.attribute("Name").unwrap_or_default();
        match arrays.element(source, child, places(name))? {
            Some(array) => put(array),
            None => {
                builder.ignore("arrays of text or bits", child.at);
                Ok(())
            }
        }
    })
}
