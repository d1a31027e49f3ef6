//! Whether a surface may be pulled apart where it hangs together in one vertex or along one ring: [`Parting`].
//!
//! The vertices that are doubled start at the same place, so the parts meet at the beginning of the pseudo-motion. It is looked
//! at from a small part of the way on.
//!
//! # What it promises
//! A parting is admitted only if, exactly,
//! * at the [`FIRST`] part of the way, and at the end, no triangle that moves or comes meets another in more than
//!   what they share, and between them none touches another;
//! * on the way no triangle that moves touches one that has none of the moving vertices;
//! * of a ring that is cut, at both places, each closing triangle has all corners of the other on that side from which
//!   the other part came ([`Cut`]).
//!
//! So the surface is embedded afterwards, nothing was passed through, and what was inside is inside.
//!
//! # What it does not promise
//! That singular vertices were pulled apart the right way round: their neighbours stay where they are and hold the cones
//! in place.

use super::workpiece::Workpiece;
use crate::surface::Plan;
use glam::DVec3;
use std::cmp::Ordering;
use welter_meshing::spatial::{Box3, meet_in_more};
use welter_meshing::surface::{TriId, VertexId};
use welter_predicates::{Sign, ccd, orient3d};

/// A triangle on its way.
#[derive(Clone, Copy, Debug)]
struct Moving {
    corners: [VertexId; 3],
    /// Where the parts meet; closing triangles come into being at `first`.
    from: [DVec3; 3],
    first: [DVec3; 3],
    to: [DVec3; 3],
}

/// A vertex on its way: where it was or is doubled, and where it goes.
pub(crate) type Shifted = (VertexId, [DVec3; 2]);

/// A ring of three edges with its copies; the third of each triple of `apexes` is that of the triangle beside the ring's
/// edge `k` to `k + 1`, of the part that keeps the ring, and of the part that gets the copies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub(crate) ring: [VertexId; 3],
    pub(crate) copies: [VertexId; 3],
    pub(crate) places: [DVec3; 3],
    pub(crate) apexes: [[DVec3; 2]; 3],
}

/// How far the parts go, as parts of the way to the mean of their neighbours: the first that is admitted.
pub(crate) const SHIFTS: [f64; 4] = [1.0 / 4.0, 1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0];

/// The part of a way from which on it is looked at.
const FIRST: f64 = 1.0 / 64.0;

impl Workpiece<'_> {
    /// Whether a plan that doubles vertices may be carried out; `shifted` are all vertices that move. The plan has them at
    /// their ends already.
    pub(crate) fn may_part(&self, plan: &Plan, shifted: &[Shifted], cut: Option<&Cut>) -> bool {
        let mesh = self.surface.connectivity();
        let way = |v: VertexId| shifted.iter().find(|(moved, _)| *moved == v).map(|&(_, way)| way);
        let first = |v: VertexId| way(v).map_or_else(|| self.at(v), |[from, to]| from + FIRST * (to - from));
        let end = |v: VertexId| way(v).map_or_else(|| self.at(v), |[_, to]| to);
        let moving = |corners: [VertexId; 3], from| Moving {
            corners,
            from,
            first: corners.map(first),
            to: corners.map(end),
        };
        let mut old: Vec<TriId> = plan.changed().iter().map(|&(t, _)| t).collect();
        old.extend(plan.removed());
        let mut movers: Vec<Moving> =
            plan.changed().iter().map(|&(t, corners)| moving(corners, self.places(t))).collect();
        for &(v, _) in shifted.iter().filter(|(v, _)| mesh.has_vertex(*v)) {
            for t in mesh.star(v).map(|h| h.triangle()) {
                if !old.contains(&t) {
                    old.push(t);
                    movers.push(moving(mesh.corners(t), self.places(t)));
                }
            }
        }
        movers.extend(plan.added().iter().map(|&corners| moving(corners, corners.map(first))));
        if !cut.is_none_or(|cut| cut.parts(first) && cut.parts(end)) {
            return false;
        }
        for (i, s) in movers.iter().enumerate() {
            let meets = |t: &Moving| {
                meet_in_more(first, s.corners, t.corners)
                    || meet_in_more(end, s.corners, t.corners)
                    || touch(s.corners, [s.first, s.to], t.corners, [t.first, t.to])
            };
            if movers[..i].iter().any(meets) {
                return false;
            }
        }
        let swept: Vec<Box3> = movers.iter().map(|m| Box3::of(m.from.into_iter().chain(m.to))).collect();
        let around = swept.iter().fold(Box3::EMPTY, |all, b| all.union(b));
        self.all_triangles_near(&around, |t, own| {
            if old.contains(&t) {
                return true;
            }
            let corners = mesh.corners(t);
            let places = corners.map(|v| self.at(v));
            movers.iter().zip(&swept).all(|(m, swept)| {
                !own.meets(swept)
                    || !(meet_in_more(first, m.corners, corners)
                        || meet_in_more(end, m.corners, corners)
                        || touch(m.corners, [m.from, m.to], corners, [places, places]))
            })
        })
    }
}

