//! How the triangles of a mesh hang together: [`Topology`].
//!
//! Computes the unique edges and the triangles on each, connected components, Euler characteristics and genus,
//! boundary loops, and every edge and vertex where the surface is no 2-manifold or its orientation is inconsistent.
//!
//! Promises: purely combinatorial, so exact; any [`TriMesh`] is accepted; every list ascends by id, components by
//! their first triangle; the same result for any number of threads.
//!
//! Does not promise anything about positions: two vertices at one place are two vertices
//! ([`duplicate_vertices`](super::duplicate_vertices) finds those).
//!
//! Definitions, with `f` triangles that run forward along an edge and `b` backward:
//! ```text
//!   closed         f + b is even for every edge: no boundary modulo 2
//!   oriented       |f - b| = (f + b) mod 2 for every edge: as balanced as its count allows
//!   edge-manifold  f + b <= 2 for every edge
//!   fan            a largest set of triangles at a vertex, linked through edges at that vertex
//!   vertex-manifold   every used vertex has one fan
//!   component      a largest set of triangles linked through shared vertices
//! ```
//! A mesh is a [`ClosedOrientedMesh`](super::ClosedOrientedMesh) exactly if it is closed and oriented.
//!
//! Method: half-edges sorted by edge; union-find over vertices (components) and over corners (fans) \[Tarjan75\].
//! Complexity: near linear in the number of triangles.

mod boundary;
mod components;
mod fans;
pub(crate) mod union_find;

pub use boundary::BoundaryLoop;
pub use components::Component;

use super::edges::{self, EdgeTable};
use super::{EdgeId, TriId, TriMesh, VertexId};

/// Edges, components and defects of connectivity of one mesh.
///
/// ```
/// use welter_meshing::{shapes, surface::Topology};
/// let torus = shapes::torus(&shapes::Torus::default())?;
/// let topology = Topology::of(&torus);
/// assert_eq!(topology.euler_characteristic(), 0);
/// assert_eq!(topology.components()[0].genus, Some(1));
/// assert!(topology.is_closed() && topology.is_oriented());
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Topology {
    table: EdgeTable,
    /// The edge of each half-edge: three a triangle, edge `k` from corner `k` to the next.
    triangle_edges: Vec<[EdgeId; 3]>,
    components: Vec<Component>,
    component_of: Vec<u32>,
    component_triangles: Vec<TriId>,
    boundary_loops: Vec<BoundaryLoop>,
    odd_edges: usize,
    inconsistent_edges: Vec<EdgeId>,
    non_manifold_edges: Vec<EdgeId>,
    non_manifold_vertices: Vec<VertexId>,
    unreferenced_vertices: Vec<VertexId>,
}

impl Topology {
    /// The topology of a mesh. Near linear in the number of triangles.
    #[must_use]
    pub fn of(mesh: &TriMesh) -> Self {
        let table = EdgeTable::new(mesh);
        let (triangle_edges, fans) =
            rayon::join(|| table.edge_of_each_side(mesh), || fans::count(mesh, &table));
        let boundary_loops = boundary::loops(mesh, &table, &triangle_edges);

        let mut odd_edges = 0;
        let mut inconsistent_edges = Vec::new();
        let mut non_manifold_edges = Vec::new();
        for edge in table.ids() {
            let [forward, backward] = table.directions(mesh, edge);
            let count = forward + backward;
            odd_edges += count % 2;
            if forward.abs_diff(backward) != count % 2 {
                inconsistent_edges.push(edge);
            }
            if count > 2 {
                non_manifold_edges.push(edge);
            }
        }
        let with_fans = |pick: fn(u32) -> bool| {
            let vertices = fans.iter().enumerate().filter(move |&(_, &count)| pick(count));
            vertices.map(|(v, _)| VertexId::from_index(v)).collect::<Vec<_>>()
        };
        let mut topology = Self {
            non_manifold_vertices: with_fans(|count| count > 1),
            unreferenced_vertices: with_fans(|count| count == 0),
            table,
            triangle_edges,
            components: Vec::new(),
            component_of: Vec::new(),
            component_triangles: Vec::new(),
            boundary_loops,
            odd_edges,
            inconsistent_edges,
            non_manifold_edges,
        };
        components::find(mesh, &mut topology);
        topology
    }

