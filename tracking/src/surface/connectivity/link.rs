//! Linking half-edges to their edges and vertices, and giving out ids.

use super::{EdgeSlot, HalfEdge, NO_EDGE, NO_HALF_EDGE, NO_VERTEX, RadialConnectivity, VertexSlot};
use welter_meshing::surface::{EdgeId, TriId, VertexId};

impl RadialConnectivity {
    pub(super) fn link_edge(&mut self, half_edge: HalfEdge, edge: EdgeId) {
        let h = half_edge.0 as usize;
        self.edge_of[h] = edge;
        let slot = &mut self.edges[edge.index()];
        if slot.first == NO_HALF_EDGE {
            slot.first = half_edge;
            self.radial[h] = half_edge;
        } else {
            let first = slot.first.0 as usize;
            self.radial[h] = self.radial[first];
            self.radial[first] = half_edge;
        }
    }

    pub(super) fn unlink_edge(&mut self, half_edge: HalfEdge) {
        let h = half_edge.0 as usize;
        let slot = &mut self.edges[self.edge_of[h].index()];
        let next = self.radial[h];
        if next == half_edge {
            slot.first = NO_HALF_EDGE;
        } else {
            let mut previous = next;
            while self.radial[previous.0 as usize] != half_edge {
                previous = self.radial[previous.0 as usize];
            }
            self.radial[previous.0 as usize] = next;
            if slot.first == half_edge {
                slot.first = previous;
            }
        }
        self.radial[h] = NO_HALF_EDGE;
        self.edge_of[h] = NO_EDGE;
    }

    pub(super) fn link_vertex(&mut self, half_edge: HalfEdge, vertex: VertexId) {
        let h = half_edge.0 as usize;
        self.triangles[half_edge.triangle().index()][half_edge.side()] = vertex;
        let slot = &mut self.vertices[vertex.index()];
        self.star_previous[h] = NO_HALF_EDGE;
        self.star_next[h] = slot.first;
        if slot.first != NO_HALF_EDGE {
            self.star_previous[slot.first.0 as usize] = half_edge;
        }
        slot.first = half_edge;
        slot.triangles += 1;
    }

    pub(super) fn unlink_vertex(&mut self, half_edge: HalfEdge) {
        let h = half_edge.0 as usize;
        let (previous, next) = (self.star_previous[h], self.star_next[h]);
        let slot = &mut self.vertices[self.triangles[half_edge.triangle().index()][half_edge.side()].index()];
        slot.triangles -= 1;
        if previous == NO_HALF_EDGE {
            slot.first = next;
        } else {
            self.star_next[previous.0 as usize] = next;
        }
        if next != NO_HALF_EDGE {
            self.star_previous[next.0 as usize] = previous;
        }
        (self.star_previous[h], self.star_next[h]) = (NO_HALF_EDGE, NO_HALF_EDGE);
        self.triangles[half_edge.triangle().index()][half_edge.side()] = NO_VERTEX;
    }

    pub(super) fn new_triangle(&mut self) -> TriId {
        self.free_triangles.pop().unwrap_or_else(|| {
            let id = TriId::from_index(self.triangles.len());
            self.triangles.push([NO_VERTEX; 3]);
            self.edge_of.extend([NO_EDGE; 3]);
            for links in [&mut self.radial, &mut self.star_next, &mut self.star_previous] {
                links.extend([NO_HALF_EDGE; 3]);
            }
            id
        })
    }

    pub(super) fn new_edge(&mut self, ends: [VertexId; 2]) -> EdgeId {
        let slot = EdgeSlot { ends, first: NO_HALF_EDGE };
        if let Some(id) = self.free_edges.pop() {
            self.edges[id.index()] = slot;
            return id;
        }
        self.edges.push(slot);
        EdgeId::from_index(self.edges.len() - 1)
    }

    pub(super) fn new_vertex(&mut self) -> VertexId {
        self.free_vertices.pop().unwrap_or_else(|| {
            self.vertices.push(VertexSlot { first: NO_HALF_EDGE, triangles: 0 });
            VertexId::from_index(self.vertices.len() - 1)
        })
    }
}
