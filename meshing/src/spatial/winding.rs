//! How often a closed oriented surface winds around a point, exactly: [`winding_number`], [`WindingNumbers`].
//!
//! # What it computes
//! The degree of the surface about the point: 0 outside, 1 inside a surface oriented outward, 2 where two such overlap, -1 inside
//! one turned inside out.
//!
//! # What it promises
//! * The exact integer for every finite `f64` input; or that the point lies on the surface, and the lowest
//!   triangle that contains it.
//! * The same for any number of threads, and by the hierarchy or by all triangles in turn.
//!
//! # What it does not promise
//! A number for open surfaces, which have none: the type [`ClosedOrientedMesh`] keeps them out.
//!
//! # Method
//! Signed crossings of the surface with the ray from `p` in direction +x \[Haines94\]. Seen along x, in the plane (y, z),
//! the ray is the point `p`; it is moved by symbolic amounts `(e, d)`, `0 < d << e << 1`, so that it lies on no
//! projected edge or vertex \[Edelsbrunner90\]. Then
//!
//! * an edge from `a` to `b` passes the height of `p` upward iff `a.z <= p.z < b.z`, downward iff `b.z <= p.z < a.z`;
//! * where the edge passes, the moved point is on its left iff `orient2d(a, b, p) > 0`, and where that is zero, iff the
//!   edge goes downward (the move along y is what counts);
//! * the projected boundary of a triangle winds about the moved point `(upward with p on the left) - (downward with p
//!   on the right)` times: the crossings with the half-line from the moved point in direction +y;
//! * a triangle with winding +-1 meets the line of the ray at one point, ahead of `p` iff `orient3d(a, b, c, p)` has
//!   the sign of that winding. If it is zero the point lies in the closed triangle, which is found out before.
//!
//! The rules for an edge are the same from both of its sides, so nothing is counted twice or lost: the sum is the
//! number of signed crossings with a ray in general position.
//!
//! # Complexity
//! O(k) orientations for k triangles whose boxes meet the ray; O(log n + k) to find them.

use rayon::prelude::*;
use welter_predicates::intersection::triangle_contains_3d;
use welter_predicates::{Sign, orient2d, orient3d};

use super::{Box3, Bvh};
use crate::surface::{ClosedOrientedMesh, TriId, TriMesh};
use crate::{Cancelled, DVec3, Monitor};

/// Where a point lies relative to a closed oriented surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Winding {
    /// Not on the surface, which winds this often around it.
    Number(i32),
    /// In the closed triangle, the lowest of those that contain the point.
    OnSurface {
        /// The triangle.
        triangle: TriId,
    },
    /// The point has an infinite or NaN coordinate.
    NotFinite,
}

/// Points of a batch that one thread takes at a time.
const CHUNK: usize = 64;

/// The winding number of a surface about one point, by all its triangles. For many points see [`WindingNumbers`].
///
/// ```
/// use welter_meshing::{DVec3, shapes::{BoxPair, nested_boxes}, spatial::{Winding, winding_number}};
/// let mesh = nested_boxes(&BoxPair::nested())?; // a box of side 1 inside of one of side 2, both outward
/// assert_eq!(winding_number(&mesh, DVec3::ZERO), Winding::Number(2));
/// assert_eq!(winding_number(&mesh, DVec3::new(0.75, 0.0, 0.0)), Winding::Number(1));
/// assert_eq!(winding_number(&mesh, DVec3::new(3.0, 0.0, 0.0)), Winding::Number(0));
/// assert!(matches!(winding_number(&mesh, DVec3::X), Winding::OnSurface { .. }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn winding_number(mesh: &ClosedOrientedMesh, point: DVec3) -> Winding {
    let mut crossings = Crossings::of(point);
    (0..mesh.triangles().len()).for_each(|t| crossings.count(mesh, TriId::from_index(t)));
    crossings.result()
}

