//! The unique edges of a mesh and the half-edges on each: [`EdgeTable`].
//!
//! A half-edge is one side of one triangle: half-edge `3 t + k` runs from corner `k` of triangle `t` to its next
//! corner. An edge is an unordered pair of vertices, written with the smaller one first; its half-edges run
//! *forward* (from the smaller to the larger vertex) or *backward*.
//!
//! Method: a counting sort of the half-edges by their smaller vertex, then a comparison sort of each (short) list
//! by the larger vertex and the half-edge. So edges ascend by their vertices, and the half-edges of an edge ascend.
//! Complexity: O(n + sum of d log d) for half-edge counts d of the vertices; 28 bytes a half-edge while it runs.

use super::{EdgeId, TriId, TriMesh, VertexId};

/// Half-edges sorted by edge.
#[derive(Clone, Debug)]
pub(crate) struct EdgeTable {
    /// The ends of each edge, the smaller first; ascending.
    pub(crate) edges: Vec<[VertexId; 2]>,
    /// The half-edges of edge `e` are `half_edges[offsets[e]..offsets[e + 1]]`.
    offsets: Vec<u32>,
    half_edges: Vec<u32>,
}

impl EdgeTable {
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let mut starts = vec![0u32; mesh.positions().len() + 1];
        for_each_half_edge(mesh, |_, low, _| starts[low + 1] += 1);
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        // Larger vertex and half-edge in one word: sorting words sorts by the former, then the latter.
        let mut words = vec![0u64; 3 * mesh.triangles().len()];
        let mut next = starts.clone();
        for_each_half_edge(mesh, |half_edge, low, high| {
            words[next[low] as usize] = u64::from(high) << 32 | u64::from(half_edge);
            next[low] += 1;
        });
        drop(next);

        // A closed surface has two half-edges an edge.
        let mut edges = Vec::with_capacity(words.len() / 2);
        let mut offsets = Vec::with_capacity(words.len() / 2 + 1);
        let mut half_edges = Vec::with_capacity(words.len());
        for (v, bounds) in starts.windows(2).enumerate() {
            let list = &mut words[bounds[0] as usize..bounds[1] as usize];
            list.sort_unstable();
            let mut last = None;
            for &word in &*list {
                let high = (word >> 32) as u32;
                if last != Some(high) {
                    last = Some(high);
                    edges.push([VertexId::from_index(v), VertexId(high)]);
                    offsets.push(half_edges.len() as u32);
                }
                half_edges.push(word as u32);
            }
        }
        offsets.push(half_edges.len() as u32);
        Self { edges, offsets, half_edges }
    }

    /// The half-edges of an edge, ascending.
    pub(crate) fn half_edges(&self, edge: EdgeId) -> &[u32] {
        let e = edge.index();
        &self.half_edges[self.offsets[e] as usize..self.offsets[e + 1] as usize]
    }

    /// How many half-edges of an edge run forward, and how many backward.
    pub(crate) fn directions(&self, mesh: &TriMesh, edge: EdgeId) -> [usize; 2] {
        let low = self.edges[edge.index()][0];
        let list = self.half_edges(edge);
        let forward = list.iter().filter(|&&h| tail(mesh, h) == low).count();
        [forward, list.len() - forward]
    }

    /// Every edge id, ascending.
    pub(crate) fn ids(&self) -> impl Iterator<Item = EdgeId> + use<> {
        (0..self.edges.len() as u32).map(EdgeId)
    }
}

/// Calls `f(half-edge, smaller vertex, larger vertex)` for each half-edge in ascending order.
fn for_each_half_edge(mesh: &TriMesh, mut f: impl FnMut(u32, usize, u32)) {
    let mut half_edge = 0;
    for &[a, b, c] in mesh.triangles() {
        for (tail, head) in [(a, b), (b, c), (c, a)] {
            f(half_edge, tail.min(head).index(), tail.max(head).0);
            half_edge += 1;
        }
    }
}

/// The triangle of a half-edge.
pub(crate) fn triangle(half_edge: u32) -> TriId {
    TriId(half_edge / 3)
}

/// The vertex where a half-edge begins.
pub(crate) fn tail(mesh: &TriMesh, half_edge: u32) -> VertexId {
    mesh.triangles()[half_edge as usize / 3][half_edge as usize % 3]
}

/// The half-edge that follows in the same triangle.
pub(crate) fn next(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}

/// The half-edge that precedes in the same triangle.
pub(crate) fn previous(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) { half_edge + 2 } else { half_edge - 1 }
}

/// The vertex of the half-edge's triangle that is not on the half-edge.
pub(crate) fn opposite(mesh: &TriMesh, half_edge: u32) -> VertexId {
    tail(mesh, previous(half_edge))
}
