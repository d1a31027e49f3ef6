//! The four changes of a [`Workpiece`]: split, collapse, flip, move. Each is made if it is accepted, else
//! nothing has changed.
//!
//! Each takes the largest sharpness ([`shape::sharpness`]) that its new triangles may have.

use super::connectivity::HalfEdge;
use super::shape::sharpest;
use super::workpiece::{Change, Workpiece};
use crate::DVec3;
use crate::field::ScalarField;
use crate::surface::{MAX_TRIANGLES, TriId, VertexId};

impl<F: ScalarField> Workpiece<'_, F> {
    /// The point where a vertex in the middle of an edge goes, with the normal and slope there; the middle
    /// itself where the surface is not found.
    pub(super) fn middle(&self, h: HalfEdge) -> (DVec3, DVec3, f64) {
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let middle = 0.5 * (self.at(a) + self.at(b));
        let normal = (self.normals[a.index()] + self.normals[b.index()]).normalize_or_zero();
        let slope = 0.5 * (self.slopes[a.index()] + self.slopes[b.index()]);
        (self.project(middle, normal, slope).unwrap_or(middle), normal, slope)
    }

    /// Puts a vertex on the middle of an edge, and onto the surface if that is accepted.
    pub(super) fn try_split(&mut self, h: HalfEdge) -> bool {
        if self.mesh.triangle_slots() + 2 > MAX_TRIANGLES {
            return false; // Ids are used up.
        }
        let (on_surface, normal, slope) = self.middle(h);
        let o = self.mesh.opposite(h);
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let [c, d] = [self.mesh.apex(h), self.mesh.apex(o)];
        let flat = 0.5 * (self.at(a) + self.at(b));
        let m = VertexId::from_index(self.positions.len());
        let disc = [h.triangle(), o.triangle()];
        let before = disc.map(|t| self.corners(t));
        let upright = self.least_upright(&disc);
        let after = [[a, m, c], [m, b, c], [b, m, d], [m, a, d]];
        self.positions.push(on_surface);
        self.normals.push(normal);
        self.slopes.push(slope);
        let change = Change { apex: m, disc: &disc, before: &before, after: &after };
        let mut accepted = self.accepts(&change, upright);
        if !accepted && flat != on_surface {
            self.positions[m.index()] = flat;
            accepted = self.accepts(&change, upright);
        }
        if !accepted {
            self.positions.pop();
            self.normals.pop();
            self.slopes.pop();
            return false;
        }
        self.mesh.split(h);
        for t in self.star(m) {
            self.place(t);
        }
        self.refresh(m);
        true
    }

    /// Merges the head of an edge into its tail, which goes to `target`. No spoke becomes longer than
    /// `longest`.
    pub(super) fn try_collapse(&mut self, h: HalfEdge, target: DVec3, worst: f64, longest: f64) -> bool {
        if !self.mesh.can_collapse(h) {
            return false;
        }
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let gone = [h.triangle(), self.mesh.opposite(h).triangle()];
        let mut disc = self.star(a);
        disc.extend(self.mesh.around(b).map(HalfEdge::triangle).filter(|t| !gone.contains(t)));
        let before: Vec<[DVec3; 3]> = disc.iter().map(|&t| self.corners(t)).collect();
        let upright = self.least_upright(&disc);
        let renamed = |t: &TriId| self.mesh.corners(*t).map(|v| if v == b { a } else { v });
        let after: Vec<[VertexId; 3]> = disc.iter().filter(|t| !gone.contains(t)).map(renamed).collect();
        let kept = (self.at(a), self.normals[a.index()]);
        self.positions[a.index()] = target;
        self.normals[a.index()] = (kept.1 + self.normals[b.index()]).normalize_or_zero();

        let ring = after.iter().flatten().filter(|&&v| v != a);
        let short = ring.into_iter().all(|&v| self.at(v).distance_squared(target) <= longest * longest);
        let change = Change { apex: a, disc: &disc, before: &before, after: &after };
        let shaped = short && self.sharpest_of(&after) <= worst;
        self.refused.shape += u64::from(!shaped);
        if !(shaped && self.accepts(&change, upright)) {
            (self.positions[a.index()], self.normals[a.index()]) = kept;
            return false;
        }
        self.mesh.collapse(h);
        gone.iter().for_each(|&t| self.buckets.remove(t));
        disc.iter().filter(|t| !gone.contains(t)).for_each(|&t| self.place(t));
        self.refresh(a);
        true
    }

    /// Flips an edge.
    pub(super) fn try_flip(&mut self, h: HalfEdge, worst: f64) -> bool {
        let o = self.mesh.opposite(h);
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let [c, d] = [self.mesh.apex(h), self.mesh.apex(o)];
        let after = [[d, c, a], [c, d, b]];
        if !(self.sharpest_of(&after) <= worst && self.mesh.can_flip(h)) {
            return false;
        }
        let disc = [h.triangle(), o.triangle()];
        let before = disc.map(|t| self.corners(t));
        let upright = self.least_upright(&disc);
        if !self.accepts(&Change { apex: c, disc: &disc, before: &before, after: &after }, upright) {
            return false;
        }
        self.mesh.flip(h);
        disc.iter().for_each(|&t| self.place(t));
        true
    }

    /// Moves a vertex.
    pub(super) fn try_move(&mut self, v: VertexId, target: DVec3, worst: f64) -> bool {
        let disc = self.star(v);
        let before: Vec<[DVec3; 3]> = disc.iter().map(|&t| self.corners(t)).collect();
        let upright = self.least_upright(&disc);
        let after: Vec<[VertexId; 3]> = disc.iter().map(|&t| self.mesh.corners(t)).collect();
        let old = std::mem::replace(&mut self.positions[v.index()], target);
        let shaped = self.sharpest_of(&after) <= worst;
        self.refused.shape += u64::from(!shaped);
        let change = Change { apex: v, disc: &disc, before: &before, after: &after };
        if !(shaped && self.accepts(&change, upright)) {
            self.positions[v.index()] = old;
            return false;
        }
        disc.iter().for_each(|&t| self.place(t));
        self.refresh(v);
        true
    }

    /// The triangles of a vertex.
    pub(super) fn star(&self, v: VertexId) -> Vec<TriId> {
        self.mesh.around(v).map(HalfEdge::triangle).collect()
    }

    pub(super) fn sharpest_of(&self, triangles: &[[VertexId; 3]]) -> f64 {
        sharpest(triangles.iter().map(|t| t.map(|v| self.at(v))))
    }

    /// The largest sharpness of a vertex's triangles.
    pub(super) fn sharpest_at(&self, v: VertexId) -> f64 {
        sharpest(self.mesh.around(v).map(|h| self.corners(h.triangle())))
    }

    fn least_upright(&self, disc: &[TriId]) -> f64 {
        disc.iter().map(|&t| self.uprightness(self.mesh.corners(t))).fold(1.0, f64::min)
    }
}