/// Winding numbers of a surface about many points, by a hierarchy.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, shapes::{Sphere, sphere}, spatial::{Winding, WindingNumbers}};
/// let mesh = sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?;
/// let numbers = WindingNumbers::new(&mesh);
/// assert_eq!(numbers.at(DVec3::ZERO), Winding::Number(1));
/// let both = numbers.at_all(&[DVec3::ZERO, 2.0 * DVec3::Y], &Monitor::none());
/// assert_eq!(both, Ok(vec![Winding::Number(1), Winding::Number(0)]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct WindingNumbers<'m> {
    bvh: Bvh<'m>,
}

impl<'m> WindingNumbers<'m> {
    /// Builds a hierarchy for the surface.
    #[must_use]
    pub fn new(mesh: &'m ClosedOrientedMesh) -> Self {
        Self { bvh: Bvh::new(mesh) }
    }

    /// The hierarchy.
    #[must_use]
    pub fn bvh(&self) -> &Bvh<'m> {
        &self.bvh
    }

    /// The winding number about a point.
    #[must_use]
    pub fn at(&self, point: DVec3) -> Winding {
        let mut crossings = Crossings::of(point);
        let ray = Box3 { min: point, max: DVec3::new(f64::MAX, point.y, point.z) };
        self.bvh.tree().visit_meeting(&ray, |t| crossings.count(self.bvh.mesh(), TriId(t)));
        crossings.result()
    }

    /// The winding numbers about many points, in order; in parallel.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn at_all(&self, points: &[DVec3], monitor: &Monitor<'_>) -> Result<Vec<Winding>, Cancelled> {
        let stage = monitor.stage("winding numbers", points.len() as u64);
        let parts: Vec<Vec<Winding>> = points
            .par_chunks(CHUNK)
            .map(|chunk| {
                stage.check()?;
                let numbers = chunk.iter().map(|&point| self.at(point)).collect();
                stage.advance(chunk.len() as u64);
                Ok(numbers)
            })
            .collect::<Result<_, Cancelled>>()?;
        Ok(parts.concat())
    }
}

/// The crossings counted so far of the ray from a point; the order of triangles does not matter.
struct Crossings {
    point: DVec3,
    sum: i32,
    on: Option<TriId>,
}

impl Crossings {
    fn of(point: DVec3) -> Self {
        Self { point, sum: 0, on: None }
    }

    fn count(&mut self, mesh: &TriMesh, triangle: TriId) {
        let p = self.point;
        let corners = mesh.corners(triangle);
        let around = Box3::of(corners);
        let beside = p.y < around.min.y || p.y > around.max.y || p.z < around.min.z || p.z > around.max.z;
        if beside || p.x > around.max.x {
            return;
        }
        if around.contains(p) && triangle_contains_3d(corners, p) {
            self.on = Some(self.on.map_or(triangle, |other| other.min(triangle)));
            return;
        }
        let winding = projected_winding(corners, p);
        if winding == 0 {
            return;
        }
        let [a, b, c] = corners;
        let ahead = if p.x < around.min.x { Sign::Positive } else { orient3d(a, b, c, p) * sign_of(winding) };
        if ahead == Sign::Positive {
            self.sum += winding;
        }
    }

    fn result(&self) -> Winding {
        match self.on {
            _ if !self.point.is_finite() => Winding::NotFinite,
            Some(triangle) => Winding::OnSurface { triangle },
            None => Winding::Number(self.sum),
        }
    }
}

fn sign_of(winding: i32) -> Sign {
    if winding > 0 { Sign::Positive } else { Sign::Negative }
}

/// How often the boundary of a triangle, seen along x, winds about the moved point: -1, 0 or 1.
fn projected_winding([a, b, c]: [DVec3; 3], p: DVec3) -> i32 {
    [(a, b), (b, c), (c, a)].into_iter().map(|(a, b)| edge_passes(a, b, p)).sum()
}

/// +1 if the edge from `a` to `b` passes upward with the moved point on its left, -1 if downward with it on the right.
fn edge_passes(a: DVec3, b: DVec3, p: DVec3) -> i32 {
    let side = || orient2d([a.y, a.z], [b.y, b.z], [p.y, p.z]);
    if a.z <= p.z && p.z < b.z {
        i32::from(side() == Sign::Positive)
    } else if b.z <= p.z && p.z < a.z {
        -i32::from(side() == Sign::Negative)
    } else {
        0
    }
}
