//! Separation of a singular vertex: each of its fans gets a vertex of its own \[Brochu12, section 3.2.5, Figure 3.5\]
//! \[Gueziec01\].
//!
//! Values: the new vertices have those of the old one, and share by the number of their triangles. Edges take theirs
//! along.

use super::super::attributes::transfer::Entry;
use super::super::connectivity::Refusal;
use super::super::connectivity::change::Change;
use super::super::{EventKind, MovingSurface};
use super::{EdgeSource, Plan, renamed};
use welter_meshing::surface::{MAX_VERTICES, VertexId};

impl MovingSurface {
    /// Plans a new vertex, at the same place, for each fan of a vertex but the first (that of the smallest
    /// half-edge); `None` if it has only one.
    ///
    /// # Errors
    /// [`Refusal`] if the vertex is not in use, or ids are used up.
    pub fn plan_separation(&self, vertex: VertexId) -> Result<Option<Plan>, Refusal> {
        self.require_vertex(vertex)?;
        let mesh = &self.connectivity;
        let fans = mesh.fans(vertex);
        let Some((first, others)) = fans.split_first().filter(|(_, others)| !others.is_empty()) else {
            return Ok(None);
        };
        if mesh.vertex_slots() + others.len() > MAX_VERTICES {
            return Err(Refusal::TooLarge);
        }
        let births = mesh.next_vertices(others.len());
        let mut change = Change { births: births.clone(), ..Change::default() };
        for (&birth, fan) in births.iter().zip(others) {
            let moved = |t| (t, renamed(mesh.corners(t), vertex, birth));
            change.recorner.extend(fan.iter().map(|h| moved(h.triangle())));
        }
        let mut plan = self.plan(EventKind::Separate { vertex }, change)?;
        plan.positions.push((vertex, self.position(vertex)));
        let total = mesh.vertex_triangles(vertex) as f64;
        plan.vertices.push(Entry::new(vertex.0, vertex.0, 1.0, first.len() as f64 / total));
        for (&birth, fan) in births.iter().zip(others) {
            plan.positions.push((birth, self.position(vertex)));
            plan.vertices.push(Entry::new(birth.0, vertex.0, 1.0, fan.len() as f64 / total));
            let mut spokes: Vec<_> =
                fan.iter().flat_map(|&h| [mesh.edge(h), mesh.edge(h.previous())]).collect();
            spokes.sort_unstable();
            spokes.dedup();
            for source in spokes {
                let target = renamed(mesh.ends(source), vertex, birth);
                plan.edges.push(EdgeSource { target, source, interpolation: 1.0, share: 1.0 });
            }
        }
        Ok(Some(plan))
    }
}
