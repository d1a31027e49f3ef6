//! The 256 cases of marching cubes: [`CellCase`].
//!
//! # What it holds
//! For every set of negative corners of a cubic cell, the triangles of the surface in it and tetrahedra that fill its negative part. Corners of both are
//! *points* of the cell: [`CellPoint`].
//!
//! # What it promises
//! Wherever the samples lie on their edges, off the ends:
//! * every tetrahedron is positively oriented, no two overlap, and together they are the cell's part that the surface and the negative
//!   parts of the cell's faces enclose;
//! * the surface has no fold and does not meet itself, and it meets a face of the cell in the segments of [`face_polygon`] only, which
//!   depend on the signs on that face alone: so the surfaces and the volumes of neighbouring cells fit together without
//!   hole or overlap.
//!
//! Why: in every case every tetrahedron is a cone from one negative corner `v` over a triangle, of positive volume (the build script decides that). About
//! `v` the region is the whole octant of the cell. So the triangles, seen from `v`, cover the octant's directions, each with the
//! same orientation; and they are a disc (the hull's boundary without the facets at `v`) whose rim runs once around the octant's rim, since the polygons of the
//! three faces at `v` stay convex. A direction is covered as often as the rim winds about it if no triangle counts the other way: once. So the region is
//! star-shaped about `v`.
//!
//! # What it does not promise
//! The same surface, reversed, for the complement of a set. The rule joins negative corners within a cell, always:
//! * on a face whose two negative corners are diagonal, they are joined (120 of the 254 mixed cases have such a face, and then
//!   the complement's surface has another boundary);
//! * negative corners that are diagonal in the cell are joined by a tunnel, positive ones are not (cases 24 and 231 and their rotations);
//! * where four or more samples bound a piece of the surface, it need not be flat, and is cut along the same diagonals wherever the samples are: it may bulge to
//!   either side.
//!
//! For 36 mixed cases the triangles are those of the complement, reversed; a test counts.
//!
//! # Method
//! Convex hulls \[Bhaniramka04\] with tetrahedra \[Gagniere22\]: see `build/main.rs`.

use super::cell::{CORNERS, EDGE_ENDS, FACE_CORNERS, edge_between};

include!(concat!(env!("OUT_DIR"), "/marching_cubes.rs"));

/// A point of a cell: a corner, or the sample on an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CellPoint {
    /// Corner `c`, at `(c & 1, c >> 1 & 1, c >> 2 & 1)`.
    Corner(u8),
    /// The sample on edge `e`: along axis `e / 4`, at the corner whose other two coordinates are the bits of `e % 4`, the lower
    /// axis first.
    Edge(u8),
}

impl CellPoint {
    #[inline]
    fn of(number: u8) -> Self {
        if number < CORNERS { Self::Corner(number) } else { Self::Edge(number - CORNERS) }
    }

    /// The two corners at the ends of the edge, the lower first; a corner twice.
    ///
    /// # Panics
    /// If there is no such edge.
    #[inline]
    #[must_use]
    pub fn ends(self) -> [u8; 2] {
        match self {
            Self::Corner(corner) => [corner; 2],
            Self::Edge(edge) => EDGE_ENDS[usize::from(edge)],
        }
    }
}

/// Which corners of a cell are negative: bit `c` for corner `c`.
///
/// ```
/// use welter_meshing::isosurface::{CellCase, CellPoint::{Corner, Edge}};
/// let case = CellCase(0b0000_0001); // the corner at the origin
/// assert_eq!(case.triangles().collect::<Vec<_>>(), [[Edge(0), Edge(4), Edge(8)]]);
/// assert_eq!(case.tetrahedra().collect::<Vec<_>>(), [[Corner(0), Edge(0), Edge(4), Edge(8)]]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CellCase(pub u8);

impl CellCase {
    /// Whether the surface passes through the cell.
    #[inline]
    #[must_use]
    pub fn is_mixed(self) -> bool {
        self.0 != 0 && self.0 != 255
    }

    /// Whether a corner is negative; not if there is no such corner.
    #[inline]
    #[must_use]
    pub fn is_negative(self, corner: u8) -> bool {
        corner < CORNERS && self.0 >> corner & 1 == 1
    }

    /// The triangles of the surface, counterclockwise seen from the positive side. All corners are samples.
    pub fn triangles(self) -> impl ExactSizeIterator<Item = [CellPoint; 3]> {
        self.triangle_numbers().iter().map(|t| t.map(CellPoint::of))
    }

    /// Tetrahedra that fill the negative part, positively oriented: the last three corners turn counterclockwise seen from the side away from the
    /// first, which is the lowest negative corner of the cell.
    pub fn tetrahedra(self) -> impl ExactSizeIterator<Item = [CellPoint; 4]> {
        self.tetrahedron_numbers().iter().map(|t| t.map(CellPoint::of))
    }

    /// As [`CellCase::triangles`], by the numbers of points.
    #[inline]
    pub(crate) fn triangle_numbers(self) -> &'static [[u8; 3]] {
        let case = usize::from(self.0);
        &TRIANGLES[usize::from(TRIANGLES_START[case])..usize::from(TRIANGLES_START[case + 1])]
    }

    /// As [`CellCase::tetrahedra`], by the numbers of points.
    #[inline]
    pub(crate) fn tetrahedron_numbers(self) -> &'static [[u8; 4]] {
        let case = usize::from(self.0);
        &TETRAHEDRA[usize::from(TETRAHEDRA_START[case])..usize::from(TETRAHEDRA_START[case + 1])]
    }

    /// The negative part of a face of the cell, a convex polygon, counterclockwise seen from outside; empty if no corner is negative.
    /// Face `f` lies across axis `f / 2`, at its lower (`f % 2 == 0`) or upper side.
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn face_polygon(self, face: usize) -> FacePolygon {
        face_polygon(self, &FACE_CORNERS[face])
    }
}

/// The negative part of a face of a cell: up to six points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacePolygon {
    points: [CellPoint; 6],
    len: u8,
}

impl std::ops::Deref for FacePolygon {
    type Target = [CellPoint];
    fn deref(&self) -> &[CellPoint] {
        &self.points[..usize::from(self.len)]
    }
}

/// Walks around a face and notes its negative corners and the samples on its edges: the convex hull of both, since all
/// of them lie on the rim of the face.
fn face_polygon(case: CellCase, corners: &[u8; 4]) -> FacePolygon {
    let mut polygon = FacePolygon { points: [CellPoint::Corner(0); 6], len: 0 };
    let mut push = |point| {
        polygon.points[usize::from(polygon.len)] = point;
        polygon.len += 1;
    };
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % 4];
        if case.is_negative(corner) {
            push(CellPoint::Corner(corner));
        }
        if case.is_negative(corner) != case.is_negative(next) {
            push(CellPoint::Edge(edge_between(corner, next)));
        }
    }
    polygon
}
