//! Whether a motion needs no resolution at all: [`is_free`].
//!
//! Most steps of most flows are such. One descent of the broad phase asks for proximities and collisions at once, and ends at
//! the first of them.

use super::contact::ElementPair;
use super::proximity::is_near;
use super::{IntegrationError, IntegrationParameters};
use crate::broad_phase::{BroadPhase, Motion};
use crate::surface::MovingSurface;
use glam::DVec3;
use std::sync::atomic::{AtomicBool, Ordering};
use welter_meshing::Monitor;

/// Whether no two elements without a common vertex are near each other at the beginning, or touch on the straight ways to some
/// ends: then [`resolve`](super::resolve) would return just these ends. The broad phase holds the motion afterwards.
///
/// # Errors
/// As [`resolve`](super::resolve).
pub(crate) fn is_free(
    surface: &MovingSurface,
    broad_phase: &mut BroadPhase,
    ends: &[DVec3],
    length: f64,
    parameters: &IntegrationParameters,
    monitor: &Monitor<'_>,
) -> Result<bool, IntegrationError> {
    broad_phase.refresh(surface, Motion::To(ends))?;
    let broad_phase = &*broad_phase;
    let (mesh, distance) = (surface.connectivity(), parameters.proximity_rel * length);
    let disturbed = AtomicBool::new(false);
    let ask = |pair: ElementPair| {
        if disturbed.load(Ordering::Relaxed) || monitor.is_cancelled() {
            return false;
        }
        let vertices = pair.vertices(mesh);
        let [from, to] = [vertices.map(|v| surface.position(v)), vertices.map(|v| ends[v.index()])];
        let found = is_near(pair, surface, length, distance) || (from != to && pair.collides(from, to).0);
        if found {
            disturbed.store(true, Ordering::Relaxed);
        }
        found
    };
    let found = broad_phase
        .vertex_triangle_pairs_that(mesh, distance, |v, t| ask(ElementPair::VertexTriangle(v, t)))?;
    if found.is_empty() {
        let _ = broad_phase.edge_edge_pairs_that(mesh, distance, |a, b| ask(ElementPair::edges(a, b)))?;
    }
    monitor.check()?;
    Ok(!disturbed.into_inner())
}
