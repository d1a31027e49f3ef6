//! Edge flips \[Brochu12, section 3.2.4\], of any two triangles of an edge that run opposite ways.
//!
//! Rule: an edge is flipped if the apexes of its triangles are nearer to each other than its ends, by the minimum gain at
//! least; sweeps over all edges in the order of their ids, until none is flipped or the most sweeps are done. A flip is
//! refused if it would turn a triangle over, make one sharper than both were, change too much volume, or meet or sweep over
//! anything (the tetrahedron of the four corners is to be empty); and where the apexes have an edge already, since that would
//! join sheets. There is no other place to fall back to.

use super::embedding::Replacement;
use super::shape::sharpness;
use super::workpiece::Workpiece;
use crate::surface::HalfEdge;
use welter_meshing::surface::EdgeId;

impl Workpiece<'_> {
    /// Flips edges until there is nothing to gain.
    pub(crate) fn flip_edges(&mut self) {
        for _ in 0..self.parameters.flip_sweeps {
            let before = self.report.flips;
            for e in (0..self.surface.connectivity().edge_slots() as u32).map(EdgeId) {
                if self.surface.connectivity().has_edge(e) {
                    self.flip_if_shorter(e);
                }
            }
            if self.report.flips == before {
                break;
            }
        }
    }

    fn flip_if_shorter(&mut self, edge: EdgeId) {
        if let Some(sides) = self.two_sides(edge) {
            self.flip_pair_if_shorter(sides);
            return;
        }
        // Any pair of opposite triangles; the first that may be flipped.
        let sides: Vec<HalfEdge> = self.surface.connectivity().around_edge(edge).collect();
        for (i, &h) in sides.iter().enumerate() {
            for &o in &sides[i + 1..] {
                if self.surface.connectivity().tail(h) != self.surface.connectivity().tail(o)
                    && self.flip_pair_if_shorter([h, o])
                {
                    return;
                }
            }
        }
    }

    fn flip_pair_if_shorter(&mut self, [h, o]: [HalfEdge; 2]) -> bool {
        let mesh = self.surface.connectivity();
        let [a, b, c, d] = [mesh.tail(h), mesh.head(h), mesh.apex(h), mesh.apex(o)];
        if c == d {
            return false;
        }
        let now = self.relative_length([a, b]);
        if now - self.relative_length([c, d]) < self.parameters.min_flip_gain_rel {
            return false;
        }
        self.flip([h, o])
    }

    /// Flips the edge of two opposite half-edges, unless that is refused.
    fn flip(&mut self, [h, o]: [HalfEdge; 2]) -> bool {
        let mesh = self.surface.connectivity();
        let [a, b, c, d] = [mesh.tail(h), mesh.head(h), mesh.apex(h), mesh.apex(o)];
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.at(v));
        let before = [[pa, pb, pc], [pb, pa, pd]];
        let after = [[pc, pa, pd], [pd, pb, pc]];
        let worst = |pair: &[[glam::DVec3; 3]; 2]| sharpness(pair[0]).max(sharpness(pair[1]));
        let fair = worst(&after) < worst(&before) || worst(&after) < MILD;
        // Both normals are near to both: a ridge is not flipped.
        let turns = before.iter().any(|&t| !self.keeps_normals(&[t], &after));
        if !fair || turns {
            self.report.refused.shape += 1;
            return false;
        }
        if !self.small_volume(&before, pc, self.parameters.max_volume_change_rel) {
            self.report.refused.volume += 1;
            return false;
        }
        if mesh.edge_between(c, d).is_some() {
            self.report.refused.topology += 1;
            return false;
        }
        let Ok(plan) = self.surface.plan_flip([h, o]) else {
            self.report.refused.topology += 1;
            return false;
        };
        let replacement = Replacement::new(self.surface, &plan);
        if !self.keeps_embedded(&replacement, pc) {
            self.report.refused.intersection += 1;
            return false;
        }
        self.carry_out(plan, &replacement);
        self.report.flips += 1;
        true
    }
}

/// [`sharpness`] of triangles that no one minds: below that of a right isosceles one, 4.
const MILD: f64 = 4.0;
