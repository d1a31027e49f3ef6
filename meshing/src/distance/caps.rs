//! [`Cap`]: a flat cylinder around the triangles below a node of the hierarchy, which bounds distances from afar much better than a box does.
//!
//! A box around a piece of surface that is oblique to the axes is as thick as it is wide, so a point at some distance cannot tell
//! which of many neighbouring boxes holds the nearest triangle. A cylinder that stands on the piece is as thick as the piece is curved.
//!
//! # What it promises
//! The value for a point is at most the squared distance to each triangle below the node, up to rounding: the square
//! root of value plus 2^-20 of the squared distance to the middle is at most the distance plus 42 of the units of `flat.rs`.
//!
//! # Method
//! Bottom-up. A leaf has a disc about its centroid. A parent takes as its axis the sum of its children's area vectors (of either sign,
//! whichever agree), the interval of their extents along it, and the circle around their circles across it.
//!
//! With z the height of the point over the middle and q its difference to it, the distance from the axis is `sqrt(q.q - z z)`. The
//! difference cancels; its error, at most 2^-21 q.q, changes the sum of squares by no more than itself, which is taken off again.

use glam::{DVec3, Vec4};
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;

use super::flat::{Lanes, Points, square_root};

/// A cylinder: middle, unit axis, half of its height, radius; in the frame of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    middle: [f32; 3],
    axis: [f32; 3],
    half_height: f32,
    radius: f32,
    /// What the node is made of.
    pub(super) below: Below,
}

/// What a node of the hierarchy is made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Below {
    /// Two nodes, this and the next.
    Children(u32),
    /// A triangle, by its place in the order of leaves.
    Leaf(u32),
}

/// Error of the squared distance from the axis, as a part of the squared distance from the middle; twice what is proven.
const CANCELLED: f32 = 1.0 / (1 << 20) as f32;

/// Makes up for a cap's numbers being rounded to single precision.
const ROUNDED_UP: f64 = 1.0 + 1.0 / (1 << 20) as f64;

impl Cap {
    /// Lower bounds of the squared distances of the points.
    #[inline(always)]
    pub(super) fn squared_distances(&self, points: &Points) -> Lanes {
        points.each(|x, y, z| {
            let (x, y, z) = (x - self.middle[0], y - self.middle[1], z - self.middle[2]);
            let height = x * self.axis[0] + y * self.axis[1] + z * self.axis[2];
            let square = x * x + y * y + z * z;
            let across = square_root((square - height * height).max(Vec4::ZERO));
            let above = (height.abs() - self.half_height).max(Vec4::ZERO);
            let beside = (across - self.radius).max(Vec4::ZERO);
            above * above + beside * beside - square * CANCELLED
        })
    }
}

/// A cap in double precision, with the sum of area vectors below it.
#[derive(Clone, Copy, Debug, Default)]
struct Cylinder {
    middle: DVec3,
    area: DVec3,
    axis: DVec3,
    half_height: f64,
    radius: f64,
}

impl Cylinder {
    fn of_triangle(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let middle = (a + b + c) / 3.0;
        let area = (b - a).cross(c - a);
        let axis = area.try_normalize().unwrap_or(DVec3::Z);
        let (mut half_height, mut radius) = (0.0_f64, 0.0_f64);
        for corner in corners {
            let height = (corner - middle).dot(axis);
            half_height = half_height.max(height.abs());
            radius = radius.max((corner - middle - height * axis).length());
        }
        Self { middle, area, axis, half_height, radius }
    }

    fn around(children: [&Self; 2]) -> Self {
        let [a, b] = children;
        let area = if a.area.dot(b.area) < 0.0 { a.area - b.area } else { a.area + b.area };
        let axis = area.try_normalize().unwrap_or(a.axis);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let circles = children.map(|child| {
            let offset = child.middle - a.middle;
            let height = offset.dot(axis);
            let cosine = child.axis.dot(axis).abs().min(1.0);
            let sine = child.axis.cross(axis).length();
            let reach = child.half_height * cosine + child.radius * sine;
            (low, high) = (low.min(height - reach), high.max(height + reach));
            (offset - height * axis, child.radius + child.half_height * sine)
        });
        let (center, radius) = circle_around(circles);
        let middle = a.middle + center + 0.5 * (low + high) * axis;
        Self { middle, area, axis, half_height: 0.5 * (high - low), radius }
    }

    /// With the same axis, and no larger than the triangles need.
    fn measured(&self, triangles: &[[DVec3; 3]]) -> Self {
        let (mut low, mut high, mut square) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for &corner in triangles.iter().flatten() {
            let offset = corner - self.middle;
            let height = offset.dot(self.axis);
            (low, high) = (low.min(height), high.max(height));
            square = square.max((offset - height * self.axis).length_squared());
        }
        let middle = self.middle + 0.5 * (low + high) * self.axis;
        Self { middle, half_height: 0.5 * (high - low), radius: square.sqrt(), ..*self }
    }

