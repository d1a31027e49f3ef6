//! Writes VTU: the XML, and the numbers in or after it.

use std::io::{self, Write};

use super::groups::GroupArrays;
use crate::io::volume_data::in_file_order;
use crate::io::vtk::{self, Array, Numbers, Row, VtkEncoding};
use crate::io::{CellKind, DataField, FieldValues, VolumeView};

/// VTK's number of a kind of cell.
fn vtk_type(kind: CellKind) -> u8 {
    match kind {
        CellKind::Triangle => 5,
        CellKind::Quadrilateral => 9,
        CellKind::Tetrahedron => 10,
        CellKind::Hexahedron => 12,
    }
}

pub(super) fn write(
    output: &mut impl Write,
    mesh: &VolumeView<'_>,
    groups: &GroupArrays<'_>,
    encoding: VtkEncoding,
) -> io::Result<()> {
    let (vertices, cells) = (mesh.vertices, mesh.cell_count());
    vtk::begin(output, "UnstructuredGrid")?;
    writeln!(output, "  <UnstructuredGrid>")?;
    groups.write(output)?;
    writeln!(output, r#"    <Piece NumberOfPoints="{vertices}" NumberOfCells="{cells}">"#)?;
    let point_data: Vec<_> = mesh.point_fields.iter().map(|field| field_array(field, vertices)).collect();
    let cell_data: Vec<_> = mesh.cell_fields.iter().map(|field| field_array(field, cells)).collect();
    let (points, connections) = ([positions(mesh)], connections(mesh));
    let mut offset = 0;
    vtk::write_data(output, "PointData", &point_data, encoding, &mut offset)?;
    vtk::write_data(output, "CellData", &cell_data, encoding, &mut offset)?;
    for (element, arrays) in [("Points", &points[..]), ("Cells", &connections)] {
        writeln!(output, "      <{element}>")?;
        for array in arrays {
            array.write_element(output, encoding, &mut offset)?;
        }
        writeln!(output, "      </{element}>")?;
    }
    writeln!(output, "    </Piece>\n  </UnstructuredGrid>")?;
    vtk::end(output, encoding, point_data.iter().chain(&cell_data).chain(&points).chain(&connections))
}

fn field_array<'a>(field: &'a DataField<'_>, places: usize) -> Array<'a> {
    fn row<'a, T: Copy>(values: &'a [T], components: usize) -> Row<'a, T> {
        Box::new(move |place, numbers| numbers.extend_from_slice(&values[place * components..][..components]))
    }
    let numbers = match &field.values {
        FieldValues::Float64(values) => Numbers::Float64(row(values, field.components)),
        FieldValues::Int32(values) => Numbers::Int32(row(values, field.components)),
        FieldValues::Int64(values) => Numbers::Int64(row(values, field.components)),
        FieldValues::UInt8(values) => Numbers::UInt8(row(values, field.components)),
    };
    Array::new(&field.name, field.components, places, numbers)
}

fn positions<'a>(mesh: &VolumeView<'a>) -> Array<'a> {
    let position = mesh.position;
    let row =
        move |vertex: usize, numbers: &mut Vec<f64>| numbers.extend_from_slice(&position(vertex).to_array());
    Array::new("Points", 3, mesh.vertices, Numbers::Float64(Box::new(row)))
}

/// The corners of all cells, where those of each cell end, and the types.
fn connections<'a>(mesh: &'a VolumeView<'_>) -> [Array<'a>; 3] {
    let cells = mesh.cell_count();
    let corner_count: u64 =
        CellKind::ALL.iter().map(|&kind| (mesh.count(kind) * kind.corners()) as u64).sum();
    let corners = move |cell: usize, sink: &mut dyn FnMut(u32)| {
        let (kind, index) = mesh.locate(cell);
        in_file_order(kind, mesh.corners(kind, index))[..kind.corners()]
            .iter()
            .for_each(|&corner| sink(corner));
    };
    let end = move |cell: usize| corners_through(mesh, cell);
    let types = move |cell: usize, numbers: &mut Vec<u8>| numbers.push(vtk_type(mesh.locate(cell).0));
    // One width for both: what is read into one cell array should not need conversion.
    let (connectivity, offsets) = if corner_count.max(mesh.vertices as u64) <= i32::MAX as u64 {
        (
            Numbers::Int32(Box::new(move |cell, numbers| {
                corners(cell, &mut |corner| numbers.push(corner as i32))
            })),
            Numbers::Int32(Box::new(move |cell, numbers| numbers.push(end(cell) as i32))),
        )
    } else {
        (
            Numbers::Int64(Box::new(move |cell, numbers| {
                corners(cell, &mut |corner| numbers.push(i64::from(corner)));
            })),
            Numbers::Int64(Box::new(move |cell, numbers| numbers.push(end(cell) as i64))),
        )
    };
    let array = |name, count, numbers| Array { name, components: None, places: cells, count, numbers };
    [
        array("connectivity", corner_count, connectivity),
        array("offsets", cells as u64, offsets),
        array("types", cells as u64, Numbers::UInt8(Box::new(types))),
    ]
}

/// Number of corners of the cells up to and with this one.
fn corners_through(mesh: &VolumeView<'_>, cell: usize) -> u64 {
    let mut left = cell + 1;
    let mut corners = 0;
    for kind in CellKind::ALL {
        let here = left.min(mesh.count(kind));
        corners += (here * kind.corners()) as u64;
        left -= here;
    }
    corners
}
