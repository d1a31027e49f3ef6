//! [`Connectivity`]: which triangles of a closed surface are neighbours, and how edges are split, flipped and
//! collapsed.
//!
//! # What it computes
//! Nothing of geometry: corners of triangles, the opposite of each half-edge, one half-edge out of each
//! vertex. Positions and all criteria belong to who calls.
//!
//! # What it promises
//! * Every edge has two triangles, one each way; every vertex in use has one fan; no two edges have the same
//!   ends; a triangle has three different corners. [`Connectivity::check`] tells where that is broken, and
//!   after no sequence of calls it is.
//! * Splits, flips and collapses keep the number of components, their genus and their orientation. What would
//!   not is refused beforehand by [`Connectivity::can_flip`] and [`Connectivity::can_collapse`] (the link
//!   condition \[Dey99\]).
//! * Ids of elements that live on never change. Those of removed ones are not given out again;
//!   [`Connectivity::compacted`] numbers anew.
//!
//! # What it does not promise
//! Room for edges with more than two triangles: such meshes are refused with the edge or vertex.
//!
//! # Method
//! Half-edge `3 t + k` runs from corner `k` of triangle `t` to the next. A triangle is on the left of its
//! half-edges.
//!
//! # Complexity
//! An operation costs as much as the triangles at the ends of its edge; nothing is allocated but by splits.

mod check;
mod edit;

pub use check::ConnectivityDefect;

use thiserror::Error;

use crate::surface::{ClosedOrientedMesh, EdgeId, Topology, TriId, VertexId};

/// A triangle's side, seen as the way from a corner to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct HalfEdge(pub u32);

impl HalfEdge {
    /// Where a vertex that is not in use goes out to.
    pub(crate) const NONE: Self = Self(u32::MAX);

    /// Side `k` of a triangle, from corner `k` to the next.
    #[inline]
    #[must_use]
    pub fn of(triangle: TriId, k: usize) -> Self {
        Self(3 * triangle.0 + k as u32)
    }

    /// Its triangle.
    #[inline]
    #[must_use]
    pub fn triangle(self) -> TriId {
        TriId(self.0 / 3)
    }

    /// Which side of its triangle it is.
    #[inline]
    #[must_use]
    pub fn side(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The half-edge that follows in the same triangle.
    #[inline]
    #[must_use]
    pub fn next(self) -> Self {
        Self(if self.side() == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The half-edge that precedes in the same triangle.
    #[inline]
    #[must_use]
    pub fn previous(self) -> Self {
        Self(if self.side() == 0 { self.0 + 2 } else { self.0 - 1 })
    }

    #[inline]
    fn index(self) -> usize {
        self.0 as usize
    }
}

/// Why a closed surface has no [`Connectivity`].
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotManifold {
    /// More than two triangles on an edge.
    #[error("the edge between vertices {} and {} has {triangles} triangles, must have 2", vertices[0].0, vertices[1].0)]
    Edge {
        /// Its ends, the smaller id first.
        vertices: [VertexId; 2],
        /// How many triangles it has.
        triangles: usize,
    },
    /// Triangles at a vertex that are not linked through its edges.
    #[error("the triangles at vertex {} form several fans, must be one", vertex.0)]
    Vertex {
        /// The first such vertex.
        vertex: VertexId,
    },
    /// Two triangles with the same three corners.
    #[error("triangles {} and {} have the same corners", triangles[0].0, triangles[1].0)]
    Doubled {
        /// Which triangles.
        triangles: [TriId; 2],
    },
}

/// The corner of a triangle that was removed.
const REMOVED: VertexId = VertexId(u32::MAX);

/// Neighbourhood of triangles in a closed surface with two triangles at every edge and one fan at every
/// vertex.
///
/// ```
/// use welter_meshing::{remesh::connectivity::Connectivity, shapes, surface::VertexId};
/// let sphere = shapes::sphere(&shapes::Sphere { edge_length: 0.5, ..Default::default() })?;
/// let mut mesh = Connectivity::new(&sphere)?;
/// let edge = mesh.around(VertexId(0)).next().expect("a closed surface");
/// let middle = mesh.split(edge);
/// assert_eq!(mesh.valence(middle), 4);
/// assert_eq!(mesh.check(), Ok(()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Connectivity {
    triangles: Vec<[VertexId; 3]>,
    opposite: Vec<HalfEdge>,
    outgoing: Vec<HalfEdge>,
}

impl Connectivity {
    /// The connectivity of a closed surface.
    ///
    /// # Errors
    /// [`NotManifold`] with the first edge that has more than two triangles, else the first vertex with
    /// several fans, else the first two triangles with the same corners.
    pub fn new(mesh: &ClosedOrientedMesh) -> Result<Self, NotManifold> {
        let topology = Topology::of(mesh);
        if let Some(&edge) = topology.non_manifold_edges().first() {
            let triangles = topology.edge_triangles(edge).len();
            return Err(NotManifold::Edge { vertices: topology.edges()[edge.index()], triangles });
        }
        if let Some(&vertex) = topology.non_manifold_vertices().first() {
            return Err(NotManifold::Vertex { vertex });
        }
        let triangles = mesh.triangles().to_vec();
        let mut opposite = vec![HalfEdge::NONE; 3 * triangles.len()];
        for edge in (0..topology.edges().len()).map(EdgeId::from_index) {
            if let &[forward, backward] = topology.table().half_edges(edge) {
                opposite[forward as usize] = HalfEdge(backward);
                opposite[backward as usize] = HalfEdge(forward);
            }
        }
        let mut outgoing = vec![HalfEdge::NONE; mesh.positions().len()];
        for (t, corners) in triangles.iter().enumerate() {
            for (k, corner) in corners.iter().enumerate() {
                outgoing[corner.index()] = HalfEdge::of(TriId::from_index(t), k);
            }
        }
        let connectivity = Self { triangles, opposite, outgoing };
        let doubled = |&h: &HalfEdge| connectivity.apex(h) == connectivity.apex(connectivity.opposite(h));
        let first = connectivity.edges().find(doubled);
        match first {
            Some(h) => {
                let triangles = [h.triangle(), connectivity.opposite(h).triangle()];
                Err(NotManifold::Doubled { triangles })
            }
            None => Ok(connectivity),
        }
    }

    /// How many vertex ids were given out; some of them may be in use no more.
    #[must_use]
    pub fn vertex_slots(&self) -> usize {
        self.outgoing.len()
    }

    /// How many triangle ids were given out; some of them may be in use no more.
    #[must_use]
    pub fn triangle_slots(&self) -> usize {
        self.triangles.len()
    }

    /// The vertices in use, ascending.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        (0..self.outgoing.len() as u32).map(VertexId).filter(|&v| self.has_vertex(v))
    }

    /// The triangles in use, ascending.
    pub fn triangles(&self) -> impl Iterator<Item = TriId> + '_ {
        (0..self.triangles.len() as u32).map(TriId).filter(|&t| self.has_triangle(t))
    }

