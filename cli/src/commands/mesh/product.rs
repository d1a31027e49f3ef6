//! What is made of a surface: the volumetric mesh, as hexahedra or tetrahedra, and its boundary.

use super::groups::Groups;
use welter_meshing::io::{CellGroup, DataField};
use welter_meshing::surface::ClosedOrientedMesh;
use welter_meshing::volumetric::{Tetrahedra, VolumeMesh, boundary_sides};
use welter_meshing::{Cancelled, DVec3, Monitor};

/// A volumetric mesh on its way to a file.
pub(crate) struct Product {
    pub(super) volume: VolumeMesh,
    /// In place of the hexahedra, if these were asked for.
    pub(super) tetrahedra: Option<Tetrahedra>,
    /// The component of each hexahedron.
    pub(super) components: Vec<u32>,
}

impl Product {
    /// Number of vertices in the file.
    pub(super) fn vertex_count(&self) -> usize {
        match &self.tetrahedra {
            Some(tetrahedra) => tetrahedra.mesh().positions.len(),
            None => self.volume.mesh.nodes().len(),
        }
    }

    pub(super) fn position(&self, vertex: usize) -> DVec3 {
        match &self.tetrahedra {
            Some(tetrahedra) => tetrahedra.mesh().positions[vertex],
            None => self.volume.mesh.position(vertex as u32),
        }
    }

    /// Numbers on the cells, those of the volume and then those of the boundary, all taken from hexahedra.
    pub(super) fn fields(&self, boundary: &Boundary) -> Vec<DataField<'static>> {
        let cells: Vec<u32> = match &self.tetrahedra {
            Some(tetrahedra) => tetrahedra.mesh().hexahedra.clone(),
            None => (0..self.volume.mesh.len() as u32).collect(),
        };
        let of = |value: &dyn Fn(usize) -> i32| -> Vec<i32> {
            cells.iter().chain(&boundary.hexahedra).map(|&hexahedron| value(hexahedron as usize)).collect()
        };
        let mut fields = vec![
            DataField::new("copy", 1, of(&|h| i32::from(self.volume.copies[h]))),
            // Hexahedra between the edges of the grid belong to no region: -1.
            DataField::new("region", 1, of(&|h| self.volume.regions[h] as i32)),
            DataField::new("component", 1, of(&|h| self.components[h] as i32)),
        ];
        if !boundary.hexahedra.is_empty() {
            let mut tags: Vec<i32> = cells.iter().map(|&h| self.components[h as usize] as i32 + 1).collect();
            tags.extend(&boundary.tags);
            fields.push(DataField::new(TAGS, 1, tags));
        }
        fields
    }
}

/// The names of the tags: of components, and of the groups of the surface.
fn names_of_tags(product: &Product, groups: &Groups) -> Vec<CellGroup> {
    let components = product.components.iter().max().map_or(0, |&last| last as usize + 1);
    let named = |dimension, name: String, number: usize| {
        let tag = i32::try_from(number).unwrap_or(i32::MAX);
        CellGroup { name, field: TAGS.to_owned(), dimension, tag }
    };
    let solids = (1..=components).map(|number| named(3, format!("component {number}"), number));
    let faces = groups.names.iter().zip(1..).map(|(name, number)| named(2, name.clone(), number));
    solids.chain(faces).collect()
}

/// The field of tags: of cells the component, of faces the group, both from 1 on.
pub(super) const TAGS: &str = "tag";

/// The faces of a volumetric mesh that have cells on one side only.
#[derive(Default)]
pub(crate) struct Boundary {
    pub(super) quadrilaterals: Vec<[u32; 4]>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The hexahedron at each face.
    hexahedra: Vec<u32>,
    /// The group of the surface at each face, from 1 on.
    pub(super) tags: Vec<i32>,
    /// What the tags stand for, also those of cells.
    pub(super) names: Vec<CellGroup>,
}

impl Boundary {
    /// Each face with the group of the triangle that is nearest among those in its hexahedron.
    pub(super) fn of(
        product: &Product,
        surface: &ClosedOrientedMesh,
        groups: &Groups,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Cancelled> {
        let mesh = &product.volume.mesh;
        let mut boundary = Self { names: names_of_tags(product, groups), ..Self::default() };
        for side in boundary_sides(mesh, monitor)? {
            let corners = side.vertices.map(|vertex| mesh.position(vertex));
            let middle = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25;
            let tag = groups.nearest(surface, &product.volume.hosts, side.hexahedron as u32, middle);
            match &product.tetrahedra {
                None => boundary.quadrilaterals.push(side.vertices),
                Some(tetrahedra) => {
                    let centre = centre_of_side(tetrahedra, side.hexahedron, side.side);
                    let [a, b, c, d] = side.vertices;
                    boundary.triangles.extend([
                        [a, b, centre],
                        [b, c, centre],
                        [c, d, centre],
                        [d, a, centre],
                    ]);
                }
            }
            let faces = if product.tetrahedra.is_some() { 4 } else { 1 };
            boundary.hexahedra.extend([side.hexahedron as u32; 4].iter().take(faces));
            boundary.tags.extend([tag; 4].iter().take(faces));
        }
        Ok(boundary)
    }
}

/// The vertex at the centre of a side of the boundary.
fn centre_of_side(tetrahedra: &Tetrahedra, hexahedron: usize, side: usize) -> u32 {
    let mut at = [0.5; 3];
    at[side / 2] = (side % 2) as f64;
    let found = tetrahedra.locate(hexahedron, at).expect("the middle of a side is a point of the hexahedron");
    let heaviest = (0..4).max_by(|&a, &b| found.weights[a].total_cmp(&found.weights[b])).unwrap_or(0);
    tetrahedra.mesh().tetrahedra[found.tetrahedron][heaviest]
}
