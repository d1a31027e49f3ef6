//! The fans of triangles at each vertex: [`count`].

use super::union_find::UnionFind;
use crate::surface::TriMesh;
use crate::surface::edges::{self, EdgeTable};

/// How many fans each vertex has: 0 where it is unused, 1 where the surface is a manifold.
pub(super) fn count(mesh: &TriMesh, table: &EdgeTable) -> Vec<u32> {
    // Corner `3 t + k` has the number of the half-edge that begins there.
    let mut corners = UnionFind::new(3 * mesh.triangles().len());
    for edge in table.ids() {
        let [low, _] = table.edges[edge.index()];
        let corner_pair = |h: u32| {
            let (at_tail, at_head) = (h, edges::next(h));
            if edges::tail(mesh, h) == low { [at_tail, at_head] } else { [at_head, at_tail] }
        };
        let list = table.half_edges(edge);
        let [first_low, first_high] = corner_pair(list[0]);
        for &h in &list[1..] {
            let [at_low, at_high] = corner_pair(h);
            corners.unite(first_low, at_low);
            corners.unite(first_high, at_high);
        }
    }
    let mut fans = vec![0; mesh.positions().len()];
    for (t, triangle) in mesh.triangles().iter().enumerate() {
        for (k, v) in triangle.iter().enumerate() {
            let corner = (3 * t + k) as u32;
            fans[v.index()] += u32::from(corners.root(corner) == corner);
        }
    }
    fans
}
