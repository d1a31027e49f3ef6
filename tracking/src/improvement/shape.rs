//! Areas, angles, normals and volumes of triangles.

use glam::DVec3;

/// Twice the area, along the normal.
#[inline]
pub(crate) fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Square of the longest side over that of the shortest altitude: the larger the sharper; infinite for degenerate ones.
/// 4/3 for an equilateral triangle.
#[inline]
pub(crate) fn sharpness(t: [DVec3; 3]) -> f64 {
    let [a, b, c] = t;
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let area = area_vector(t).length_squared();
    if area > 0.0 { longest * longest / area } else { f64::INFINITY }
}

/// Cosine of the angle at the first corner; 1 where it has none.
#[inline]
pub(crate) fn cosine_at([a, b, c]: [DVec3; 3]) -> f64 {
    let (p, q) = (b - a, c - a);
    let squared = p.length_squared() * q.length_squared();
    if squared > 0.0 { p.dot(q) / squared.sqrt() } else { 1.0 }
}

/// Six times the volume between triangles and a tip.
pub(crate) fn six_volumes(triangles: &[[DVec3; 3]], tip: DVec3) -> f64 {
    triangles.iter().map(|&[a, b, c]| (a - tip).dot((b - tip).cross(c - tip))).sum()
}

/// The place nearest to `tip` to which triangles around it may be joined without a change of volume: off along their mean
/// normal \[Lindstrom98\]. The tip itself where they have none.
pub(crate) fn volume_preserving(triangles: &[[DVec3; 3]], tip: DVec3) -> DVec3 {
    // The volume between the triangles and the tip is linear in the tip.
    let area: DVec3 = triangles.iter().map(|&t| area_vector(t)).sum();
    let shift = six_volumes(triangles, tip) / area.length_squared();
    let place = tip + shift * area;
    if place.is_finite() { place } else { tip }
}