impl Cut {
    /// Whether both closing triangles have the other part's copies of the ring on the right side.
    ///
    /// Around an edge of the ring lie the closing triangle and one triangle of each part. The part whose triangle comes
    /// first when the closing one is turned towards its normal has its closing triangle on that side.
    fn parts(&self, at: impl Fn(VertexId) -> DVec3) -> bool {
        let [ring, copies] = [self.ring, self.copies].map(|triple| triple.map(&at));
        let Some(kept_first) = self.order() else { return false };
        // What is kept goes along the normal of its closing triangle if it comes first, and the copies against it; the
        // closing triangle of the copies is turned over.
        let wanted = if kept_first { Sign::Negative } else { Sign::Positive };
        let [a, b, c] = copies;
        copies.iter().all(|&p| side(ring, p) == wanted) && ring.iter().all(|&p| side([a, c, b], p) == wanted)
    }

    /// Whether the part that keeps the ring comes first at each edge; none if the edges differ, or it cannot be told.
    fn order(&self) -> Option<bool> {
        let mut orders = (0..3).map(|k| {
            let [p, q, r] = [0, 1, 2].map(|i| self.places[(k + i) % 3]);
            let [kept, copied] = self.apexes[k];
            let half = |x: DVec3| match side([p, q, r], x) {
                Sign::Positive => 0,
                Sign::Zero => 1,
                Sign::Negative => 2,
            };
            match half(kept).cmp(&half(copied)) {
                Ordering::Less => Some(true),
                Ordering::Greater => Some(false),
                Ordering::Equal => match side([p, q, kept], copied) {
                    Sign::Positive => Some(true),
                    Sign::Negative => Some(false),
                    Sign::Zero => None,
                },
            }
        });
        let first = orders.next()??;
        orders.all(|order| order == Some(first)).then_some(first)
    }
}

/// On which side of a triangle a point lies: positive where its normal points, exactly.
pub(super) fn side([a, b, c]: [DVec3; 3], p: DVec3) -> Sign {
    orient3d(a.to_array(), c.to_array(), b.to_array(), p.to_array())
}

/// Whether two triangles touch on their ways, otherwise than at common corners.
fn touch(s: [VertexId; 3], [s0, s1]: [[DVec3; 3]; 2], t: [VertexId; 3], [t0, t1]: [[DVec3; 3]; 2]) -> bool {
    if s0 == s1 && t0 == t1 {
        return false;
    }
    let vertex_meets = |k: usize| {
        let ([a, b, c], [d, e, f]) = (t0, t1);
        !t.contains(&s[k]) && ccd::vertex_face([s0[k], a, b, c], [s1[k], d, e, f])
    };
    let face_meets = |k: usize| {
        let ([a, b, c], [d, e, f]) = (s0, s1);
        !s.contains(&t[k]) && ccd::vertex_face([t0[k], a, b, c], [t1[k], d, e, f])
    };
    let edges_meet = |i: usize, j: usize| {
        let ([i, k], [j, l]) = ([i, (i + 1) % 3], [j, (j + 1) % 3]);
        let disjoint = [i, k].iter().all(|&i| s[i] != t[j] && s[i] != t[l]);
        disjoint && ccd::edge_edge([s0[i], s0[k], t0[j], t0[l]], [s1[i], s1[k], t1[j], t1[l]])
    };
    (0..3).any(|i| vertex_meets(i) || face_meets(i) || (0..3).any(|j| edges_meet(i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_point_to_the_positive_side() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(side(triangle, DVec3::Z), Sign::Positive);
        assert_eq!(side(triangle, -DVec3::Z), Sign::Negative);
    }

    /// A neck along z, the kept part below; then a pit, whose walls go down from its rim and get the copies.
    #[test]
    fn necks_and_pits_are_told_apart() {
        let ids = |first: u32| [0, 1, 2].map(|k| VertexId(first + k));
        let places = [DVec3::X, DVec3::new(-0.5, 0.8, 0.0), DVec3::new(-0.5, -0.8, 0.0)];
        let middles = [0, 1, 2].map(|k| 0.5 * (places[k] + places[(k + 1) % 3]));
        let cut = |kept: DVec3, scale: f64, copied: DVec3| Cut {
            ring: ids(0),
            copies: ids(3),
            places,
            apexes: middles.map(|m| [scale * m + kept, m + copied]),
        };
        let apart = |height: f64| {
            move |v: VertexId| {
                if v.0 < 3 { places[v.index()] } else { places[v.index() - 3] + height * DVec3::Z }
            }
        };
        let neck = cut(-DVec3::Z, 1.0, DVec3::Z);
        assert_eq!(neck.order(), Some(false));
        assert!(neck.parts(apart(0.1)) && !neck.parts(apart(-0.1)));
        let pit = cut(DVec3::ZERO, 3.0, -DVec3::Z);
        assert_eq!(pit.order(), Some(true));
        assert!(pit.parts(apart(-0.1)) && !pit.parts(apart(0.1)));
        // A rim that slopes down steeply outside of the pit.
        let crater = cut(-DVec3::Z, 1.5, -DVec3::Z);
        assert_eq!(crater.order(), Some(true));
    }
}
