//! The connectivity of a list of triangles, in its canonical order.

use super::{EdgeSlot, HalfEdge, NO_EDGE, NO_HALF_EDGE, RadialConnectivity, SurfaceDefects, VertexSlot};
use welter_meshing::surface::{EdgeId, TriId, TriMesh, VertexId};

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
        let half_edges = 3 * triangles.len();
        let mut built = Self {
            triangles,
            edge_of: vec![NO_EDGE; half_edges],
            radial: vec![NO_HALF_EDGE; half_edges],
            star_next: vec![NO_HALF_EDGE; half_edges],
            star_previous: vec![NO_HALF_EDGE; half_edges],
            edges: Vec::with_capacity(half_edges / 2),
            vertices: vec![VertexSlot { first: NO_HALF_EDGE, triangles: 0 }; vertices],
            free_triangles: Vec::new(),
            free_edges: Vec::new(),
            free_vertices: Vec::new(),
        };
        // Each half-edge goes to the front of its list, so that lists ascend.
        for t in (0..built.triangles.len()).rev().map(TriId::from_index) {
            for k in (0..3).rev() {
                let v = built.triangles[t.index()][k];
                built.link_vertex(HalfEdge::of(t, k), v);
            }
        }
        let mut words: Vec<u64> = Vec::new();
        for low in (0..vertices).map(VertexId::from_index) {
            words.clear();
            for h in built.star(low) {
                for (side, high) in [(h, built.head(h)), (h.previous(), built.apex(h))] {
                    if high > low {
                        words.push(u64::from(high.0) << 32 | u64::from(side.0));
                    }
                }
            }
            words.sort_unstable();
            for group in words.chunk_by(|a, b| a >> 32 == b >> 32) {
                let ends = [low, VertexId((group[0] >> 32) as u32)];
                built.push_edge(ends, group);
            }
        }
        let unused = (0..vertices as u32).rev().map(VertexId);
        built.free_vertices = unused.filter(|v| built.vertices[v.index()].triangles == 0).collect();
        built
    }

    /// An edge with a cycle of half-edges (the lower halves of the words) in the order given.
    fn push_edge(&mut self, ends: [VertexId; 2], words: &[u64]) {
        let edge = EdgeId::from_index(self.edges.len());
        let half_edge = |i: usize| HalfEdge(words[i % words.len()] as u32);
        for i in 0..words.len() {
            self.edge_of[half_edge(i).0 as usize] = edge;
            self.radial[half_edge(i).0 as usize] = half_edge(i + 1);
        }
        self.edges.push(EdgeSlot { ends, first: half_edge(0) });
    }
}
