//! Edge collapse \[Brochu12, section 3.2.4, Figure 3.3\], of edges with any number of triangles.
//!
//! The triangles of the edge go; those of the removed end get the kept end instead. Edges from both ends to one
//! vertex become one edge. That joins sheets where the two edges were sides of no common triangle, as on a ring of
//! three edges: [`Consequences`](super::super::Consequences) tells (the link condition \[Dey99\] is that there are
//! none but the vertex that is meant to go).
//!
//! Values: the kept vertex gets the mean, and the sum, of both; so does an edge that two edges become. Triangles and the
//! edge that go leave theirs to their neighbours.

use super::super::attributes::transfer::Entry;
use super::super::connectivity::Refusal;
use super::super::connectivity::change::Change;
use super::super::{EventKind, MovingSurface};
use super::{EdgeSource, Plan, renamed};
use welter_meshing::surface::{EdgeId, VertexId};

impl MovingSurface {
    /// Plans the collapse of an edge to one of its ends, which is put at a fraction of the way to the other end.
    /// Triangles that would be on top of each other, with opposite orientation, cancel.
    ///
    /// # Errors
    /// [`Refusal`] if `kept` is no end of the edge, the fraction is not between 0 and 1, or the surface would not be
    /// admissible.
    pub fn plan_collapse(&self, edge: EdgeId, kept: VertexId, fraction: f64) -> Result<Plan, Refusal> {
        self.require_edge(edge)?;
        let mesh = &self.connectivity;
        if !mesh.ends(edge).contains(&kept) {
            return Err(Refusal::NotInUse { element: "vertex", id: kept.0 });
        }
        if !(0.0..=1.0).contains(&fraction) {
            return Err(Refusal::Fraction { value: fraction, range: "from 0 to 1" });
        }
        let removed = mesh.other_end(edge, kept);
        let mut change = Change::default();
        for h in mesh.star(removed) {
            let corners = mesh.corners(h.triangle());
            if corners.contains(&kept) {
                change.remove.push(h.triangle());
            } else {
                change.recorner.push((h.triangle(), renamed(corners, removed, kept)));
            }
        }
        let mut plan = self.plan(EventKind::Collapse { kept, removed, fraction }, change)?;
        plan.positions.push((kept, self.between(kept, removed, fraction)));
        plan.vertices.push(Entry::new(kept.0, kept.0, 1.0 - fraction, 1.0));
        plan.vertices.push(Entry::new(kept.0, removed.0, fraction, 1.0));
        for spoke in mesh.edges_at(removed).into_iter().filter(|&spoke| spoke != edge) {
            let far = mesh.other_end(spoke, removed);
            let target = renamed(mesh.ends(spoke), removed, kept);
            let between =
                plan.change.sides.binary_search_by_key(&[kept.min(far), kept.max(far)], |side| side.ends);
            let twin = between.ok().and_then(|i| plan.change.sides[i].edge);
            if let Some(twin) = twin {
                let interpolation = 1.0 - fraction;
                let ends = mesh.ends(twin);
                plan.edges.push(EdgeSource { target: ends, source: twin, interpolation, share: 1.0 });
            }
            let interpolation = if twin.is_some() { fraction } else { 1.0 };
            plan.edges.push(EdgeSource { target, source: spoke, interpolation, share: 1.0 });
        }
        Ok(plan)
    }
}
