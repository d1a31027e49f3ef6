//! Where surfaces part \[Brochu12, section 3.2.5\]: singular vertices, and rings of three edges.
//!
//! Singular vertices: each fan but the first gets a vertex of its own, pulled towards its neighbours. Rules and fallbacks are
//! alike: how far the parts go is a ladder of distances, and where none is admitted the surface is left as it is, until
//! something around it has changed.
//!
//! Rings of three edges that bound no triangle are cut where an edge of theirs would collapse \[Wojtan10\]: both parts are
//! closed by a triangle, so that no edge with more than two triangles comes about. Where one side is but a small tip, it is replaced
//! by a triangle, which is no change of topology.

use super::embedding::Replacement;
use super::parting::{Cut, SHIFTS, Shifted};
use super::workpiece::Workpiece;
use crate::surface::{HalfEdge, Plan};
use glam::DVec3;
use welter_meshing::surface::{TriId, VertexId};

/// The most triangles of a tip: a few rings of neighbours around its vertex.
const MOST_OF_A_TIP: usize = 32;

impl Workpiece<'_> {
    /// Separates all singular vertices.
    pub(crate) fn separate_singular_vertices(&mut self) {
        for v in (0..self.surface.connectivity().vertex_slots() as u32).map(VertexId) {
            if !self.has_one_fan(v) {
                self.separate(v);
            }
        }
    }

    /// Whether a walk around a vertex surely passes all of its triangles; vertices not in use have none.
    fn has_one_fan(&self, v: VertexId) -> bool {
        let mesh = self.surface.connectivity();
        let Some(start) = mesh.star(v).next() else { return true };
        let (mut h, mut passed) = (start, 0);
        loop {
            passed += 1;
            let back = h.previous();
            let Some([s, t]) = self.two_sides(mesh.edge(back)) else { break };
            h = if s == back { t } else { s };
            if h == start {
                break;
            }
        }
        passed == mesh.vertex_triangles(v) || mesh.fans(v).len() == 1
    }

    fn separate(&mut self, v: VertexId) {
        let Ok(Some(plan)) = self.surface.plan_separation(v) else {
            self.report.refused.topology += 1;
            return;
        };
        let mesh = self.surface.connectivity();
        let here = self.at(v);
        let births: Vec<VertexId> = plan.positions().iter().map(|&(w, _)| w).filter(|&w| w != v).collect();
        // The way of each fan: to the mean of its neighbours.
        let moves = |t| plan.changed().iter().any(|&(changed, _)| changed == t);
        let stay = mesh.star(v).filter(|h| !moves(h.triangle())).flat_map(|h| [mesh.head(h), mesh.apex(h)]);
        let mut ways = vec![(v, mean(stay.map(|w| self.at(w) - here)))];
        for &birth in &births {
            let own = plan.changed().iter().filter(|(_, corners)| corners.contains(&birth));
            let others = own.flat_map(|(_, corners)| *corners).filter(|&w| w != birth);
            ways.push((birth, mean(others.map(|w| self.at(w) - here))));
        }
        if self.immovable(v) {
            ways[0].1 = DVec3::ZERO;
        }
        // All but the first fan move, or all but the last, or all of them.
        let last = ways.len() - 1;
        let sets = [1..=last, 0..=last - 1, 0..=last];
        for (shift, set) in
            SHIFTS.into_iter().flat_map(|shift| sets.iter().map(move |set| (shift, set.clone())))
        {
            let mut plan = plan.clone();
            let mut shifted: Vec<Shifted> = ways.iter().map(|&(w, _)| (w, [here; 2])).collect();
            for i in set {
                shifted[i].1[1] = here + shift * ways[i].1;
            }
            if shifted.iter().any(|&(w, [_, place])| plan.place(w, place).is_err())
                || !self.may_part(&plan, &shifted, None)
            {
                continue;
            }
            let mut touched: Vec<_> = plan.changed().iter().map(|&(t, _)| t).collect();
            touched.extend(self.surface.connectivity().star(v).map(|h| h.triangle()));
            self.surface.apply(plan);
            self.follow_triangles(touched.into_iter());
            births.iter().for_each(|&birth| self.sizing.copied(birth, v));
            self.report.separations += 1;
            return;
        }
        self.report.refused.intersection += 1;
    }

    /// Replaces a small patch that a ring of three edges bounds by one triangle: a tip, whose topology is that of a disc. Whether
    /// it did.
    pub(crate) fn cap_tip(&mut self, [a, b, c]: [VertexId; 3]) -> bool {
        for ring in [[a, b, c], [a, c, b]] {
            let Some(patch) = self.patch_to_the_left(ring) else { continue };
            let Ok(plan) = self.surface.plan_replacement(&patch, &[ring]) else { continue };
            let tip = self.at(a);
            let replacement = Replacement::new(self.surface, &plan);
            let after = replacement.places(self.surface);
            if after.len() != 1
                || replacement.old.len() != patch.len()
                || !self.keeps_normals(&replacement.before, &after)
                || !self.small_volume(&replacement.before, tip, self.parameters.max_volume_change_rel)
                || !self.keeps_embedded(&replacement, tip)
            {
                continue;
            }
            self.carry_out(plan, &replacement);
            self.report.collapses += 1;
            return true;
        }
        false
    }

    /// The triangles to the left of a ring, if they are few and form a disc of which no vertex is immovable.
    fn patch_to_the_left(&self, ring: [VertexId; 3]) -> Option<Vec<TriId>> {
        let mesh = self.surface.connectivity();
        let way = |h: HalfEdge| [mesh.tail(h), mesh.head(h)];
        let on_ring = |[p, q]: [VertexId; 2]| (0..3).any(|k| [ring[k], ring[(k + 1) % 3]] == [p, q]);
        let start = mesh.star(ring[0]).find(|&h| mesh.head(h) == ring[1])?;
        let mut patch = vec![start.triangle()];
        let (mut next, mut sides) = (0, 0);
        while let Some(&t) = patch.get(next) {
            next += 1;
            for h in (0..3).map(|k| HalfEdge::of(t, k)) {
                if on_ring(way(h)) {
                    sides += 1;
                    continue;
                }
                let [p, q] = self.two_sides(mesh.edge(h))?;
                let beyond = if p == h { q } else { p };
                let [tail, head] = way(beyond);
                if on_ring([head, tail]) || tail == mesh.tail(h) {
                    return None;
                }
                if !patch.contains(&beyond.triangle()) {
                    patch.push(beyond.triangle());
                }
            }
            if patch.len() > MOST_OF_A_TIP {
                return None;
            }
        }
        let mut vertices: Vec<VertexId> = patch.iter().flat_map(|&t| mesh.corners(t)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        // A disc has Euler characteristic 1; three edges are on the ring, the others have two triangles.
        let edges = (3 * patch.len() + 3) / 2;
        let euler = vertices.len() as i64 - edges as i64 + patch.len() as i64;
        let inner = |v: &VertexId| !ring.contains(v);
        let whole = vertices
            .iter()
            .filter(|v| inner(v))
            .all(|&v| mesh.star(v).all(|h| patch.contains(&h.triangle())) && !self.immovable(v));
        (sides == 3 && euler == 1 && whole && patch.len() > 1).then_some(patch)
    }

    /// What is beside the edges of a ring that a plan cuts.
    fn cut(&self, ring: [VertexId; 3], births: &[VertexId], plan: &Plan) -> Option<Cut> {
        let mesh = self.surface.connectivity();
        let &[a, b, c] = births else { return None };
        let moves = |t| plan.changed().iter().any(|&(changed, _)| changed == t);
        let beside = |k: usize, moved: bool| {
            let edge = mesh.edge_between(ring[k], ring[(k + 1) % 3])?;
            let mut sides = mesh.around_edge(edge).filter(|h| moves(h.triangle()) == moved);
            Some(self.at(mesh.apex(sides.next()?)))
        };
        let mut apexes = [[DVec3::ZERO; 2]; 3];
        for (k, apexes) in apexes.iter_mut().enumerate() {
            *apexes = [beside(k, false)?, beside(k, true)?];
        }
        Some(Cut { ring, copies: [a, b, c], places: ring.map(|v| self.at(v)), apexes })
    }

    /// Cuts the surface along a ring of three edges. Whether it did.
    pub(crate) fn part_along_ring(&mut self, ring: [VertexId; 3]) -> bool {
        if ring.iter().any(|&v| self.immovable(v)) {
            self.report.refused.topology += 1;
            return false;
        }
        let Ok(plan) = self.surface.plan_cut(ring) else {
            self.report.refused.topology += 1;
            return false;
        };
        let mesh = self.surface.connectivity();
        let births: Vec<VertexId> =
            plan.positions().iter().map(|&(v, _)| v).filter(|v| !ring.contains(v)).collect();
        let ways: Vec<[DVec3; 2]> = (0..3)
            .map(|k| {
                let here = self.at(ring[k]);
                let moves = |t| plan.changed().iter().any(|&(changed, _)| changed == t);
                let side = |moved: bool| {
                    let own = mesh.star(ring[k]).filter(|h| moves(h.triangle()) == moved);
                    let others = own.flat_map(|h| [mesh.head(h), mesh.apex(h)]).filter(|v| !ring.contains(v));
                    mean(others.map(|v| self.at(v) - here))
                };
                [side(false), side(true)]
            })
            .collect();
        let Some(cut) = self.cut(ring, &births, &plan) else {
            self.report.refused.topology += 1;
            return false;
        };
        for shift in SHIFTS {
            let mut plan = plan.clone();
            let shifted: Vec<Shifted> = (0..3)
                .flat_map(|k| {
                    let here = self.at(ring[k]);
                    [(ring[k], ways[k][0]), (births[k], ways[k][1])]
                        .map(|(v, way)| (v, [here, here + shift * way]))
                })
                .collect();
            if shifted.iter().any(|&(v, [_, place])| plan.place(v, place).is_err())
                || !self.may_part(&plan, &shifted, Some(&cut))
            {
                continue;
            }
            let touched: Vec<_> = ring
                .iter()
                .flat_map(|&v| self.surface.connectivity().star(v))
                .map(|h| h.triangle())
                .collect();
            let outcome = self.surface.apply(plan);
            self.follow_triangles(touched.into_iter().chain(outcome.triangles));
            births.iter().zip(ring).for_each(|(&birth, v)| self.sizing.copied(birth, v));
            self.report.separations += 1;
            return true;
        }
        self.report.refused.intersection += 1;
        false
    }
}

/// The mean of some vectors, zero of none.
fn mean(vectors: impl Iterator<Item = DVec3>) -> DVec3 {
    let (sum, count) = vectors.fold((DVec3::ZERO, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    if count > 0.0 { sum / count } else { DVec3::ZERO }
}
