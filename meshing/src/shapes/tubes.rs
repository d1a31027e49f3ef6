//! Round tubes along curves, most of them thick enough to overlap themselves: [`ring_overlap`], [`helix_overlap`],
//! [`trefoil_overlap`], [`figure_eight`].
//!
//! Method: the centre curve is sampled at even arc length and a regular polygon swept along it.

use super::error::{ShapeError, divisions, require, require_length, require_triangles};
use super::sweep::{Sweep, sweep};
use crate::surface::ClosedOrientedMesh;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Parameters of [`ring_overlap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingOverlap {
    /// Mean radius of the ring. Default: 1.
    pub radius: f64,
    /// Radius of the tube, less than that of the ring. Default: 0.3.
    pub tube_radius: f64,
    /// Angle by which the ends overlap, in radians, more than 0 and at most 2 pi. Default: 0.5.
    pub overlap: f64,
    /// How much farther from the ring's centre the tube begins than it ends. Default: 0.15, half the tube's radius,
    /// so that the ends overlap without coinciding; from twice the tube's radius on they do not meet.
    pub drift: f64,
    /// Distance of neighbouring vertices along and around the tube. Default: 0.05 (about 11,000 triangles).
    pub edge_length: f64,
}

impl Default for RingOverlap {
    fn default() -> Self {
        Self { radius: 1.0, tube_radius: 0.3, overlap: 0.5, drift: 0.15, edge_length: 0.05 }
    }
}

/// A tube bent into a ring whose ends overlap: genus 0, winding number 2 in the overlap.
///
/// ```
/// use welter_meshing::shapes::{RingOverlap, ring_overlap};
/// let mesh = ring_overlap(&RingOverlap { edge_length: 0.2, ..RingOverlap::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 4);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn ring_overlap(parameters: &RingOverlap) -> Result<ClosedOrientedMesh, ShapeError> {
    let &RingOverlap { radius, tube_radius, overlap, drift, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("tube_radius", tube_radius)?;
    require(tube_radius < radius, "tube_radius", tube_radius, "less than the radius of the ring")?;
    require(overlap > 0.0 && overlap <= TAU, "overlap", overlap, "an angle of more than 0, at most 2 pi")?;
    require(drift.abs() < radius, "drift", drift, "less than the radius of the ring")?;
    let angle = TAU + overlap;
    let curve = |t: f64| {
        let (sin, cos) = libm::sincos(t * angle);
        let r = radius + drift * (0.5 - t);
        DVec3::new(r * cos, r * sin, 0.0)
    };
    tube(curve, false, tube_radius, edge_length)
}

/// Parameters of [`helix_overlap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixOverlap {
    /// Radius of the coil. Default: 1.
    pub radius: f64,
    /// Radius of the tube, less than that of the coil. Default: 0.25.
    pub tube_radius: f64,
    /// Rise in one turn. Default: 0.35, less than the tube's diameter, so that neighbouring turns overlap.
    pub pitch: f64,
    /// Number of turns, between 0.1 and 1000. Default: 3.
    pub turns: f64,
    /// Distance of neighbouring vertices along and around the tube. Default: 0.07 (about 13,000 triangles).
    pub edge_length: f64,
}

impl Default for HelixOverlap {
    fn default() -> Self {
        Self { radius: 1.0, tube_radius: 0.25, pitch: 0.35, turns: 3.0, edge_length: 0.07 }
    }
}

/// A coil whose neighbouring turns overlap: genus 0.
///
/// ```
/// use welter_meshing::shapes::{HelixOverlap, helix_overlap};
/// let mesh = helix_overlap(&HelixOverlap { edge_length: 0.2, ..HelixOverlap::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 4);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn helix_overlap(parameters: &HelixOverlap) -> Result<ClosedOrientedMesh, ShapeError> {
    let &HelixOverlap { radius, tube_radius, pitch, turns, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("tube_radius", tube_radius)?;
    require(tube_radius < radius, "tube_radius", tube_radius, "less than the radius of the coil")?;
    require_length("pitch", pitch)?;
    require((0.1..=1000.0).contains(&turns), "turns", turns, "between 0.1 and 1000")?;
    let curve = |t: f64| {
        let (sin, cos) = libm::sincos(t * turns * TAU);
        DVec3::new(radius * cos, radius * sin, pitch * turns * (t - 0.5))
    };
    tube(curve, false, tube_radius, edge_length)
}

/// Parameters of [`trefoil_overlap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrefoilOverlap {
    /// Scale of the knot, whose outermost points are at 3 times this distance from its axis. Default: 0.5.
    pub radius: f64,
    /// Half the height of the knot; its strands pass each other at about twice this distance. Default: 0.2.
    pub height: f64,
    /// Radius of the tube. Default: 0.25, so that the strands overlap at the three crossings.
    pub tube_radius: f64,
    /// Distance of neighbouring vertices along and around the tube. Default: 0.06 (about 12,000 triangles).
    pub edge_length: f64,
}

impl Default for TrefoilOverlap {
    fn default() -> Self {
        Self { radius: 0.5, height: 0.2, tube_radius: 0.25, edge_length: 0.06 }
    }
}

