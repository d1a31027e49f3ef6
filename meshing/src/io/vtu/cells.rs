//! The arrays of a piece put together to a mesh: [`assemble`].

use super::elements::{Body, DataArrayElement};
use super::piece::Piece;
use crate::DVec3;
use crate::io::error::{Place, ReadError};
use crate::io::volume_builder::VolumeBuilder;
use crate::io::volume_data::{AROUND, vertex_index};
use crate::io::{CellKind, DataField, FieldValues, ReadReport, VolumeData};

/// Our kind of a cell of VTK, and for each of its corners in the order of files the place where VTK has it.
fn kind(vtk_type: i64) -> Option<(CellKind, &'static [usize])> {
    // VTK orders the corners of voxels and pixels as we do: along x, then y, then z.
    const STRAIGHT: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
    Some(match vtk_type {
        5 => (CellKind::Triangle, &STRAIGHT[..3]),
        8 => (CellKind::Quadrilateral, &AROUND[..4]),
        9 => (CellKind::Quadrilateral, &STRAIGHT[..4]),
        10 => (CellKind::Tetrahedron, &STRAIGHT[..4]),
        11 => (CellKind::Hexahedron, &AROUND),
        12 => (CellKind::Hexahedron, &STRAIGHT),
        _ => return None,
    })
}

/// What cells that cannot be held are called in the report.
fn passed_over(vtk_type: i64) -> &'static str {
    match vtk_type {
        1 | 2 => "point cells",
        3 | 4 => "line cells",
        13 => "wedges",
        14 => "pyramids",
        42 => "polyhedra",
        _ => "cells of other types",
    }
}

/// The numbers of an array that there must be.
fn numbers(
    array: Option<DataArrayElement>,
    piece: Place,
    what: &str,
) -> Result<(FieldValues<'static>, Place), ReadError> {
    match array {
        Some(DataArrayElement { at, body: Body::Read(values), .. }) => Ok((values, at)),
        Some(DataArrayElement { at, .. }) => {
            Err(ReadError::unexpected(at, "appended data behind the XML", b""))
        }
        None => Err(ReadError::unexpected(piece, what, b"")),
    }
}

pub(super) fn assemble(
    piece: Piece,
    mut builder: VolumeBuilder,
) -> Result<(VolumeData, ReadReport), ReadError> {
    let place = piece.at;
    positions(piece.positions, piece.points, place, &mut builder)?;
    let (connectivity, at) = match (piece.connectivity, piece.cells) {
        (None, 0) => (FieldValues::from(Vec::<i32>::new()), place),
        (array, _) => numbers(array, place, "an array `connectivity`")?,
    };
    if piece.cells > 0 {
        let (offsets, offsets_at) = numbers(piece.offsets, place, "an array `offsets`")?;
        let (types, types_at) = numbers(piece.types, place, "an array `types`")?;
        for (values, at) in [(&connectivity, at), (&offsets, offsets_at), (&types, types_at)] {
            if !values.is_integer() {
                return Err(ReadError::unexpected(at, "an array of integers", b"real numbers"));
            }
        }
        let cells =
            Cells { connectivity: &connectivity, at, offsets: &offsets, offsets_at, types: &types, types_at };
        cells.add(&mut builder)?;
    } else if !connectivity.is_empty() {
        return Err(ReadError::unexpected(at, "no corners, as there are no cells", b"some"));
    }
    for array in piece.point_data {
        let field = field(array)?;
        builder.data.point_fields.push(field);
    }
    let fields = piece.cell_data.into_iter().map(field).collect::<Result<Vec<_>, _>>()?;
    builder.add_cell_fields(fields);
    Ok(builder.finish())
}

fn field(array: DataArrayElement) -> Result<DataField<'static>, ReadError> {
    let (name, components, at) = (array.name.clone(), array.components, array.at);
    let (values, _) = numbers(Some(array), at, "numbers")?;
    Ok(DataField::new(name, components, values))
}

fn positions(
    array: Option<DataArrayElement>,
    points: u64,
    place: Place,
    builder: &mut VolumeBuilder,
) -> Result<(), ReadError> {
    if array.is_none() && points == 0 {
        return Ok(());
    }
    let components = array.as_ref().map_or(3, |array| array.components);
    let (values, at) = numbers(array, place, "an array of points")?;
    if components != 3 {
        let expected = "points of 3 components".to_owned();
        return Err(ReadError::Unexpected { at, expected, found: components.to_string() });
    }
    let FieldValues::Float64(values) = values else {
        return Err(ReadError::unexpected(at, "points of type `Float64` or `Float32`", b"integers"));
    };
    for &[x, y, z] in values.as_chunks::<3>().0 {
        builder.vertex(DVec3::new(x, y, z), at)?;
    }
    Ok(())
}

/// The three arrays that make cells, of integers, with the places of their elements.
struct Cells<'a> {
    connectivity: &'a FieldValues<'a>,
    at: Place,
    offsets: &'a FieldValues<'a>,
    offsets_at: Place,
    types: &'a FieldValues<'a>,
    types_at: Place,
}

impl Cells<'_> {
    fn add(&self, builder: &mut VolumeBuilder) -> Result<(), ReadError> {
        let integer =
            |values: &FieldValues<'_>, index| values.integer(index).expect("checked to be integers");
        let corner_count = self.connectivity.len();
        let mut begin = 0;
        for cell in 0..self.types.len() {
            let offset = integer(self.offsets, cell);
            let end = usize::try_from(offset).ok().filter(|end| (begin..=corner_count).contains(end));
            let Some(end) = end else {
                let expected = format!("the offset of cell {cell} from {begin} to {corner_count}");
                return Err(ReadError::Unexpected {
                    at: self.offsets_at,
                    expected,
                    found: offset.to_string(),
                });
            };
            let vtk_type = integer(self.types, cell);
            match kind(vtk_type) {
                None => builder.pass_over(passed_over(vtk_type), self.types_at)?,
                Some((kind, order)) if order.len() == end - begin => {
                    let mut corners = [0; 8];
                    for (corner, &place) in corners.iter_mut().zip(order) {
                        *corner =
                            self.corner(integer(self.connectivity, begin + place), builder.vertices())?;
                    }
                    builder.cell(kind, &corners[..order.len()], self.at)?;
                }
                Some((kind, order)) => {
                    let expected = format!("{} corners of cell {cell}, a {kind}", order.len());
                    let found = (end - begin).to_string();
                    return Err(ReadError::Unexpected { at: self.offsets_at, expected, found });
                }
            }
            begin = end;
        }
        if begin == corner_count {
            return Ok(());
        }
        let expected = format!("{begin} corners, as many as the cells have");
        Err(ReadError::Unexpected { at: self.at, expected, found: corner_count.to_string() })
    }

    fn corner(&self, index: i64, vertices: usize) -> Result<u32, ReadError> {
        vertex_index(index, vertices).ok_or(ReadError::IndexOutOfRange {
            at: self.at,
            index,
            vertices: vertices as u64,
            base: 0,
            declared: true,
        })
    }
}
