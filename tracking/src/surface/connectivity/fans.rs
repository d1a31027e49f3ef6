//! The fans of a vertex: its triangles, grouped by the edges at the vertex that they share.

use super::{HalfEdge, RadialConnectivity};
use welter_meshing::surface::VertexId;

/// Groups of corners at one vertex; each corner comes with the two other vertices of its triangle. A group is a
/// largest set linked through other vertices. Groups ascend by their first corner, and so do corners in a group.
///
/// Complexity: O(d log d) for d corners.
pub(crate) fn group<T: Copy + Ord>(corners: &[(T, [VertexId; 2])]) -> Vec<Vec<T>> {
    let mut spokes: Vec<(VertexId, usize)> =
        corners.iter().enumerate().flat_map(|(i, (_, others))| others.map(|v| (v, i))).collect();
    spokes.sort_unstable();
    let mut parent: Vec<usize> = (0..corners.len()).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for pair in spokes.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let (a, b) = (root(&mut parent, pair[0].1), root(&mut parent, pair[1].1));
        parent[a.max(b)] = a.min(b);
    }
    let mut grouped: Vec<(usize, T)> =
        (0..corners.len()).map(|i| (root(&mut parent, i), corners[i].0)).collect();
    grouped.sort_unstable();
    let mut groups: Vec<Vec<T>> = grouped
        .chunk_by(|a, b| a.0 == b.0)
        .map(|group| group.iter().map(|&(_, corner)| corner).collect())
        .collect();
    groups.sort_unstable();
    groups
}

impl RadialConnectivity {
    /// The fans of a vertex: its half-edges, grouped by the edges at the vertex that their triangles share. Each
    /// fan ascends, and fans ascend by their first half-edge. A vertex with several is singular.
    ///
    /// # Panics
    /// If the id was never given out.
    #[must_use]
    pub fn fans(&self, vertex: VertexId) -> Vec<Vec<HalfEdge>> {
        let corners: Vec<_> = self.star(vertex).map(|h| (h, [self.head(h), self.apex(h)])).collect();
        group(&corners)
    }
}
