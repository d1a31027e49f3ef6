//! What a file of a volumetric mesh holds: [`VolumeFacts`].

use super::{Bounds, LISTED, Line, ignored, not_read, size};
use crate::commands::mesh::VolumeFormat;
use crate::failure::{Failure, shown};
use crate::input::Reading;
use crate::numbers::{bytes, grouped, number};
use crate::run::Run;
use crate::volume_input::VolumeInput;
use serde_json::{Value, json};
use std::path::Path;
use welter_meshing::io::{DataField, ReadReport, TaggedCells, VolumeData};

/// Fields of files without names of groups whose numbers are tags all the same: what the readers of MSH and MEDIT call them.
const TAGS: [&str; 2] = ["gmsh:physical", "medit:ref"];

pub(super) struct VolumeFacts {
    format: VolumeFormat,
    bytes: Option<u64>,
    mesh: VolumeData,
    held: ReadReport,
    bounds: Bounds,
    parts: usize,
    tagged: Vec<TaggedCells>,
}

impl VolumeFacts {
    pub(super) fn of(
        file: &Path,
        format: VolumeFormat,
        reading: &Reading,
        run: &Run,
    ) -> Result<Self, Box<Failure>> {
        let input = VolumeInput::open(file, format, reading)?;
        let bytes = input.bytes;
        let (mesh, held) = input.read(&run.console.progress)?;
        run.console.progress.clear();
        let bounds = Bounds::of(&mesh.positions);
        let (parts, tagged) = (mesh.part_count(), mesh.tagged_cells(|field| TAGS.contains(&field)));
        Ok(Self { format, bytes, mesh, held, bounds, parts, tagged })
    }

    /// Names and numbers of cells, by kind.
    fn cells(&self) -> [(&'static str, usize); 4] {
        let mesh = &self.mesh;
        [
            ("hexahedra", mesh.hexahedra.len()),
            ("tetrahedra", mesh.tetrahedra.len()),
            ("quadrilaterals", mesh.quadrilaterals.len()),
            ("triangles", mesh.triangles.len()),
        ]
    }

    pub(super) fn row(&self, name: String) -> [String; 7] {
        [
            name,
            self.format.name().to_owned(),
            self.bytes.map_or_else(String::new, grouped),
            grouped(self.mesh.positions.len() as u64),
            grouped(self.mesh.cell_count() as u64),
            grouped(self.tagged.len() as u64),
            self.bounds.sides.map_or_else(String::new, size),
        ]
    }

    pub(super) fn lines(&self) -> Vec<Line> {
        let size_on_disk = self.bytes.map_or_else(String::new, |count| format!(", {}", bytes(count)));
        let mut lines: Vec<Line> = vec![
            ("format", format!("{}{size_on_disk}", self.format.name())),
            ("vertices", grouped(self.mesh.positions.len() as u64)),
        ];
        let cells = self.cells().into_iter().filter(|&(_, count)| count > 0);
        lines.extend(cells.map(|(kind, count)| (kind, grouped(count as u64))));
        if self.mesh.cell_count() == 0 {
            lines.push(("cells", "none".to_owned()));
        }
        lines.push(("parts", format!("{} (cells that share vertices)", grouped(self.parts as u64))));
        lines.extend(self.bounds.lines());
        for (label, fields) in
            [("vertex fields", &self.mesh.point_fields), ("cell fields", &self.mesh.cell_fields)]
        {
            listed(&mut lines, label, fields, |field| field_in_words(field));
        }
        listed(&mut lines, "groups", &self.tagged, group_in_words);
        lines.extend(not_read(&self.held));
        lines
    }

    pub(super) fn to_json(&self, file: &Path) -> Value {
        let fields = |fields: &[DataField<'_>]| fields.iter().map(field_to_json).collect::<Vec<_>>();
        let groups: Vec<Value> = self
            .tagged
            .iter()
            .map(|group| {
                json!({
                    "name": group.name,
                    "field": group.field,
                    "dimension": group.dimension,
                    "tag": group.tag,
                    "cells": group.cells,
                })
            })
            .collect();
        let mut object = json!({
            "file": shown(file),
            "format": self.format.extension(),
            "bytes": self.bytes,
            "vertices": self.mesh.positions.len(),
            "parts": self.parts,
            "non_finite_vertices": self.bounds.non_finite,
            "bounding_box": self.bounds.to_json(),
            "point_fields": fields(&self.mesh.point_fields),
            "cell_fields": fields(&self.mesh.cell_fields),
            "groups": groups,
            "not_read": ignored(&self.held),
        });
        for (kind, count) in self.cells() {
            object[kind] = count.into();
        }
        object
    }
}

/// Lines for the first of some things, and how many more there are.
fn listed<T>(lines: &mut Vec<Line>, label: &'static str, things: &[T], in_words: impl Fn(&T) -> String) {
    for (k, thing) in things.iter().enumerate().take(LISTED) {
        lines.push((if k == 0 { label } else { "" }, in_words(thing)));
    }
    if things.len() > LISTED {
        lines.push(("", format!("and {} more", grouped((things.len() - LISTED) as u64))));
    }
}

fn ranges(field: &DataField<'_>) -> Vec<Option<[f64; 2]>> {
    (0..field.components).map(|component| field.range(component)).collect()
}

fn field_in_words(field: &DataField<'_>) -> String {
    let components = if field.components == 1 { String::new() } else { format!(" x {}", field.components) };
    let range = |range: Option<[f64; 2]>| {
        range.map_or("no finite number".to_owned(), |[low, high]| {
            format!("{} .. {}", number(low), number(high))
        })
    };
    let shown: Vec<String> = ranges(field).into_iter().take(LISTED).map(range).collect();
    format!("{:?}, {}{components}, {}", field.name, field.values.type_name(), shown.join(", "))
}

fn field_to_json(field: &DataField<'_>) -> Value {
    json!({
        "name": field.name,
        "type": field.values.type_name(),
        "components": field.components,
        "ranges": ranges(field),
    })
}

fn group_in_words(group: &TaggedCells) -> String {
    let name = group.name.as_ref().map_or("no name".to_owned(), |name| format!("{name:?}"));
    let TaggedCells { field, dimension, tag, cells, .. } = group;
    format!("{name}, {} cells of dimension {dimension} ({field} = {tag})", grouped(*cells as u64))
}
