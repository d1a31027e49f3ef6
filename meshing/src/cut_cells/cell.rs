//! [`CutCell`]: the geometry of one cell that the surface passes through.

use glam::DVec3;

use super::CutCells;
use crate::isosurface::{CellCase, CellPoint};

/// A cell that the surface passes through, and the part of it where samples are below the level.
#[derive(Clone, Copy, Debug)]
pub struct CutCell<'a> {
    pub(super) cells: &'a CutCells,
    pub(super) index: [u32; 3],
    pub(super) case: CellCase,
    /// Numbers of the samples on those edges that have one, by ascending edge.
    pub(super) samples: &'a [u32],
}

impl<'a> CutCell<'a> {
    /// Which cell of the grid it is.
    #[must_use]
    pub fn index(&self) -> [u32; 3] {
        self.index
    }

    /// Which of its corners are below the level.
    #[must_use]
    pub fn case(&self) -> CellCase {
        self.case
    }

    /// The number of a sample's vertex among [`CutCells::positions`], if the edge has a sample.
    #[must_use]
    pub fn vertex(&self, edge: u8) -> Option<u32> {
        if edge >= 12 || !self.is_cut(edge) {
            return None;
        }
        Some(self.samples[(0..edge).filter(|&e| self.is_cut(e)).count()])
    }

    /// Where a point of the cell is; a sample that does not exist is at the lower end of its edge.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub fn place(&self, point: CellPoint) -> DVec3 {
        if let CellPoint::Edge(edge) = point
            && let Some(vertex) = self.vertex(edge)
        {
            return self.cells.positions()[vertex as usize];
        }
        self.corner(point.ends()[0])
    }

    /// All points of the cell: eight corners, then twelve edges.
    fn places(&self) -> [DVec3; 20] {
        let mut samples = self.samples.iter();
        std::array::from_fn(|p| {
            let edge = (p as u8).checked_sub(8);
            match edge.filter(|&edge| self.is_cut(edge)).and_then(|_| samples.next()) {
                Some(&vertex) => self.cells.positions()[vertex as usize],
                None => self.corner(edge.map_or(p as u8, |edge| CellPoint::Edge(edge).ends()[0])),
            }
        })
    }

    fn is_cut(&self, edge: u8) -> bool {
        let [a, b] = CellPoint::Edge(edge).ends();
        self.case.is_negative(a) != self.case.is_negative(b)
    }

    fn corner(&self, corner: u8) -> DVec3 {
        let [i, j, k] = self.index;
        let [dx, dy, dz] = [corner & 1, corner >> 1 & 1, corner >> 2 & 1].map(u32::from);
        self.cells.grid().position([i + dx, j + dy, k + dz])
    }

    /// The surface in the cell, counterclockwise seen from the positive side.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [DVec3; 3]> + use<> {
        let places = self.places();
        self.case.triangle_numbers().iter().map(move |t| t.map(|p| places[usize::from(p)]))
    }

    /// Tetrahedra that tile the negative part, positively oriented.
    pub fn tetrahedra(&self) -> impl ExactSizeIterator<Item = [DVec3; 4]> + use<> {
        let places = self.places();
        self.case.tetrahedron_numbers().iter().map(move |t| t.map(|p| places[usize::from(p)]))
    }

    /// The negative part of a face of the cell ([`CellCase::face_polygon`]), a convex polygon counterclockwise seen from outside of the cell.
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn face(&self, face: usize) -> Vec<DVec3> {
        self.case.face_polygon(face).iter().map(|&p| self.place(p)).collect()
    }

    /// Volume of the negative part.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.tetrahedra().map(tetrahedron_volume).sum()
    }

    /// Area of the surface in the cell.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.triangles().map(|t| length(triangle_normal(t))).sum()
    }

    /// Area of the negative part of a face, without sign.
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn face_area(&self, face: usize) -> f64 {
        fan(&self.face(face)).map(|t| length(triangle_normal(t))).sum()
    }

    /// The integral of the unit normal over the surface in the cell, pointing to the positive side.
    #[must_use]
    pub fn area_vector(&self) -> DVec3 {
        self.triangles().map(triangle_normal).sum()
    }
}

/// A convex polygon as triangles about its first corner.
pub(super) fn fan(polygon: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]])
}

/// Volume of a positively oriented tetrahedron.
pub(super) fn tetrahedron_volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a) / 6.0
}

/// The normal of a triangle, as long as its area.
pub(super) fn triangle_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    0.5 * (b - a).cross(c - a)
}

/// The length of an area vector. On grids of the smallest spacings the squares of its coordinates are below the smallest number: it is scaled up
/// by a power of two then, which rounds nothing. Cells of the largest spacings have areas whose squares do not overflow.
pub(super) fn length(area: DVec3) -> f64 {
    /// Below this, a square loses digits to underflow; with 2^-400 the coordinate that counts still has a square of 2^-800.
    const SMALL: f64 = f64::from_bits((1023 - 400) << 52);
    const UP: f64 = f64::from_bits((1023 + 400) << 52);
    if area.abs().max_element() < SMALL { (area * UP).length() / UP } else { area.length() }
}
