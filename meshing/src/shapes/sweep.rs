//! A polygon carried along a curve: [`sweep`], the tool behind the tubes and the Moebius bands.
//!
//! Method: a rotation-minimising frame by double reflection \[Wang08\]. On a closed curve the frame comes back turned
//! about the tangent by some angle; the opposite turn, and the twist asked for, are spread evenly over the curve.
//! Open sweeps are closed by flat caps of rings that shrink to a centre.
//!
//! Does not promise: freedom from self-intersection. The surface cuts itself where the curve bends more
//! tightly than the profile is wide, or comes nearer to itself than that. Complexity: linear in the number of
//! vertices.

use super::error::{MAX_SHAPE_TRIANGLES, ShapeError, finish, require, require_coordinates};
use super::rings::RingBuilder;
use crate::surface::ClosedOrientedMesh;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// What [`sweep`] carries, and along what.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Points of the centre curve in order, consecutive ones distinct: at least 2, or 3 where closed.
    pub centers: Vec<DVec3>,
    /// Whether the last point is followed by the first again (which is not repeated).
    pub closed: bool,
    /// The profile's corners, counterclockwise, at least 3, in the plane across the curve whose origin is on the
    /// curve. For an open sweep it must be convex with the origin inside (the caps are drawn to the origin).
    pub profile: Vec<DVec2>,
    /// By how many places the profile's corners have moved on after the whole length, from the frame that turns
    /// least: corner `i` ends where corner `i + twist` began. Half the number of corners is a half turn.
    pub twist: i32,
}

/// The surface swept by a polygon along a curve. Closed: genus 1, the boundary of a solid torus. Open: genus 0.
///
/// ```
/// use welter_meshing::{DVec2, DVec3, shapes::{Sweep, sweep}};
/// let prism = sweep(&Sweep {
///     centers: vec![DVec3::ZERO, DVec3::Z],
///     closed: false,
///     profile: vec![DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y],
///     twist: 0,
/// })?;
/// assert_eq!(prism.triangles().len(), 4 + 8 + 4); // cap, sides, cap
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for too few points, coordinates out of range, consecutive points that agree, a curve that turns
/// back on itself, a profile that is not counterclockwise, or more than [`MAX_SHAPE_TRIANGLES`] triangles.
pub fn sweep(parameters: &Sweep) -> Result<ClosedOrientedMesh, ShapeError> {
    let Sweep { centers, closed, profile, twist } = parameters;
    let (n, m) = (centers.len(), profile.len());
    let least = if *closed { 3 } else { 2 };
    require(n >= least, "centers", n as f64, "at least 2 points, 3 where closed")?;
    require(m >= 3, "profile", m as f64, "at least 3 corners")?;
    let triangles = 2.0 * (n as f64 + m as f64) * m as f64;
    if triangles > f64::from(MAX_SHAPE_TRIANGLES) {
        return Err(ShapeError::TooManyTriangles { edge_length: 0.0, triangles });
    }
    for &center in centers {
        require_coordinates("centers", center)?;
    }
    for corner in profile {
        require_coordinates("profile", corner.extend(0.0))?;
    }
    require(
        signed_area(profile) > 0.0,
        "profile",
        signed_area(profile),
        "of positive area (counterclockwise)",
    )?;
    let total_turn = TAU * f64::from(*twist) / m as f64;
    let frames = frames(centers, *closed, total_turn)?;

    let mut rings = RingBuilder::default();
    if *closed {
        for (&center, frame) in centers.iter().zip(&frames) {
            rings.push(profile.iter().map(|&p| frame.place(center, p)));
        }
        rings.close(twist.rem_euclid(m as i32) as u32);
    } else {
        let cap = cap_rings(profile);
        let (first, last) = (0, n - 1);
        for ring in &cap {
            rings.push(ring.iter().map(|&p| frames[first].place(centers[first], p)));
        }
        for (&center, frame) in centers.iter().zip(&frames) {
            rings.push(profile.iter().map(|&p| frame.place(center, p)));
        }
        for ring in cap.iter().rev() {
            rings.push(ring.iter().map(|&p| frames[last].place(centers[last], p)));
        }
    }
    Ok(finish(rings.finish()))
}

/// Twice nothing cancels that matters: the sign is that of the orientation for any profile worth sweeping.
fn signed_area(profile: &[DVec2]) -> f64 {
    let next = profile.iter().cycle().skip(1);
    profile.iter().zip(next).map(|(p, q)| 0.5 * p.perp_dot(*q)).sum()
}

