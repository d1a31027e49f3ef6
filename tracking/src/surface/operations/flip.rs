//! Edge flip \[Brochu12, section 3.2.4, Figure 3.2\], between any two opposite triangles of an edge.
//!
//! ```text
//!        c                  c
//!      /   \              / | \
//!     a --- b     ->     a  |  b
//!      \   /              \ | /
//!        d                  d
//! ```
//! Values: the two triangles get the mean, and half the sum, of their old values. The new edge takes over the value of
//! the old one; where there are more triangles, the old edge keeps its value and the new one copies it without a
//! share. Where there is an edge between `c` and `d` already, it keeps its value, and takes over the sum.

use super::super::connectivity::change::Change;
use super::super::connectivity::{HalfEdge, Refusal};
use super::super::{EventKind, MovingSurface};
use super::{EdgeSource, Plan, TriangleSource, TriangleTarget};

impl MovingSurface {
    /// Plans the flip of the edge between two triangles, given by their half-edges on it, which must run in opposite
    /// directions. The triangle at the first half-edge keeps its tail, the other its head. Triangles that exist
    /// already with the new corners cancel.
    ///
    /// # Errors
    /// [`Refusal`] if the half-edges are not opposite, or the surface would not be admissible.
    pub fn plan_flip(&self, half_edges: [HalfEdge; 2]) -> Result<Plan, Refusal> {
        let mesh = &self.connectivity;
        half_edges.iter().try_for_each(|h| self.require_triangle(h.triangle()))?;
        let [h, o] = half_edges;
        if mesh.edge(h) != mesh.edge(o) || mesh.tail(h) != mesh.head(o) {
            return Err(Refusal::NotOpposite { half_edges });
        }
        let [a, b, c, d] = [mesh.tail(h), mesh.head(h), mesh.apex(h), mesh.apex(o)];
        let (s, t) = (h.triangle(), o.triangle());
        let recorner = vec![(s, [c, a, d]), (t, [d, b, c])];
        let edge = mesh.edge(h);
        let change = Change { recorner, ..Change::default() };
        let mut plan = self.plan(EventKind::Flip { ends: [a, b], apexes: [c, d] }, change)?;
        for target in [s, t] {
            for source in [s, t] {
                let target = TriangleTarget::Old(target);
                plan.triangles.push(TriangleSource { target, source, interpolation: 0.5, share: 0.5 });
            }
        }
        let target = if mesh.ends(edge) == [a, b] { [c, d] } else { [d, c] };
        let interpolation = if mesh.edge_between(c, d).is_some() { 0.0 } else { 1.0 };
        let share = if mesh.edge_triangles(edge) == 2 { 1.0 } else { 0.0 };
        plan.edges.push(EdgeSource { target, source: edge, interpolation, share });
        Ok(plan)
    }
}
