//! The triangles that a ray meets: [`Bvh::ray_hits`].
//!
//! # What it promises
//! Exactly the triangles that the closed ray from `origin` along `direction` meets, each with the case in which it does,
//! by predicates on the coordinates given (no sum `origin + direction` is formed).
//!
//! # What it does not promise
//! Where along the ray they are: that is a number, not a case.
//!
//! # Method
//! Nodes are left out by intervals of the ray's parameter, in the frame's coordinates. A triangle's box lies within
//! [`Frame::ERROR`] of its node's; the origin's place in the frame is rounded by at most 2^-52 of its size. Boxes are widened by
//! four times both, the ends of the intervals by 2^-50 of themselves, which covers the two roundings of each end.

use glam::DVec3;
use obvhs::aabb::Aabb;
use welter_predicates::intersection::{RayTriangle, ray_triangle_direction};

use super::Bvh;
use super::frame::{Frame, Scale};
use crate::surface::TriId;

impl Bvh<'_> {
    /// All triangles that the ray from `origin` along `direction` meets, ascending, with the case of each. Exact.
    ///
    /// A direction of zero makes the ray a point. Nothing is met if a coordinate is not finite.
    ///
    /// ```
    /// use welter_meshing::{DVec3, spatial::Bvh, surface::{TriId, TriMesh, TriangleSoup}};
    /// let positions = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [0., 0., 9.]].map(DVec3::from_array).to_vec();
    /// let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2], [3, 2, 1]], ..Default::default() };
    /// let mesh = TriMesh::new(soup)?;
    /// let hits = Bvh::new(&mesh).ray_hits(DVec3::new(1.0, 1.0, -1.0), DVec3::Z);
    /// assert_eq!(hits.iter().map(|hit| hit.0).collect::<Vec<_>>(), [TriId(0), TriId(1)]);
    /// assert!(hits[0].1.is_proper());
    /// # Ok::<(), welter_meshing::surface::TriMeshError>(())
    /// ```
    #[must_use]
    pub fn ray_hits(&self, origin: DVec3, direction: DVec3) -> Vec<(TriId, RayTriangle)> {
        let mut hits = Vec::new();
        if !origin.is_finite() || !direction.is_finite() {
            return hits;
        }
        let ray = FrameRay::new(&self.tree().frame, origin, direction);
        self.tree().visit(
            |node| ray.may_meet(node.aabb()),
            |t| {
                let case = ray_triangle_direction(origin, direction, self.mesh().corners(TriId(t)));
                if case != RayTriangle::Disjoint {
                    hits.push((TriId(t), case));
                }
            },
        );
        hits.sort_unstable_by_key(|hit| hit.0);
        hits
    }
}

/// A ray in the coordinates of a frame, rounded, and how far its boxes are widened for that.
struct FrameRay {
    origin: DVec3,
    direction: DVec3,
    slack: f64,
}

impl FrameRay {
    fn new(frame: &Frame, origin: DVec3, direction: DVec3) -> Self {
        let origin = frame.place(origin);
        let size = origin.abs().max_element();
        let direction = Scale::shrinking(direction.abs().max_element()).apply(direction);
        Self { origin, direction, slack: 4.0 * (Frame::ERROR + size / (1u64 << 52) as f64) }
    }

    /// False only if no triangle of the node can meet the ray.
    fn may_meet(&self, b: &Aabb) -> bool {
        const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;
        if !self.slack.is_finite() {
            return true;
        }
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (self.origin[axis], self.direction[axis]);
            let low = f64::from(b.min[axis]) - self.slack - o;
            let high = f64::from(b.max[axis]) + self.slack - o;
            if d == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let (near, far) = if d > 0.0 { (low / d, high / d) } else { (high / d, low / d) };
            enter = enter.max(near);
            leave = leave.min(far);
        }
        enter * (1.0 - ROUNDING) <= leave * (1.0 + ROUNDING)
    }
}
