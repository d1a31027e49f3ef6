//! Writes the fields: a section for each.

use std::io::{self, Write};

use super::data::left_out;
use super::output::Output;
use crate::io::{DataField, VolumeView};

pub(super) fn write<W: Write>(
    out: &mut Output<'_, W>,
    mesh: &VolumeView<'_>,
    tags: Option<&str>,
) -> io::Result<()> {
    for field in mesh.point_fields {
        if left_out(field, mesh.vertices, None).is_none() {
            write_field(out, "NodeData", field, mesh.vertices)?;
        }
    }
    for field in mesh.cell_fields {
        if tags != Some(&*field.name) && left_out(field, mesh.cell_count(), tags).is_none() {
            write_field(out, "ElementData", field, mesh.cell_count())?;
        }
    }
    Ok(())
}

fn write_field<W: Write>(
    out: &mut Output<'_, W>,
    section: &str,
    field: &DataField<'_>,
    places: usize,
) -> io::Result<()> {
    out.line(&format!("${section}"))?;
    // One string: the name. One real number: the time. Three integers: the time step, the components, the places.
    for line in ["1", &format!("\"{}\"", field.name), "1", "0", "3", "0"] {
        out.line(line)?;
    }
    out.line(&field.components.to_string())?;
    out.line(&places.to_string())?;
    for place in 0..places {
        out.int(place as i32 + 1)?;
        for component in 0..field.components {
            out.double(field.values.float(place * field.components + component))?;
        }
        out.end_line()?;
    }
    out.end_section(section)
}
