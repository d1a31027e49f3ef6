//! Writes MEDIT: one section for each kind of cell that there is.

use std::io::{self, Write};

use super::REFERENCE;
use crate::io::text::Decimal;
use crate::io::volume_data::in_file_order;
use crate::io::{CellKind, DataField, Dropped, FieldLoss, FieldValues, VolumeView};

/// The keyword of a kind of cell.
pub(super) fn keyword(kind: CellKind) -> &'static str {
    match kind {
        CellKind::Hexahedron => "Hexahedra",
        CellKind::Tetrahedron => "Tetrahedra",
        CellKind::Quadrilateral => "Quadrilaterals",
        CellKind::Triangle => "Triangles",
    }
}

pub(super) fn write(
    output: &mut impl Write,
    mesh: &VolumeView<'_>,
    vertices: Option<&DataField<'_>>,
    cells: Option<&DataField<'_>>,
) -> io::Result<()> {
    let reference = |field: Option<&DataField<'_>>, place| {
        field.map_or(0, |field| field.values.integer(place).expect("references are integers"))
    };
    // Version 2 stands for f64 and integers of 32 bits, version 4 for integers of 64.
    let wide = |field: Option<&DataField<'_>>| {
        field.is_some_and(|field| {
            (0..field.values.len()).any(|k| i32::try_from(reference(Some(field), k)).is_err())
        })
    };
    let counts_fit = mesh.vertices.max(mesh.cell_count()) <= i32::MAX as usize;
    let version = if counts_fit && !wide(vertices) && !wide(cells) { 2 } else { 4 };
    writeln!(output, "MeshVersionFormatted {version}\nDimension 3\nVertices\n{}", mesh.vertices)?;
    for vertex in 0..mesh.vertices {
        let p = (mesh.position)(vertex);
        let reference = reference(vertices, vertex);
        writeln!(output, "{} {} {} {reference}", Decimal(p.x), Decimal(p.y), Decimal(p.z))?;
    }
    let mut first = 0;
    for kind in CellKind::ALL {
        let count = mesh.count(kind);
        if count > 0 {
            writeln!(output, "{}\n{count}", keyword(kind))?;
        }
        for index in 0..count {
            for corner in &in_file_order(kind, mesh.corners(kind, index))[..kind.corners()] {
                write!(output, "{} ", u64::from(*corner) + 1)?;
            }
            writeln!(output, "{}", reference(cells, first + index))?;
        }
        first += count;
    }
    writeln!(output, "End")
}

/// The fields that are not in the file, or not as they were.
pub(super) fn dropped(
    mesh: &VolumeView<'_>,
    vertices: Option<&DataField<'_>>,
    cells: Option<&DataField<'_>>,
) -> Vec<Dropped> {
    let mut dropped = Vec::new();
    for (fields, written) in [(mesh.point_fields, vertices), (mesh.cell_fields, cells)] {
        for field in fields {
            let name = field.name.to_string();
            let is_written = written.is_some_and(|written| written.name == field.name);
            if !is_written {
                dropped.push(Dropped::Field { name, loss: FieldLoss::Everything });
            } else if !comes_back(field) {
                dropped.push(Dropped::Field { name, loss: FieldLoss::Renamed });
            }
        }
    }
    dropped
}

/// Whether references are read as the field that they were.
fn comes_back(field: &DataField<'_>) -> bool {
    let nonzero = (0..field.values.len()).any(|place| field.values.integer(place) != Some(0));
    let same_type = match &field.values {
        FieldValues::Int32(_) => true,
        FieldValues::Int64(values) => values.iter().any(|&value| i32::try_from(value).is_err()),
        _ => false,
    };
    field.name == REFERENCE && nonzero && same_type
}