/// The rings of a cap from its centre outward, without the profile itself; the first is the centre alone.
fn cap_rings(profile: &[DVec2]) -> Vec<Vec<DVec2>> {
    let m = profile.len();
    // As far apart as the corners are on a circle: m / 2 pi rings.
    let count = ((m as f64 / TAU).round() as usize).max(1);
    let mut rings = vec![vec![DVec2::ZERO]];
    for k in 1..count {
        let scale = k as f64 / count as f64;
        // Six corners go round a point evenly.
        let corners = ((m as f64 * scale).round() as usize).clamp(m.min(6), m);
        rings.push((0..corners).map(|i| scale * along(profile, i as f64 / corners as f64)).collect());
    }
    rings
}

/// The point of a polygon at a share of its corners between 0 and 1, linear in between.
fn along(profile: &[DVec2], share: f64) -> DVec2 {
    let m = profile.len();
    let place = share * m as f64;
    let i = (place as usize).min(m - 1);
    profile[i].lerp(profile[(i + 1) % m], place - i as f64)
}

/// Two unit vectors across the curve; with the tangent they are right-handed.
#[derive(Clone, Copy, Debug)]
struct Frame {
    u: DVec3,
    v: DVec3,
}

impl Frame {
    /// The frame of a tangent and a vector that is nearly normal to it, turned counterclockwise by an angle.
    fn new(tangent: DVec3, near: DVec3, turn: f64) -> Self {
        let u = (near - tangent * tangent.dot(near)).normalize();
        let v = tangent.cross(u);
        let (sin, cos) = libm::sincos(turn);
        Self { u: u * cos + v * sin, v: v * cos - u * sin }
    }

    fn place(&self, center: DVec3, p: DVec2) -> DVec3 {
        center + self.u * p.x + self.v * p.y
    }
}

/// A frame at each point: least turning, plus an even turn that closes a closed curve, plus `total_turn`.
fn frames(centers: &[DVec3], closed: bool, total_turn: f64) -> Result<Vec<Frame>, ShapeError> {
    let n = centers.len();
    let tangents = tangents(centers, closed)?;
    let mut normals = Vec::with_capacity(n);
    normals.push(tangents[0].any_orthonormal_vector());
    for i in 1..n {
        let step = centers[i] - centers[i - 1];
        normals.push(transport(normals[i - 1], step, tangents[i - 1], tangents[i]));
    }
    let turn = if closed {
        let back = transport(normals[n - 1], centers[0] - centers[n - 1], tangents[n - 1], tangents[0]);
        let missing = libm::atan2(back.cross(normals[0]).dot(tangents[0]), back.dot(normals[0]));
        (missing + total_turn) / n as f64
    } else {
        total_turn / (n - 1) as f64
    };
    Ok((0..n).map(|i| Frame::new(tangents[i], normals[i], turn * i as f64)).collect())
}

/// Unit tangents by central differences (one-sided at open ends).
fn tangents(centers: &[DVec3], closed: bool) -> Result<Vec<DVec3>, ShapeError> {
    let n = centers.len();
    (0..n)
        .map(|i| {
            let (before, after) = match (i, closed) {
                (0, false) => (0, 1),
                (i, false) if i == n - 1 => (n - 2, n - 1),
                (i, _) => ((i + n - 1) % n, (i + 1) % n),
            };
            // Unit steps first, so that the tangent bisects them whatever their lengths.
            let arriving = (centers[i] - centers[before]).normalize_or_zero();
            let leaving = (centers[after] - centers[i]).normalize_or_zero();
            let tangent = (arriving + leaving).normalize_or_zero();
            let (distinct, range) = (tangent != DVec3::ZERO, "distinct points, not turning back at once");
            require(distinct, "centers", i as f64, range).map(|()| tangent)
        })
        .collect()
}

/// Double reflection: carries a normal from one point of a curve to the next with the least turn \[Wang08\].
fn transport(normal: DVec3, step: DVec3, tangent: DVec3, next_tangent: DVec3) -> DVec3 {
    let reflected_normal = reflect(normal, step);
    let reflected_tangent = reflect(tangent, step);
    reflect(reflected_normal, next_tangent - reflected_tangent)
}

/// The reflection in the plane across `axis`; unchanged where the axis vanishes.
fn reflect(v: DVec3, axis: DVec3) -> DVec3 {
    let axis = axis.normalize_or_zero();
    v - axis * (2.0 * axis.dot(v))
}
