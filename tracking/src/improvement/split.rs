//! Edge splits \[Brochu12, section 3.2.4\], of edges with any number of triangles.
//!
//! Rule: edges longer than the limit, the longest first, until there are none; new edges are looked at, too. The new vertex goes
//! where the subdivision scheme says; where that is not admitted (it meets something, turns triangles over, or changes
//! too much volume) it falls back to the middle of the edge. The rounded middle lies beside the edge by a rounding, so it
//! is tested like any other place, and refused if the surface would meet itself.
//!
//! A pass splits at most as many edges as there were, and none once there are as many triangles as are allowed: a surface
//! that a flow blows up grows step by step, not without bound within one.

use super::embedding::Replacement;
use super::placement;
use super::workpiece::Workpiece;
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use welter_meshing::surface::{EdgeId, VertexId};

/// A positive number as an integer of the same order.
pub(crate) fn ordered(x: f64) -> u64 {
    x.to_bits()
}

impl Workpiece<'_> {
    /// Splits all edges that are too long.
    pub(crate) fn split_long_edges(&mut self) {
        let limit = self.parameters.max_edge_rel;
        let mesh = self.surface.connectivity();
        let long = |e: EdgeId| {
            let ends = mesh.ends(e);
            let length = self.relative_length(ends);
            (length > limit).then_some((ordered(length), Reverse(e.0), ends))
        };
        let mut heap: BinaryHeap<_> = mesh.edges().filter_map(long).collect();
        let mut left = mesh.edge_count();
        while let Some((length, Reverse(e), ends)) = heap.pop() {
            if left == 0 {
                break;
            }
            let edge = EdgeId(e);
            let mesh = self.surface.connectivity();
            let stands = mesh.has_edge(edge) && mesh.ends(edge) == ends;
            if !stands || ordered(self.relative_length(ends)) != length {
                continue;
            }
            let Some(new) = self.split(edge) else { continue };
            left -= 1;
            let mesh = self.surface.connectivity();
            for e in mesh.edges_at(new) {
                let ends = mesh.ends(e);
                let length = self.relative_length(ends);
                if length > limit {
                    heap.push((ordered(length), Reverse(e.0), ends));
                }
            }
        }
    }

    /// Splits an edge; the new vertex, unless it is refused.
    pub(crate) fn split(&mut self, edge: EdgeId) -> Option<VertexId> {
        let ends = self.surface.connectivity().ends(edge);
        let mesh = self.surface.connectivity();
        if mesh.triangle_count() + mesh.edge_triangles(edge) > self.parameters.most_triangles {
            self.report.refused.budget += 1;
            return None;
        }
        let Ok(plan) = self.surface.plan_split(edge, 0.5) else {
            self.report.refused.topology += 1;
            return None;
        };
        let (vertex, middle) = plan.positions()[0];
        if ends.iter().any(|&v| self.at(v) == middle) {
            // Ends that have no number between them.
            self.report.refused.shape += 1;
            return None;
        }
        let place = placement::of_split(self, edge).filter(|place| place.is_finite());
        for (place, scheme) in place.map(|p| (p, true)).into_iter().chain([(middle, false)]) {
            let mut plan = plan.clone();
            if plan.place(vertex, place).is_err() {
                continue;
            }
            let replacement = Replacement::new(self.surface, &plan);
            if scheme && !self.split_is_gentle(&replacement, place) {
                continue;
            }
            if !self.keeps_embedded(&replacement, place) {
                continue;
            }
            self.carry_out(plan, &replacement);
            self.sizing.born(vertex, ends);
            self.report.splits += 1;
            return Some(vertex);
        }
        self.report.refused.intersection += 1;
        None
    }

    /// Whether a place off the edge leaves triangles and volume much as they were.
    fn split_is_gentle(&self, replacement: &Replacement, place: DVec3) -> bool {
        let after = replacement.places(self.surface);
        let reach = |[a, b, c]: [DVec3; 3]| {
            let squared = |p: DVec3, q: DVec3| p.distance_squared(q);
            squared(a, b).max(squared(b, c)).max(squared(c, a))
        };
        let longest = |triangles: &[[DVec3; 3]]| triangles.iter().map(|&t| reach(t)).fold(0.0, f64::max);
        longest(&after) <= longest(&replacement.before)
            && self.keeps_normals(&replacement.before, &after)
            && self.small_volume(&replacement.before, place, self.parameters.max_split_volume_change_rel)
    }
}
