//! A mesh of an area on its way to a file: [`Sheet`].

use crate::commands::mesh::product::TAGS;
use crate::commands::mesh::volume_file::{VolumeFormat, VolumeWriting};
use crate::failure::Failure;
use crate::output::Output;
use welter_meshing::DVec3;
use welter_meshing::io::{CellGroup, DataField, VolumeView};
use welter_meshing::volumetric::plane::{AreaMesh, AreaTriangles};

/// The corners of a quadrilateral in the order around it.
const AROUND: [usize; 4] = [0, 1, 3, 2];

/// A mesh of an area in the form that was asked for.
pub(super) struct Sheet {
    pub(super) area: AreaMesh,
    /// In place of the quadrilaterals, if these were asked for.
    pub(super) triangles: Option<AreaTriangles>,
    /// The component of each quadrilateral.
    components: Vec<u32>,
    /// The Euler characteristic of each component.
    pub(super) characteristics: Vec<i64>,
    /// The z coordinate of its plane.
    height: f64,
}

impl Sheet {
    /// None if triangles were asked for and their vertices cannot be numbered with 32 bits.
    pub(super) fn new(area: AreaMesh, height: f64, as_triangles: bool) -> Option<Self> {
        let triangles = if as_triangles { Some(area.mesh.triangles()?) } else { None };
        let (components, characteristics) = area.mesh.components();
        Some(Self { area, triangles, components, characteristics, height })
    }

    /// Number of vertices in the file.
    pub(super) fn vertex_count(&self) -> usize {
        match &self.triangles {
            Some(triangles) => triangles.positions.len(),
            None => self.area.mesh.nodes().len(),
        }
    }

    pub(super) fn position(&self, vertex: usize) -> DVec3 {
        let p = match &self.triangles {
            Some(triangles) => triangles.positions[vertex],
            None => self.area.mesh.position(vertex as u32),
        };
        p.extend(self.height)
    }

    /// Numbers on the cells in the file, taken from quadrilaterals.
    fn fields(&self, with_tags: bool) -> Vec<DataField<'static>> {
        let of = |value: &dyn Fn(usize) -> i32| -> Vec<i32> {
            match &self.triangles {
                Some(triangles) => triangles.quadrilaterals.iter().map(|&q| value(q as usize)).collect(),
                None => (0..self.area.mesh.len()).map(value).collect(),
            }
        };
        let mut fields = vec![
            DataField::new("copy", 1, of(&|q| i32::from(self.area.copies[q]))),
            // Quadrilaterals between the edges of the grid belong to no region: -1.
            DataField::new("region", 1, of(&|q| self.area.regions[q] as i32)),
            DataField::new("component", 1, of(&|q| self.components[q] as i32)),
        ];
        if with_tags {
            fields.push(DataField::new(TAGS, 1, of(&|q| self.components[q] as i32 + 1)));
        }
        fields
    }

    /// Writes the mesh; returns what the format could not hold, in words. The tags of Gmsh and MEDIT files are the components, from 1 on.
    pub(super) fn write(&self, writing: &VolumeWriting, output: Output) -> Result<Vec<String>, Box<Failure>> {
        let with_tags = writing.format != VolumeFormat::Vtu;
        let fields = self.fields(with_tags);
        let component = |number: usize| CellGroup {
            name: format!("component {number}"),
            field: TAGS.to_owned(),
            dimension: 2,
            tag: i32::try_from(number).unwrap_or(i32::MAX),
        };
        let groups: Vec<CellGroup> = match with_tags {
            true => (1..=self.characteristics.len()).map(component).collect(),
            false => Vec::new(),
        };
        let around: Vec<[u32; 4]> = match &self.triangles {
            Some(_) => Vec::new(),
            None => {
                self.area.mesh.quadrilaterals().iter().map(|corners| AROUND.map(|c| corners[c])).collect()
            }
        };
        let position = |vertex: usize| self.position(vertex);
        let view = VolumeView {
            quadrilaterals: &around,
            triangles: self.triangles.as_ref().map_or(&[], |triangles| &triangles.triangles),
            cell_fields: &fields,
            groups: &groups,
            ..VolumeView::new(self.vertex_count(), &position)
        };
        writing.write_view(output, &view, with_tags.then_some(TAGS))
    }
}
