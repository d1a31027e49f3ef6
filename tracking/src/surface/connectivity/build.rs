//! The connectivity of a list of triangles, in its canonical order.

use super::{
    EdgeSlot, HalfEdge, Links, NO_HALF_EDGE, NO_VERTEX, RadialConnectivity, SurfaceDefects, VertexSlot,
};
use welter_meshing::surface::{EdgeId, TriId, TriMesh, VertexId};

/// The ids that elements had before they were numbered anew, by their new ids.
#[derive(Clone, Debug)]
pub(crate) struct OldIds {
    pub(crate) vertices: Vec<VertexId>,
    /// With true where the edge had the opposite direction.
    pub(crate) edges: Vec<(EdgeId, bool)>,
    pub(crate) triangles: Vec<TriId>,
}

impl RadialConnectivity {
    /// The connectivity of a surface. Vertices without triangles keep their ids, as free ones.
    ///
    /// Edges are numbered and directed as in [`Topology::edges`](welter_meshing::surface::Topology::edges): from the
    /// smaller vertex to the larger, ascending.
    ///
    /// # Errors
    /// [`SurfaceDefects`] with every edge that is neither balanced nor a boundary, and all triangles that share
    /// their three corners.
    pub fn new(mesh: &TriMesh) -> Result<Self, SurfaceDefects> {
        let connectivity = Self::canonical(mesh.positions().len(), mesh.triangles().to_vec());
        let defects = SurfaceDefects::of(&connectivity);
        if defects.is_empty() { Ok(connectivity) } else { Err(defects) }
    }

    /// The links of triangles all of which are in use, admissible or not; a function of the arguments alone.
    pub(crate) fn canonical(vertices: usize, triangles: Vec<[VertexId; 3]>) -> Self {
        let mut built = Self {
            triangles,
            links: Vec::new(),
            edges: Vec::new(),
            vertices: Vec::new(),
            free_triangles: Vec::new(),
            free_edges: Vec::new(),
            free_vertices: Vec::new(),
        };
        built.link(vertices);
        built
    }

    /// Makes all links anew from the corners of the triangles, which are all in use.
    fn link(&mut self, vertices: usize) {
        self.links.clear();
        self.links.resize(3 * self.triangles.len(), Links::NONE);
        self.vertices.clear();
        self.vertices.resize(vertices, VertexSlot { first: NO_HALF_EDGE, triangles: 0 });
        // Each half-edge goes to the front of its list, so that lists ascend.
        for t in (0..self.triangles.len()).rev().map(TriId::from_index) {
            for k in (0..3).rev() {
                let v = self.triangles[t.index()][k];
                self.link_vertex(HalfEdge::of(t, k), v);
            }
        }
        self.edges = Vec::with_capacity(self.links.len() / 2);
        self.link_edges(vertices);
        self.free_triangles.clear();
        self.free_edges.clear();
        let unused = (0..vertices as u32).rev().map(VertexId);
        self.free_vertices = unused.filter(|v| self.vertices[v.index()].triangles == 0).collect();
    }

    /// Numbers vertices and triangles anew in their order, and makes all links anew. The memory of triangles and
    /// links is used again: fresh pages would cost more than the work.
    pub(crate) fn compact(&mut self) -> OldIds {
        let vertices: Vec<VertexId> = self.vertices().collect();
        let mut new = vec![NO_VERTEX; self.vertices.len()];
        for (i, v) in (0..).map(VertexId).zip(&vertices) {
            new[v.index()] = i;
        }
        let triangles: Vec<TriId> = self.triangles().collect();
        let mut edge_of = Vec::with_capacity(3 * triangles.len());
        for (i, &t) in triangles.iter().enumerate() {
            edge_of.extend((0..3).map(|k| self.edge(HalfEdge::of(t, k))));
            self.triangles[i] = self.corners(t).map(|v| new[v.index()]);
        }
        self.triangles.truncate(triangles.len());
        let before = std::mem::take(&mut self.edges);
        self.link(vertices.len());
        let old = |slot: &EdgeSlot| {
            let edge = edge_of[slot.first.0 as usize];
            (edge, new[before[edge.index()].ends[0].index()] != slot.ends[0])
        };
        let edges = self.edges.iter().map(old).collect();
        OldIds { vertices, edges, triangles }
    }

    /// Finds the edges: a counting sort of the half-edges by their smaller vertex, then a comparison sort of each short
    /// list by the larger vertex and the half-edge. Memory is passed in its order where that can be.
    fn link_edges(&mut self, vertices: usize) {
        let mut starts = vec![0_u32; vertices + 1];
        let ends = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
        let sides = |[a, b, c]: [VertexId; 3]| [[a, b], [b, c], [c, a]].map(ends);
        for [low, _] in self.triangles.iter().flat_map(|&corners| sides(corners)) {
            starts[low.index() + 1] += 1;
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut words = vec![0_u64; 3 * self.triangles.len()];
        let mut next = starts.clone();
        for (h, [low, high]) in (0_u32..).zip(self.triangles.iter().flat_map(|&corners| sides(corners))) {
            words[next[low.index()] as usize] = u64::from(high.0) << 32 | u64::from(h);
            next[low.index()] += 1;
        }
        for (low, bounds) in starts.windows(2).enumerate() {
            let list = &mut words[bounds[0] as usize..bounds[1] as usize];
            list.sort_unstable();
            for group in list.chunk_by(|a, b| a >> 32 == b >> 32) {
                let ends = [VertexId::from_index(low), VertexId((group[0] >> 32) as u32)];
                self.push_edge(ends, group);
            }
        }
    }

    /// An edge with a cycle of half-edges (the lower halves of the words) in the order given.
    fn push_edge(&mut self, ends: [VertexId; 2], words: &[u64]) {
        let edge = EdgeId::from_index(self.edges.len());
        let half_edge = |i: usize| HalfEdge(words[i % words.len()] as u32);
        for i in 0..words.len() {
            let links = &mut self.links[half_edge(i).0 as usize];
            (links.edge, links.radial) = (edge, half_edge(i + 1));
        }
        self.edges.push(EdgeSlot { ends, first: half_edge(0) });
    }
}
