//! All pairs of elements, one by one, in exact rational arithmetic: [`collisions`].

use crate::exact::collision::Motion;
use glam::DVec3;
use welter_tracking::integration::ElementPair;
use welter_tracking::surface::MovingSurface;

/// The pairs of elements without a common vertex that touch on the straight ways to some ends, sorted.
#[must_use]
pub fn collisions(surface: &MovingSurface, ends: &[DVec3]) -> Vec<ElementPair> {
    all_pairs(surface).filter(|pair| collides(surface, ends, pair)).collect()
}

/// The first of [`collisions`].
#[must_use]
pub fn first_collision(surface: &MovingSurface, ends: &[DVec3]) -> Option<ElementPair> {
    all_pairs(surface).find(|pair| collides(surface, ends, pair))
}

fn all_pairs(surface: &MovingSurface) -> impl Iterator<Item = ElementPair> + '_ {
    let mesh = surface.connectivity();
    let vertex_triangle = mesh.vertices().flat_map(move |v| {
        let others = mesh.triangles().filter(move |&t| !mesh.corners(t).contains(&v));
        others.map(move |t| ElementPair::VertexTriangle(v, t))
    });
    let edge_edge = mesh.edges().flat_map(move |e| {
        let others =
            mesh.edges().filter(move |&f| e < f && !mesh.ends(f).iter().any(|v| mesh.ends(e).contains(v)));
        others.map(move |f| ElementPair::EdgeEdge(e, f))
    });
    vertex_triangle.chain(edge_edge)
}

fn collides(surface: &MovingSurface, ends: &[DVec3], pair: &ElementPair) -> bool {
    let vertices = pair.vertices(surface.connectivity());
    let from = vertices.map(|v| surface.position(v).to_array());
    let to = vertices.map(|v| ends[v.index()].to_array());
    // A gap along an axis, exactly; nearly all pairs end here.
    let first = if matches!(pair, ElementPair::VertexTriangle(..)) { 1 } else { 2 };
    let apart = (0..3).any(|axis| {
        let range = |of: std::ops::Range<usize>| {
            of.flat_map(|i| [from[i][axis], to[i][axis]])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (a, b) = (range(0..first), range(first..4));
        a.1 < b.0 || b.1 < a.0
    });
    if apart {
        return false;
    }
    let motion = match pair {
        ElementPair::VertexTriangle(..) => Motion::vertex_face(&from, &to),
        ElementPair::EdgeEdge(..) => Motion::edge_edge(&from, &to),
    };
    motion.contacts().any()
}
