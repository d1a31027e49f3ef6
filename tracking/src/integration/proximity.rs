//! Repulsion: elements that are near before the step are sent apart.
//!
//! # What it computes
//! [`Proximities`]: the pairs of elements without a common vertex that are nearer than a distance on the surface at
//! rest, with their closest points. [`repel`] changes the ends so that each pair, one after the other, leaves the step
//! with that distance along the direction between its closest points, if the pair moves alone.
//!
//! # What it promises
//! Positions are not touched, only ends; the sum of masses times displacements is kept to rounding, where no vertex is
//! immovable. Nothing about safety: this makes collisions rare, it does not exclude them.
//!
//! # Method
//! The first phase of \[Brochu12, section 3.2.7\], in displacements. Most candidates of the broad phase are
//! neighbours on the surface; a direction between their centres, or the normal of the triangle, tells that they are farther
//! apart than the distance at a fraction of the cost of closest points. That test is rounded; a proximity is no promise.

use super::contact::{Contact, ElementPair};
use super::friction::rub;
use super::step::Step;
use super::{IntegrationError, IntegrationParameters};
use crate::broad_phase::BroadPhase;
use crate::collision::{MinimumSeparationParameters, closest_points, length, minimum_separation, unit};
use crate::surface::MovingSurface;
use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::Monitor;

/// Pairs nearer than a distance, sorted.
pub(super) struct Proximities {
    distance: f64,
    near: Vec<Proximity>,
}

struct Proximity {
    contact: Contact,
    distance: f64,
}

impl Proximities {
    /// Finds them; the broad phase is at rest.
    pub(super) fn find(
        surface: &MovingSurface,
        broad_phase: &BroadPhase,
        reference_length: f64,
        parameters: &IntegrationParameters,
        monitor: &Monitor<'_>,
    ) -> Result<Self, IntegrationError> {
        let distance = parameters.proximity_rel * reference_length;
        if distance == 0.0 {
            return Ok(Self { distance, near: Vec::new() });
        }
        let (mesh, unit) = (surface.connectivity(), reciprocal_power(reference_length));
        let places = |pair: ElementPair| pair.vertices(mesh).map(|v| surface.position(v));
        let may_be_near = |pair: ElementPair| {
            !monitor.is_cancelled() && !clearly_apart(pair, places(pair), unit, distance * unit)
        };
        let vertex_triangle = broad_phase.vertex_triangle_pairs_that(mesh, distance, |v, t| {
            may_be_near(ElementPair::VertexTriangle(v, t))
        })?;
        let edge_edge =
            broad_phase.edge_edge_pairs_that(mesh, distance, |a, b| may_be_near(ElementPair::edges(a, b)))?;
        monitor.check()?;
        let pairs: Vec<ElementPair> = vertex_triangle
            .into_iter()
            .map(|(v, t)| ElementPair::VertexTriangle(v, t))
            .chain(edge_edge.into_iter().map(|[a, b]| ElementPair::EdgeEdge(a, b)))
            .collect();
        let measured = pairs.par_iter().map(|&pair| Proximity::of(pair, surface, distance));
        let near = measured.filter_map(|proximity| proximity).collect();
        Ok(Self { distance, near })
    }

    pub(super) fn len(&self) -> usize {
        self.near.len()
    }
}

/// Whether the elements of a pair are within a distance at rest.
pub(super) fn is_near(
    pair: ElementPair,
    surface: &MovingSurface,
    reference_length: f64,
    distance: f64,
) -> bool {
    if distance == 0.0 {
        return false;
    }
    let (mesh, unit) = (surface.connectivity(), reciprocal_power(reference_length));
    let places = pair.vertices(mesh).map(|v| surface.position(v));
    !clearly_apart(pair, places, unit, distance * unit) && Proximity::of(pair, surface, distance).is_some()
}

impl Proximity {
    /// The proximity of a pair, if its elements are within the distance.
    fn of(pair: ElementPair, surface: &MovingSurface, distance: f64) -> Option<Self> {
        const FINITE: &str = "positions are finite";
        let vertices = pair.vertices(surface.connectivity());
        let places = vertices.map(|v| surface.position(v));
        let closest = match pair {
            ElementPair::VertexTriangle(..) => closest_points::vertex_face(places),
            ElementPair::EdgeEdge(..) => closest_points::edge_edge(places),
        };
        let closest = closest.expect(FINITE);
        if closest.distance[0] >= distance {
            return None;
        }
        let contact = Contact { vertices, weights: pair.signed(closest.weights), normal: DVec3::ZERO };
        let apart = contact.weighted(places);
        if closest.distance[0] > 0.0
            && let Some(normal) = unit(apart)
        {
            return Some(Self { contact: Contact { normal, ..contact }, distance: length(apart) });
        }
        // Rounding leaves no direction: that of a contact, with all its choices.
        let parameters = MinimumSeparationParameters { distance, ..Default::default() };
        let approach = match pair {
            ElementPair::VertexTriangle(..) => minimum_separation::vertex_face(places, places, &parameters),
            ElementPair::EdgeEdge(..) => minimum_separation::edge_edge(places, places, &parameters),
        };
        let normal = DVec3::from_array(approach.expect(FINITE)?.normal);
        Some(Self { contact: Contact { normal, ..contact }, distance: 0.0 })
    }
}

/// The power of two that brings a length to [1/2, 1), or the next that is a number.
fn reciprocal_power(length: f64) -> f64 {
    libm::scalbn(1.0, (-libm::frexp(length).1).clamp(-1022, 1023))
}

/// Whether a direction tells that two elements are farther apart than a distance: computed in units of the reference
/// length, so that products are the same at every scale.
fn clearly_apart(pair: ElementPair, [a, b, c, d]: [DVec3; 4], unit: f64, distance: f64) -> bool {
    let along = |direction: DVec3, corners: [DVec3; 4]| {
        let limit = distance * direction.length();
        let products = corners.map(|p| direction.dot(p));
        products.iter().all(|&x| x > limit) || products.iter().all(|&x| x < -limit)
    };
    match pair {
        ElementPair::VertexTriangle(..) => {
            let [b, c, d] = [b, c, d].map(|p| (p - a) * unit);
            let corners = [b, c, d, d];
            along((b + c) + d, corners) || along((c - b).cross(d - b), corners)
        }
        ElementPair::EdgeEdge(..) => {
            let corners = [(c - a) * unit, (c - b) * unit, (d - b) * unit, (d - a) * unit];
            let centre = (corners[0] + corners[1]) + (corners[2] + corners[3]);
            along(centre, corners) || along((corners[1] - corners[0]).cross(corners[3] - corners[0]), corners)
        }
    }
}

/// Sends the elements of each pair apart, in their order.
pub(super) fn repel(step: &mut Step<'_>, proximities: &Proximities) {
    for Proximity { contact, distance } in &proximities.near {
        let approach = -contact.normal.dot(step.relative(contact));
        let change = (proximities.distance - distance) + approach;
        if change > 0.0 && step.push(contact, contact.normal, change) {
            step.report.repulsions += 1;
            rub(step, contact, approach);
        }
    }
}
