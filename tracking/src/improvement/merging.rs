//! Merging by zippering \[Brochu12, section 3.2.6\].
//!
//! Rule: pairs of edges nearer to each other than the merge distance, the nearest first; each has two triangles. The four
//! triangles go, which leaves two holes of four edges, and the holes are joined by a tube of eight triangles.
//!
//! Which pairs: the sheets must face each other across a gap outside, each with the other in front of it; so two parts of a
//! surface merge, but a thin sheet is not punctured.
//!
//! Where the holes have corners in common, at the seam of an earlier merge, the triangles of the tube between equal
//! corners drop out, and those of an edge that both have cancel: the seam moves on. That is how the opening
//! widens from pair to pair. The vertex where the seam parts has two fans then, and is separated.
//!
//! Of the four ways to put the holes together that with the shortest edges across is tried first; each with both ways of
//! cutting its quadrilaterals. Where none is admitted the pair is left. A way is admitted only if it
//! fills the space between the sheets and nothing else (`filling`); and where edges would get more than two triangles it is
//! not.

use super::shape::unit_normal;
use super::workpiece::Workpiece;
use crate::collision::closest_points;
use crate::surface::HalfEdge;
use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// Cosine of the angle by which sheets may fail to face each other: each normal is within 60 degrees of the way across.
const FACING: f64 = 0.5;

impl Workpiece<'_> {
    /// Zips near edges together. The broad phase knows all elements at rest.
    pub(crate) fn merge_close_edges(&mut self) {
        let distance = self.topology.merge_distance_rel * self.length;
        // Who may pass through itself does not merge.
        let Some(broad_phase) = self.broad_phase.as_deref() else { return };
        let Ok(pairs) = broad_phase.edge_edge_pairs(self.surface.connectivity(), distance) else { return };
        let near = |&pair: &[EdgeId; 2]| Some((self.gap(pair, distance)?, pair));
        let mut candidates: Vec<(f64, [EdgeId; 2])> = pairs.par_iter().filter_map(near).collect();
        candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Ids of edges that went may be in use again.
        let ends: Vec<_> =
            candidates.iter().map(|(_, pair)| pair.map(|e| self.surface.connectivity().ends(e))).collect();
        for ((_, pair), ends) in candidates.into_iter().zip(ends) {
            let mesh = self.surface.connectivity();
            let stand = pair.iter().zip(ends).all(|(&e, ends)| mesh.has_edge(e) && mesh.ends(e) == ends);
            if stand && self.gap(pair, distance).is_some() {
                self.merge(pair);
            }
        }
    }

    /// The distance of two edges whose sheets face each other across a gap of at most `distance`.
    fn gap(&self, [e, f]: [EdgeId; 2], distance: f64) -> Option<f64> {
        let mesh = self.surface.connectivity();
        let sides = [self.two_sides(e)?, self.two_sides(f)?];
        let [[a, b], [c, d]] = [mesh.ends(e), mesh.ends(f)].map(|ends| ends.map(|v| self.at(v)));
        let closest = closest_points::edge_edge([a, b, c, d]).ok()?;
        let [w0, w1, w2, w3] = closest.weights;
        let across = (w2 * c + w3 * d) - (w0 * a + w1 * b);
        let length = across.length();
        if length > distance || length == 0.0 {
            return None;
        }
        let faces = |[h, o]: [HalfEdge; 2], way: DVec3| {
            [h, o].iter().all(|h| unit_normal(self.places(h.triangle())).dot(way) > FACING * way.length())
        };
        (faces(sides[0], across) && faces(sides[1], -across)).then_some(length)
    }

    fn merge(&mut self, [e, f]: [EdgeId; 2]) {
        let (Some(one), Some(other)) = (self.two_sides(e), self.two_sides(f)) else { return };
        let remove: Vec<TriId> = one.iter().chain(&other).map(|h| h.triangle()).collect();
        let distinct = remove.iter().enumerate().all(|(i, t)| !remove[..i].contains(t));
        let [p, q] = [self.hole(one), self.hole(other)];
        if !distinct || remove.len() != 4 {
            return;
        }
        let across = |turn: usize| -> f64 {
            (0..4).map(|i| self.at(p[i]).distance_squared(self.at(q[(turn + 4 - i) % 4]))).sum()
        };
        let mut turns = [0, 1, 2, 3].map(|turn| (across(turn), turn));
        turns.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut reason = None;
        for (turn, other_diagonal) in turns.iter().flat_map(|&(_, turn)| [(turn, false), (turn, true)]) {
            let add = tube(p, q, turn, other_diagonal);
            let Ok(plan) = self.surface.plan_replacement(&remove, &add) else {
                reason = reason.or(Some(Reason::Topology));
                continue;
            };
            let consequences = self.surface.consequences(&plan);
            if !consequences.joined_edges.is_empty() || !consequences.opened_edges.is_empty() {
                reason = reason.or(Some(Reason::Topology));
                continue;
            }
            if !self.may_fill(plan.removed(), &remove, plan.added(), &add) {
                reason = Some(Reason::Intersection);
                continue;
            }
            let gone: Vec<TriId> = plan.removed().to_vec();
            self.report.cancelled += consequences.cancelled.len() as u64;
            let outcome = self.surface.apply(plan);
            self.follow_triangles(gone.into_iter().chain(outcome.triangles));
            self.report.merges += 1;
            return;
        }
        match reason {
            Some(Reason::Topology) => self.report.refused.topology += 1,
            Some(Reason::Intersection) => self.report.refused.intersection += 1,
            None => {}
        }
    }

    /// The corners of the hole that two triangles leave, in the order in which new triangles run along it.
    fn hole(&self, [h, o]: [HalfEdge; 2]) -> [VertexId; 4] {
        let mesh = self.surface.connectivity();
        [mesh.tail(h), mesh.apex(o), mesh.head(h), mesh.apex(h)]
    }
}

#[derive(Clone, Copy, Debug)]
enum Reason {
    Topology,
    Intersection,
}

/// The triangles between two holes, of which corner `i` of the first is put to corner `turn - i` of the second; without
/// those between equal corners.
fn tube(p: [VertexId; 4], q: [VertexId; 4], turn: usize, other_diagonal: bool) -> Vec<[VertexId; 3]> {
    let mut triangles = Vec::with_capacity(8);
    for i in 0..4 {
        let [a, b] = [p[i], p[(i + 1) % 4]];
        let [d, c] = [q[(turn + 4 - i) % 4], q[(turn + 7 - i) % 4]];
        if other_diagonal {
            triangles.extend([[a, b, c], [c, d, a]]);
        } else {
            triangles.extend([[a, b, d], [c, d, b]]);
        }
    }
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    triangles
}
