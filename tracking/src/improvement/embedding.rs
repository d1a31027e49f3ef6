//! Whether a planned change keeps a surface embedded: [`Replacement`].
//!
//! # The question
//! A split, a collapse and a flip replace some triangles by others that have one corner in common, the *tip*: the new
//! vertex, the vertex that remains, an apex of the flipped edge. As a pseudo-motion \[Brochu12, section 3.2.4\], each
//! triangle that goes sweeps the tetrahedron between it and the tip.
//!
//! # What it promises
//! A change is admitted only if, exactly,
//! * no new triangle meets another new one, or one that stays, in more than what they share;
//! * no vertex of a triangle that stays lies in one of the tetrahedra, but those of the new triangles;
//! * no triangle that stays, all of whose corners are of the new triangles, crosses a side between two tetrahedra or
//!   has a corner in one that it is no corner of.
//!
//! So the surface stays embedded, for triangles that stay do not meet each other as before; and nothing passes through it:
//! what is swept over would have a vertex in a tetrahedron or cross an old or a new triangle.
//!
//! # Complexity
//! One descent of the tree of triangles, and a few orientations for each triangle whose box is near.

use crate::broad_phase::BroadPhase;
use crate::surface::{MovingSurface, Plan};
use glam::DVec3;
use welter_meshing::spatial::{Box3, meet_in_more};
use welter_meshing::surface::{TriId, VertexId};
use welter_predicates::intersection::tetrahedron_contains;

/// What a plan does to the triangles of a surface.
#[derive(Clone, Debug)]
pub(crate) struct Replacement {
    /// Triangles that go, get other corners, or have a corner that moves.
    pub(crate) old: Vec<TriId>,
    /// Where the corners of those are.
    pub(crate) before: Vec<[DVec3; 3]>,
    /// The corners of the triangles that come in their place.
    pub(crate) after: Vec<[VertexId; 3]>,
    /// Vertices that are new or move, with their places.
    moved: Vec<(VertexId, DVec3)>,
}

impl Replacement {
    pub(crate) fn new(surface: &MovingSurface, plan: &Plan) -> Self {
        let mesh = surface.connectivity();
        let mut old: Vec<TriId> = plan.changed().iter().map(|&(t, _)| t).collect();
        old.extend(plan.removed());
        let mut after: Vec<[VertexId; 3]> = plan.changed().iter().map(|&(_, corners)| corners).collect();
        after.extend(plan.added());
        let named = old.len();
        for &(v, place) in plan.positions() {
            if mesh.has_vertex(v) && surface.position(v) != place {
                for t in mesh.star(v).map(|h| h.triangle()) {
                    if !old[..named].contains(&t) && !old[named..].contains(&t) {
                        old.push(t);
                        after.push(mesh.corners(t));
                    }
                }
            }
        }
        let before = old.iter().map(|&t| mesh.corners(t).map(|v| surface.position(v))).collect();
        Self { old, before, after, moved: plan.positions().to_vec() }
    }

    /// Where a vertex is afterwards.
    #[inline]
    pub(crate) fn at(&self, surface: &MovingSurface, v: VertexId) -> DVec3 {
        match self.moved.iter().find(|(moved, _)| *moved == v) {
            Some(&(_, place)) => place,
            None => surface.position(v),
        }
    }

    /// Where the corners of the new triangles are.
    pub(crate) fn places(&self, surface: &MovingSurface) -> Vec<[DVec3; 3]> {
        self.after.iter().map(|t| t.map(|v| self.at(surface, v))).collect()
    }

    /// See the module; `tip` is a corner of all new triangles.
    pub(crate) fn keeps_embedded(
        &self,
        surface: &MovingSurface,
        broad_phase: &BroadPhase,
        tip: DVec3,
    ) -> bool {
        let at = |v: VertexId| self.at(surface, v);
        for (i, &s) in self.after.iter().enumerate() {
            if self.after[..i].iter().any(|&t| meet_in_more(at, s, t)) {
                return false;
            }
        }
        let new: Vec<Box3> = self.after.iter().map(|t| Box3::of(t.map(at))).collect();
        let swept: Vec<Box3> = self.before.iter().map(|&[a, b, c]| Box3::of([a, b, c, tip])).collect();
        let around = new.iter().chain(&swept).fold(Box3::EMPTY, |all, b| all.union(b));
        let at_corner = |v: VertexId| self.after.iter().flatten().any(|&w| w == v);
        let sweeps = |v: VertexId| {
            let p = surface.position(v);
            let contains = |(b, &[x, y, z]): (&Box3, &[DVec3; 3])| {
                b.contains(p) && tetrahedron_contains([x, y, z, tip], p)
            };
            around.contains(p) && !at_corner(v) && swept.iter().zip(&self.before).any(contains)
        };
        broad_phase.all_triangles_near(&around, |t, own| {
            if self.old.contains(&t) {
                return true;
            }
            let corners = surface.connectivity().corners(t);
            let meets = |(b, &new): (&Box3, &[VertexId; 3])| own.meets(b) && meet_in_more(at, corners, new);
            let enclosed = || {
                corners.iter().all(|&v| at_corner(v))
                    && lies_between(&self.before, tip, corners.map(|v| surface.position(v)))
            };
            let hit =
                new.iter().zip(&self.after).any(meets) || corners.iter().any(|&v| sweeps(v)) || enclosed();
            !hit
        })
    }
}

/// Whether a triangle may lie within the tetrahedra that join triangles to a tip: meets a side between two of them in more
/// than common corners and edges, or has a corner in one that it is no corner of. Names are positions here: different
/// vertices of an embedded surface lie at different places.
fn lies_between(triangles: &[[DVec3; 3]], tip: DVec3, corners: [DVec3; 3]) -> bool {
    let edges = || triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut inner = edges().filter(|&(p, q)| edges().any(|other| other == (q, p)));
    let within = |&[x, y, z]: &[DVec3; 3]| {
        let tetrahedron = [x, y, z, tip];
        corners.iter().any(|p| !tetrahedron.contains(p) && tetrahedron_contains(tetrahedron, *p))
    };
    triangles.iter().any(within)
        || inner.any(|(p, q)| {
            let [a, b, c] = corners;
            let points = [a, b, c, tip, p, q];
            let name = |point: DVec3| {
                let place = points.iter().position(|&x| x == point);
                VertexId::from_index(place.expect("one of the points"))
            };
            meet_in_more(|v| points[v.index()], corners.map(name), [tip, p, q].map(name))
        })
}
