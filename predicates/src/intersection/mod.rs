//! How two primitives meet, by combinatorial case.
//!
//! **Computes**, for two primitives given by their points, which case of intersection holds: disjoint, meeting
//! at one point (and on which feature of each operand it lies), overlapping along a segment or over an area
//! (and which features bound the overlap), or meeting while an operand is degenerate. One file per pair:
//!
//! | pair | case | yes or no |
//! | --- | --- | --- |
//! | segment, segment (2D, 3D) | [`segment_segment_2d`], [`segment_segment_3d`] | [`segments_intersect_2d`], [`segments_intersect_3d`] |
//! | segment, triangle | [`segment_triangle`] | [`segment_intersects_triangle`] |
//! | triangle, triangle | [`triangle_triangle`] | [`triangles_intersect`] |
//! | ray, triangle | [`ray_triangle`], [`ray_triangle_direction`], [`ray_triangle_axis`] | [`ray_intersects_triangle`] |
//! | point, triangle (2D, 3D) | [`point_in_triangle_2d`], [`point_in_triangle_3d`] | [`triangle_contains_2d`], [`triangle_contains_3d`] |
//! | point, tetrahedron | [`point_in_tetrahedron`] | [`tetrahedron_contains`] |
//! | point, box | [`point_in_box`] | [`box_contains`] |
//! | segment, box | [`segment_box`] | [`segment_intersects_box`] |
//! | triangle, box | [`triangle_box`] | [`triangle_intersects_box`] |
//!
//! **Promises.** Operands are closed sets. Every answer is right for every finite `f64`: it is made of signs of
//! [`orient2d`](crate::orient2d) and [`orient3d`](crate::orient3d), of comparisons of coordinates and, for rays along
//! a vector, of two determinants as exact as those. The yes-or-no form always equals `case != Disjoint`.
//! Degenerate operands (a segment of length zero, a collinear or one-point triangle, a flat tetrahedron or box) are decided too: where the closed sets
//! meet, the answer is `Degenerate` with a flag for each operand; where they do not, `Disjoint`. A box with
//! `min > max` on some axis is the empty set, disjoint from everything. When a coordinate is infinite or NaN the
//! answer is `Disjoint`; the `try_` form returns [`NonFinite`](crate::NonFinite) instead.
//!
//! **Does not promise** coordinates: where a point of intersection lies is a number, hence a construction, and
//! not asked here.
//!
//! **Conventions.** Edge `i` of a triangle joins its vertices `i` and `(i + 1) % 3`. Face `i` of a tetrahedron is
//! the one without vertex `i`. In a [`Contact`], `a` is the feature of the first operand of the call, `b` that of
//! the second; a feature is the smallest vertex, edge or interior that contains the point, so that it is unique.
//!
//! **Method.** Two convex sets meet at the points where a face of one meets a face of the other, and the extreme
//! points of the common set are those where the two relative interiors have exactly that point in common. Cases
//! are told by the signs that decide these face pairs. Coplanar configurations are projected along a coordinate
//! axis along which they do not degenerate, which an exact sign finds; collinear ones are put in lexicographic
//! order. Complexity: constant.

mod direction;
mod feature;
mod hull;
#[cfg(test)]
mod named_cases;
#[cfg(test)]
mod oracle;
mod planar;
mod plane;
mod point_tetrahedron;
mod point_triangle;
mod ray_triangle;
mod segment_box;
mod segment_segment;
mod segment_triangle;
mod triangle_box;
mod triangle_triangle;

pub use feature::{Contact, SegmentFeature, TriangleFeature};
pub use point_tetrahedron::{
    PointTetrahedron, TetrahedronFeature, point_in_tetrahedron, tetrahedron_contains,
    try_point_in_tetrahedron,
};
pub use point_triangle::{
    PointTriangle, point_in_triangle_2d, point_in_triangle_3d, triangle_contains_2d, triangle_contains_3d,
    try_point_in_triangle_2d, try_point_in_triangle_3d,
};
pub use ray_triangle::{
    RayFeature, RayTriangle, ray_intersects_triangle, ray_triangle, ray_triangle_axis,
    ray_triangle_direction, try_ray_triangle, try_ray_triangle_axis, try_ray_triangle_direction,
};
pub use segment_box::{
    BoxFeature, PointBox, SegmentBox, Side, box_contains, point_in_box, segment_box, segment_intersects_box,
    try_point_in_box, try_segment_box,
};
pub use segment_segment::{
    SegmentSegment, segment_segment_2d, segment_segment_3d, segments_intersect_2d, segments_intersect_3d,
    try_segment_segment_2d, try_segment_segment_3d,
};
pub use segment_triangle::{
    SegmentTriangle, segment_intersects_triangle, segment_triangle, try_segment_triangle,
};
pub use triangle_box::{TriangleBox, triangle_box, triangle_intersects_box, try_triangle_box};
pub use triangle_triangle::{
    Corners, TriangleContact, TriangleTriangle, triangle_triangle, triangles_intersect, try_triangle_triangle,
};

pub(crate) use hull::all_finite;
pub(crate) use planar::project;
pub(crate) use plane::sides;

type P2 = [f64; 2];
type P3 = [f64; 3];
