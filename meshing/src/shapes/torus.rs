//! The torus: [`torus`].

use super::error::{
    ShapeError, divisions, finish, require, require_coordinates, require_length, require_triangles,
};
use super::rings::RingBuilder;
use crate::surface::ClosedOrientedMesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// Parameters of [`torus`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Centre. Default: the origin.
    pub center: DVec3,
    /// Radius of the centre circle, about the z axis. Default: 1.
    pub radius: f64,
    /// Radius of the tube, less than that of the centre circle. Default: 0.4.
    pub tube_radius: f64,
    /// Distance of neighbouring vertices along the centre circle and around the tube. Default: 0.06 (about 9,000
    /// triangles).
    pub edge_length: f64,
}

impl Default for Torus {
    fn default() -> Self {
        Self { center: DVec3::ZERO, radius: 1.0, tube_radius: 0.4, edge_length: 0.06 }
    }
}

/// A torus of revolution: genus 1, no self-intersection.
///
/// ```
/// use welter_meshing::shapes::{Torus, torus};
/// let mesh = torus(&Torus { edge_length: 0.2, ..Torus::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn torus(parameters: &Torus) -> Result<ClosedOrientedMesh, ShapeError> {
    let &Torus { center, radius, tube_radius, edge_length } = parameters;
    require_coordinates("center", center)?;
    require_length("radius", radius)?;
    require_length("tube_radius", tube_radius)?;
    require(tube_radius < radius, "tube_radius", tube_radius, "less than the radius of the centre circle")?;
    require_length("edge_length", edge_length)?;
    let around = divisions(TAU * radius, edge_length, 3);
    let across = divisions(TAU * tube_radius, edge_length, 3);
    require_triangles(edge_length, 2.0 * around * across)?;
    let (around, across) = (around as u32, across as u32);
    let mut rings = RingBuilder::default();
    for i in 0..around {
        let (sin, cos) = libm::sincos(TAU * f64::from(i) / f64::from(around));
        rings.push((0..across).map(|j| {
            // Counterclockwise about the direction of advance: from outward to upward is clockwise.
            let (height, outward) = libm::sincos(-TAU * f64::from(j) / f64::from(across));
            let r = radius + tube_radius * outward;
            center + DVec3::new(r * cos, r * sin, tube_radius * height)
        }));
    }
    rings.close(0);
    Ok(finish(rings.finish()))
}
