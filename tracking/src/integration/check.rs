//! The exact static check: [`tangles`].

use super::IntegrationError;
use super::error::Tangle;
use crate::broad_phase::{BroadPhase, Motion};
use crate::surface::MovingSurface;
use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::spatial::meet_in_more;
use welter_meshing::surface::TriId;

/// The pairs of triangles that meet in more than they share, with their vertices at some places; sorted. The broad
/// phase holds the boxes of these places.
pub(super) fn tangles(
    surface: &MovingSurface,
    broad_phase: &BroadPhase,
    places: &[DVec3],
    monitor: &Monitor<'_>,
) -> Result<Vec<[TriId; 2]>, IntegrationError> {
    monitor.check()?;
    let mesh = surface.connectivity();
    let pairs = broad_phase.triangle_pairs_that(0.0, |s, t| {
        !monitor.is_cancelled() && meet_in_more(|v| places[v.index()], mesh.corners(s), mesh.corners(t))
    })?;
    monitor.check()?;
    Ok(pairs)
}

/// All about the first of some pairs.
pub(super) fn first_tangle(
    surface: &MovingSurface,
    places: &[DVec3],
    pairs: &[[TriId; 2]],
) -> Option<Box<Tangle>> {
    let &triangles = pairs.first()?;
    let corners = triangles.map(|t| surface.connectivity().corners(t));
    Some(Box::new(Tangle {
        triangles,
        corners,
        before: corners.map(|t| t.map(|v| surface.position(v))),
        after: corners.map(|t| t.map(|v| places[v.index()])),
    }))
}

/// Refuses a surface that intersects itself. The broad phase must be at rest.
pub(super) fn require_embedded(
    surface: &MovingSurface,
    broad_phase: &BroadPhase,
    monitor: &Monitor<'_>,
) -> Result<(), IntegrationError> {
    let pairs = tangles(surface, broad_phase, surface.positions(), monitor)?;
    match first_tangle(surface, surface.positions(), &pairs) {
        Some(first) => Err(IntegrationError::NotEmbedded { pairs, first }),
        None => Ok(()),
    }
}

/// Refuses places at which the surface intersects itself; gives the broad phase their boxes.
pub(super) fn require_embedded_at(
    surface: &MovingSurface,
    broad_phase: &mut BroadPhase,
    places: &[DVec3],
    monitor: &Monitor<'_>,
) -> Result<(), IntegrationError> {
    broad_phase.refresh(surface, Motion::At(places))?;
    let pairs = tangles(surface, broad_phase, places, monitor)?;
    match first_tangle(surface, places, &pairs) {
        Some(first) => Err(IntegrationError::Intersection { pairs, first }),
        None => Ok(()),
    }
}
