//! Null-space smoothing \[Jiao07\] \[Brochu12, section 3.2.4\].
//!
//! Rule: each vertex goes towards the mean of its triangles' centroids, weighted by area, but only in the null space of its
//! quadric metric tensor: within the surface where that is smooth, along a ridge, not at all at a corner. Then along its mean
//! normal, so that it takes no volume from its triangles, nor adds any: without, curved surfaces would shrink. Or, if
//! [`ImprovementParameters::keeps_volume`] is off, onto the polynomial fitted to the vertices around it. On a boundary
//! it goes along the boundary, towards the middle between its neighbours; immovable vertices and those where more than two
//! sheets meet stay. No vertex goes farther than [`REACH`] of its nearest neighbour's distance. All go at once, as
//! a pseudo-motion, which is made safe as any other motion.

use super::ImprovementParameters;
use super::osculating::Osculating;
use super::shape::volume_preserving;
use crate::quadric::VertexQuadric;
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;
use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::VertexId;

/// Of two neighbours that go towards each other none passes the other, nor does a vertex of a fair triangle pass the
/// opposite side.
const REACH: f64 = 0.25;

/// Where smoothing would put the vertices, by slot.
pub(crate) fn smoothed(surface: &MovingSurface, parameters: &ImprovementParameters) -> Vec<DVec3> {
    let slots = 0..surface.connectivity().vertex_slots();
    slots.into_par_iter().map(|v| place(surface, VertexId::from_index(v), parameters)).collect()
}

fn place(surface: &MovingSurface, v: VertexId, parameters: &ImprovementParameters) -> DVec3 {
    let mesh = surface.connectivity();
    let here = surface.position(v);
    if !mesh.has_vertex(v) || surface.masses()[v.index()].is_infinite() {
        return here;
    }
    let scale = Scale::of_star(surface, v);
    let (mut sum, mut weight, mut nearest) = (DVec3::ZERO, 0.0, f64::INFINITY);
    let mut ends = [None; 2];
    for h in mesh.star(v) {
        let [p, q] = [mesh.head(h), mesh.apex(h)].map(|w| scale.difference(surface.position(w), here));
        let area = p.cross(q).length();
        sum += area * ((p + q) / 3.0);
        weight += area;
        nearest = nearest.min(p.length()).min(q.length());
        for (edge, way) in [(mesh.edge(h), p), (mesh.edge(h.previous()), q)] {
            match mesh.edge_triangles(edge) {
                2 => {}
                1 => match ends.iter_mut().find(|end| end.is_none()) {
                    Some(end) => *end = Some(way),
                    None => return here,
                },
                _ => return here,
            }
        }
    }
    let quadric = VertexQuadric::new(surface, v);
    let way = match ends {
        [Some(p), Some(q)] => along_boundary(p, q),
        _ if weight > 0.0 => quadric.null_part(sum / weight, parameters.ridge_threshold),
        _ => DVec3::ZERO,
    };
    let length = way.length();
    let most = REACH * nearest;
    let way = if length > most { (most / length) * way } else { way };
    let mut moved = here + scale.restored(way);
    if ends == [None; 2] && length > 0.0 {
        if !parameters.keeps_volume && quadric.rank(parameters.ridge_threshold) == 1 {
            let fit = Osculating::fit(surface, v, quadric.normal());
            if let Some(place) = fit.and_then(|fit| fit.place(scale.restored(way))) {
                return place;
            }
        }
        let triangles = mesh.star(v).map(|h| mesh.corners(h.triangle()).map(|w| surface.position(w)));
        moved = volume_preserving(&triangles.collect::<Vec<_>>(), moved);
    }
    if moved.is_finite() { moved } else { here }
}

/// Towards the middle between two neighbours on a boundary, along it; nowhere where it bends by more than 60 degrees.
fn along_boundary(p: DVec3, q: DVec3) -> DVec3 {
    if -p.dot(q) < 0.5 * p.length() * q.length() {
        return DVec3::ZERO;
    }
    let tangent = (q - p).normalize_or_zero();
    tangent.dot(0.5 * (p + q)) * tangent
}
