//! What happened to a surface, in order: [`EventLog`].
//!
//! Promise: the log tells the whole history of connectivity. Who knows the triangles at its beginning and applies
//! the changes of each event in order knows them at its end, ids included; [`EventKind::Compact`] is the one event
//! that lists no changes, for it keeps the order of all elements ([`Renumbering`](super::Renumbering)).

use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// Which operation it was.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EventKind {
    /// A vertex was put on an edge.
    Split {
        /// The ends of the edge before.
        ends: [VertexId; 2],
        /// The new vertex.
        vertex: VertexId,
        /// How far from the first end to the second it was put.
        fraction: f64,
    },
    /// The common edge of two triangles was replaced by that between their apexes.
    Flip {
        /// The ends of the edge before.
        ends: [VertexId; 2],
        /// The ends of the edge afterwards.
        apexes: [VertexId; 2],
    },
    /// An edge became a vertex.
    Collapse {
        /// The end that remains, unless all of its triangles cancelled.
        kept: VertexId,
        /// The end that went.
        removed: VertexId,
        /// How far from the first to the second the vertex moved.
        fraction: f64,
    },
    /// Triangles were replaced by others, as when two surfaces merge.
    Replace,
    /// The fans of a vertex got a vertex each.
    Separate {
        /// The vertex, which the first fan keeps; the others got the new vertices.
        vertex: VertexId,
    },
    /// A surface was cut along three edges, and closed on both sides.
    Cut {
        /// The vertices of the ring, which one side keeps.
        ring: [VertexId; 3],
        /// Those that the other side got in their place.
        copies: [VertexId; 3],
    },
    /// A mesh was added beside the surface.
    Append,
    /// The surface became that of its union with a shape.
    Unite,
    /// All elements were numbered anew, without gaps.
    Compact,
}

/// A vertex that came or went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexChange {
    /// Which vertex.
    pub vertex: VertexId,
    /// Whether it is new; else it went.
    pub born: bool,
}

/// An edge that came or went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeChange {
    /// Which edge.
    pub edge: EdgeId,
    /// Its ends, in the order of its direction.
    pub ends: [VertexId; 2],
    /// Whether it is new; else it went.
    pub born: bool,
}

/// A triangle that came, went or got other corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleChange {
    /// Which triangle.
    pub triangle: TriId,
    /// Its corners before; `None` for a new one.
    pub before: Option<[VertexId; 3]>,
    /// Its corners afterwards; `None` for one that went.
    pub after: Option<[VertexId; 3]>,
}

/// One event, with everything that it changed. Edges and vertices that are not listed keep their ids and their ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<'a> {
    /// Which operation it was.
    pub kind: EventKind,
    /// Vertices that came, in the order of the operation; then those that went, ascending.
    pub vertices: &'a [VertexChange],
    /// Edges that went or came, by their ends.
    pub edges: &'a [EdgeChange],
    /// Triangles.
    pub triangles: &'a [TriangleChange],
}

/// A list of events.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventLog {
    /// Each with the ends of its parts of the lists below.
    kinds: Vec<(EventKind, [usize; 3])>,
    vertices: Vec<VertexChange>,
    edges: Vec<EdgeChange>,
    triangles: Vec<TriangleChange>,
}

impl EventLog {
    /// How many events there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// Whether nothing happened.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }

    /// The event of a place, from the first on.
    #[must_use]
    pub fn get(&self, i: usize) -> Option<Event<'_>> {
        let &(kind, [vertices, edges, triangles]) = self.kinds.get(i)?;
        let [v, e, t] = i.checked_sub(1).map_or([0; 3], |before| self.kinds[before].1);
        Some(Event {
            kind,
            vertices: &self.vertices[v..vertices],
            edges: &self.edges[e..edges],
            triangles: &self.triangles[t..triangles],
        })
    }

    /// Adds the events of another log at the end.
    pub fn append(&mut self, other: &Self) {
        let [v, e, t] = [self.vertices.len(), self.edges.len(), self.triangles.len()];
        let moved = |&(kind, [i, j, k]): &(EventKind, [usize; 3])| (kind, [i + v, j + e, k + t]);
        self.kinds.extend(other.kinds.iter().map(moved));
        self.vertices.extend(&other.vertices);
        self.edges.extend(&other.edges);
        self.triangles.extend(&other.triangles);
    }

    /// All events in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Event<'_>> {
        (0..self.len()).map(|i| self.get(i).expect("an event of the list"))
    }

    pub(crate) fn push(
        &mut self,
        kind: EventKind,
        vertices: impl IntoIterator<Item = VertexChange>,
        edges: impl IntoIterator<Item = EdgeChange>,
        triangles: impl IntoIterator<Item = TriangleChange>,
    ) {
        self.vertices.extend(vertices);
        self.edges.extend(edges);
        self.triangles.extend(triangles);
        self.kinds.push((kind, [self.vertices.len(), self.edges.len(), self.triangles.len()]));
    }
}
