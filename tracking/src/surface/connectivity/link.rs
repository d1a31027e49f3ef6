//! Linking half-edges to their edges and vertices, and giving out ids.

use super::{EdgeSlot, HalfEdge, Links, NO_EDGE, NO_HALF_EDGE, NO_VERTEX, RadialConnectivity, VertexSlot};
use welter_meshing::surface::{EdgeId, TriId, VertexId};

impl RadialConnectivity {
    pub(super) fn link_edge(&mut self, half_edge: HalfEdge, edge: EdgeId) {
        let h = half_edge.0 as usize;
        self.links[h].edge = edge;
        let slot = &mut self.edges[edge.index()];
        if slot.first == NO_HALF_EDGE {
            slot.first = half_edge;
            self.links[h].radial = half_edge;
        } else {
            let first = slot.first.0 as usize;
            self.links[h].radial = self.links[first].radial;
            self.links[first].radial = half_edge;
        }
    }

    pub(super) fn unlink_edge(&mut self, half_edge: HalfEdge) {
        let h = half_edge.0 as usize;
        let slot = &mut self.edges[self.links[h].edge.index()];
        let next = self.links[h].radial;
        if next == half_edge {
            slot.first = NO_HALF_EDGE;
        } else {
            let mut previous = next;
            while self.links[previous.0 as usize].radial != half_edge {
                previous = self.links[previous.0 as usize].radial;
            }
            self.links[previous.0 as usize].radial = next;
            if slot.first == half_edge {
                slot.first = previous;
            }
        }
        self.links[h].radial = NO_HALF_EDGE;
        self.links[h].edge = NO_EDGE;
    }

    pub(super) fn link_vertex(&mut self, half_edge: HalfEdge, vertex: VertexId) {
        let h = half_edge.0 as usize;
        self.triangles[half_edge.triangle().index()][half_edge.side()] = vertex;
        let slot = &mut self.vertices[vertex.index()];
        self.links[h].previous = NO_HALF_EDGE;
        self.links[h].next = slot.first;
        if slot.first != NO_HALF_EDGE {
            self.links[slot.first.0 as usize].previous = half_edge;
        }
        slot.first = half_edge;
        slot.triangles += 1;
    }

    pub(super) fn unlink_vertex(&mut self, half_edge: HalfEdge) {
        let h = half_edge.0 as usize;
        let (previous, next) = (self.links[h].previous, self.links[h].next);
        let slot = &mut self.vertices[self.triangles[half_edge.triangle().index()][half_edge.side()].index()];
        slot.triangles -= 1;
        if previous == NO_HALF_EDGE {
            slot.first = next;
        } else {
            self.links[previous.0 as usize].next = next;
        }
        if next != NO_HALF_EDGE {
            self.links[next.0 as usize].previous = previous;
        }
        (self.links[h].previous, self.links[h].next) = (NO_HALF_EDGE, NO_HALF_EDGE);
        self.triangles[half_edge.triangle().index()][half_edge.side()] = NO_VERTEX;
    }

    pub(super) fn new_triangle(&mut self) -> TriId {
        self.free_triangles.pop().unwrap_or_else(|| {
            let id = TriId::from_index(self.triangles.len());
            self.triangles.push([NO_VERTEX; 3]);
            self.links.extend([Links::NONE; 3]);
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
