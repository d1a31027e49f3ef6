//! Moebius bands of thickness: [`moebius`], [`double_moebius`].
//!
//! A thickened band is a solid whose boundary is closed and orientable: a torus, since the rectangle that is
//! carried round meets itself after its half turn. Method: a rectangle swept along a circle.

use super::error::{ShapeError, divisions, require, require_length, require_triangles};
use super::sweep::{Sweep, sweep};
use crate::surface::ClosedOrientedMesh;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Parameters of [`moebius`] and [`double_moebius`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moebius {
    /// Radius of the centre circle. Default: 1.
    pub radius: f64,
    /// Width of the band, less than the diameter of the centre circle. Default: 0.7.
    pub width: f64,
    /// Thickness of the band, at most its width. Default: 0.15.
    pub thickness: f64,
    /// Number of half turns in the whole length, between -100 and 100; odd: the band has one side. Default: 1.
    pub half_turns: i32,
    /// Distance of neighbouring vertices along the centre circle and around the rectangle. Default: 0.05 (about
    /// 9,000 triangles; the double band, twice as long, has twice as many).
    pub edge_length: f64,
}

impl Default for Moebius {
    fn default() -> Self {
        Self { radius: 1.0, width: 0.7, thickness: 0.15, half_turns: 1, edge_length: 0.05 }
    }
}

/// A Moebius band of thickness, once round: genus 1, no self-intersection.
///
/// ```
/// use welter_meshing::shapes::{Moebius, moebius};
/// let mesh = moebius(&Moebius { edge_length: 0.1, ..Moebius::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn moebius(parameters: &Moebius) -> Result<ClosedOrientedMesh, ShapeError> {
    band(parameters, 1)
}

/// A Moebius band of thickness that goes twice round the same circle: genus 1. With one half turn in all, the
/// second lap stands at right angles to the first, and the two cross along the whole circle; the winding
/// number is 2 there.
///
/// ```
/// use welter_meshing::shapes::{Moebius, double_moebius};
/// let mesh = double_moebius(&Moebius { edge_length: 0.1, ..Moebius::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn double_moebius(parameters: &Moebius) -> Result<ClosedOrientedMesh, ShapeError> {
    band(parameters, 2)
}

fn band(parameters: &Moebius, laps: u32) -> Result<ClosedOrientedMesh, ShapeError> {
    let &Moebius { radius, width, thickness, half_turns, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("width", width)?;
    require_length("thickness", thickness)?;
    require(width < 2.0 * radius, "width", width, "less than the diameter of the centre circle")?;
    require(thickness <= width, "thickness", thickness, "at most the width")?;
    require((-100..=100).contains(&half_turns), "half_turns", f64::from(half_turns), "between -100 and 100")?;
    let length = f64::from(laps) * TAU * radius;
    require_length("edge_length", edge_length)?;
    let steps = divisions(length, edge_length, 7 * laps);
    let around = 2.0 * (divisions(width, edge_length, 1) + divisions(thickness, edge_length, 1));
    require_triangles(edge_length, 2.0 * steps * around)?;
    // An odd number of steps, so that the points of the second lap lie between those of the first.
    let steps = steps as u32 | 1;
    let centers = (0..steps)
        .map(|i| {
            let angle = f64::from(laps) * TAU * f64::from(i) / f64::from(steps);
            let (sin, cos) = libm::sincos(angle);
            DVec3::new(radius * cos, radius * sin, 0.0)
        })
        .collect();
    let profile = rectangle(width, thickness, edge_length);
    let half_turn = profile.len() as i32 / 2;
    sweep(&Sweep { centers, closed: true, profile, twist: half_turns * half_turn })
}

/// Points around a rectangle about the origin, counterclockwise; the second half are exact opposites of the first.
fn rectangle(width: f64, thickness: f64, edge_length: f64) -> Vec<DVec2> {
    let (w, h) = (0.5 * width, 0.5 * thickness);
    let [along, across] = [width, thickness].map(|side| divisions(side, edge_length, 1) as u32);
    let mut half = Vec::new();
    half.extend((0..across).map(|i| DVec2::new(w, -h + thickness * f64::from(i) / f64::from(across))));
    half.extend((0..along).map(|i| DVec2::new(w - width * f64::from(i) / f64::from(along), h)));
    let opposite: Vec<_> = half.iter().map(|&p| -p).collect();
    half.extend(opposite);
    half
}
