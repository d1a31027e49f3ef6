//! Where new and merged vertices go: subdivision schemes and the quadric metric tensor.
//!
//! Butterfly \[Dyn90\]: for the edge `p1 p2` with apexes `q1 q2` and the four apexes `r` beyond the other sides of its two
//! triangles, `(8 (p1 + p2) + 2 (q1 + q2) - (r1 + r2 + r3 + r4)) / 16` \[Brochu12, section 3.2.4\]. It reproduces cubics on a
//! regular triangulation, so a smooth surface keeps its shape.
//!
//! Modified butterfly \[Zorin96\]: where an end has another number of neighbours than six, its own stencil with weights by
//! the number of its neighbours; the mean of both where both ends do.
//!
//! Fitted: on the polynomials through the vertices around the ends, [`Osculating`].
//!
//! On a boundary the four-point scheme along it: `(9 (p1 + p2) - (o1 + o2)) / 16`.
//!
//! On creases none of these applies: they would round them off. There the middle is taken; and where a stencil reaches beyond
//! a crease, the point there is replaced by the one of a flat continuation.

use super::SplitScheme;
use super::osculating::Osculating;
use super::shape::unit_normal;
use super::workpiece::Workpiece;
use crate::quadric::VertexQuadric;
use crate::surface::HalfEdge;
use glam::DVec3;
use std::f64::consts::TAU;
use welter_meshing::surface::{EdgeId, VertexId};

/// On what a vertex lies \[Jiao07\].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Feature {
    Smooth,
    Ridge,
    Corner,
}

impl Feature {
    pub(crate) fn of(piece: &Workpiece<'_>, v: VertexId) -> Self {
        match VertexQuadric::new(piece.surface, v).rank(piece.parameters.ridge_threshold) {
            0 | 1 => Self::Smooth,
            2 => Self::Ridge,
            _ => Self::Corner,
        }
    }
}

/// Where the scheme puts the new vertex of an edge; none where it says nothing but the middle.
pub(crate) fn of_split(piece: &Workpiece<'_>, edge: EdgeId) -> Option<DVec3> {
    if piece.parameters.split_scheme == SplitScheme::Midpoint {
        return None;
    }
    let mesh = piece.surface.connectivity();
    let ends = mesh.ends(edge);
    let Some(sides) = piece.two_sides(edge) else {
        return if mesh.is_boundary(edge) { four_point(piece, edge) } else { None };
    };
    if is_crease(piece, sides) {
        return None;
    }
    match piece.parameters.split_scheme {
        SplitScheme::Midpoint => None,
        SplitScheme::Butterfly => butterfly(piece, sides),
        SplitScheme::ModifiedButterfly => modified_butterfly(piece, sides),
        SplitScheme::Quadric => quadric(piece, ends),
        SplitScheme::Fitted => fitted(piece, ends),
    }
}

/// Where the scheme puts what remains of an edge whose ends are on a smooth patch.
pub(crate) fn of_collapse(piece: &Workpiece<'_>, edge: EdgeId) -> Option<DVec3> {
    let sides = piece.two_sides(edge)?;
    match piece.parameters.split_scheme {
        SplitScheme::Midpoint => None,
        SplitScheme::Butterfly => butterfly(piece, sides),
        SplitScheme::ModifiedButterfly => modified_butterfly(piece, sides),
        SplitScheme::Quadric => quadric(piece, piece.surface.connectivity().ends(edge)),
        SplitScheme::Fitted => fitted(piece, piece.surface.connectivity().ends(edge)),
    }
    .filter(|place| place.is_finite())
}

/// Whether the triangles of two half-edges differ in their normals by more than the crease angle.
fn is_crease(piece: &Workpiece<'_>, sides: [HalfEdge; 2]) -> bool {
    let [n, m] = sides.map(|h| unit_normal(piece.places(h.triangle())));
    n.dot(m) < piece.crease_cosine
}

/// The apex of the triangle beyond a half-edge, if there is just one. Beyond a crease there is another patch, which says nothing of
/// this one: there, it is where it would be on a flat regular triangulation.
fn beyond(piece: &Workpiece<'_>, h: HalfEdge) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let [s, t] = piece.two_sides(mesh.edge(h))?;
    let other = if s == h { t } else { s };
    if is_crease(piece, [h, other]) {
        return Some(piece.at(mesh.tail(h)) + piece.at(mesh.head(h)) - piece.at(mesh.apex(h)));
    }
    Some(piece.at(mesh.apex(other)))
}

fn butterfly(piece: &Workpiece<'_>, sides: [HalfEdge; 2]) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let [h, o] = sides;
    let ends = piece.at(mesh.tail(h)) + piece.at(mesh.head(h));
    let apexes = piece.at(mesh.apex(h)) + piece.at(mesh.apex(o));
    let mut wings = DVec3::ZERO;
    for side in sides {
        wings += beyond(piece, side.next())? + beyond(piece, side.previous())?;
    }
    Some((8.0 * ends + 2.0 * apexes - wings) / 16.0)
}

