//! Writes the nodes and elements of version 2.2.

use std::io::{self, Write};

use super::entities::Tags;
use super::names::Names;
use super::output::Output;
use super::types;
use crate::io::volume_data::in_file_order;
use crate::io::{CellKind, VolumeView, WriteError};

/// Numbers are of 32 bits with a sign.
pub(super) fn check(mesh: &VolumeView<'_>) -> Result<(), WriteError> {
    let limit = i32::MAX as u64;
    for (what, count) in [("vertices", mesh.vertices), ("cells", mesh.cell_count())] {
        if count as u64 > limit {
            return Err(WriteError::TooMany { what, count, limit });
        }
    }
    Ok(())
}

pub(super) fn write<W: Write>(
    out: &mut Output<'_, W>,
    mesh: &VolumeView<'_>,
    tags: &Tags<'_>,
    names: &Names<'_>,
) -> io::Result<()> {
    out.format("2.2")?;
    names.write(out)?;
    out.line("$Nodes")?;
    out.line(&mesh.vertices.to_string())?;
    for vertex in 0..mesh.vertices {
        out.int(vertex as i32 + 1)?;
        for coordinate in (mesh.position)(vertex).to_array() {
            out.double(coordinate)?;
        }
        out.end_line()?;
    }
    out.end_section("Nodes")?;
    out.line("$Elements")?;
    out.line(&mesh.cell_count().to_string())?;
    let mut cell = 0;
    for kind in CellKind::ALL {
        if out.binary && mesh.count(kind) > 0 {
            // What follows: elements of a type, their number, and how many tags each has.
            for number in [types::number(kind), mesh.count(kind) as i32, 2] {
                out.int(number)?;
            }
        }
        for index in 0..mesh.count(kind) {
            out.int(cell as i32 + 1)?;
            if !out.binary {
                out.int(types::number(kind))?;
                out.int(2)?;
            }
            out.int(tags.physical(cell))?;
            out.int(tags.entity(cell))?;
            for &corner in &in_file_order(kind, mesh.corners(kind, index))[..kind.corners()] {
                out.int(corner as i32 + 1)?;
            }
            out.end_line()?;
            cell += 1;
        }
    }
    out.end_section("Elements")
}
