//! Convex polyhedra cut by planes: the volume of a convex surface in a box.
//!
//! Each face is cut as a polygon; the hole that a plane leaves is closed by the points on it in the order of
//! their angle. The volume is that of the pyramids over the faces from one of the points.

use glam::DVec3;

/// Faces of a convex polyhedron, their corners counterclockwise from outside.
pub type Faces = Vec<Vec<DVec3>>;

/// The part of a convex polyhedron where `normal . p <= offset`.
#[must_use]
pub fn cut(faces: &Faces, normal: DVec3, offset: f64) -> Faces {
    let distance = |p: DVec3| normal.dot(p) - offset;
    let mut kept = Faces::new();
    let mut rim = Vec::new();
    for face in faces {
        let mut polygon = Vec::new();
        for (i, &to) in face.iter().enumerate() {
            let from = face[(i + face.len() - 1) % face.len()];
            let (d, e) = (distance(from), distance(to));
            if (d <= 0.0) != (e <= 0.0) {
                let point = from + d / (d - e) * (to - from);
                polygon.push(point);
                rim.push(point);
            }
            if e <= 0.0 {
                polygon.push(to);
            }
        }
        if polygon.len() >= 3 {
            kept.push(polygon);
        }
    }
    if rim.len() >= 3 {
        let middle = rim.iter().sum::<DVec3>() / rim.len() as f64;
        let u = normal.any_orthonormal_vector();
        let v = normal.normalize().cross(u);
        let angle = |p: &DVec3| (*p - middle).dot(v).atan2((*p - middle).dot(u));
        rim.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
        kept.push(rim);
    }
    kept
}

/// Volume of a convex polyhedron.
#[must_use]
pub fn volume(faces: &Faces) -> f64 {
    let Some(&apex) = faces.first().and_then(|face| face.first()) else { return 0.0 };
    let pyramid = |face: &Vec<DVec3>| -> f64 {
        let a = face[0] - apex;
        face[1..].windows(2).map(|p| a.dot((p[0] - apex).cross(p[1] - apex))).sum::<f64>() / 6.0
    };
    faces.iter().map(pyramid).sum()
}

/// The volume of a convex polyhedron in a box with an edge along each of three axes at right angles.
#[must_use]
pub fn volume_in_box(faces: &Faces, axes: [DVec3; 3], low: [f64; 3], high: [f64; 3]) -> f64 {
    let mut part = faces.clone();
    for k in 0..3 {
        part = cut(&cut(&part, axes[k], high[k]), -axes[k], -low[k]);
    }
    volume(&part)
}
