//! Where a ray crosses the triangles of a surface, one after the other.
//!
//! The solution of `origin + t direction = a + u (b - a) + v (c - a)` by Cramer's rule. A ray that meets an
//! edge, by rounding, may count a triangle too often or not at all; the crossings of a closed surface then do
//! not balance, and the ray is moved by a part in 10^9.

use glam::DVec3;

/// A crossing of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Place along the ray, in units of its direction.
    pub t: f64,
    /// 1 where the ray enters what is behind the front, -1 where it leaves.
    pub sign: i32,
    /// Which triangle.
    pub triangle: usize,
    /// Weights of the corners.
    pub weights: [f64; 3],
}

/// The crossing of one triangle, before or behind the origin.
fn hit(origin: DVec3, direction: DVec3, triangle: usize, [a, b, c]: [DVec3; 3]) -> Option<Hit> {
    let (e, f, s) = (b - a, c - a, origin - a);
    let normal = e.cross(f);
    let determinant = -direction.dot(normal);
    if determinant == 0.0 {
        return None;
    }
    let t = s.dot(normal) / determinant;
    let moment = direction.cross(s);
    let u = moment.dot(f) / -determinant;
    let v = moment.dot(e) / determinant;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    let sign = if determinant > 0.0 { 1 } else { -1 };
    inside.then_some(Hit { t, sign, triangle, weights: [1.0 - u - v, u, v] })
}

/// All crossings of the whole line, by their place on it.
fn line(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> Vec<Hit> {
    let all = triangles.iter().enumerate();
    let mut hits: Vec<Hit> = all.filter_map(|(i, &corners)| hit(origin, direction, i, corners)).collect();
    hits.sort_by(|a, b| a.t.total_cmp(&b.t));
    hits
}

/// All crossings of a line with a closed surface, in balance.
#[must_use]
pub fn crossings(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> Vec<Hit> {
    let size = direction.length() * 1e-9;
    let shifts = [DVec3::ZERO, DVec3::new(0.31, 0.72, -0.55), DVec3::new(-0.83, 0.12, 0.47)];
    for shift in shifts {
        let hits = line(triangles, origin, direction + size * shift);
        if hits.iter().map(|hit| hit.sign).sum::<i32>() == 0 {
            return hits;
        }
    }
    panic!("a ray from {origin} along {direction} does not balance: the surface is not closed");
}

/// Whether a ray meets any triangle after its origin.
#[must_use]
pub fn meets(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> bool {
    triangles.iter().any(|&corners| hit(origin, direction, 0, corners).is_some_and(|hit| hit.t > 0.0))
}

/// The first triangle after the origin.
#[must_use]
pub fn first(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> Option<Hit> {
    line(triangles, origin, direction).into_iter().find(|hit| hit.t > 0.0)
}

/// How often the surface winds around a point of a line: what has been entered and not left, from one end of
/// the line.
#[must_use]
pub fn winding_at(hits: &[Hit], t: f64) -> i32 {
    hits.iter().filter(|hit| hit.t < t).map(|hit| hit.sign).sum()
}