    /// One half-edge of every edge, that with the smaller number; ascending.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdge> + '_ {
        (0..self.opposite.len() as u32)
            .map(HalfEdge)
            .filter(|&h| self.has_triangle(h.triangle()) && h < self.opposite(h))
    }

    /// Whether a vertex is in use.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn has_vertex(&self, vertex: VertexId) -> bool {
        self.outgoing[vertex.index()] != HalfEdge::NONE
    }

    /// Whether a triangle is in use.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn has_triangle(&self, triangle: TriId) -> bool {
        self.triangles[triangle.index()][0] != REMOVED
    }

    /// The corners of a triangle.
    #[inline]
    #[must_use]
    pub fn corners(&self, triangle: TriId) -> [VertexId; 3] {
        self.triangles[triangle.index()]
    }

    /// The half-edge of the neighbouring triangle along the same edge.
    #[inline]
    #[must_use]
    pub fn opposite(&self, half_edge: HalfEdge) -> HalfEdge {
        self.opposite[half_edge.index()]
    }

    /// Where a half-edge begins.
    #[inline]
    #[must_use]
    pub fn tail(&self, half_edge: HalfEdge) -> VertexId {
        self.triangles[half_edge.triangle().index()][half_edge.side()]
    }

    /// Where a half-edge ends.
    #[inline]
    #[must_use]
    pub fn head(&self, half_edge: HalfEdge) -> VertexId {
        self.tail(half_edge.next())
    }

    /// The corner of a half-edge's triangle that is not on it.
    #[inline]
    #[must_use]
    pub fn apex(&self, half_edge: HalfEdge) -> VertexId {
        self.tail(half_edge.previous())
    }

    /// The half-edges out of a vertex, counterclockwise seen from the side from which triangles are; none of
    /// a vertex that is not in use.
    pub fn around(&self, vertex: VertexId) -> impl Iterator<Item = HalfEdge> + '_ {
        let first = self.outgoing[vertex.index()];
        let mut next = (first != HalfEdge::NONE).then_some(first);
        std::iter::from_fn(move || {
            let here = next?;
            let turned = self.opposite(here.previous());
            next = (turned != first).then_some(turned);
            Some(here)
        })
    }

    /// The neighbours of a vertex.
    pub fn neighbours(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.around(vertex).map(|h| self.head(h))
    }

    /// How many edges, and triangles, a vertex has.
    #[must_use]
    pub fn valence(&self, vertex: VertexId) -> usize {
        self.around(vertex).count()
    }

    /// Whether two vertices are the ends of an edge.
    #[must_use]
    pub fn adjacent(&self, a: VertexId, b: VertexId) -> bool {
        self.neighbours(a).any(|v| v == b)
    }

    /// The triangles in use with vertices numbered without gaps, and for each new vertex its old id. Orders
    /// are kept.
    #[must_use]
    pub fn compacted(&self) -> (Vec<[u32; 3]>, Vec<VertexId>) {
        let old: Vec<VertexId> = self.vertices().collect();
        let mut new = vec![u32::MAX; self.vertex_slots()];
        for (i, v) in (0..).zip(&old) {
            new[v.index()] = i;
        }
        let triangles = self.triangles().map(|t| self.corners(t).map(|v| new[v.index()])).collect();
        (triangles, old)
    }
}