fn modified_butterfly(piece: &Workpiece<'_>, sides: [HalfEdge; 2]) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let [h, o] = sides;
    let valence = |v: VertexId| mesh.vertex_triangles(v);
    let irregular: Vec<HalfEdge> = [h, o].into_iter().filter(|&h| valence(mesh.tail(h)) != 6).collect();
    match irregular[..] {
        [] => butterfly(piece, sides),
        [one] => around(piece, one).or_else(|| butterfly(piece, sides)),
        _ => match (around(piece, h), around(piece, o)) {
            (Some(p), Some(q)) => Some(0.5 * p + 0.5 * q),
            (p, q) => p.or(q).or_else(|| butterfly(piece, sides)),
        },
    }
}

/// The stencil of an irregular vertex, the tail of `h`: the new vertex is towards the head.
fn around(piece: &Workpiece<'_>, h: HalfEdge) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let count = mesh.vertex_triangles(mesh.tail(h));
    // The neighbours in order, beginning with the head.
    let mut neighbours = Vec::with_capacity(count);
    let mut at = h;
    for _ in 0..count {
        neighbours.push(piece.at(mesh.head(at)));
        let back = at.previous();
        let [s, t] = piece.two_sides(mesh.edge(back))?;
        if is_crease(piece, [s, t]) {
            return None;
        }
        at = if s == back { t } else { s };
    }
    if at != h {
        return None;
    }
    let weight = |j: usize| match (count, j) {
        (3, 0) => 5.0 / 12.0,
        (3, _) => -1.0 / 12.0,
        (4, 0) => 3.0 / 8.0,
        (4, 2) => -1.0 / 8.0,
        (4, _) => 0.0,
        _ => {
            let angle = TAU * j as f64 / count as f64;
            (0.25 + libm::cos(angle) + 0.5 * libm::cos(2.0 * angle)) / count as f64
        }
    };
    // Weights sum to one with that of the vertex itself, 3/4.
    let centre = piece.at(mesh.tail(h));
    Some(neighbours.iter().enumerate().fold(centre, |sum, (j, &p)| sum + weight(j) * (p - centre)))
}

/// Along a boundary; nothing at its corners.
fn four_point(piece: &Workpiece<'_>, edge: EdgeId) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let [a, b] = mesh.ends(edge);
    let other = |v: VertexId, beside: VertexId| {
        let mut found = None;
        for e in mesh.edges_at(v).into_iter().filter(|&e| mesh.is_boundary(e)) {
            let far = mesh.other_end(e, v);
            if far != beside && found.replace(far).is_some() {
                return None;
            }
        }
        found.map(|far| piece.at(far))
    };
    let (pa, pb) = (piece.at(a), piece.at(b));
    let (oa, ob) = (other(a, b)?, other(b, a)?);
    let bends = |p: DVec3, q: DVec3, r: DVec3| (q - p).dot(r - q) <= 0.5 * q.distance(p) * r.distance(q);
    if bends(oa, pa, pb) || bends(pa, pb, ob) {
        return None;
    }
    Some((9.0 * (pa + pb) - (oa + ob)) / 16.0)
}

/// The point nearest to the planes of the triangles at both ends, on the plane across the middle of the edge.
fn quadric(piece: &Workpiece<'_>, ends: [VertexId; 2]) -> Option<DVec3> {
    let mesh = piece.surface.connectivity();
    let [pa, pb] = ends.map(|v| piece.at(v));
    let middle = 0.5 * pa + 0.5 * pb;
    let tensors = ends.map(|v| VertexQuadric::new(piece.surface, v));
    // Along the mean normal alone: in other directions the planes say little on a smooth patch.
    let mut normal = DVec3::ZERO;
    for tensor in &tensors {
        let n = tensor.normal();
        normal += if n.dot(normal) < 0.0 { -n } else { n };
    }
    let along = (pb - pa).normalize_or_zero();
    let normal = (normal - normal.dot(along) * along).normalize_or_zero();
    let (mut numerator, mut denominator) = (0.0, 0.0);
    for t in ends.iter().flat_map(|&v| mesh.star(v)).map(|h| h.triangle()) {
        let [a, b, c] = piece.places(t);
        let area = (b - a).cross(c - a) / (piece.length * piece.length);
        let weight = area.length();
        let n = area.normalize_or_zero();
        let slope = n.dot(normal);
        numerator += weight * slope * n.dot(a - middle);
        denominator += weight * slope * slope;
    }
    (denominator > 0.0).then(|| middle + numerator / denominator * normal)
}

/// The mean of where the polynomials around both ends have the middle of the edge.
fn fitted(piece: &Workpiece<'_>, ends: [VertexId; 2]) -> Option<DVec3> {
    let [a, b] = ends;
    let from = |v: VertexId, w: VertexId| {
        let fit = Osculating::fit(piece.surface, v, VertexQuadric::new(piece.surface, v).normal())?;
        let half = 0.5 * (piece.at(w) - piece.at(v));
        fit.place(half)
    };
    match (from(a, b), from(b, a)) {
        (Some(p), Some(q)) => Some(0.5 * p + 0.5 * q),
        (p, q) => p.or(q),
    }
}
