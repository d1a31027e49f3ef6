//! [`RadialConnectivity`]: which triangles meet at which edges and vertices, for surfaces with more than two
//! triangles at an edge.
//!
//! # What it computes
//! Nothing of geometry: corners of triangles, the cycle of half-edges around each edge, the list of corners at
//! each vertex, and ids for all three kinds of element.
//!
//! # What it promises
//! A surface is *admissible* \[Brochu12, section 3.2.1\] if
//! * every edge has as many triangles that run one way along it as the other, or has one triangle (boundary);
//! * no two triangles have the same three corners;
//! * the corners of a triangle differ.
//!
//! Every change is planned first, and refused with the place if its result would not be admissible.
//! [`RadialConnectivity::check`] finds from scratch whether anything is broken; after no sequence of changes it is.
//!
//! Ids of elements that live on never change until the surface is compacted. Those of removed elements are given
//! out again, the last removed first.
//!
//! # What it does not promise
//! An order of the half-edges at an edge or a vertex: it depends on the changes made (on nothing else), until
//! the surface is compacted; then it ascends.
//!
//! # Method
//! Half-edge `3 t + k` runs from corner `k` of triangle `t` to the next. Half-edges on one edge form a cycle, as
//! in the radial-edge structure \[Weiler88\]; half-edges out of one vertex form a doubly linked list.
//!
//! # Complexity
//! A change costs as much as the triangles that it touches and the smaller of the stars at the ends of each new
//! edge. 28 bytes a half-edge.

mod build;
mod cancel;
pub(crate) mod change;
mod check;
mod consequences;
mod defects;
mod fans;
mod link;
mod refusal;

pub(crate) use build::OldIds;
pub use check::ConnectivityDefect;
pub use consequences::Consequences;
pub use defects::{DoubledTriangles, SurfaceDefects};
pub use refusal::Refusal;
pub use welter_meshing::remesh::connectivity::HalfEdge;

use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// The end of a list, and the corner of a triangle that is not in use.
pub(crate) const NO_HALF_EDGE: HalfEdge = HalfEdge(u32::MAX);
pub(crate) const NO_VERTEX: VertexId = VertexId(u32::MAX);
pub(crate) const NO_EDGE: EdgeId = EdgeId(u32::MAX);

/// What a half-edge is linked to. The links of one are read together, so they stand together in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Links {
    pub(crate) edge: EdgeId,
    /// The next half-edge on the same edge, in a cycle.
    pub(crate) radial: HalfEdge,
    /// The next and the previous in the list of half-edges out of the same vertex.
    pub(crate) next: HalfEdge,
    pub(crate) previous: HalfEdge,
}

impl Links {
    pub(crate) const NONE: Self =
        Self { edge: NO_EDGE, radial: NO_HALF_EDGE, next: NO_HALF_EDGE, previous: NO_HALF_EDGE };
}

/// An edge in use, or a free slot (`first` is [`NO_HALF_EDGE`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct EdgeSlot {
    /// From where to where values that have a direction count.
    pub(crate) ends: [VertexId; 2],
    pub(crate) first: HalfEdge,
}

/// A vertex in use, or a free slot (no triangles).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct VertexSlot {
    pub(crate) first: HalfEdge,
    pub(crate) triangles: u32,
}

/// Neighbourhood of triangles where edges have one triangle or any even number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RadialConnectivity {
    pub(crate) triangles: Vec<[VertexId; 3]>,
    /// By half-edge.
    pub(crate) links: Vec<Links>,
    pub(crate) edges: Vec<EdgeSlot>,
    pub(crate) vertices: Vec<VertexSlot>,
    pub(crate) free_triangles: Vec<TriId>,
    pub(crate) free_edges: Vec<EdgeId>,
    pub(crate) free_vertices: Vec<VertexId>,
}

impl RadialConnectivity {
    /// How many vertex ids there are, in use or free.
    #[must_use]
    pub fn vertex_slots(&self) -> usize {
        self.vertices.len()
    }

    /// How many edge ids there are, in use or free.
    #[must_use]
    pub fn edge_slots(&self) -> usize {
        self.edges.len()
    }

    /// How many triangle ids there are, in use or free.
    #[must_use]
    pub fn triangle_slots(&self) -> usize {
        self.triangles.len()
    }

