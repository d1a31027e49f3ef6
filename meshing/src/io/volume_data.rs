//! Volumetric meshes as files hold them: [`VolumeData`] owns what a reader found, [`VolumeView`] borrows what a writer is to write.

use std::fmt;

use super::WriteError;
use super::cell_group::{CellGroup, check_groups};
use super::data_field::{DataField, check_fields};
use crate::DVec3;

/// A kind of cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CellKind {
    /// Eight corners; corner `c` lies at `(c & 1, c >> 1 & 1, c >> 2)` of a cube.
    Hexahedron,
    /// Four corners, the last on the side from which the others turn counterclockwise: of positive volume.
    Tetrahedron,
    /// Four corners, one after the other around it.
    Quadrilateral,
    /// Three corners.
    Triangle,
}

impl CellKind {
    /// Every kind, in the order in which cells are numbered.
    pub const ALL: [Self; 4] = [Self::Hexahedron, Self::Tetrahedron, Self::Quadrilateral, Self::Triangle];

    /// Number of corners.
    #[must_use]
    pub const fn corners(self) -> usize {
        match self {
            Self::Hexahedron => 8,
            Self::Tetrahedron | Self::Quadrilateral => 4,
            Self::Triangle => 3,
        }
    }

    /// Dimension: 3 or 2.
    #[must_use]
    pub const fn dimension(self) -> usize {
        match self {
            Self::Hexahedron | Self::Tetrahedron => 3,
            Self::Quadrilateral | Self::Triangle => 2,
        }
    }
}

impl fmt::Display for CellKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hexahedron => "hexahedron",
            Self::Tetrahedron => "tetrahedron",
            Self::Quadrilateral => "quadrilateral",
            Self::Triangle => "triangle",
        })
    }
}

/// The corner of a hexahedron of ours that each place of one in a file of VTK, Gmsh or MEDIT holds: these go around the lower side,
/// then around the upper. The order is its own inverse.
pub(super) const AROUND: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];

/// The corners of a cell of ours in the order of files, or the other way; as many as the kind has.
#[inline]
pub(super) fn in_file_order(kind: CellKind, corners: &[u32]) -> [u32; 8] {
    let mut ordered = [0; 8];
    ordered[..corners.len()].copy_from_slice(corners);
    if kind == CellKind::Hexahedron { AROUND.map(|corner| ordered[corner]) } else { ordered }
}

/// A volumetric mesh as a file holds it. Indices are in range where a reader made it; nothing else is promised of the cells.
///
/// Cells are numbered across kinds: all hexahedra, then all tetrahedra, quadrilaterals and triangles. That is the order of the values
/// of cell fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeData {
    /// Where the vertices are.
    pub positions: Vec<DVec3>,
    /// Corners of the hexahedra: corner `c` lies at `(c & 1, c >> 1 & 1, c >> 2)` of a cube.
    pub hexahedra: Vec<[u32; 8]>,
    /// Corners of the tetrahedra.
    pub tetrahedra: Vec<[u32; 4]>,
    /// Corners of the quadrilaterals, one after the other around them.
    pub quadrilaterals: Vec<[u32; 4]>,
    /// Corners of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Numbers on the vertices.
    pub point_fields: Vec<DataField<'static>>,
    /// Numbers on the cells.
    pub cell_fields: Vec<DataField<'static>>,
    /// Names for cells of a tag.
    pub groups: Vec<CellGroup>,
}

impl VolumeData {
    /// Calls a writer on the mesh, which is not copied.
    ///
    /// ```
    /// use welter_meshing::{DVec3, io::{Limits, VolumeData, VtkEncoding, read_vtu, write_vtu}};
    /// let mesh = VolumeData {
    ///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
    ///     tetrahedra: vec![[0, 1, 2, 3]],
    ///     ..VolumeData::default()
    /// };
    /// let mut file = Vec::new();
    /// let report = mesh.with_view(|view| write_vtu(&mut file, view, VtkEncoding::Appended))?;
    /// assert!(report.dropped.is_empty());
    /// assert_eq!(read_vtu(&file[..], &Limits::default())?.0, mesh);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_view<T>(&self, write: impl FnOnce(&VolumeView<'_>) -> T) -> T {
        let position = |vertex: usize| self.positions[vertex];
        write(&VolumeView {
            hexahedra: &self.hexahedra,
            tetrahedra: &self.tetrahedra,
            quadrilaterals: &self.quadrilaterals,
            triangles: &self.triangles,
            point_fields: &self.point_fields,
            cell_fields: &self.cell_fields,
            groups: &self.groups,
            ..VolumeView::new(self.positions.len(), &position)
        })
    }

    /// Number of cells of all kinds.
    #[must_use]
    pub fn cell_count(&self) -> usize {
        self.hexahedra.len() + self.tetrahedra.len() + self.quadrilaterals.len() + self.triangles.len()
    }
}

