//! Cuts along a ring of three edges that bounds no triangle: two surfaces, each closed by a triangle \[Wojtan10\].
//!
//! ```text
//!     \  |  /            \  |  /
//!      a-b-c      ->      a-b-c   closed by a triangle
//!     /  |  \
//!                         a'b'c'  closed by a triangle
//!                        /  |  \
//! ```
//! Values: the new vertices have those of the old ones, and share by the number of their triangles. Edges that move take theirs
//! along; those of the ring share with their copies equally. The two closing triangles begin with zero.

use super::super::attributes::transfer::Entry;
use super::super::connectivity::Refusal;
use super::super::connectivity::change::Change;
use super::super::{EventKind, HalfEdge, MovingSurface};
use super::{EdgeSource, Plan};
use welter_meshing::surface::{MAX_TRIANGLES, MAX_VERTICES, TriId, VertexId};

impl MovingSurface {
    /// Plans the cut along the edges `ring[0] ring[1]`, `ring[1] ring[2]`, `ring[2] ring[0]`, each of which has two
    /// triangles. The part to the left, whose triangles run along the ring in this order, gets new vertices at the same places.
    ///
    /// # Errors
    /// [`Refusal`] if there is no such ring, the ring does not part the triangles at one of its vertices in two, or ids are
    /// used up.
    pub fn plan_cut(&self, ring: [VertexId; 3]) -> Result<Plan, Refusal> {
        ring.iter().try_for_each(|&v| self.require_vertex(v))?;
        let mesh = &self.connectivity;
        let [a, b, c] = ring;
        let refusal = Refusal::Corners { corners: ring };
        // A triangle on the ring would have nothing behind it.
        let on_ring = |h: HalfEdge| ring.contains(&mesh.head(h)) && ring.contains(&mesh.apex(h));
        if a == b || b == c || c == a || mesh.star(a).any(on_ring) {
            return Err(refusal);
        }
        let mut left: Vec<TriId> = Vec::new();
        for [from, to, before] in [[a, b, c], [b, c, a], [c, a, b]] {
            left.extend(self.left_arc(from, to, before).ok_or(refusal)?);
        }
        left.sort_unstable();
        left.dedup();
        if mesh.vertex_slots() + 3 > MAX_VERTICES || mesh.triangle_slots() + 2 > MAX_TRIANGLES {
            return Err(Refusal::TooLarge);
        }
        let births = mesh.next_vertices(3);
        let copy = |v: VertexId| ring.iter().position(|&r| r == v).map_or(v, |i| births[i]);
        let mut change = Change { births: births.clone(), ..Change::default() };
        change.recorner.extend(left.iter().map(|&t| (t, mesh.corners(t).map(copy))));
        change.add.extend([ring, [births[0], births[2], births[1]]]);
        let copies = [births[0], births[1], births[2]];
        let mut plan = self.plan(EventKind::Cut { ring, copies }, change)?;
        for (&v, &birth) in ring.iter().zip(&births) {
            let moved = left.iter().filter(|&&t| mesh.corners(t).contains(&v)).count();
            let share = moved as f64 / mesh.vertex_triangles(v) as f64;
            plan.positions.extend([(v, self.position(v)), (birth, self.position(v))]);
            plan.vertices.push(Entry::new(v.0, v.0, 1.0, 1.0 - share));
            plan.vertices.push(Entry::new(birth.0, v.0, 1.0, share));
        }
        let mut spokes: Vec<_> = left
            .iter()
            .flat_map(|&t| (0..3).map(move |k| HalfEdge::of(t, k)))
            .map(|h| mesh.edge(h))
            .collect();
        spokes.sort_unstable();
        spokes.dedup();
        for source in spokes {
            let ends = mesh.ends(source);
            let target = ends.map(copy);
            if target == ends {
                continue;
            }
            let on_ring = ends.iter().all(|v| ring.contains(v));
            let share = if on_ring { 0.5 } else { 1.0 };
            if on_ring {
                plan.edges.push(EdgeSource { target: ends, source, interpolation: 1.0, share });
            }
            plan.edges.push(EdgeSource { target, source, interpolation: 1.0, share });
        }
        Ok(plan)
    }

    /// The triangles at `from` to the left of the way `before`, `from`, `to`; none if they are not in one fan between
    /// the two edges, of two triangles each.
    fn left_arc(&self, from: VertexId, to: VertexId, before: VertexId) -> Option<Vec<TriId>> {
        let mesh = &self.connectivity;
        let start = mesh.star(from).find(|&h| mesh.head(h) == to)?;
        let two = |h: HalfEdge| {
            let mut around = mesh.around_edge(mesh.edge(h));
            let sides = [around.next()?, around.next()?];
            around.next().is_none().then(|| if sides[0] == h { sides[1] } else { sides[0] })
        };
        two(start)?;
        let mut arc = Vec::new();
        let mut h = start;
        loop {
            arc.push(h.triangle());
            let back = h.previous();
            let beyond = two(back)?;
            if mesh.tail(back) == before {
                break;
            }
            if mesh.tail(beyond) != from || beyond == start {
                return None;
            }
            h = beyond;
        }
        // Something is to be left on the other side.
        (arc.len() < mesh.vertex_triangles(from)).then_some(arc)
    }
}
