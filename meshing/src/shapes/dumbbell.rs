//! Two balls joined by a neck: [`dumbbell`].
//!
//! Method: a surface of revolution about the z axis. Its generating line runs over the lower sphere, a fillet
//! that is tangent to the sphere and to the neck, the cylindrical neck, the other fillet and the upper
//! sphere; it is smooth.
//! ```text
//!    ___           ___
//!   /   \_________/   \       fillet: circle of radius f that touches both; its centre is at distance
//!  |     _________     |      r + f from the axis and R + f from the sphere's centre
//!   \___/         \___/
//! ```
//! It stands in for the dumbbell of \[Brochu12\] 3.3.2, which is Sethian's and whose sizes are not given there: two balls and a handle thin
//! enough to pinch off before the balls vanish. The fillets are an addition: without, curvature would jump at the neck's ends.
//!
//! Each ring of vertices has as many as its circumference needs, so triangles keep their size toward the poles.

use super::error::{ShapeError, divisions, finish, require, require_length, require_triangles};
use super::rings::RingBuilder;
use crate::surface::ClosedOrientedMesh;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Parameters of [`dumbbell`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dumbbell {
    /// Radius of the spheres. Default: 0.5.
    pub radius: f64,
    /// Distance of the spheres' centres, which lie on the z axis, symmetric to the origin. Default: 2.
    pub distance: f64,
    /// Radius of the neck, less than that of the spheres. Default: 0.15: thin enough to pinch under mean curvature.
    pub neck_radius: f64,
    /// Radius of the fillets between spheres and neck, small enough to fit into the distance. Default: 0.2.
    pub fillet_radius: f64,
    /// Distance of neighbouring vertices along and around. Default: 0.04 (about 9,000 triangles).
    pub edge_length: f64,
}

impl Default for Dumbbell {
    fn default() -> Self {
        Self { radius: 0.5, distance: 2.0, neck_radius: 0.15, fillet_radius: 0.2, edge_length: 0.04 }
    }
}

/// A dumbbell: genus 0, no self-intersection.
///
/// ```
/// use welter_meshing::shapes::{Dumbbell, dumbbell};
/// let mesh = dumbbell(&Dumbbell { edge_length: 0.1, ..Dumbbell::default() })?;
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 4);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn dumbbell(parameters: &Dumbbell) -> Result<ClosedOrientedMesh, ShapeError> {
    let &Dumbbell { radius, distance, neck_radius, fillet_radius, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("distance", distance)?;
    require_length("neck_radius", neck_radius)?;
    require_length("fillet_radius", fillet_radius)?;
    require(neck_radius < radius, "neck_radius", neck_radius, "less than the radius of the spheres")?;
    // The centre of the upper fillet, seen from the centre of the upper sphere.
    let across = neck_radius + fillet_radius;
    let reach = radius + fillet_radius;
    let down = (reach * reach - across * across).sqrt();
    let half_neck = 0.5 * distance - down;
    require(half_neck >= 0.0, "fillet_radius", fillet_radius, "small enough to fit between the spheres")?;
    require_length("edge_length", edge_length)?;

    let generator = Generator { radius, distance, neck_radius, fillet_radius, half_neck, down, across };
    require_triangles(edge_length, generator.triangles(edge_length))?;
    let mut rings = RingBuilder::default();
    for point in generator.line(edge_length) {
        let around = if point.x == 0.0 { 1 } else { divisions(TAU * point.x, edge_length, 6) as u32 };
        rings.push((0..around).map(|i| {
            let (sin, cos) = libm::sincos(TAU * f64::from(i) / f64::from(around));
            DVec3::new(point.x * cos, point.x * sin, point.y)
        }));
    }
    Ok(finish(rings.finish()))
}

/// The generating line in the half plane (distance from the axis, height).
struct Generator {
    radius: f64,
    distance: f64,
    neck_radius: f64,
    fillet_radius: f64,
    half_neck: f64,
    /// From the sphere's centre down to the fillet's.
    down: f64,
    /// From the axis to the fillet's centre.
    across: f64,
}

impl Generator {
    /// At most so many triangles: two a vertex, with the rings of a part as large as its largest.
    fn triangles(&self, edge_length: f64) -> f64 {
        let around = |radius| divisions(TAU * radius, edge_length, 6);
        let along = |length| divisions(length, edge_length, 2);
        let neck = along(self.half_neck) * around(self.neck_radius);
        let fillet = along(FRAC_PI_2 * self.fillet_radius) * around(self.radius);
        let sphere = along(PI * self.radius) * around(self.radius);
        4.0 * (neck + fillet + sphere)
    }

    /// Points along the line from the lower pole to the upper one, about `edge_length` apart.
    fn line(&self, edge_length: f64) -> Vec<DVec2> {
        // The upper half from the neck's middle to the pole, then mirrored. Angles are above the equator.
        let touching = -libm::atan2(self.down, self.across);
        let sphere = DVec2::new(0.0, 0.5 * self.distance);
        let fillet = DVec2::new(self.across, self.half_neck);
        let mut upper = Vec::new();
        let neck_steps = divisions(self.half_neck, edge_length, 1) as u32;
        for i in 0..neck_steps {
            let z = self.half_neck * f64::from(i) / f64::from(neck_steps);
            upper.push(DVec2::new(self.neck_radius, z));
        }
        // On the fillet the outward direction turns from toward the axis to opposite the sphere's normal.
        arc(&mut upper, fillet, self.fillet_radius, [PI, PI + touching], edge_length);
        arc(&mut upper, sphere, self.radius, [touching, FRAC_PI_2], edge_length);
        let mut line = vec![DVec2::new(0.0, -(0.5 * self.distance + self.radius))];
        line.extend(upper.iter().skip(1).rev().map(|p| DVec2::new(p.x, -p.y)));
        line.extend(&upper);
        line.push(DVec2::new(0.0, 0.5 * self.distance + self.radius));
        line
    }
}

/// Points of an arc without its last.
fn arc(points: &mut Vec<DVec2>, center: DVec2, radius: f64, [from, to]: [f64; 2], edge_length: f64) {
    let steps = divisions(radius * (to - from).abs(), edge_length, 2) as u32;
    for i in 0..steps {
        let (sin, cos) = libm::sincos(from + (to - from) * f64::from(i) / f64::from(steps));
        points.push(center + radius * DVec2::new(cos, sin));
    }
}
