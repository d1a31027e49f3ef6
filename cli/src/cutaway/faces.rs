//! The faces of a volumetric mesh that are seen when it is cut open: [`Faces`].

use crate::render::Cut;
use welter_meshing::volumetric::{HexMesh, QUADRILATERALS, boundary_sides};
use welter_meshing::{Cancelled, DVec3, Monitor};

/// Where a face lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// On the cut.
    Cut,
    /// On the boundary of the mesh.
    Boundary,
}

/// A face that is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Face {
    /// The cell and side: what lies at the same place is next to each other.
    cell: u64,
    side: u8,
    /// The hexahedron that it is a side of.
    pub(super) hexahedron: u32,
    pub(super) kind: Kind,
}

/// All faces that are seen, ascending.
pub(super) struct Faces(Vec<Face>);

impl Faces {
    /// What is left if the hexahedra are taken away whose centre lies above the plane, or below it.
    pub(super) fn of(
        mesh: &HexMesh,
        cut: Cut,
        above: bool,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Cancelled> {
        let grid = mesh.grid();
        let is_kept = |cell: u64| {
            let layer = grid.cell_at(cell as usize)[cut.axis];
            let centre = 0.5 * grid.coordinate(cut.axis, layer) + 0.5 * grid.coordinate(cut.axis, layer + 1);
            if above { centre <= cut.value } else { centre >= cut.value }
        };
        let kept: Vec<u32> =
            (0..).zip(mesh.cells()).filter(|&(_, &cell)| is_kept(cell)).map(|(h, _)| h).collect();
        let rest = HexMesh::new(
            *grid,
            mesh.nodes().to_vec(),
            kept.iter().map(|&h| mesh.hexahedra()[h as usize]).collect(),
            kept.iter().map(|&h| mesh.cells()[h as usize]).collect(),
        )
        .expect("a part of a mesh of hexahedra is one");
        let whole: Vec<(usize, usize)> =
            boundary_sides(mesh, monitor)?.iter().map(|found| (found.hexahedron, found.side)).collect();
        let mut faces: Vec<Face> = boundary_sides(&rest, monitor)?
            .iter()
            .map(|found| {
                let hexahedron = kept[found.hexahedron];
                let is_old = whole.binary_search(&(hexahedron as usize, found.side)).is_ok();
                let kind = if is_old { Kind::Boundary } else { Kind::Cut };
                Face { cell: mesh.cells()[hexahedron as usize], side: found.side as u8, hexahedron, kind }
            })
            .collect();
        faces.sort_unstable();
        Ok(Self(faces))
    }

    /// The faces at the same place, together.
    pub(super) fn stacks(&self) -> impl Iterator<Item = &[Face]> {
        self.0.chunk_by(|a, b| (a.cell, a.side) == (b.cell, b.side))
    }

    /// The corners of a face, counterclockwise seen from outside.
    pub(super) fn corners(&self, face: Face, mesh: &HexMesh) -> [DVec3; 4] {
        let corners = mesh.hexahedra()[face.hexahedron as usize];
        QUADRILATERALS[usize::from(face.side)].map(|corner| mesh.position(corners[corner]))
    }
}
