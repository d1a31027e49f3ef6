//! A regular grid that has been moved by symbolic infinitesimals, so that it meets no vertex and no edge of a surface.
//!
//! **Computes** how nodes, lines and cells of a grid lie to a triangle, where each point `(x, y, z)` of the grid stands for
//!
//! ```text
//! (x + c, y + e, z + d)        0 < d << e << c << 1
//! ```
//!
//! with `c`, `e`, `d` smaller than every positive number, `e` smaller than every positive multiple of `c`, and `d` than
//! every positive multiple of `e`. Triangles and segments stay where they are.
//!
//! | question | where |
//! | --- | --- |
//! | on which side of a plane is a node? | [`orient3d_moved`] |
//! | does a line of the grid cross a triangle, and from which side? | [`axis_line_crossing`] |
//! | which of two crossings comes first, which side of a node is one on? | [`compare_crossings`], [`crossing_precedes`] |
//! | does a cell meet a triangle, a segment? | [`moved_box_meets_triangle`], [`moved_box_meets_segment`] |
//!
//! **Promises.** All answers are exact for every finite `f64`, and all speak of one and the same moved grid, so that they agree with
//! each other. No node lies on a plane, no line meets an edge or a vertex, and no boundary of a cell touches a triangle without
//! passing through it. So of the triangles around an edge or a vertex of a closed surface that a line of the grid
//! meets, those are crossed that the moved line crosses: the signs of [`axis_line_crossing`] add up to zero along a line. A point
//! lies in exactly one of the cells that fill space, and a triangle in a plane of the grid meets the cells on one side of it.
//!
//! **Does not promise** where a crossing is: that is a construction. When a coordinate is infinite or NaN the answer is the one that
//! means "nothing" (`Zero`, `Equal`, `false`); the `try_` form returns [`NonFinite`](crate::NonFinite) instead.
//!
//! **Conventions.** A line along coordinate axis `axis % 3` is given by its other two coordinates in cyclic order: `[y, z]`
//! along x, `[z, x]` along y, `[x, y]` along z. The projection of a triangle along the axis then has the sign of that
//! component of the normal `(b - a) x (c - a)`.
//!
//! **Method** \[Edelsbrunner90\]. Each answer is made of signs of quantities that are affine in the coordinates of the
//! node, the line or the corner. After the move such a quantity is its plain value plus `c`, `e` and `d` times its derivatives: the
//! sign is that of the first of the four that is not zero. Complexity: constant.

mod cell;
mod line;
mod node;
mod order;

pub use cell::{
    moved_box_meets_segment, moved_box_meets_triangle, try_moved_box_meets_segment,
    try_moved_box_meets_triangle,
};
pub use line::{axis_line_crossing, crossing_precedes, try_axis_line_crossing, try_crossing_precedes};
pub use node::{orient3d_moved, try_orient3d_moved};
pub use order::{compare_crossings, try_compare_crossings};

#[cfg(test)]
pub(crate) use order::{Crossings, Slopes};

type P2 = [f64; 2];
type P3 = [f64; 3];
