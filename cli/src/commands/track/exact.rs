//! How far a surface is from where it should be, for scenes whose end is known.
//!
//! Promises: the largest distance (`linf`) and the mean distance weighted by area (`l1`) of its vertices from the exact surface; for scenes that
//! return to their initial surface, the Hausdorff distance of both meshes, sampled at their vertices, from both sides.
//!
//! Does not promise: the Hausdorff distance of offsets, which would need points on the exact surface.

use super::flow::Schedule;
use super::scene::{Exact, TrackScene};
use crate::numbers;
use crate::progress::{Progress, ProgressMode};
use glam::DVec3;
use rayon::prelude::*;
use serde_json::{Value, json};
use welter_meshing::spatial::Bvh;
use welter_meshing::surface::TriMesh;

/// Distances in the unit of the coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ExactError {
    pub(super) linf: f64,
    pub(super) l1: f64,
    pub(super) hausdorff: Option<f64>,
}

impl ExactError {
    pub(super) fn to_json(self) -> Value {
        json!({ "linf": self.linf, "l1": self.l1, "hausdorff": self.hausdorff })
    }

    /// For people.
    pub(super) fn in_words(error: &Value) -> String {
        let number = |key: &str| error[key].as_f64().map_or("not known".to_owned(), numbers::number);
        format!("linf {}, l1 {}, Hausdorff {}", number("linf"), number("l1"), number("hausdorff"))
    }
}

/// The error of the surface at the end of a scene, if that is known.
pub(super) fn error(scene: &TrackScene, end: &TriMesh) -> Option<ExactError> {
    match scene.exact {
        Exact::None => None,
        Exact::Initial => {
            let initial = scene.surface.build(&Progress::new(ProgressMode::None, true)).ok()?;
            let there = distances(end, &initial)?;
            let back = distances(&initial, end)?.into_iter().fold(0.0, f64::max);
            let (linf, l1) = norms(end, &there);
            Some(ExactError { linf, l1, hausdorff: Some(linf.max(back)) })
        }
        Exact::Offset => {
            let offset = Offset::of(&scene.surface.balls()?, scene.flow.entropy_schedule()?, scene.time.end)?;
            let there: Vec<f64> = end.positions().par_iter().map(|&p| offset.distance(p).abs()).collect();
            let (linf, l1) = norms(end, &there);
            Some(ExactError { linf, l1, hausdorff: None })
        }
    }
}

/// The distance of each vertex of a mesh to another.
fn distances(from: &TriMesh, to: &TriMesh) -> Option<Vec<f64>> {
    let tree = Bvh::new(to);
    from.positions().par_iter().map(|&p| tree.closest_point(p).map(|closest| closest.distance)).collect()
}

/// The largest of numbers at vertices, and their mean where each vertex has a third of the area around it.
fn norms(mesh: &TriMesh, values: &[f64]) -> (f64, f64) {
    let (mut sum, mut whole) = (0.0, 0.0);
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|v| mesh.positions()[v.index()]);
        let area = 0.5 * (b - a).cross(c - a).length();
        sum += area * corners.iter().map(|v| values[v.index()]).sum::<f64>() / 3.0;
        whole += area;
    }
    let linf = values.iter().copied().fold(0.0, f64::max);
    (linf, if whole > 0.0 { sum / whole } else { 0.0 })
}

/// A union of balls that grew and, after that, shrank.
#[derive(Clone, Debug, PartialEq)]
struct Offset {
    /// When they were largest.
    balls: Vec<(DVec3, f64)>,
    /// By how much their union shrank.
    shrunk: f64,
}

impl Offset {
    /// None where they shrink first and grow then, or where the union of more than two shrinks: then more points than those below could be
    /// nearest.
    fn of(balls: &[(DVec3, f64)], schedule: &Schedule, end: f64) -> Option<Self> {
        let times = schedule.0.iter().skip(1).map(|[from, _]| from.clamp(0.0, end)).chain([end]);
        let (mut time, mut moved, mut largest, mut shrinks) = (0.0, 0.0, 0.0_f64, false);
        for ([_, speed], until) in schedule.0.iter().zip(times) {
            let by = speed * (until - time);
            if by > 0.0 && shrinks && balls.len() > 1 {
                return None;
            }
            shrinks |= by < 0.0;
            moved += by;
            largest = largest.max(moved);
            time = until;
        }
        let shrunk = largest - moved;
        let balls: Vec<(DVec3, f64)> = balls.iter().map(|&(c, r)| (c, r + largest)).collect();
        let known = shrunk == 0.0 || balls.len() <= 2;
        (known && balls.iter().all(|&(_, radius)| radius > shrunk)).then_some(Self { balls, shrunk })
    }

