//! Writes the entities, nodes and elements of version 4.1.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::ops::Range;

use super::entities::{Entity, Tags};
use super::names::Names;
use super::output::Output;
use super::types;
use crate::io::volume_data::in_file_order;
use crate::io::{CellKind, VolumeView};

pub(super) fn write<W: Write>(
    out: &mut Output<'_, W>,
    mesh: &VolumeView<'_>,
    tags: &Tags<'_>,
    names: &Names<'_>,
) -> io::Result<()> {
    let entities = tags.entities(mesh);
    out.format("4.1")?;
    names.write(out)?;
    write_entities(out, &entities)?;
    write_nodes(out, mesh, &entities)?;
    write_elements(out, mesh, tags)
}

fn write_entities<W: Write>(
    out: &mut Output<'_, W>,
    entities: &BTreeMap<(usize, i32), Entity>,
) -> io::Result<()> {
    out.line("$Entities")?;
    for dimension in 0..=3 {
        out.size(entities.keys().filter(|key| key.0 == dimension).count() as u64)?;
    }
    out.end_line()?;
    for (&(_, number), entity) in entities {
        out.int(number)?;
        for coordinate in [entity.min, entity.max].map(|corner| corner.to_array()).as_flattened() {
            out.double(*coordinate)?;
        }
        if entity.physical == 0 {
            out.size(0)?;
        } else {
            out.size(1)?;
            out.int(entity.physical)?;
        }
        out.size(0)?; // nothing is said of its boundary
        out.end_line()?;
    }
    out.end_section("Entities")
}

/// All nodes in one block, of an entity of the highest dimension.
fn write_nodes<W: Write>(
    out: &mut Output<'_, W>,
    mesh: &VolumeView<'_>,
    entities: &BTreeMap<(usize, i32), Entity>,
) -> io::Result<()> {
    let vertices = mesh.vertices as u64;
    let blocks = u64::from(vertices > 0);
    out.line("$Nodes")?;
    for number in [blocks, vertices, blocks, vertices] {
        out.size(number)?;
    }
    out.end_line()?;
    if let Some((dimension, entity)) =
        entities.keys().copied().max_by_key(|&(d, e)| (d, std::cmp::Reverse(e)))
    {
        for number in [dimension as i32, entity, 0] {
            out.int(number)?;
        }
        out.size(vertices)?;
        out.end_line()?;
        for number in 1..=vertices {
            out.size(number)?;
            out.end_line()?;
        }
        for vertex in 0..mesh.vertices {
            for coordinate in (mesh.position)(vertex).to_array() {
                out.double(coordinate)?;
            }
            out.end_line()?;
        }
    }
    out.end_section("Nodes")
}

/// Calls `run` on each run of cells of a kind and an entity: the kind, the number of the first cell, and the range within the kind.
fn each_run(
    mesh: &VolumeView<'_>,
    tags: &Tags<'_>,
    mut run: impl FnMut(CellKind, usize, Range<usize>) -> io::Result<()>,
) -> io::Result<()> {
    let mut first = 0;
    for kind in CellKind::ALL {
        let count = mesh.count(kind);
        let mut begin = 0;
        for end in 1..=count {
            if end == count || tags.entity(first + end) != tags.entity(first + begin) {
                run(kind, first + begin, begin..end)?;
                begin = end;
            }
        }
        first += count;
    }
    Ok(())
}

fn write_elements<W: Write>(
    out: &mut Output<'_, W>,
    mesh: &VolumeView<'_>,
    tags: &Tags<'_>,
) -> io::Result<()> {
    let cells = mesh.cell_count() as u64;
    let mut blocks = 0;
    each_run(mesh, tags, |_, _, _| {
        blocks += 1;
        Ok(())
    })?;
    out.line("$Elements")?;
    for number in [blocks, cells, cells.min(1), cells] {
        out.size(number)?;
    }
    out.end_line()?;
    each_run(mesh, tags, |kind, first, run| {
        for number in [kind.dimension() as i32, tags.entity(first), types::number(kind)] {
            out.int(number)?;
        }
        out.size(run.len() as u64)?;
        out.end_line()?;
        for (cell, index) in (first..).zip(run) {
            out.size(cell as u64 + 1)?;
            for &corner in &in_file_order(kind, mesh.corners(kind, index))[..kind.corners()] {
                out.size(u64::from(corner) + 1)?;
            }
            out.end_line()?;
        }
        Ok(())
    })?;
    out.end_section("Elements")
}
