//! Whether a surface may be pulled apart where it hangs together in one vertex or along one ring: [`Parting`].
//!
//! The vertices that are doubled start at the same place, so the parts meet at the beginning of the pseudo-motion, and only the
//! end can be free of intersection.
//!
//! # What it promises
//! A parting is admitted only if, exactly,
//! * at the end no triangle that moved or came meets another in more than what they share;
//! * on the way no triangle that moves touches one that has none of the moving vertices.
//!
//! So the surface is embedded afterwards, and nothing else was passed through.

use super::workpiece::Workpiece;
use crate::surface::Plan;
use glam::DVec3;
use welter_meshing::spatial::{Box3, meet_in_more};
use welter_meshing::surface::{TriId, VertexId};
use welter_predicates::ccd;

/// A triangle on its way.
#[derive(Clone, Copy, Debug)]
struct Moving {
    corners: [VertexId; 3],
    from: [DVec3; 3],
    to: [DVec3; 3],
}

/// How far the parts go, as parts of the way to the mean of their neighbours: the first that is admitted.
pub(crate) const SHIFTS: [f64; 4] = [1.0 / 4.0, 1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0];

impl Workpiece<'_> {
    /// Whether a plan that doubles vertices may be carried out; `shifted` are all vertices that move, with where they go. The
    /// plan has them there already.
    pub(crate) fn may_part(&self, plan: &Plan, shifted: &[(VertexId, DVec3)]) -> bool {
        let mesh = self.surface.connectivity();
        let place = |v: VertexId| shifted.iter().find(|(moved, _)| *moved == v).map(|&(_, place)| place);
        let end = |v: VertexId| place(v).unwrap_or_else(|| self.at(v));
        let mut old: Vec<TriId> = plan.changed().iter().map(|&(t, _)| t).collect();
        old.extend(plan.removed());
        let mut moving: Vec<Moving> = Vec::new();
        for &(t, corners) in plan.changed() {
            moving.push(Moving { corners, from: self.places(t), to: corners.map(end) });
        }
        for &(v, _) in shifted.iter().filter(|(v, _)| mesh.has_vertex(*v)) {
            for t in mesh.star(v).map(|h| h.triangle()) {
                if !old.contains(&t) {
                    old.push(t);
                    let corners = mesh.corners(t);
                    moving.push(Moving { corners, from: self.places(t), to: corners.map(end) });
                }
            }
        }
        // Those that come close the parts where these are afterwards.
        for &corners in plan.added() {
            let to = corners.map(end);
            moving.push(Moving { corners, from: to, to });
        }
        for (i, s) in moving.iter().enumerate() {
            if moving[..i].iter().any(|t| meet_in_more(end, s.corners, t.corners)) {
                return false;
            }
        }
        let swept: Vec<Box3> = moving.iter().map(|m| Box3::of(m.from.into_iter().chain(m.to))).collect();
        let around = swept.iter().fold(Box3::EMPTY, |all, b| all.union(b));
        self.broad_phase.all_triangles_near(&around, |t, own| {
            if old.contains(&t) {
                return true;
            }
            let corners = mesh.corners(t);
            let places = corners.map(|v| self.at(v));
            moving.iter().zip(&swept).all(|(m, swept)| {
                !own.meets(swept) || !(meet_in_more(end, m.corners, corners) || m.touches(corners, places))
            })
        })
    }
}

impl Moving {
    /// Whether it touches a triangle at rest on the way, otherwise than at common corners.
    fn touches(&self, corners: [VertexId; 3], places: [DVec3; 3]) -> bool {
        if self.from == self.to {
            return false;
        }
        let vertex_meets = |k: usize| {
            let (v, [p, q]) = (self.corners[k], [self.from[k], self.to[k]]);
            let [a, b, c] = places;
            !corners.contains(&v) && p != q && ccd::vertex_face([p, a, b, c], [q, a, b, c])
        };
        let face_meets = |k: usize| {
            let p = places[k];
            let [[a, b, c], [d, e, f]] = [self.from, self.to];
            !self.corners.contains(&corners[k]) && ccd::vertex_face([p, a, b, c], [p, d, e, f])
        };
        let edges_meet = |i: usize, j: usize| {
            let [s, t] = [[i, (i + 1) % 3], [j, (j + 1) % 3]];
            let disjoint = s.iter().all(|&i| t.iter().all(|&j| self.corners[i] != corners[j]));
            let [a, b] = s.map(|i| self.from[i]);
            let [c, d] = s.map(|i| self.to[i]);
            let [p, q] = t.map(|j| places[j]);
            disjoint && ccd::edge_edge([a, b, p, q], [c, d, p, q])
        };
        (0..3).any(|i| vertex_meets(i) || face_meets(i) || (0..3).any(|j| edges_meet(i, j)))
    }
}