    /// The distance to the surface, below 0 inside of it. Exact outside of the grown union only up to sign and zeros.
    fn distance(&self, p: DVec3) -> f64 {
        let to_balls = self.balls.iter().map(|&(c, r)| p.distance(c) - r).fold(f64::INFINITY, f64::min);
        if self.shrunk == 0.0 || to_balls > 0.0 {
            return to_balls + self.shrunk;
        }
        // Inside: the nearest point of the surface is on a sphere, outside of the other, or where both meet.
        let mut nearest = f64::INFINITY;
        for (k, &(c, r)) in self.balls.iter().enumerate() {
            let foot = c + (p - c).normalize_or(DVec3::X) * r;
            let free = self.balls.iter().enumerate().all(|(j, &(d, s))| j == k || foot.distance(d) >= s);
            if free {
                nearest = nearest.min(r - p.distance(c));
            }
        }
        if let [(c, r), (d, s)] = self.balls[..] {
            let apart = c.distance(d);
            let along = 0.5 * (apart + (r * r - s * s) / apart);
            let radius = (r * r - along * along).sqrt();
            if radius > 0.0 {
                let axis = (d - c) / apart;
                let height = (p - c).dot(axis);
                let from_axis = (p - c - height * axis).length();
                nearest = nearest.min((height - along).hypot(from_axis - radius));
            }
        }
        self.shrunk - nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BALLS: [(DVec3, f64); 2] = [(DVec3::new(-0.25, 0.0, 0.0), 0.2), (DVec3::new(0.25, 0.0, 0.0), 0.2)];

    #[test]
    fn balls_that_grow_and_shrink_leave_a_rounded_bridge() {
        let schedule = Schedule(vec![[0.0, 0.2], [1.0, -0.2]]);
        let grown = Offset::of(&BALLS, &schedule, 1.0).unwrap();
        assert_eq!((grown.balls[0].1, grown.shrunk), (0.4, 0.0));
        assert!(grown.distance(DVec3::new(0.65, 0.0, 0.0)).abs() < 1e-15);
        let back = Offset::of(&BALLS, &schedule, 2.0).unwrap();
        // Far from the bridge the spheres are as before.
        for p in [DVec3::new(0.45, 0.0, 0.0), DVec3::new(-0.25, 0.0, 0.2) + DVec3::new(-0.1, 0.0, 0.0)] {
            let exact = BALLS.iter().map(|&(c, r)| p.distance(c) - r).fold(f64::INFINITY, f64::min);
            assert!((back.distance(p) - exact).abs() < 1e-12, "{p}");
        }
        // In the middle: spheres of radius 0.4 met in a circle of radius sqrt(0.16 - 0.0625), which was offset by 0.2.
        let neck = (0.16_f64 - 0.0625).sqrt() - 0.2;
        assert!(back.distance(DVec3::new(0.0, neck, 0.0)).abs() < 1e-12);
        assert!(back.distance(DVec3::ZERO) < 0.0 && back.distance(DVec3::new(0.0, 0.2, 0.0)) > 0.0);
    }

    #[test]
    fn the_distance_inside_is_that_to_the_nearest_of_many_points() {
        let offset = Offset { balls: BALLS.map(|(c, r)| (c, r + 0.2)).to_vec(), shrunk: 0.1 };
        // Points of both spheres that are outside of the other one.
        let mut points = Vec::new();
        for (k, &(c, r)) in offset.balls.iter().enumerate() {
            for i in 0..400 {
                for j in 0..800 {
                    let (z, t) = (f64::from(i) / 199.5 - 1.0, f64::from(j) / 800.0 * std::f64::consts::TAU);
                    let p =
                        c + r * DVec3::new(z, (1.0 - z * z).sqrt() * t.cos(), (1.0 - z * z).sqrt() * t.sin());
                    let (d, s) = offset.balls[1 - k];
                    if p.distance(d) >= s {
                        points.push(p);
                    }
                }
            }
        }
        for p in [[0.0, 0.0, 0.0], [0.1, 0.2, 0.0], [0.0, 0.1, 0.1], [0.3, 0.2, -0.1], [-0.5, 0.05, 0.0]] {
            let p = DVec3::from_array(p);
            let nearest = points.iter().map(|q| p.distance(*q)).fold(f64::INFINITY, f64::min);
            assert!((offset.distance(p) - (0.1 - nearest)).abs() < 3e-3, "{p}");
        }
    }

    #[test]
    fn what_is_not_known_is_not_claimed() {
        let inward_first = Schedule(vec![[0.0, -0.1], [0.5, 0.1]]);
        assert_eq!(Offset::of(&BALLS, &inward_first, 1.0), None);
        assert!(Offset::of(&BALLS[..1], &inward_first, 1.0).is_some());
        assert_eq!(Offset::of(&BALLS, &Schedule(vec![[0.0, -0.3]]), 1.0), None);
    }
}
