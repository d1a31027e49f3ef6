//! How often each side winds about the points just above a triangle of it: [`Walls`].
//!
//! # Method
//! A wall is a part of a surface without self-intersection, joined across edges of two triangles: the winding numbers above it and below
//! it are the same everywhere, and differ by one. They are those of two points on both sides of one of its triangles, the segment
//! between which meets no other triangle. All of it is decided exactly; points are brought nearer until they serve.

use glam::DVec3;
use welter_meshing::spatial::{Box3, Winding, WindingNumbers};
use welter_meshing::surface::{ClosedOrientedMesh, TriId};
use welter_predicates::intersection::{segment_intersects_triangle, segment_triangle};

use super::UnionObstacle;
use super::error::Stop;
use super::overlay::Overlay;
use super::patches::Patches;
use crate::quadric::scale::Scale;

/// The distance of the first pair of points from the triangle, as a part of its longest edge; the next are an eighth of it.
const FIRST_DISTANCE: f64 = 0.125;

/// After so many pairs of points the next triangle is tried; they are nearer than roundings then.
const PAIRS: u32 = 16;

/// By triangle, the winding number of its own side above it, where that may be asked for.
#[derive(Debug)]
pub(super) struct Walls {
    above: Vec<Option<i32>>,
}

impl Walls {
    /// The walls of closed components that have a triangle whose box meets that of the other side.
    pub(super) fn new(overlay: &Overlay, sides: &[Side<'_>; 2]) -> Result<Self, Stop> {
        let mesh = &overlay.connectivity;
        let walls = Patches::new(mesh, |edge| mesh.edge_triangles(edge) == 2);
        let mut wanted = vec![false; walls.count()];
        for t in mesh.triangles().filter(|t| !overlay.open[t.index()]) {
            let around = Box3::of(overlay.mesh.corners(t));
            wanted[walls.of(t)] |= around.meets(&overlay.boxes[1 - overlay.side(t)]);
        }
        let mut found = vec![None; walls.count()];
        for side in sides {
            for (local, &t) in side.ids.iter().enumerate() {
                let wall = walls.of(t);
                if wanted[wall] && found[wall].is_none() {
                    found[wall] = side.above(TriId::from_index(local));
                }
            }
        }
        if (0..walls.count()).any(|wall| wanted[wall] && found[wall].is_none()) {
            return Err(Stop::Degenerate(UnionObstacle::Room));
        }
        Ok(Self { above: mesh.triangles().map(|t| found[walls.of(t)]).collect() })
    }

    /// The winding number above a triangle of its own side.
    pub(super) fn above(&self, triangle: TriId) -> Option<i32> {
        self.above[triangle.index()]
    }
}

/// The closed components of the surface or of the shape.
pub(super) struct Side<'a> {
    mesh: &'a ClosedOrientedMesh,
    /// Of its triangles in the overlay.
    ids: &'a [TriId],
    numbers: WindingNumbers<'a>,
}

impl<'a> Side<'a> {
    pub(super) fn new((mesh, ids): &'a (ClosedOrientedMesh, Vec<TriId>)) -> Self {
        Self { mesh, ids, numbers: WindingNumbers::new(mesh) }
    }

    /// How often it winds about a point; none on it.
    pub(super) fn winding(&self, point: DVec3) -> Option<i32> {
        match self.numbers.at(point) {
            Winding::Number(number) => Some(number),
            _ => None,
        }
    }

    /// The winding number just above one of its triangles, if it could be found.
    fn above(&self, triangle: TriId) -> Option<i32> {
        let corners = self.mesh.corners(triangle);
        let [a, b, c] = corners;
        let longest =
            [b - a, c - b, a - c].map(|edge| edge.abs().max_element()).into_iter().fold(0.0, f64::max);
        let scale = Scale::of_length(longest, 1.0);
        let normal = scale.difference(b, a).cross(scale.difference(c, a)).normalize_or_zero();
        let center = a / 3.0 + b / 3.0 + c / 3.0;
        let mut distance = FIRST_DISTANCE;
        for _ in 0..PAIRS {
            let away = scale.restored(normal * distance);
            let ends = [center + away, center - away];
            distance /= 8.0;
            if !segment_triangle(ends, corners).is_proper() {
                continue;
            }
            let others = self.numbers.bvh().boxes_meeting(&Box3::of(ends));
            let in_the_way =
                |&t: &TriId| t != triangle && segment_intersects_triangle(ends, self.mesh.corners(t));
            if others.iter().any(in_the_way) {
                continue;
            }
            let [above, below] = ends.map(|end| self.winding(end));
            if let (Some(above), Some(below)) = (above, below)
                && below == above + 1
            {
                return Some(above);
            }
        }
        None
    }
}