/// A closed tube along a flat trefoil knot, overlapping itself at the three crossings: genus 1.
///
/// ```
/// use welter_meshing::shapes::{TrefoilOverlap, trefoil_overlap};
/// let mesh = trefoil_overlap(&TrefoilOverlap { edge_length: 0.2, ..TrefoilOverlap::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn trefoil_overlap(parameters: &TrefoilOverlap) -> Result<ClosedOrientedMesh, ShapeError> {
    let &TrefoilOverlap { radius, height, tube_radius, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("height", height)?;
    require_length("tube_radius", tube_radius)?;
    require(tube_radius < radius, "tube_radius", tube_radius, "less than the radius of the knot")?;
    let curve = |t: f64| {
        let (sin1, cos1) = libm::sincos(t * TAU);
        let (sin2, cos2) = libm::sincos(2.0 * t * TAU);
        let sin3 = libm::sin(3.0 * t * TAU);
        DVec3::new(radius * (sin1 + 2.0 * sin2), radius * (cos1 - 2.0 * cos2), -height * sin3)
    };
    tube(curve, true, tube_radius, edge_length)
}

/// Parameters of [`figure_eight`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureEight {
    /// Half the length of the eight. Default: 1.5.
    pub radius: f64,
    /// Radius of the tube, less than `radius / 5`: the eight's smallest radius of curvature is 0.209 `radius`.
    /// Default: 0.25.
    pub tube_radius: f64,
    /// Distance of neighbouring vertices along and around the tube. Default: 0.06 (about 8,000 triangles).
    pub edge_length: f64,
}

impl Default for FigureEight {
    fn default() -> Self {
        Self { radius: 1.5, tube_radius: 0.25, edge_length: 0.06 }
    }
}

/// A closed tube along the lemniscate (cos t, sin t cos t) that crosses itself in the middle: genus 1, winding
/// number 2 in the crossing.
///
/// ```
/// use welter_meshing::shapes::{FigureEight, figure_eight};
/// let mesh = figure_eight(&FigureEight { edge_length: 0.2, ..FigureEight::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn figure_eight(parameters: &FigureEight) -> Result<ClosedOrientedMesh, ShapeError> {
    let &FigureEight { radius, tube_radius, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("tube_radius", tube_radius)?;
    require(tube_radius < radius / 5.0, "tube_radius", tube_radius, "less than a fifth of the radius")?;
    let curve = |t: f64| {
        let (sin, cos) = libm::sincos(t * TAU);
        DVec3::new(radius * cos, radius * sin * cos, 0.0)
    };
    tube(curve, true, tube_radius, edge_length)
}

/// A round tube about a curve over [0, 1].
fn tube(
    curve: impl Fn(f64) -> DVec3,
    closed: bool,
    radius: f64,
    edge_length: f64,
) -> Result<ClosedOrientedMesh, ShapeError> {
    let arc = ArcLength::new(&curve);
    require_length("edge_length", edge_length)?;
    let along = divisions(arc.length(), edge_length, 6);
    let corners = divisions(TAU * radius, edge_length, 6);
    require_triangles(edge_length, 2.0 * (along + corners) * corners)?;
    let centers = arc.points(&curve, along as u32, closed);
    sweep(&Sweep { centers, closed, profile: regular_polygon(corners as u32, radius), twist: 0 })
}

/// Corners on a circle, counterclockwise from the first axis.
fn regular_polygon(corners: u32, radius: f64) -> Vec<DVec2> {
    (0..corners)
        .map(|i| {
            let (sin, cos) = libm::sincos(TAU * f64::from(i) / f64::from(corners));
            DVec2::new(radius * cos, radius * sin)
        })
        .collect()
}

/// Arc length along a curve over [0, 1] as a table of chords.
pub(crate) struct ArcLength {
    /// Length up to each of the evenly spaced parameters, from 0.
    lengths: Vec<f64>,
}

/// Chords of the table: 65 in each of 1000 turns, many more in each bend of the other curves. Positions along the
/// curve need not be exact, only even.
const CHORDS: usize = 1 << 16;

impl ArcLength {
    pub(crate) fn new(curve: impl Fn(f64) -> DVec3) -> Self {
        let mut lengths = Vec::with_capacity(CHORDS + 1);
        let (mut sum, mut last) = (0.0, curve(0.0));
        lengths.push(0.0);
        for i in 1..=CHORDS {
            let point = curve(i as f64 / CHORDS as f64);
            sum += point.distance(last);
            last = point;
            lengths.push(sum);
        }
        Self { lengths }
    }

    pub(crate) fn length(&self) -> f64 {
        self.lengths[CHORDS]
    }

    /// Points that divide the curve into `count` even pieces; a closed curve's last point is its first.
    pub(crate) fn points(&self, curve: impl Fn(f64) -> DVec3, count: u32, closed: bool) -> Vec<DVec3> {
        let last = if closed { count - 1 } else { count };
        let mut chord = 0;
        (0..=last)
            .map(|i| {
                let target = self.length() * (f64::from(i) / f64::from(count));
                while chord + 1 < CHORDS && self.lengths[chord + 1] < target {
                    chord += 1;
                }
                let (low, high) = (self.lengths[chord], self.lengths[chord + 1]);
                let within = if high > low { ((target - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
                curve((chord as f64 + within) / CHORDS as f64)
            })
            .collect()
    }
}
