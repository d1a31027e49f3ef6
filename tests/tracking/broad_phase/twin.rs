//! The slow twin: every pair of elements, its boxes made from the corners and compared axis by axis.

use glam::DVec3;
use welter_kit::mesher::Random;
use welter_meshing::surface::{EdgeId, TriId, TriMesh, TriangleSoup, VertexId};
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::surface::MovingSurface;

/// All pairs of a surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lists {
    pub(super) vertex_triangle: Vec<(VertexId, TriId)>,
    pub(super) edge_edge: Vec<[EdgeId; 2]>,
    pub(super) edge_triangle: Vec<(EdgeId, TriId)>,
}

impl Lists {
    pub(super) fn of(broad_phase: &BroadPhase, surface: &MovingSurface, distance: f64) -> Self {
        let mesh = surface.connectivity();
        Self {
            vertex_triangle: broad_phase.vertex_triangle_pairs(mesh, distance).unwrap(),
            edge_edge: broad_phase.edge_edge_pairs(mesh, distance).unwrap(),
            edge_triangle: broad_phase.edge_triangle_pairs(mesh, distance).unwrap(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.vertex_triangle.len() + self.edge_edge.len() + self.edge_triangle.len()
    }

    /// Those for which a question about the corners of both is answered with yes.
    pub(super) fn by_all_pairs(
        surface: &MovingSurface,
        near: impl Fn(&[VertexId], &[VertexId]) -> bool,
    ) -> Self {
        let mesh = surface.connectivity();
        let common = |a: &[VertexId], b: &[VertexId]| a.iter().filter(|v| b.contains(v)).count();
        let mut lists =
            Self { vertex_triangle: Vec::new(), edge_edge: Vec::new(), edge_triangle: Vec::new() };
        let triangles: Vec<(TriId, [VertexId; 3])> = mesh.triangles().map(|t| (t, mesh.corners(t))).collect();
        let edges: Vec<(EdgeId, [VertexId; 2])> = mesh.edges().map(|e| (e, mesh.ends(e))).collect();
        for v in mesh.vertices() {
            let of_v = triangles.iter().filter(|(_, t)| common(&[v], t) == 0 && near(&[v], t));
            lists.vertex_triangle.extend(of_v.map(|&(t, _)| (v, t)));
        }
        for (i, (e, ends)) in edges.iter().enumerate() {
            let of_e =
                edges[i + 1..].iter().filter(|(_, other)| common(ends, other) == 0 && near(ends, other));
            lists.edge_edge.extend(of_e.map(|&(other, _)| [*e, other]));
            let of_e = triangles.iter().filter(|(_, t)| common(ends, t) < 2 && near(ends, t));
            lists.edge_triangle.extend(of_e.map(|&(t, _)| (*e, t)));
        }
        lists
    }

    /// By boxes and rounded differences.
    pub(super) fn twin(surface: &MovingSurface, motion: Motion<'_>, distance: f64) -> Self {
        Self::by_all_pairs(surface, |a, b| {
            (0..3).all(|axis| {
                let [(a_low, a_high), (b_low, b_high)] = [a, b].map(|of| range(surface, motion, of, axis));
                a_low - b_high <= distance && b_low - a_high <= distance
            })
        })
    }
}

/// The least and the largest coordinate of vertices along a motion.
pub(super) fn range(surface: &MovingSurface, motion: Motion<'_>, of: &[VertexId], axis: usize) -> (f64, f64) {
    let mut all: Vec<f64> = of.iter().map(|&v| surface.position(v)[axis]).collect();
    match motion {
        Motion::To(ends) => all.extend(of.iter().map(|v| ends[v.index()][axis])),
        Motion::At(places) => all = of.iter().map(|v| places[v.index()][axis]).collect(),
        Motion::Rest => {}
    }
    all.sort_by(f64::total_cmp);
    (all[0], all[all.len() - 1])
}

/// What is asked of one element agrees with the pairs of all.
pub(super) fn check_single(
    broad_phase: &BroadPhase,
    surface: &MovingSurface,
    random: &mut Random,
    distance: f64,
    lists: &Lists,
) {
    let mesh = surface.connectivity();
    let mut id = |slots: usize| random.below(slots as u64) as u32;
    let vertex = VertexId(id(mesh.vertex_slots()));
    let edge = EdgeId(id(mesh.edge_slots()));
    let triangle = TriId(id(mesh.triangle_slots()));
    let seconds = lists.vertex_triangle.iter().filter(|pair| pair.0 == vertex).map(|pair| pair.1);
    assert_eq!(
        broad_phase.triangles_near_vertex(mesh, vertex, distance).unwrap(),
        seconds.collect::<Vec<_>>()
    );
    let firsts = lists.vertex_triangle.iter().filter(|pair| pair.1 == triangle).map(|pair| pair.0);
    assert_eq!(
        broad_phase.vertices_near_triangle(mesh, triangle, distance).unwrap(),
        firsts.collect::<Vec<_>>()
    );
    let mut others: Vec<EdgeId> = lists
        .edge_edge
        .iter()
        .filter(|pair| pair.contains(&edge))
        .map(|pair| if pair[0] == edge { pair[1] } else { pair[0] })
        .collect();
    others.sort_unstable();
    assert_eq!(broad_phase.edges_near_edge(mesh, edge, distance).unwrap(), others);
    let seconds = lists.edge_triangle.iter().filter(|pair| pair.0 == edge).map(|pair| pair.1);
    assert_eq!(broad_phase.triangles_near_edge(mesh, edge, distance).unwrap(), seconds.collect::<Vec<_>>());
    let firsts = lists.edge_triangle.iter().filter(|pair| pair.1 == triangle).map(|pair| pair.0);
    assert_eq!(
        broad_phase.edges_near_triangle(mesh, triangle, distance).unwrap(),
        firsts.collect::<Vec<_>>()
    );
}

/// A surface of triangles that share nothing, given by their corners.
pub(super) fn loose(corners: Vec<[DVec3; 3]>) -> MovingSurface {
    let triangles = (0..corners.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let soup = TriangleSoup { positions: corners.concat(), triangles, ..TriangleSoup::default() };
    MovingSurface::new(&TriMesh::new(soup).unwrap()).unwrap()
}
