//! Connected components and their genus: [`Component`].

use super::Topology;
use super::union_find::UnionFind;
use crate::surface::{TriId, TriMesh};

/// A largest set of triangles linked through shared vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Component {
    /// Number of triangles.
    pub triangles: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Its first triangle.
    pub first_triangle: TriId,
    /// Vertices - edges + triangles.
    pub euler_characteristic: i64,
    /// Number of boundary loops (and chains).
    pub boundary_loops: usize,
    /// Whether every edge has an even number of triangles.
    pub closed: bool,
    /// Whether the triangles of every edge run both ways as evenly as their number allows.
    pub oriented: bool,
    /// Whether every edge has at most two triangles and every vertex one fan.
    pub manifold: bool,
    /// Where `oriented` and `manifold`: the number of handles, (2 - Euler characteristic - boundary loops) / 2.
    pub genus: Option<u64>,
    /// Where its triangles begin in the list sorted by component.
    pub(super) start: usize,
}

/// Fills in the components of a topology whose edges, boundary and defects are known.
pub(super) fn find(mesh: &TriMesh, topology: &mut Topology) {
    let mut vertices = UnionFind::new(mesh.positions().len());
    for &[a, b] in topology.edges() {
        vertices.unite(a.0, b.0);
    }

    const NONE: u32 = u32::MAX;
    // The component of each root vertex, numbered as the triangles come.
    let mut number = vec![NONE; mesh.positions().len()];
    let mut components: Vec<Component> = Vec::new();
    let mut component_of = Vec::with_capacity(mesh.triangles().len());
    for (t, &[v, ..]) in mesh.triangles().iter().enumerate() {
        let slot = &mut number[vertices.root(v.0) as usize];
        if *slot == NONE {
            *slot = components.len() as u32;
            components.push(Component {
                triangles: 0,
                edges: 0,
                vertices: 0,
                first_triangle: TriId::from_index(t),
                euler_characteristic: 0,
                boundary_loops: 0,
                closed: true,
                oriented: true,
                manifold: true,
                genus: None,
                start: 0,
            });
        }
        component_of.push(*slot);
        components[*slot as usize].triangles += 1;
    }

    let mut component_of_vertex = |v: u32| number[vertices.root(v) as usize] as usize;
    for edge in topology.table.ids() {
        let component = &mut components[component_of_vertex(topology.edges()[edge.index()][0].0)];
        component.edges += 1;
        component.closed &= topology.table.half_edges(edge).len().is_multiple_of(2);
    }
    let mut unreferenced = topology.unreferenced_vertices.iter().peekable();
    for v in 0..mesh.positions().len() as u32 {
        if unreferenced.next_if(|u| u.0 == v).is_none() {
            components[component_of_vertex(v)].vertices += 1;
        }
    }
    for edge in &topology.inconsistent_edges {
        components[component_of_vertex(topology.edges()[edge.index()][0].0)].oriented = false;
    }
    for edge in &topology.non_manifold_edges {
        components[component_of_vertex(topology.edges()[edge.index()][0].0)].manifold = false;
    }
    for vertex in &topology.non_manifold_vertices {
        components[component_of_vertex(vertex.0)].manifold = false;
    }
    for boundary in &topology.boundary_loops {
        components[component_of_vertex(boundary.vertices[0].0)].boundary_loops += 1;
    }

    let mut start = 0;
    for component in &mut components {
        component.start = start;
        start += component.triangles;
        let Component { vertices, edges, triangles, boundary_loops, .. } = *component;
        component.euler_characteristic = vertices as i64 - edges as i64 + triangles as i64;
        if component.oriented && component.manifold {
            let twice = 2 - component.euler_characteristic - boundary_loops as i64;
            component.genus = Some(twice as u64 / 2);
        }
    }
    let mut next: Vec<usize> = components.iter().map(|component| component.start).collect();
    let mut sorted = vec![TriId(0); component_of.len()];
    for (t, &component) in component_of.iter().enumerate() {
        sorted[next[component as usize]] = TriId::from_index(t);
        next[component as usize] += 1;
    }
    topology.components = components;
    topology.component_of = component_of;
    topology.component_triangles = sorted;
}
