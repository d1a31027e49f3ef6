//! The pairs of primitives that can collide: [`Pair`].

/// Two primitives, given by `P` vertices, and the polygon of `K` corners that their differences are.
///
/// The polygon is a segment, a triangle or a parallelogram, `P_0 + s (P_1 - P_0) + t (P_last - P_0)`; the
/// primitives touch where it holds the origin, and their distance is its distance from the origin.
pub(super) struct Pair<const P: usize, const K: usize> {
    /// What the vertices are called.
    pub(super) names: [&'static str; P],
    /// Corners of the polygon: `(i, j)` stands for vertex `i` minus vertex `j`.
    pub(super) corners: [(usize, usize); K],
    /// Whether the corners are the first primitive minus the second; else the reverse.
    pub(super) first_minus_second: bool,
    /// The weights of the vertices at the point of the polygon with parameters `s`, `t`.
    pub(super) weights: fn([f64; 2]) -> [f64; P],
}

pub(super) const VERTEX_FACE: Pair<4, 3> = Pair {
    names: ["v", "f0", "f1", "f2"],
    corners: [(1, 0), (2, 0), (3, 0)],
    first_minus_second: false,
    weights: |[s, t]| [1.0, 1.0 - s - t, s, t],
};

pub(super) const EDGE_EDGE: Pair<4, 4> = Pair {
    names: ["ea0", "ea1", "eb0", "eb1"],
    corners: [(0, 2), (1, 2), (1, 3), (0, 3)],
    first_minus_second: true,
    weights: |[s, t]| [1.0 - s, s, 1.0 - t, t],
};

pub(super) const VERTEX_SEGMENT: Pair<3, 2> = Pair {
    names: ["v", "s0", "s1"],
    corners: [(1, 0), (2, 0)],
    first_minus_second: false,
    weights: |[s, _]| [1.0, 1.0 - s, s],
};