    fn cap(&self, node: &Bvh2Node) -> Cap {
        let below = if node.is_leaf() { Below::Leaf } else { Below::Children }(node.first_index);
        let single = |v: DVec3| v.to_array().map(|t| t as f32);
        let up = |length: f64| (length * ROUNDED_UP) as f32;
        let [middle, axis] = [self.middle, self.axis].map(single);
        Cap { middle, axis, half_height: up(self.half_height), radius: up(self.radius), below }
    }
}

/// The circle (or ball) around two in the same plane.
fn circle_around([(p, r), (q, s)]: [(DVec3, f64); 2]) -> (DVec3, f64) {
    let gap = (q - p).length();
    if r >= gap + s {
        (p, r)
    } else if s >= gap + r {
        (q, s)
    } else {
        let radius = 0.5 * (gap + r + s);
        (p + (q - p) * ((radius - r) / gap), radius)
    }
}

/// Triangles below a node up to which its cylinder is measured on their corners: the work for them is a factor of log2 of this on a
/// pass over the mesh. Cylinders around cylinders are some times too thick, which matters near the leaves most.
const MEASURED: u32 = 256;

/// The caps of all nodes; `corners` gives a triangle, by its place in the order of leaves, in the frame of the scene.
pub(super) fn caps(tree: &Bvh2, corners: impl Fn(u32) -> [DVec3; 3] + Sync) -> Vec<Cap> {
    let nodes = &tree.nodes;
    let mut cylinders = vec![Cylinder::default(); nodes.len()];
    let mut counts = vec![1; nodes.len()];
    // Children come after their parents.
    for (index, node) in nodes.iter().enumerate().rev() {
        if node.is_leaf() {
            cylinders[index] = Cylinder::of_triangle(corners(node.first_index));
        } else {
            let [a, b] = [node.first_index as usize, node.first_index as usize + 1];
            cylinders[index] = Cylinder::around([&cylinders[a], &cylinders[b]]);
            counts[index] = counts[a] + counts[b];
        }
    }
    // Leaves from left to right, so that those below a node are a range.
    let mut starts = vec![0_u32; nodes.len()];
    let mut leaves = vec![[DVec3::ZERO; 3]; tree.primitive_indices.len()];
    for (index, node) in nodes.iter().enumerate() {
        if node.is_leaf() {
            leaves[starts[index] as usize] = corners(node.first_index);
        } else {
            let [a, b] = [node.first_index as usize, node.first_index as usize + 1];
            starts[a] = starts[index];
            starts[b] = starts[a] + counts[a];
        }
    }
    let measured = |(index, cylinder): (usize, &Cylinder)| {
        if (2..=MEASURED).contains(&counts[index]) {
            let first = starts[index] as usize;
            cylinder.measured(&leaves[first..first + counts[index] as usize]).cap(&nodes[index])
        } else {
            cylinder.cap(&nodes[index])
        }
    };
    cylinders.par_iter().enumerate().with_min_len(1024).map(measured).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::flat::LANES;
    use crate::shapes::{Torus, torus};
    use crate::spatial::Bvh;
    use crate::spatial::closest::triangle_distance;
    use crate::surface::TriId;

    #[test]
    fn caps_are_no_farther_than_any_triangle_below() {
        const UNIT: f64 = 1.0 / (1 << 24) as f64;
        let mesh = torus(&Torus { edge_length: 0.25, ..Torus::default() }).expect("valid parameters");
        let bvh = Bvh::new(&mesh);
        let tree = &bvh.tree().bvh;
        let placed = |leaf: u32| {
            let triangle = TriId(tree.primitive_indices[leaf as usize]);
            mesh.corners(triangle).map(|p| bvh.tree().frame.place(p))
        };
        let caps = caps(tree, placed);
        let points: [DVec3; LANES] = std::array::from_fn(|i| {
            let t = i as f64;
            DVec3::new((1.3 * t).sin(), (2.1 * t).cos(), 0.2 * t - 0.7)
        });
        let lanes = |axis: usize| Lanes::of(points.map(|p| p[axis] as f32));
        let lanes = Points { x: lanes(0), y: lanes(1), z: lanes(2) };
        let mut tight = 0;
        for index in 0..tree.nodes.len() {
            let bounds = caps[index].squared_distances(&lanes).to_array();
            let mut below = vec![index];
            let mut least = [f64::INFINITY; LANES];
            while let Some(node) = below.pop() {
                match caps[node].below {
                    Below::Children(first) => below.extend([first as usize, first as usize + 1]),
                    Below::Leaf(leaf) => {
                        for (least, p) in least.iter_mut().zip(points) {
                            *least = least.min(triangle_distance(placed(leaf).map(|q| q - p)));
                        }
                    }
                }
            }
            for (bound, least) in bounds.into_iter().zip(least) {
                assert!(
                    f64::from(bound.max(0.0)).sqrt() <= least + 42.0 * UNIT,
                    "node {index}: {bound} {least}"
                );
                tight += usize::from(f64::from(bound.max(0.0)).sqrt() > 0.95 * least);
            }
        }
        assert!(tight > 6 * tree.nodes.len(), "{tight} of {} are tight", LANES * tree.nodes.len());
    }
}
