//! Edge split \[Brochu12, section 3.2.4, Figure 3.1\], of edges with any number of triangles.
//!
//! ```text
//!        c                  c
//!      /   \              / | \
//!     a --- b     ->     a--m--b      and so for every other triangle of the edge
//! ```
//! Values: the vertex is a mean of the ends. An edge shares its value by length, a triangle by area. A vertex shares
//! as if it had a third of the area of each of its triangles, all alike: from end `a` of `n` triangles, `k` of them on
//! the edge, goes `k (1 - fraction) / n`. The edge to `c` is a mean of the edges from the ends to `c`.

use super::super::attributes::transfer::Entry;
use super::super::connectivity::Refusal;
use super::super::connectivity::change::Change;
use super::super::{EventKind, MovingSurface};
use super::{EdgeSource, Plan, TriangleSource, TriangleTarget, renamed};
use welter_meshing::surface::{EdgeId, MAX_TRIANGLES};

impl MovingSurface {
    /// Plans a new vertex on an edge, at a fraction of the way from its first end to its second. Each triangle
    /// of the edge keeps its part at the first end; that at the second is a new triangle.
    ///
    /// # Errors
    /// [`Refusal`] if the edge is not in use, the fraction is not strictly between 0 and 1, or ids are used up.
    pub fn plan_split(&self, edge: EdgeId, fraction: f64) -> Result<Plan, Refusal> {
        self.require_edge(edge)?;
        if !(fraction > 0.0 && fraction < 1.0) {
            return Err(Refusal::Fraction { value: fraction, range: "above 0 and below 1" });
        }
        let mesh = &self.connectivity;
        let [a, b] = mesh.ends(edge);
        let m = mesh.next_vertices(1)[0];
        let mut change = Change { births: vec![m], ..Change::default() };
        let mut apexes = Vec::new();
        for h in mesh.around_edge(edge) {
            let corners = mesh.corners(h.triangle());
            change.recorner.push((h.triangle(), renamed(corners, b, m)));
            change.add.push(renamed(corners, a, m));
            apexes.push((mesh.apex(h), h));
        }
        let triangles = change.add.len();
        if mesh.triangle_slots() + triangles > MAX_TRIANGLES {
            return Err(Refusal::TooLarge);
        }
        let on_edge: Vec<_> = change.recorner.iter().map(|&(t, _)| t).collect();
        let mut plan = self.plan(EventKind::Split { ends: [a, b], vertex: m, fraction }, change)?;
        plan.positions.push((m, self.between(a, b, fraction)));

        let given = |v, part: f64| triangles as f64 * part / mesh.vertex_triangles(v) as f64;
        for (end, weight) in [(a, 1.0 - fraction), (b, fraction)] {
            let share = given(end, weight);
            plan.vertices.push(Entry::new(end.0, end.0, 1.0, 1.0 - share));
            plan.vertices.push(Entry::new(m.0, end.0, weight, share));
        }
        for (i, &t) in on_edge.iter().enumerate() {
            for (target, share) in
                [(TriangleTarget::Old(t), fraction), (TriangleTarget::New(i), 1.0 - fraction)]
            {
                plan.triangles.push(TriangleSource { target, source: t, interpolation: 1.0, share });
            }
        }
        for (target, share) in [([a, m], fraction), ([m, b], 1.0 - fraction)] {
            plan.edges.push(EdgeSource { target, source: edge, interpolation: 1.0, share });
        }
        for (_, h) in apexes {
            let at_tail = mesh.edge(h.previous());
            let at_head = mesh.edge(h.next());
            let [at_a, at_b] = if mesh.tail(h) == a { [at_tail, at_head] } else { [at_head, at_tail] };
            for (source, end, interpolation) in [(at_a, a, 1.0 - fraction), (at_b, b, fraction)] {
                let target = renamed(mesh.ends(source), end, m);
                plan.edges.push(EdgeSource { target, source, interpolation, share: 0.0 });
            }
        }
        Ok(plan)
    }
}
