//! [`Workpiece`]: a surface under change, and the one way in which it changes.
//!
//! # The one way
//! Splits, flips, collapses and moves of a vertex are all the same to the embedding: the triangles of a disc
//! are replaced by those that join the boundary of the disc to one point, the apex (the new vertex, an apex
//! of the flipped edge, the vertex that remains, the vertex that moves).
//! [`Workpiece::accepts`] decides whether such a change may be made.
//!
//! # What it promises
//! An accepted change keeps the surface embedded, by the exact predicate that defines it: no new triangle
//! meets another new one, or one that stays, in more than the vertex or edge that they share. The triangles
//! that stay do not meet each other as before.
//!
//! It also keeps what is inside of what: the disc, the new triangles and the tetrahedra between the apex and
//! the triangles of the disc bound the region swept by the change. No vertex of a triangle that stays lies in
//! one of these tetrahedra, but those on the boundary of the disc; and a triangle that stays with all corners
//! on that boundary crosses no side between two of the tetrahedra, nor are its corners in one that they are
//! no corners of. So no other component is swept over: it
//! would have a vertex there, or cross the old or the new triangles. Nor does the disc pass to the other side
//! of its own component, as three sides of a tetrahedron could through the fourth.
//!
//! # What else it asks
//! The shape of new triangles, which is a criterion and no promise: their normals are at most [`STEEPEST`]
//! off those of the field at their corners, or at least no worse than those of the disc; so a fold can be
//! undone, but none is made.

use super::buckets::Buckets;
use super::connectivity::{Connectivity, HalfEdge};
use super::shape;
use crate::DVec3;
use crate::field::ScalarField;
use crate::spatial::{Box3, meet_in_more};
use crate::surface::{TriId, VertexId};
use welter_predicates::intersection::tetrahedron_contains;

/// Cosine of the largest angle between the normal of a new triangle and the mean normal at its corners: 60
/// degrees. A triangle of edge length L inscribed in a sphere of radius r is off by up to asin(L / r) or so;
/// surfaces that a grid resolves have r > L.
const STEEPEST: f64 = 0.5;

/// Half the distance over which fields are differenced, in edge lengths: far above the rounding of
/// coordinates, far below the size of features.
pub(super) const STEP_REL: f64 = 1.0 / 1024.0;

/// Sides of boxes that triangles may have in any case, in edge lengths: a little above the longest edges that
/// remain.
const REACH_REL: f64 = 1.5;

/// What became of proposed changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Refusals {
    pub(super) shape: u64,
    pub(super) intersection: u64,
}

pub(super) struct Workpiece<'a, F> {
    pub(super) field: &'a F,
    /// Target edge length.
    pub(super) length: f64,
    /// 1 where the field increases to the side from which triangles are counterclockwise, else -1.
    pub(super) side: f64,
    pub(super) mesh: Connectivity,
    pub(super) positions: Vec<DVec3>,
    /// Unit normals; zero where nothing tells one.
    pub(super) normals: Vec<DVec3>,
    /// Derivative of the field along the normal; zero where it is not known.
    pub(super) slopes: Vec<f64>,
    pub(super) buckets: Buckets,
    pub(super) refused: Refusals,
}

/// A change to be judged: the apex is at its new position already, the triangles of the disc are listed with
/// their old corners.
pub(super) struct Change<'c> {
    pub(super) apex: VertexId,
    pub(super) disc: &'c [TriId],
    pub(super) before: &'c [[DVec3; 3]],
    pub(super) after: &'c [[VertexId; 3]],
}

impl<'a, F: ScalarField> Workpiece<'a, F> {
    pub(super) fn new(field: &'a F, length: f64, mesh: Connectivity, positions: Vec<DVec3>) -> Self {
        let vertices = positions.len();
        let mut piece = Self {
            field,
            length,
            side: 1.0,
            buckets: Buckets::new(length, 0),
            mesh,
            positions,
            normals: vec![DVec3::ZERO; vertices],
            slopes: vec![0.0; vertices],
            refused: Refusals::default(),
        };
        piece.side = piece.side_of_field();
        for v in 0..vertices as u32 {
            piece.refresh(VertexId(v));
        }
        piece.rebuild();
        piece
    }

