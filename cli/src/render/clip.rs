//! Parts of triangles on one side of planes \[Sutherland74\].
//!
//! A crossing point is computed from the inner to the outer end of the edge, so two triangles that share the edge get the
//! same point and stay watertight.

use glam::{DVec3, DVec4};

/// The side `normal . p + offset >= 0`, as `(normal, offset)`.
pub(super) type Plane = DVec4;

#[inline]
pub(super) fn signed(plane: Plane, p: DVec3) -> f64 {
    plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w
}

/// The triangles of a fan of what lies inside all planes.
pub(super) fn clip(corners: [DVec3; 3], planes: &[Plane], mut emit: impl FnMut([DVec3; 3])) {
    let mut polygon = corners.to_vec();
    let mut next = Vec::with_capacity(3 + planes.len());
    for &plane in planes {
        next.clear();
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let (dp, dq) = (signed(plane, p), signed(plane, q));
            if dp >= 0.0 {
                next.push(p);
            }
            if (dp >= 0.0) != (dq >= 0.0) {
                let (inner, outer, di, d_o) = if dp >= 0.0 { (p, q, dp, dq) } else { (q, p, dq, dp) };
                next.push(inner + (outer - inner) * (di / (di - d_o)));
            }
        }
        std::mem::swap(&mut polygon, &mut next);
    }
    for i in 2..polygon.len() {
        emit([polygon[0], polygon[i - 1], polygon[i]]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_triangle_keeps_the_area_inside() {
        let corners = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.0, 2.0, 0.0)];
        let mut area = 0.0;
        clip(corners, &[DVec4::new(-1.0, 0.0, 0.0, 1.0)], |[a, b, c]| area += (b - a).cross(c - a).z / 2.0);
        assert_eq!(area, 1.5);
        clip(corners, &[DVec4::new(1.0, 0.0, 0.0, -3.0)], |_| panic!("all of it lies outside"));
    }
}
