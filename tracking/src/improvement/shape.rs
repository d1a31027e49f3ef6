//! Angles, normals and volumes of triangles, of any size: what has squares of areas in it is computed of lengths near one.

use crate::quadric::scale::Scale;
use glam::DVec3;

/// Two sides of a triangle, times the power of two that brings the longest component near one.
#[inline]
fn sides([a, b, c]: [DVec3; 3]) -> [DVec3; 2] {
    let (p, q) = (b - a, c - a);
    let scale = Scale::of_length(p.abs().max(q.abs()).max_element(), 1.0);
    [scale.scaled(p), scale.scaled(q)]
}

/// The normal, of length 1; zero if it has none.
#[inline]
pub(crate) fn unit_normal(t: [DVec3; 3]) -> DVec3 {
    let [p, q] = sides(t);
    p.cross(q).normalize_or_zero()
}

/// Square of the longest side over that of the shortest altitude: the larger the sharper; infinite for degenerate ones.
/// 4/3 for an equilateral triangle.
#[inline]
pub(crate) fn sharpness(t: [DVec3; 3]) -> f64 {
    let [p, q] = sides(t);
    let longest = p.length_squared().max(q.length_squared()).max(p.distance_squared(q));
    let area = p.cross(q).length_squared();
    if area > 0.0 { longest * longest / area } else { f64::INFINITY }
}

/// Cosine of the angle at the first corner; 1 where it has none.
#[inline]
pub(crate) fn cosine_at(t: [DVec3; 3]) -> f64 {
    let [p, q] = sides(t);
    let squared = p.length_squared() * q.length_squared();
    if squared > 0.0 { p.dot(q) / squared.sqrt() } else { 1.0 }
}

/// Six times the volume between triangles and a tip.
pub(crate) fn six_volumes(triangles: &[[DVec3; 3]], tip: DVec3) -> f64 {
    triangles.iter().map(|&[a, b, c]| (a - tip).dot((b - tip).cross(c - tip))).sum()
}

/// The sum of the magnitudes that [`six_volumes`] adds up, for the origin as tip: its roundings are in proportion to that.
pub(crate) fn six_volumes_size(triangles: &[[DVec3; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.length() * b.length() * c.length()).sum()
}

/// The place nearest to `tip` to which triangles around it may be joined without a change of volume: off along their mean
/// normal \[Lindstrom98\]. The tip itself where they have none.
pub(crate) fn volume_preserving(triangles: &[[DVec3; 3]], tip: DVec3) -> DVec3 {
    let farthest =
        triangles.iter().flatten().fold(0.0, |far: f64, &p| far.max((p - tip).abs().max_element()));
    let scale = Scale::of_length(farthest, 1.0);
    let around: Vec<[DVec3; 3]> = triangles.iter().map(|t| t.map(|p| scale.difference(p, tip))).collect();
    // The volume between the triangles and the tip is linear in the tip.
    let area: DVec3 = around.iter().map(|&[a, b, c]| (b - a).cross(c - a)).sum();
    let shift = six_volumes(&around, DVec3::ZERO) / area.length_squared();
    let place = tip + scale.restored(shift * area);
    if place.is_finite() { place } else { tip }
}