    /// Buckets for the triangles as they are.
    pub(super) fn rebuild(&mut self) {
        let extent = |t: TriId| {
            let b = Box3::of(self.corners(t));
            (b.max - b.min).max_element()
        };
        let longest = self.mesh.triangles().map(extent).fold(REACH_REL * self.length, f64::max);
        self.buckets = Buckets::new(longest, self.mesh.triangle_slots());
        for t in (0..self.mesh.triangle_slots() as u32).map(TriId) {
            if self.mesh.has_triangle(t) {
                self.place(t);
            }
        }
    }

    #[inline]
    pub(super) fn at(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    #[inline]
    pub(super) fn corners(&self, t: TriId) -> [DVec3; 3] {
        self.mesh.corners(t).map(|v| self.at(v))
    }

    /// Square of the length of an edge.
    #[inline]
    pub(super) fn squared(&self, h: HalfEdge) -> f64 {
        self.at(self.mesh.tail(h)).distance_squared(self.at(self.mesh.head(h)))
    }

    pub(super) fn place(&mut self, t: TriId) {
        let around = Box3::of(self.corners(t));
        self.buckets.place(t, around);
    }

    /// Whether the field increases outward of the triangles, by a vote of the areas.
    fn side_of_field(&self) -> f64 {
        let step = self.length * STEP_REL;
        let mut vote = 0.0;
        for v in self.mesh.vertices() {
            let gradient = self.field.gradient(self.at(v), step);
            let agreement = gradient.normalize_or_zero().dot(self.area_normal(v) / self.length);
            if agreement.is_finite() {
                vote += agreement;
            }
        }
        if vote < 0.0 { -1.0 } else { 1.0 }
    }

    /// Sum of the area vectors of a vertex's triangles: thin triangles have little say.
    fn area_normal(&self, v: VertexId) -> DVec3 {
        self.mesh.around(v).map(|h| shape::area_vector(self.corners(h.triangle()))).sum()
    }

    /// Computes the normal of a vertex anew: the gradient where that is usable, else the normal of the mesh.
    pub(super) fn refresh(&mut self, v: VertexId) {
        if !self.mesh.has_vertex(v) {
            return;
        }
        let gradient = self.side * self.field.gradient(self.at(v), self.length * STEP_REL);
        let slope = gradient.length();
        let of_mesh = self.area_normal(v).normalize_or_zero();
        let usable = slope.is_finite() && slope > 0.0 && (gradient / slope).dot(of_mesh) > STEEPEST;
        (self.normals[v.index()], self.slopes[v.index()]) =
            if usable { (gradient / slope, slope) } else { (of_mesh, 0.0) };
    }

    /// Cosine of the angle between a triangle's normal and the mean normal at its corners; -1 where one of
    /// them has no direction.
    pub(super) fn uprightness(&self, corners: [VertexId; 3]) -> f64 {
        let area = shape::area_vector(corners.map(|v| self.at(v)));
        let mean: DVec3 = corners.iter().map(|v| self.normals[v.index()]).sum();
        let cosine = area.normalize_or_zero().dot(mean.normalize_or_zero());
        if cosine == 0.0 { -1.0 } else { cosine }
    }

    /// Whether a change keeps the surface embedded and upright: see the head.
    pub(super) fn accepts(&mut self, change: &Change<'_>, upright_before: f64) -> bool {
        let limit = upright_before.min(STEEPEST);
        let reach = self.buckets.reach();
        let fits = |t: &[VertexId; 3]| {
            let b = Box3::of(t.map(|v| self.at(v)));
            (b.max - b.min).max_element() <= reach && self.uprightness(*t) >= limit
        };
        if !change.after.iter().all(fits) {
            self.refused.shape += 1;
            return false;
        }
        let safe = self.keeps_embedded(change);
        self.refused.intersection += u64::from(!safe);
        safe
    }

    /// The exact part: see the head.
    fn keeps_embedded(&self, change: &Change<'_>) -> bool {
        let &Change { apex, disc, before, after } = change;
        let at = |v| self.at(v);
        for (i, &s) in after.iter().enumerate() {
            if after[..i].iter().any(|&t| meet_in_more(at, s, t)) {
                return false;
            }
        }
        let tip = self.at(apex);
        let added: Vec<Box3> = after.iter().map(|t| Box3::of(t.map(|v| self.at(v)))).collect();
        let swept: Vec<Box3> = before.iter().map(|&[a, b, c]| Box3::of([a, b, c, tip])).collect();
        let around = added.iter().chain(&swept).fold(Box3::EMPTY, |all, b| all.union(b));
        // Vertices of the new triangles are corners of the region.
        let at_corner = |v: VertexId| after.iter().flatten().any(|&w| w == v);
        let sweeps = |v: VertexId| {
            let p = self.at(v);
            let contains = |(b, &[x, y, z]): (&Box3, &[DVec3; 3])| {
                b.contains(p) && tetrahedron_contains([x, y, z, tip], p)
            };
            around.contains(p) && !at_corner(v) && swept.iter().zip(before).any(contains)
        };
        self.buckets.all_near(&around, |t, own| {
            if disc.contains(&t) {
                return true;
            }
            let corners = self.mesh.corners(t);
            let meets = |(b, new): (&Box3, &[VertexId; 3])| own.meets(b) && meet_in_more(at, corners, *new);
            let enclosed = || {
                corners.iter().all(|&v| at_corner(v))
                    && lies_between(before, tip, corners.map(|v| self.at(v)))
            };
            let hit = added.iter().zip(after).any(meets) || corners.iter().any(|&v| sweeps(v)) || enclosed();
            !hit
        })
    }
}

/// Whether a triangle may lie within the tetrahedra that join triangles of a disc to an apex: meets a side
/// between two of them in more than common corners and edges, or has a corner in one that it is no corner of.
/// Names are positions here: different vertices lie at different places.
fn lies_between(disc: &[[DVec3; 3]], apex: DVec3, corners: [DVec3; 3]) -> bool {
    let edges = || disc.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut inner = edges().filter(|&(p, q)| edges().any(|other| other == (q, p)));
    let within = |&[x, y, z]: &[DVec3; 3]| {
        let tetrahedron = [x, y, z, apex];
        corners.iter().any(|p| !tetrahedron.contains(p) && tetrahedron_contains(tetrahedron, *p))
    };
    disc.iter().any(within)
        || inner.any(|(p, q)| {
            let [a, b, c] = corners;
            let points = [a, b, c, apex, p, q];
            let name =
                |point: DVec3| VertexId::from_index(points.iter().position(|&x| x == point).unwrap_or(0));
            meet_in_more(|v| points[v.index()], corners.map(name), [apex, p, q].map(name))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Sphere, sphere};
    use crate::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

    /// An octahedron, and a tetrahedron of size 0.1 above its top.
    fn octahedron_and_speck() -> Workpiece<'static, fn(DVec3) -> f64> {
        let mut positions: Vec<DVec3> = DVec3::AXES.iter().flat_map(|&axis| [axis, -axis]).collect();
        let top = |x: u32, y: u32| if x == y { [x, 2 + y, 4] } else { [2 + y, x, 4] };
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for (x, y) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let [a, b, c] = top(x, y);
            triangles.extend([[a, b, c], [b, a, c + 1]]);
        }
        let speck = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        positions.extend(speck.map(|p| 0.1 * p + DVec3::new(0.0, 0.0, 1.5)));
        triangles.extend([[6, 8, 7], [6, 7, 9], [7, 8, 9], [8, 6, 9]]);
        let soup = TriangleSoup { positions: positions.clone(), triangles, ..TriangleSoup::default() };
        let mesh = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
        let field: &'static fn(DVec3) -> f64 = &((|p| p.length() - 1.0) as fn(DVec3) -> f64);
        Workpiece::new(field, 4.0, Connectivity::new(&mesh).unwrap(), positions)
    }

