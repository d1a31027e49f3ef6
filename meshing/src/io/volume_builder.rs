//! Collects a [`VolumeData`] as cells arrive in any order of kinds, within the [`Limits`].
//!
//! Invariant: memory is proportional to what was read, whatever a file declares.

use super::error::{Place, ReadError};
use super::volume_data::{CellKind, VolumeData, in_file_order};
use super::{DataField, Ignored, Limits, ReadReport};
use crate::DVec3;

/// A mesh under construction.
pub(super) struct VolumeBuilder {
    pub(super) data: VolumeData,
    limits: Limits,
    /// Kind of each cell of the file, in its order; none for one that cannot be held.
    order: Vec<Option<CellKind>>,
    ignored: Vec<Ignored>,
}

impl VolumeBuilder {
    pub(super) fn new(limits: &Limits) -> Self {
        Self { data: VolumeData::default(), limits: *limits, order: Vec::new(), ignored: Vec::new() }
    }

    /// Refuses a number of vertices beyond the limits.
    pub(super) fn check_vertices(&self, count: u64, at: Place) -> Result<(), ReadError> {
        let limit = u64::from(self.limits.max_vertices);
        if count > limit { Err(ReadError::OverLimit { at, what: "vertices", limit }) } else { Ok(()) }
    }

    /// Refuses a number of cells beyond the limits.
    pub(super) fn check_cells(&self, count: u64, at: Place) -> Result<(), ReadError> {
        let limit = u64::from(self.limits.max_cells);
        if count > limit { Err(ReadError::OverLimit { at, what: "cells", limit }) } else { Ok(()) }
    }

    pub(super) fn vertices(&self) -> usize {
        self.data.positions.len()
    }

    pub(super) fn vertex(&mut self, position: DVec3, at: Place) -> Result<(), ReadError> {
        self.check_vertices(self.vertices() as u64 + 1, at)?;
        self.data.positions.push(position);
        Ok(())
    }

    /// Adds a cell with its corners, checked to be vertices, in the order of files.
    pub(super) fn cell(&mut self, kind: CellKind, corners: &[u32], at: Place) -> Result<(), ReadError> {
        self.check_cells(self.order.len() as u64 + 1, at)?;
        let [a, b, c, d, ..] = in_file_order(kind, corners);
        match kind {
            CellKind::Hexahedron => self.data.hexahedra.push(in_file_order(kind, corners)),
            CellKind::Tetrahedron => self.data.tetrahedra.push([a, b, c, d]),
            CellKind::Quadrilateral => self.data.quadrilaterals.push([a, b, c, d]),
            CellKind::Triangle => self.data.triangles.push([a, b, c]),
        }
        self.order.push(Some(kind));
        Ok(())
    }

    /// Passes over a cell that cannot be held.
    pub(super) fn pass_over(&mut self, what: &str, at: Place) -> Result<(), ReadError> {
        self.check_cells(self.order.len() as u64 + 1, at)?;
        self.order.push(None);
        self.ignore(what, at);
        Ok(())
    }

    /// Notes content that the data cannot hold.
    pub(super) fn ignore(&mut self, what: impl AsRef<str> + Into<String>, at: Place) {
        match self.ignored.iter_mut().find(|i| i.what == what.as_ref()) {
            Some(ignored) => ignored.count += 1,
            None => self.ignored.push(Ignored { what: what.into(), count: 1, first: at }),
        }
    }

    /// Number of each cell of the file among those held, which are ordered by kind; none for one that is not.
    pub(super) fn numbers(&self) -> Vec<Option<u32>> {
        let data = &self.data;
        let mut next = [0, data.hexahedra.len(), data.tetrahedra.len(), data.quadrilaterals.len()];
        for k in 1..next.len() {
            next[k] += next[k - 1];
        }
        let numbers = self.order.iter().map(|kind| {
            kind.map(|kind| {
                let number = next[kind as usize] as u32; // within the limit, which is of 32 bits
                next[kind as usize] += 1;
                number
            })
        });
        numbers.collect()
    }

    /// Puts the values of cell fields, one for each cell of the file, into the order of the cells.
    pub(super) fn add_cell_fields(&mut self, fields: Vec<DataField<'static>>) {
        if self.order.iter().all(Option::is_some) && self.order.is_sorted() {
            self.data.cell_fields.extend(fields);
            return;
        }
        let numbers = self.numbers();
        for DataField { name, components, values } in fields {
            let values = values.rearranged(components, &numbers);
            self.data.cell_fields.push(DataField { name, components, values });
        }
    }

    pub(super) fn finish(self) -> (VolumeData, ReadReport) {
        (self.data, ReadReport { ignored: self.ignored })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_sorted_by_kind_and_their_values_go_with_them() {
        let mut builder = VolumeBuilder::new(&Limits::default());
        let at = Place::Byte(0);
        builder.cell(CellKind::Triangle, &[0, 1, 2], at).unwrap();
        builder.pass_over("pyramids", at).unwrap();
        builder.cell(CellKind::Tetrahedron, &[0, 1, 2, 3], at).unwrap();
        builder.cell(CellKind::Triangle, &[3, 2, 1], at).unwrap();
        builder.add_cell_fields(vec![DataField::new("a", 1, vec![10_u8, 20, 30, 40])]);
        let (data, report) = builder.finish();
        assert_eq!(data.triangles, [[0, 1, 2], [3, 2, 1]]);
        assert_eq!(data.cell_fields, [DataField::new("a", 1, vec![30_u8, 10, 40])]);
        assert_eq!(report.ignored, [Ignored { what: "pyramids".to_owned(), count: 1, first: at }]);
    }

    #[test]
    fn limits_hold() {
        let limits = Limits { max_vertices: 1, max_cells: 1, ..Limits::default() };
        let mut builder = VolumeBuilder::new(&limits);
        let at = Place::Line(7);
        builder.vertex(DVec3::ZERO, at).unwrap();
        assert_eq!(builder.vertex(DVec3::ZERO, at).unwrap_err().to_string(), "line 7: more than 1 vertices");
        builder.pass_over("wedges", at).unwrap();
        let error = builder.cell(CellKind::Triangle, &[0, 0, 0], at).unwrap_err();
        assert_eq!(error.to_string(), "line 7: more than 1 cells");
    }
}
