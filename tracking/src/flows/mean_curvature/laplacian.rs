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
    /// `W` of the vertex: the sum of the weights by area.
    pub(super) fn stiffness(&self) -> f64 {
        self.weights / (2.0 * self.area)
    }
}

/// The sums at each vertex id.
pub(super) fn laplacians(surface: &MovingSurface, scale: &Scale) -> Vec<VertexLaplacian> {
    let mesh = surface.connectivity();
    let triangles: Vec<Corners> = (0..mesh.triangle_slots())
        .into_par_iter()
        .with_min_len(PIECE)
        .map(|t| corners(surface, scale, TriId::from_index(t)))
        .collect();
    let edges: Vec<EdgeWeight> = (0..mesh.edge_slots())
        .into_par_iter()
        .with_min_len(PIECE)
        .map(|e| edge_weight(surface, &triangles, EdgeId::from_index(e)))
        .collect();
    (0..mesh.vertex_slots())
        .into_par_iter()
        .with_min_len(PIECE)
        .map(|v| laplacian(surface, scale, &triangles, &edges, VertexId::from_index(v)))
        .collect()
}

fn laplacian(
    surface: &MovingSurface,
    scale: &Scale,
    triangles: &[Corners],
    edges: &[EdgeWeight],
    vertex: VertexId,
) -> VertexLaplacian {
    let mesh = surface.connectivity();
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
            sums.pull += edge.mean * scale.difference(surface.position(other), surface.position(vertex));
        }
    }
    sums
}

/// A triangle without area has none of the weights, as it has none of the area.
fn corners(surface: &MovingSurface, scale: &Scale, triangle: TriId) -> Corners {
    let mesh = surface.connectivity();
    if !mesh.has_triangle(triangle) {
        return Corners::default();
    }
    let x = mesh.corners(triangle).map(|v| surface.position(v));
    // Side k is opposite to corner k.
    let sides: [DVec3; 3] = std::array::from_fn(|k| scale.difference(x[(k + 2) % 3], x[(k + 1) % 3]));
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

fn edge_weight(surface: &MovingSurface, triangles: &[Corners], edge: EdgeId) -> EdgeWeight {
    let mesh = surface.connectivity();
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