    /// The ends of every edge, the smaller id first; ascending. Indexed by [`EdgeId`].
    #[must_use]
    pub fn edges(&self) -> &[[VertexId; 2]] {
        &self.table.edges
    }

    /// The triangles on an edge, ascending.
    ///
    /// # Panics
    /// If the edge is not one of this mesh.
    pub fn edge_triangles(&self, edge: EdgeId) -> impl ExactSizeIterator<Item = TriId> + '_ {
        self.table.half_edges(edge).iter().map(|&h| edges::triangle(h))
    }

    /// The edges of every triangle: edge `k` runs from corner `k` to the next. Indexed by [`TriId`].
    #[must_use]
    pub fn triangle_edges(&self) -> &[[EdgeId; 3]] {
        &self.triangle_edges
    }

    /// The edge between two vertices, if there is one.
    #[must_use]
    pub fn edge_between(&self, a: VertexId, b: VertexId) -> Option<EdgeId> {
        self.table.edges.binary_search(&[a.min(b), a.max(b)]).ok().map(EdgeId::from_index)
    }

    /// The connected components, in the order of their first triangles.
    #[must_use]
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// The component of a triangle, as an index into [`Topology::components`].
    ///
    /// # Panics
    /// If the triangle is not one of this mesh.
    #[must_use]
    pub fn component_of(&self, triangle: TriId) -> usize {
        self.component_of[triangle.index()] as usize
    }

    /// The triangles of a component, ascending.
    ///
    /// # Panics
    /// If there is no such component.
    #[must_use]
    pub fn component_triangles(&self, component: usize) -> &[TriId] {
        let Component { start, triangles, .. } = self.components[component];
        &self.component_triangles[start..start + triangles]
    }

    /// Vertices - edges + triangles, where unused vertices do not count.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        self.components.iter().map(|component| component.euler_characteristic).sum()
    }

    /// The sum of the components' genera, if every one has a genus ([`Component::genus`]).
    #[must_use]
    pub fn genus(&self) -> Option<u64> {
        self.components.iter().map(|component| component.genus).sum()
    }

    /// Whether every edge has an even number of triangles. True of the empty mesh.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.odd_edges == 0
    }

    /// Whether the triangles of every edge run both ways as evenly as their number allows.
    #[must_use]
    pub fn is_oriented(&self) -> bool {
        self.inconsistent_edges.is_empty()
    }

    /// Whether every edge has one or two triangles.
    #[must_use]
    pub fn is_edge_manifold(&self) -> bool {
        self.non_manifold_edges.is_empty()
    }

    /// Whether the triangles of every vertex form one fan.
    #[must_use]
    pub fn is_vertex_manifold(&self) -> bool {
        self.non_manifold_vertices.is_empty()
    }

    /// The boundary: chains of edges that have one triangle.
    #[must_use]
    pub fn boundary_loops(&self) -> &[BoundaryLoop] {
        &self.boundary_loops
    }

    /// Edges whose triangles run one way more often than their number makes necessary.
    #[must_use]
    pub fn inconsistent_edges(&self) -> &[EdgeId] {
        &self.inconsistent_edges
    }

    /// Edges with three or more triangles.
    #[must_use]
    pub fn non_manifold_edges(&self) -> &[EdgeId] {
        &self.non_manifold_edges
    }

    /// Vertices with two or more fans.
    #[must_use]
    pub fn non_manifold_vertices(&self) -> &[VertexId] {
        &self.non_manifold_vertices
    }

    /// Vertices of no triangle.
    #[must_use]
    pub fn unreferenced_vertices(&self) -> &[VertexId] {
        &self.unreferenced_vertices
    }

    pub(crate) fn table(&self) -> &EdgeTable {
        &self.table
    }
}

impl EdgeTable {
    fn edge_of_each_side(&self, mesh: &TriMesh) -> Vec<[EdgeId; 3]> {
        let mut sides = vec![[EdgeId(0); 3]; mesh.triangles().len()];
        for edge in self.ids() {
            for &h in self.half_edges(edge) {
                sides[h as usize / 3][h as usize % 3] = edge;
            }
        }
        sides
    }
}
