//! Distances to the sectors around a vertex: [`distance`].

use glam::DVec3;

/// The distance of a unit vector from the sector of all `p a + q b` with `p` and `q` not below 0, for independent `a` and `b`.
/// At most 1, that of the apex.
pub(super) fn distance(unit: DVec3, a: DVec3, b: DVec3) -> f64 {
    let across = a.cross(b);
    let over = unit.cross(b).dot(across) >= 0.0 && a.cross(unit).dot(across) >= 0.0;
    if over {
        return unit.dot(across).abs() / across.length();
    }
    let from_ray =
        |ray: DVec3| if unit.dot(ray) > 0.0 { unit.cross(ray).length() / ray.length() } else { 1.0 };
    from_ray(a).min(from_ray(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    #[test]
    fn nearest_points_on_face_edge_and_apex() {
        let quarter = |p: DVec3| distance(p, 2.0 * DVec3::X, 3.0 * DVec3::Y);
        assert_eq!(quarter(DVec3::Z), 1.0);
        assert_eq!(quarter(DVec3::NEG_X), 1.0);
        assert_eq!(quarter(DVec3::X), 0.0);
        let unit = DVec3::ONE.normalize();
        assert!((quarter(unit) - unit.z).abs() < 1e-15);
        // Nearest to the ray of x.
        assert!((quarter(DVec3::new(0.6, -0.8, 0.0)) - 0.8).abs() < 1e-15);
        assert!((quarter(DVec3::new(0.0, -1.0, 1.0).normalize()) - 1.0).abs() < 1e-15);
        assert!((quarter(DVec3::new(-1.0, 1.0, 0.0).normalize()) - FRAC_1_SQRT_2).abs() < 1e-15);
    }
}
