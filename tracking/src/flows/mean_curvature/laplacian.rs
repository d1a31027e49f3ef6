//! The cotangent Laplacian of the positions at each vertex: [`VertexLaplacian`].

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

use crate::flows::PIECE;
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;

/// The sums at a vertex, in scaled units. All zero at vertices not in use, and at those of the boundary.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VertexLaplacian {
    /// `sum w_ij (x_j - x_i)`.
    pub(super) pull: DVec3,
    /// `sum |w_ij|`.
    pub(super) weights: f64,
    /// The mixed area.
    pub(super) area: f64,
}

/// Cotangents of the angles of a triangle, and how its area is shared among the corners.
#[derive(Clone, Copy, Default)]
struct Corners {
    cotangents: [f64; 3],
    shares: [f64; 3],
}

/// The mean of the cotangents opposite to an edge.
#[derive(Clone, Copy, Default)]
struct EdgeWeight {
    mean: f64,
    boundary: bool,
}

impl VertexLaplacian {
    /// Whether there is a velocity at all.
    pub(super) fn moves(&self) -> bool {
        self.weights > 0.0 && self.area > 0.0
    }

    /// The displacement in a time, both in scaled units and for unit speed; that to the weighted mean of the neighbours at
    /// most.
    pub(super) fn displacement(&self, time: f64) -> DVec3 {
        if self.moves() {
            (time / (2.0 * self.area)).min(1.0 / self.weights) * self.pull
        } else {
            DVec3::ZERO
        }
    }

    /// `W` of the vertex: the sum of the weights by area.
    pub(super) fn stiffness(&self) -> f64 {
        self.weights / (2.0 * self.area)
    }
}

/// Vertices of a surface at given positions.
#[derive(Clone, Copy)]
pub(super) struct Placed<'s> {
    pub(super) surface: &'s MovingSurface,
    /// By vertex id.
    pub(super) positions: &'s [DVec3],
    pub(super) scale: &'s Scale,
}

impl Placed<'_> {
    /// The sums at each vertex id.
    pub(super) fn laplacians(&self) -> Vec<VertexLaplacian> {
        let mesh = self.surface.connectivity();
        let triangles: Vec<Corners> = (0..mesh.triangle_slots())
            .into_par_iter()
            .with_min_len(PIECE)
            .map(|t| self.corners(TriId::from_index(t)))
            .collect();
        let edges: Vec<EdgeWeight> = (0..mesh.edge_slots())
            .into_par_iter()
            .with_min_len(PIECE)
            .map(|e| self.edge_weight(&triangles, EdgeId::from_index(e)))
            .collect();
        (0..mesh.vertex_slots())
            .into_par_iter()
            .with_min_len(PIECE)
            .map(|v| self.laplacian(&triangles, &edges, VertexId::from_index(v)))
            .collect()
    }

    /// From one vertex to another, scaled.
    fn edge(&self, from: VertexId, to: VertexId) -> DVec3 {
        self.scale.difference(self.positions[to.index()], self.positions[from.index()])
    }

    fn laplacian(&self, triangles: &[Corners], edges: &[EdgeWeight], vertex: VertexId) -> VertexLaplacian {
        let mesh = self.surface.connectivity();
        let mut sums = VertexLaplacian::default();
        for half_edge in mesh.star(vertex) {
            sums.area += triangles[half_edge.triangle().index()].shares[half_edge.side()];
            // Each edge is met with each of its triangles, and counts with the mean over them.
            let sides = [(half_edge, mesh.head(half_edge)), (half_edge.previous(), mesh.apex(half_edge))];
            for (side, other) in sides {
                let edge = edges[mesh.edge(side).index()];
                if edge.boundary {
                    return VertexLaplacian::default();
                }
                sums.weights += edge.mean.abs();
                sums.pull += edge.mean * self.edge(vertex, other);
            }
        }
        sums
    }

    /// A triangle without area has none of the weights, as it has none of the area.
    fn corners(&self, triangle: TriId) -> Corners {
        let mesh = self.surface.connectivity();
        if !mesh.has_triangle(triangle) {
            return Corners::default();
        }
        let corners = mesh.corners(triangle);
        // Side k is opposite to corner k.
        let sides: [DVec3; 3] =
            std::array::from_fn(|k| self.edge(corners[(k + 1) % 3], corners[(k + 2) % 3]));
        let double_area = sides[0].cross(sides[1]).length();
        let dots: [f64; 3] = std::array::from_fn(|k| -sides[(k + 1) % 3].dot(sides[(k + 2) % 3]));
        let cotangents = dots.map(|dot| dot / double_area);
        if cotangents.iter().any(|cotangent| !cotangent.is_finite()) {
            return Corners::default();
        }
        let shares = match (0..3).find(|&k| dots[k] < 0.0) {
            Some(obtuse) => {
                std::array::from_fn(|k| if k == obtuse { double_area / 4.0 } else { double_area / 8.0 })
            }
            None => std::array::from_fn(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                (sides[i].length_squared() * cotangents[i] + sides[j].length_squared() * cotangents[j]) / 8.0
            }),
        };
        Corners { cotangents, shares }
    }

    fn edge_weight(&self, triangles: &[Corners], edge: EdgeId) -> EdgeWeight {
        let mesh = self.surface.connectivity();
        if !mesh.has_edge(edge) {
            return EdgeWeight::default();
        }
        let (mut sum, mut count) = (0.0, 0);
        for half_edge in mesh.around_edge(edge) {
            sum += triangles[half_edge.triangle().index()].cotangents[half_edge.previous().side()];
            count += 1;
        }
        EdgeWeight { mean: sum / f64::from(count), boundary: count == 1 }
    }
}