    #[test]
    fn a_vertex_does_not_jump_over_another_part_of_the_surface() {
        let mut piece = octahedron_and_speck();
        let top = VertexId(4);
        let upward = |z: f64| DVec3::new(0.0, 0.0, z);
        assert!(piece.try_move(top, upward(1.4), 1.0), "below the speck");
        assert_eq!(piece.refused.intersection, 0);
        assert!(!piece.try_move(top, upward(1.55), 1.0), "into the speck");
        assert!(
            !piece.try_move(top, upward(3.0), 1.0),
            "beyond: nothing intersects, but the speck would be inside"
        );
        assert_eq!(piece.refused.intersection, 2);
        assert_eq!(piece.at(top), upward(1.4));
        // With the speck out of the way it is free.
        for v in 6..10 {
            assert!(piece.mesh.has_vertex(VertexId(v)));
            piece.positions[v as usize].x += 9.0;
        }
        piece.rebuild();
        assert!(piece.try_move(top, upward(3.0), 1.0));
    }

    #[test]
    fn a_vertex_does_not_turn_its_triangles_over() {
        let mut piece = octahedron_and_speck();
        assert!(!piece.try_move(VertexId(4), DVec3::new(0.0, 0.0, -0.5), 1.0));
        assert_eq!((piece.refused.shape, piece.refused.intersection), (1, 0));
    }

