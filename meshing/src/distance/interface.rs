//! The distance of the nodes next to a zero contour: [`Interface`].
//!
//! # What it computes
//! The level set between the nodes is taken to be linear in each simplex of the Kuhn subdivision: every cell is cut along its
//! diagonal into `D!` simplices, one for each order in which the axes may be walked from its first corner to its last. The
//! zero contour of that is a polygon or polyhedron. A node is *next to* it if its own value is zero or a neighbour
//! along an axis has a value of another sign. Such a node is at most one spacing away from the contour, so the nearest point
//! lies in one of the `2^D` cells around it; its distance to the parts of the contour in these is computed.
//!
//! # What it promises
//! The distance to that contour up to a few roundings. The contour is a second-order approximation of that of a smooth level set.
//!
//! Infinite values count as very large: between two of them the contour passes half-way, and next to a finite value at that.

use crate::grid::Grid;

/// Most corners of a simplex, and of a section through one.
const MOST_CORNERS: usize = 4;

/// The zero contour of a level set.
pub(super) struct Interface<'a, const D: usize> {
    pub(super) grid: &'a Grid<D>,
    pub(super) values: &'a [f64],
}

/// The order of the axes on the way through each simplex of a cell of three dimensions.
const WALKS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Those of a cell of two dimensions: they end with the axis that is not there.
const FLAT_WALKS: [[usize; 3]; 2] = [[0, 1, 2], [1, 0, 2]];

/// A point relative to a node, in spacings; the last coordinate is 0 in two dimensions.
type Offset = [f64; 3];

impl<const D: usize> Interface<'_, D> {
    /// The distance of a node to the contour in spacings, if it is next to it.
    pub(super) fn distance(&self, node: [u32; D]) -> Option<f64> {
        let value = self.values[self.grid.node_index(node)];
        if value == 0.0 {
            return Some(0.0);
        }
        self.is_beside(node, value).then(|| self.least(node))
    }

    /// Whether a neighbour has a value of another sign.
    fn is_beside(&self, node: [u32; D], value: f64) -> bool {
        let differs = |neighbour: [u32; D]| {
            let other = self.values[self.grid.node_index(neighbour)];
            other == 0.0 || (other < 0.0) != (value < 0.0)
        };
        (0..D).any(|axis| {
            let at = |i: u32| std::array::from_fn(|a| if a == axis { i } else { node[a] });
            (node[axis] > 0 && differs(at(node[axis] - 1)))
                || (node[axis] < self.grid.cells()[axis] && differs(at(node[axis] + 1)))
        })
    }

    /// The least distance to the contour in the cells around a node.
    fn least(&self, node: [u32; D]) -> f64 {
        let mut least = f64::INFINITY;
        for side in 0..1_usize << D {
            // The cell's first corner relative to the node: 0 or -1 along each axis.
            let before = |axis: usize| (side >> axis & 1) as u32;
            if (0..D)
                .any(|axis| node[axis] < before(axis) || node[axis] - before(axis) >= self.grid.cells()[axis])
            {
                continue;
            }
            let first: [u32; D] = std::array::from_fn(|axis| node[axis] - before(axis));
            let origin = std::array::from_fn(|axis| if axis < D { -f64::from(before(axis)) } else { 0.0 });
            least = least.min(self.in_cell(first, origin));
        }
        least
    }

    /// The distance of the node to the contour in a cell, of which the first corner is at `origin` relative to the node.
    fn in_cell(&self, first: [u32; D], origin: Offset) -> f64 {
        let values: [f64; 8] = std::array::from_fn(|corner| {
            let far = |axis: usize| (corner >> axis & 1) as u32;
            let inside = corner < 1 << D;
            let at = std::array::from_fn(|axis| first[axis] + if inside { far(axis) } else { 0 });
            self.values[self.grid.node_index(at)]
        });
        let corners = &values[..1 << D];
        if corners.iter().all(|&v| v > 0.0) || corners.iter().all(|&v| v < 0.0) {
            return f64::INFINITY;
        }
        let at = |corner: usize| -> Offset {
            std::array::from_fn(|axis| origin[axis] + (corner >> axis & 1) as f64)
        };
        let mut least = f64::INFINITY;
        // A zero at a corner is a point of the contour also where the other values have the same sign.
        for (corner, _) in corners.iter().enumerate().filter(|&(_, &v)| v == 0.0) {
            least = least.min(norm(at(corner)));
        }
        let walks = if D == 2 { &FLAT_WALKS[..] } else { &WALKS[..] };
        for walk in walks {
            let mut simplex = [0; MOST_CORNERS];
            for (step, &axis) in walk[..D].iter().enumerate() {
                simplex[step + 1] = simplex[step] | 1 << axis;
            }
            let simplex = simplex.map(|corner| (at(corner), values[corner]));
            least = least.min(in_simplex(&simplex[..=D]));
        }
        least
    }
}

/// The distance of the origin to where the linear function with these values at the corners of a simplex is zero.
fn in_simplex(simplex: &[(Offset, f64)]) -> f64 {
    let negative = simplex.iter().filter(|corner| corner.1 < 0.0);
    let others = || simplex.iter().filter(|corner| corner.1 >= 0.0);
    let (mut points, mut count) = ([[0.0; 3]; MOST_CORNERS], 0);
    for (turn, a) in negative.enumerate() {
        // There and back, so that the four points of a section through two and two corners go around it.
        let mut add = |b: &(Offset, f64)| {
            points[count] = crossing(a, b);
            count += 1;
        };
        if turn % 2 == 0 { others().for_each(&mut add) } else { others().rev().for_each(&mut add) }
    }
    match points[..count] {
        [] => f64::INFINITY,
        [p] => norm(p),
        [p, q] => to_segment(p, q),
        [p, q, r] => to_triangle(p, q, r),
        [p, q, r, s] => to_triangle(p, q, r).min(to_triangle(p, r, s)),
        _ => unreachable!("a simplex of four corners has sections of at most four"),
    }
}

/// Where the linear function is zero on an edge with ends of different signs.
fn crossing(a: &(Offset, f64), b: &(Offset, f64)) -> Offset {
    let (va, vb) = (a.1, b.1);
    let t = match (va.is_infinite(), vb.is_infinite()) {
        (true, true) => 0.5,
        (true, false) => 1.0,
        _ if (va - vb).is_finite() => va / (va - vb),
        _ => (va * 0.5) / (va * 0.5 - vb * 0.5),
    };
    std::array::from_fn(|axis| a.0[axis] + t * (b.0[axis] - a.0[axis]))
}

fn dot(a: Offset, b: Offset) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Offset, b: Offset) -> Offset {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn norm(a: Offset) -> f64 {
    dot(a, a).sqrt()
}

/// The distance of the origin to a segment.
fn to_segment(p: Offset, q: Offset) -> f64 {
    let along = minus(q, p);
    let square = dot(along, along);
    let t = if square > 0.0 { (-dot(p, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    norm(std::array::from_fn(|axis| p[axis] + t * along[axis]))
}

/// The distance of the origin to a triangle.
fn to_triangle(p: Offset, q: Offset, r: Offset) -> f64 {
    let (u, v) = (minus(q, p), minus(r, p));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let square = dot(normal, normal);
    let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
    let (pu, pv) = (-dot(p, u), -dot(p, v));
    let (s, t) = (vv * pu - uv * pv, uu * pv - uv * pu);
    if square > 0.0 && s > 0.0 && t > 0.0 && s + t < square {
        return dot(p, normal).abs() / square.sqrt();
    }
    to_segment(p, q).min(to_segment(q, r)).min(to_segment(r, p))
}
