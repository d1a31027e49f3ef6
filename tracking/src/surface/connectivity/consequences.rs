//! What a change would do beyond itself: [`Consequences`].

use super::change::{Change, PlannedChange, Side};
use super::{RadialConnectivity, fans};
use welter_meshing::surface::{TriId, VertexId};

/// What a change would do to the surface beyond itself; nothing of it is forbidden.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Consequences {
    /// Pairs of triangles that would cancel, by their ids before; `None` for a triangle that is only asked for.
    pub cancelled: Vec<[Option<TriId>; 2]>,
    /// Edges that would have more triangles than before, and more than two; the smaller end first.
    pub joined_edges: Vec<[VertexId; 2]>,
    /// Edges that would have one triangle and did not before.
    pub opened_edges: Vec<[VertexId; 2]>,
    /// Edges that have one triangle and would have two.
    pub closed_edges: Vec<[VertexId; 2]>,
    /// Vertices that would lose their last triangle.
    pub lost_vertices: Vec<VertexId>,
    /// Vertices that would have several fans, with the number of them, where they have fewer now.
    pub singular_vertices: Vec<(VertexId, usize)>,
}

impl RadialConnectivity {
    /// What a planned change would do beyond itself.
    pub(crate) fn consequences(&self, plan: &PlannedChange) -> Consequences {
        let mut result = Consequences { cancelled: plan.cancelled.clone(), ..Consequences::default() };
        for side in &plan.sides {
            let (before, after) = (Side::total(side.before), Side::total(side.after));
            if after > before && after > 2 {
                result.joined_edges.push(side.ends);
            }
            if after == 1 && before != 1 {
                result.opened_edges.push(side.ends);
            }
            if before == 1 && after == 2 {
                result.closed_edges.push(side.ends);
            }
        }
        let mut vertices: Vec<VertexId> = plan.sides.iter().flat_map(|side| side.ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for vertex in vertices {
            let after = self.fans_after(&plan.change, vertex);
            let known = self.has_vertex(vertex);
            if after == 0 && known {
                result.lost_vertices.push(vertex);
            }
            if after > 1 && after > if known { self.fans(vertex).len() } else { 0 } {
                result.singular_vertices.push((vertex, after));
            }
        }
        result
    }

    fn fans_after(&self, change: &Change, vertex: VertexId) -> usize {
        let star = (vertex.index() < self.vertex_slots()).then(|| self.star(vertex)).into_iter().flatten();
        let stay = star.filter(|h| !change.touches(h.triangle())).map(|h| [self.head(h), self.apex(h)]);
        let new = change.recorner.iter().map(|&(_, corners)| corners).chain(change.add.iter().copied());
        let come = new.filter_map(|[a, b, c]| match vertex {
            v if v == a => Some([b, c]),
            v if v == b => Some([c, a]),
            v if v == c => Some([a, b]),
            _ => None,
        });
        let corners: Vec<(usize, [VertexId; 2])> = stay.chain(come).enumerate().collect();
        fans::group(&corners).len()
    }
}