    /// How many vertices are in use: those of a triangle.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertices.len() - self.free_vertices.len()
    }

    /// How many edges are in use.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.edges.len() - self.free_edges.len()
    }

    /// How many triangles are in use.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len() - self.free_triangles.len()
    }

    /// Vertices - edges + triangles.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.triangle_count() as i64
    }

    /// The vertices in use, ascending.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        (0..self.vertices.len() as u32).map(VertexId).filter(|&v| self.has_vertex(v))
    }

    /// The edges in use, ascending.
    pub fn edges(&self) -> impl Iterator<Item = EdgeId> + '_ {
        (0..self.edges.len() as u32).map(EdgeId).filter(|&e| self.has_edge(e))
    }

    /// The triangles in use, ascending.
    pub fn triangles(&self) -> impl Iterator<Item = TriId> + '_ {
        (0..self.triangles.len() as u32).map(TriId).filter(|&t| self.has_triangle(t))
    }

    /// Whether a vertex is in use; false for ids that were never given out.
    #[must_use]
    pub fn has_vertex(&self, vertex: VertexId) -> bool {
        self.vertices.get(vertex.index()).is_some_and(|slot| slot.triangles > 0)
    }

    /// Whether an edge is in use; false for ids that were never given out.
    #[must_use]
    pub fn has_edge(&self, edge: EdgeId) -> bool {
        self.edges.get(edge.index()).is_some_and(|slot| slot.first != NO_HALF_EDGE)
    }

    /// Whether a triangle is in use; false for ids that were never given out.
    #[must_use]
    pub fn has_triangle(&self, triangle: TriId) -> bool {
        self.triangles.get(triangle.index()).is_some_and(|corners| corners[0] != NO_VERTEX)
    }

    /// The corners of a triangle in use.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn corners(&self, triangle: TriId) -> [VertexId; 3] {
        self.triangles[triangle.index()]
    }

    /// The ends of an edge in use, in the order in which values with a direction count.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn ends(&self, edge: EdgeId) -> [VertexId; 2] {
        self.edges[edge.index()].ends
    }

    /// The edge of a half-edge.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn edge(&self, half_edge: HalfEdge) -> EdgeId {
        self.links[half_edge.0 as usize].edge
    }

    /// Where a half-edge begins.
    ///
    /// # Panics
    /// If its id was never given out.
    #[inline]
    #[must_use]
    pub fn tail(&self, half_edge: HalfEdge) -> VertexId {
        self.triangles[half_edge.triangle().index()][half_edge.side()]
    }

    /// Where a half-edge ends.
    ///
    /// # Panics
    /// As [`RadialConnectivity::tail`].
    #[inline]
    #[must_use]
    pub fn head(&self, half_edge: HalfEdge) -> VertexId {
        self.tail(half_edge.next())
    }

    /// The corner of the half-edge's triangle that is not on it.
    ///
    /// # Panics
    /// As [`RadialConnectivity::tail`].
    #[inline]
    #[must_use]
    pub fn apex(&self, half_edge: HalfEdge) -> VertexId {
        self.tail(half_edge.previous())
    }

    /// The half-edges on an edge, each once.
    ///
    /// # Panics
    /// If the edge is not in use.
    pub fn around_edge(&self, edge: EdgeId) -> impl Iterator<Item = HalfEdge> + '_ {
        assert!(self.has_edge(edge), "edge {} is not in use", edge.0);
        let first = self.edges[edge.index()].first;
        let on = move |&h: &HalfEdge| Some(self.links[h.0 as usize].radial).filter(|&next| next != first);
        std::iter::successors(Some(first), on)
    }

    /// How many triangles an edge has.
    ///
    /// # Panics
    /// If the edge is not in use.
    #[must_use]
    pub fn edge_triangles(&self, edge: EdgeId) -> usize {
        self.around_edge(edge).count()
    }

    /// Whether an edge has one triangle.
    ///
    /// # Panics
    /// If the edge is not in use.
    #[must_use]
    pub fn is_boundary(&self, edge: EdgeId) -> bool {
        self.edge_triangles(edge) == 1
    }

    /// The half-edges that begin at a vertex, one for each of its triangles. Nothing for a vertex not in use.
    ///
    /// # Panics
    /// If its id was never given out.
    pub fn star(&self, vertex: VertexId) -> impl Iterator<Item = HalfEdge> + '_ {
        let some = |h: HalfEdge| Some(h).filter(|&h| h != NO_HALF_EDGE);
        let first = some(self.vertices[vertex.index()].first);
        std::iter::successors(first, move |&h| some(self.links[h.0 as usize].next))
    }

    /// How many triangles a vertex has.
    ///
    /// # Panics
    /// If its id was never given out.
    #[must_use]
    pub fn vertex_triangles(&self, vertex: VertexId) -> usize {
        self.vertices[vertex.index()].triangles as usize
    }

    /// The edge between two vertices, if there is one. Costs as much as the smaller of their stars.
    ///
    /// # Panics
    /// If one of the ids was never given out.
    #[must_use]
    pub fn edge_between(&self, a: VertexId, b: VertexId) -> Option<EdgeId> {
        let (few, other) = if self.vertex_triangles(a) <= self.vertex_triangles(b) { (a, b) } else { (b, a) };
        self.star(few).find_map(|h| {
            if self.head(h) == other {
                Some(self.edge(h))
            } else if self.apex(h) == other {
                Some(self.edge(h.previous()))
            } else {
                None
            }
        })
    }

    /// The edges at a vertex, ascending, each once.
    ///
    /// # Panics
    /// If its id was never given out.
    #[must_use]
    pub fn edges_at(&self, vertex: VertexId) -> Vec<EdgeId> {
        let mut edges: Vec<EdgeId> =
            self.star(vertex).flat_map(|h| [self.edge(h), self.edge(h.previous())]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The end of an edge that is not the one given.
    pub(crate) fn other_end(&self, edge: EdgeId, end: VertexId) -> VertexId {
        let [a, b] = self.ends(edge);
        if a == end { b } else { a }
    }

    /// The ids that the next `count` new vertices will have.
    pub(crate) fn next_vertices(&self, count: usize) -> Vec<VertexId> {
        let reused = self.free_vertices.iter().rev().copied();
        let fresh = (self.vertices.len()..).map(VertexId::from_index);
        reused.chain(fresh).take(count).collect()
    }
}