    #[test]
    fn a_tetrahedron_does_not_turn_inside_out() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let soup = TriangleSoup { positions: positions.clone(), triangles, ..TriangleSoup::default() };
        let mesh = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
        let field = |p: DVec3| p.length() - 1.0;
        let mut piece = Workpiece::new(&field, 1.0, Connectivity::new(&mesh).unwrap(), positions);
        let top = VertexId(3);
        let disc = piece.star(top);
        let before: Vec<_> = disc.iter().map(|&t| piece.corners(t)).collect();
        let after: Vec<_> = disc.iter().map(|&t| piece.mesh.corners(t)).collect();
        let mut allows = |x: f64, z: f64| {
            piece.positions[3] = DVec3::new(x, x, z);
            piece.keeps_embedded(&Change { apex: top, disc: &disc, before: &before, after: &after })
        };
        assert!(allows(0.0, 0.5) && allows(0.3, 1e-300) && allows(5.0, 0.1));
        assert!(!allows(0.3, 0.0), "flat");
        assert!(!allows(0.3, -1e-300) && !allows(0.0, -1.0) && !allows(-0.1, -0.5) && !allows(0.3, -0.5));
    }

    #[test]
    fn what_may_be_near_is_what_the_plain_search_finds() {
        let surface = sphere(&Sphere { edge_length: 0.3, ..Sphere::default() }).unwrap();
        let field = |p: DVec3| p.length() - 1.0;
        let connectivity = Connectivity::new(&surface).unwrap();
        let mut piece = Workpiece::new(&field, 0.05, connectivity, surface.positions().to_vec());
        for round in 0..3 {
            for (i, t) in piece.mesh.triangles().collect::<Vec<_>>().into_iter().enumerate() {
                let around = Box3::of(piece.corners(t));
                let mut found: Vec<TriId> = Vec::new();
                piece.buckets.all_near(&around, |t, _| {
                    found.push(t);
                    true
                });
                found.sort_unstable();
                found.dedup();
                let meets = |&t: &TriId| Box3::of(piece.corners(t)).meets(&around);
                assert_eq!(found, piece.mesh.triangles().filter(meets).collect::<Vec<_>>(), "{i}");
            }
            // Once with other places, once with triangles gone.
            let limit = [0.25, 0.3, 0.0][round];
            let short = piece.mesh.edges().filter(|&h| piece.squared(h) < limit * limit).collect::<Vec<_>>();
            for h in short {
                let target = if piece.mesh.has_triangle(h.triangle()) { piece.middle(h).0 } else { continue };
                piece.try_collapse(h, target, 1.0, 1.0);
            }
        }
    }
}
