//! The boundary of a surface as chains of edges: [`BoundaryLoop`].
//!
//! Method: at each end of a boundary edge, turn about the vertex from triangle to triangle until the other boundary
//! edge of the same fan is reached; so a vertex where several loops meet does not mix them.

use crate::surface::edges::{self, EdgeTable};
use crate::surface::{EdgeId, TriMesh, VertexId};

/// A chain of edges that have one triangle each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundaryLoop {
    /// Its vertices in order. A loop begins at its smallest edge and runs as the triangle on it does, the surface
    /// to the left; the first vertex is not repeated. A chain has one vertex more than edges.
    pub vertices: Vec<VertexId>,
    /// Its edges: edge `i` joins vertex `i` to the next.
    pub edges: Vec<EdgeId>,
    /// True for a loop. False for a chain that ends where a fan meets an edge of three or more triangles.
    pub closed: bool,
}

/// One end of a boundary edge: its place in the list of those, and whether it is the head of the half-edge.
type End = (usize, bool);

/// The edges of the boundary, ascending, and what it takes to walk along them.
struct Boundary<'a> {
    mesh: &'a TriMesh,
    table: &'a EdgeTable,
    triangle_edges: &'a [[EdgeId; 3]],
    edges: Vec<EdgeId>,
}

/// The loops and chains, ordered by their smallest edges.
pub(super) fn loops(mesh: &TriMesh, table: &EdgeTable, triangle_edges: &[[EdgeId; 3]]) -> Vec<BoundaryLoop> {
    let edges = table.ids().filter(|&e| table.half_edges(e).len() == 1).collect();
    let boundary = Boundary { mesh, table, triangle_edges, edges };
    let mut used = vec![false; boundary.edges.len()];
    let mut loops = Vec::new();
    // Chains first, from their ends; what is left comes round.
    let ends = [false, true].into_iter().flat_map(|head| (0..used.len()).map(move |i| (i, head)));
    let starts: Vec<End> = ends.filter(|&end| boundary.across(end).is_none()).collect();
    for start in starts.into_iter().chain((0..used.len()).map(|i| (i, false))) {
        if !used[start.0] {
            loops.push(boundary.walk(start, &mut used));
        }
    }
    loops.sort_by_key(|l| l.edges.iter().copied().min());
    loops
}

impl Boundary<'_> {
    fn vertex(&self, (i, head): End) -> VertexId {
        let h = self.half_edge(i);
        edges::tail(self.mesh, if head { edges::next(h) } else { h })
    }

    fn half_edge(&self, i: usize) -> u32 {
        self.table.half_edges(self.edges[i])[0]
    }

    /// The end on the other side of the fan at an end.
    fn across(&self, end: End) -> Option<End> {
        let v = self.vertex(end);
        let mut h = self.half_edge(end.0);
        loop {
            let other = if edges::tail(self.mesh, h) == v { edges::previous(h) } else { edges::next(h) };
            let edge = self.triangle_edges[other as usize / 3][other as usize % 3];
            match *self.table.half_edges(edge) {
                [_] => {
                    let i =
                        self.edges.binary_search(&edge).expect("the list holds every edge with one triangle");
                    return Some((i, edges::tail(self.mesh, other) != v));
                }
                [a, b] => h = if a == other { b } else { a },
                _ => return None,
            }
        }
    }

    /// Walks from one end of an edge through that edge, and on until the chain ends or comes round.
    fn walk(&self, start: End, used: &mut [bool]) -> BoundaryLoop {
        let mut chain = BoundaryLoop { vertices: Vec::new(), edges: Vec::new(), closed: false };
        let mut end = start;
        loop {
            used[end.0] = true;
            chain.vertices.push(self.vertex(end));
            chain.edges.push(self.edges[end.0]);
            let leaving = (end.0, !end.1);
            match self.across(leaving) {
                None => {
                    chain.vertices.push(self.vertex(leaving));
                    return chain;
                }
                Some(next) if next == start => {
                    chain.closed = true;
                    return chain;
                }
                Some(next) => end = next,
            }
        }
    }
}
