//! [`ClosedOrientedMesh`]: a surface without boundary whose triangles agree on its two sides.
//!
//! Promises: along every edge `{u, v}` as many triangles run from `u` to `v` as from `v` to `u`. So the
//! surface is a cycle: it has no boundary, it encloses a signed volume, and every point off it has a winding
//! number. Allowed are an edge with 2 triangles (one each way) and an edge with 4, 6, ... triangles, half of
//! them each way, as where two cubes meet along an edge; vertices where several fans meet; triangles listed
//! twice, once each way or otherwise balanced; any number of components; unused vertices; the empty mesh.
//!
//! Does not promise: freedom from self-intersection, positive volume, or triangles with area.
//!
//! Method: half-edges sorted by edge. Complexity: as `EdgeTable`, near linear.
//!
//! What is refused, by edge, with `f` triangles forward and `b` backward:
//! ```text
//!   f + b = 1                 boundary: the surface ends there
//!   f + b = 2, f != b         inconsistent: the two triangles lie on opposite sides, as on a Moebius band
//!   f + b > 2, f != b         unbalanced: three triangles, or four of which three run one way, ...
//! ```

use super::edges::{self, EdgeTable};
use super::list;
use super::{EdgeId, TriId, TriMesh, VertexId};
use std::{fmt, ops::Deref};
use thiserror::Error;

/// Each directed edge has its reverse partner; the surface may intersect itself.
///
/// ```
/// use welter_meshing::{DVec3, surface::*};
/// let tetrahedron = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
///     ..TriangleSoup::default()
/// };
/// let mesh = ClosedOrientedMesh::new(TriMesh::new(tetrahedron.clone())?)?;
/// assert_eq!(mesh.triangles().len(), 4); // derefs to TriMesh
///
/// let mut open = tetrahedron;
/// open.triangles.pop();
/// let Err(ClosedOrientedError::Defects(defects)) = ClosedOrientedMesh::new(TriMesh::new(open)?) else { panic!() };
/// assert_eq!(defects.boundary[0].vertices, [VertexId(0), VertexId(2)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedOrientedMesh(TriMesh);

impl ClosedOrientedMesh {
    /// Checks a mesh and takes it over.
    ///
    /// # Errors
    /// As [`ClosedOrientedMesh::check`]. The mesh is dropped then; check first to keep it.
    pub fn new(mesh: TriMesh) -> Result<Self, ClosedOrientedError> {
        Self::check(&mesh)?;
        Ok(Self(mesh))
    }

    /// Whether [`ClosedOrientedMesh::new`] would accept the mesh.
    ///
    /// # Errors
    /// [`ClosedOrientedError`] with every edge at fault.
    pub fn check(mesh: &TriMesh) -> Result<(), ClosedOrientedError> {
        let table = EdgeTable::new(mesh);
        let mut defects = ClosedOrientedDefects::default();
        for edge in table.ids() {
            let [forward, backward] = table.directions(mesh, edge);
            if forward == backward {
                continue;
            }
            let list = match forward + backward {
                1 => &mut defects.boundary,
                2 => &mut defects.inconsistent,
                _ => &mut defects.unbalanced,
            };
            list.push(EdgeDefect::new(&table, edge, forward, backward));
        }
        if defects.is_empty() { Ok(()) } else { Err(ClosedOrientedError::Defects(Box::new(defects))) }
    }

    /// Takes over a mesh of which the promise is known by its construction.
    pub(crate) fn by_construction(mesh: TriMesh) -> Self {
        debug_assert!(Self::check(&mesh).is_ok(), "a construction that promises a closed oriented surface");
        Self(mesh)
    }

    /// The mesh without its promise.
    #[must_use]
    pub fn as_mesh(&self) -> &TriMesh {
        &self.0
    }

    /// The mesh without its promise, taken out.
    #[must_use]
    pub fn into_mesh(self) -> TriMesh {
        self.0
    }

    /// The same surface seen from its other side: the sign of its volume and of its winding numbers changes.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self(self.0.reversed())
    }
}

impl Deref for ClosedOrientedMesh {
    type Target = TriMesh;
    fn deref(&self) -> &TriMesh {
        &self.0
    }
}

impl AsRef<TriMesh> for ClosedOrientedMesh {
    fn as_ref(&self) -> &TriMesh {
        &self.0
    }
}

/// An edge along which the triangles do not balance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgeDefect {
    /// Its ends, the smaller id first.
    pub vertices: [VertexId; 2],
    /// How many triangles run from the first end to the second.
    pub forward: usize,
    /// How many triangles run from the second end to the first.
    pub backward: usize,
    /// The triangles on it, ascending.
    pub triangles: Box<[TriId]>,
}

impl EdgeDefect {
    fn new(table: &EdgeTable, edge: EdgeId, forward: usize, backward: usize) -> Self {
        let triangles = table.half_edges(edge).iter().map(|&h| edges::triangle(h)).collect();
        Self { vertices: table.edges[edge.index()], forward, backward, triangles }
    }
}

impl fmt::Display for EdgeDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.vertices;
        write!(f, "{}-{} (triangle", a.0, b.0)?;
        if self.triangles.len() > 1 {
            f.write_str("s")?;
        }
        for (i, t) in self.triangles.iter().take(4).enumerate() {
            write!(f, "{} {}", if i > 0 { "," } else { "" }, t.0)?;
        }
        f.write_str(if self.triangles.len() > 4 { ", ...)" } else { ")" })
    }
}

/// Every edge that keeps a mesh from being a [`ClosedOrientedMesh`], by kind, each list ascending.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ClosedOrientedDefects {
    /// Edges with one triangle.
    pub boundary: Vec<EdgeDefect>,
    /// Edges with two triangles that run the same way.
    pub inconsistent: Vec<EdgeDefect>,
    /// Edges with three or more triangles that do not balance.
    pub unbalanced: Vec<EdgeDefect>,
}

impl ClosedOrientedDefects {
    /// True when there is no defect.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.boundary.is_empty() && self.inconsistent.is_empty() && self.unbalanced.is_empty()
    }

    /// Every edge at fault: boundary, then inconsistent, then unbalanced.
    pub fn iter(&self) -> impl Iterator<Item = &EdgeDefect> {
        self.boundary.iter().chain(&self.inconsistent).chain(&self.unbalanced)
    }
}

impl fmt::Display for ClosedOrientedDefects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        list::describe(&mut parts, &self.boundary, ["boundary edge", "boundary edges"]);
        list::describe(
            &mut parts,
            &self.inconsistent,
            ["edge with triangles of opposite orientation", "edges with triangles of opposite orientation"],
        );
        list::describe(
            &mut parts,
            &self.unbalanced,
            ["edge with unbalanced triangles", "edges with unbalanced triangles"],
        );
        f.write_str(&parts.join("; "))
    }
}

/// Why a mesh is not a [`ClosedOrientedMesh`].
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ClosedOrientedError {
    /// Edges at fault, all of them.
    #[error("{0}")]
    Defects(Box<ClosedOrientedDefects>),
}