/// A volumetric mesh to be written, borrowed. Positions are asked for as they are written, so that a mesh that computes them need not
/// keep them.
///
/// ```
/// use welter_meshing::grid::Grid3;
/// use welter_meshing::io::{VolumeView, VtkEncoding, write_vtu};
/// use welter_meshing::volumetric::HexMesh;
/// let mesh = HexMesh::new(Grid3::new([0.0; 3], 0.5, [1; 3])?, (0..8).collect(), vec![[0, 1, 2, 3, 4, 5, 6, 7]], vec![0])?;
/// let position = |vertex: usize| mesh.position(vertex as u32);
/// let view = VolumeView { hexahedra: mesh.hexahedra(), ..VolumeView::new(mesh.nodes().len(), &position) };
/// let mut file = Vec::new();
/// write_vtu(&mut file, &view, VtkEncoding::Ascii)?;
/// assert!(String::from_utf8(file)?.contains("0 1 3 2 4 5 7 6"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct VolumeView<'a> {
    /// Number of vertices.
    pub vertices: usize,
    /// Where each vertex is. Asked for more than once, and to give the same each time.
    pub position: &'a dyn Fn(usize) -> DVec3,
    /// Corners of the hexahedra, ordered as in [`VolumeData`].
    pub hexahedra: &'a [[u32; 8]],
    /// Corners of the tetrahedra.
    pub tetrahedra: &'a [[u32; 4]],
    /// Corners of the quadrilaterals, one after the other around them.
    pub quadrilaterals: &'a [[u32; 4]],
    /// Corners of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// Numbers on the vertices.
    pub point_fields: &'a [DataField<'a>],
    /// Numbers on the cells, in the order of [`VolumeData`].
    pub cell_fields: &'a [DataField<'a>],
    /// Names for cells of a tag.
    pub groups: &'a [CellGroup],
}

impl fmt::Debug for VolumeView<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells =
            [self.hexahedra.len(), self.tetrahedra.len(), self.quadrilaterals.len(), self.triangles.len()];
        f.debug_struct("VolumeView").field("vertices", &self.vertices).field("cells", &cells).finish()
    }
}

impl<'a> VolumeView<'a> {
    /// Vertices without cells and fields.
    #[must_use]
    pub fn new(vertices: usize, position: &'a dyn Fn(usize) -> DVec3) -> Self {
        Self {
            vertices,
            position,
            hexahedra: &[],
            tetrahedra: &[],
            quadrilaterals: &[],
            triangles: &[],
            point_fields: &[],
            cell_fields: &[],
            groups: &[],
        }
    }

    /// Number of cells of a kind.
    pub(super) fn count(&self, kind: CellKind) -> usize {
        match kind {
            CellKind::Hexahedron => self.hexahedra.len(),
            CellKind::Tetrahedron => self.tetrahedra.len(),
            CellKind::Quadrilateral => self.quadrilaterals.len(),
            CellKind::Triangle => self.triangles.len(),
        }
    }

    /// Number of cells of all kinds.
    pub(super) fn cell_count(&self) -> usize {
        CellKind::ALL.into_iter().map(|kind| self.count(kind)).sum()
    }

    /// Kind and number within its kind of a cell, which is below [`cell_count`](Self::cell_count).
    #[inline]
    pub(super) fn locate(&self, mut cell: usize) -> (CellKind, usize) {
        for kind in CellKind::ALL {
            if cell < self.count(kind) {
                return (kind, cell);
            }
            cell -= self.count(kind);
        }
        unreachable!("callers go through the cells that there are")
    }

    /// Corners of a cell of a kind.
    #[inline]
    pub(super) fn corners(&self, kind: CellKind, index: usize) -> &'a [u32] {
        match kind {
            CellKind::Hexahedron => &self.hexahedra[index],
            CellKind::Tetrahedron => &self.tetrahedra[index],
            CellKind::Quadrilateral => &self.quadrilaterals[index],
            CellKind::Triangle => &self.triangles[index],
        }
    }

    /// Counts within 32 bits, indices in range, fields and groups that fit.
    pub(super) fn check(&self) -> Result<(), WriteError> {
        let limit = u64::from(u32::MAX);
        for (what, count) in [("vertices", self.vertices), ("cells", self.cell_count())] {
            if count as u64 > limit {
                return Err(WriteError::TooMany { what, count, limit });
            }
        }
        for kind in CellKind::ALL {
            for cell in 0..self.count(kind) {
                let corners = self.corners(kind, cell);
                if let Some(&index) = corners.iter().find(|&&index| index as usize >= self.vertices) {
                    return Err(WriteError::Corner { kind, cell, index, vertices: self.vertices });
                }
            }
        }
        check_fields(self.point_fields, self.vertices)?;
        check_fields(self.cell_fields, self.cell_count())?;
        check_groups(self.groups)
    }
}

/// A file's corner as an index, if the file has such a vertex.
pub(super) fn vertex_index(index: i64, vertices: usize) -> Option<u32> {
    u32::try_from(index).ok().filter(|&index| (index as usize) < vertices)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_files_is_its_own_inverse_and_goes_around() {
        let corners = [10, 11, 12, 13, 14, 15, 16, 17];
        let there = in_file_order(CellKind::Hexahedron, &corners);
        assert_eq!(in_file_order(CellKind::Hexahedron, &there), corners);
        // Neighbours around a side differ in one coordinate.
        for k in 0..4 {
            assert_eq!((AROUND[k] ^ AROUND[(k + 1) % 4]).count_ones(), 1);
            assert_eq!(AROUND[k] + 4, AROUND[k + 4]);
        }
        assert_eq!(in_file_order(CellKind::Triangle, &[7, 8, 9])[..3], [7, 8, 9]);
    }

    #[test]
    fn corners_out_of_range_are_named() {
        let mesh = VolumeData {
            positions: vec![DVec3::ZERO; 4],
            tetrahedra: vec![[0, 1, 2, 3]],
            triangles: vec![[0, 1, 2], [0, 4, 1]],
            ..VolumeData::default()
        };
        let error = mesh.with_view(|view| view.check()).unwrap_err();
        assert_eq!(error.to_string(), "triangle 1 names vertex 4, there are 4 vertices");
    }
}
