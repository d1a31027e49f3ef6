//! Everything `welter check` says about a surface: [`Findings`].
//!
//! What it computes: topology, measures, and by exact predicates the degenerate triangles and the triangle pairs whose
//! intersection is more than the vertex or edge they share.
//! Promises: counts are exact for every finite coordinate; the same bits for any number of threads.
//! Does not promise: area and volume beyond floating-point accuracy.

mod bad;
mod text;

pub(crate) use bad::offending;
pub(crate) use text::{HEADINGS, block, facts, row};

use crate::codes::Code;
use crate::console::{Console, Seconds};
use crate::failure::Failure;
use serde_json::{Map, Value, json};
use welter_meshing::spatial::{Bvh, Sharing};
use welter_meshing::surface::{
    EdgeId, Topology, TriId, TriMesh, TriMeshDefects, TriangleSoup, degenerate_triangles,
    duplicate_triangles, duplicate_vertices, measure,
};
use welter_meshing::{DVec3, Monitor, Progress};

/// What is known of a mesh.
#[derive(Debug)]
pub(crate) struct Findings {
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
    pub(crate) topology: Topology,
    /// Defined for closed, consistently oriented surfaces.
    pub(crate) volume: Option<f64>,
    pub(crate) area: f64,
    /// Its least and greatest corner.
    pub(crate) bounding_box: Option<[DVec3; 2]>,
    /// Triangles whose corners are collinear or equal.
    pub(crate) degenerate: Vec<TriId>,
    /// Vertices at the position of an earlier one.
    pub(crate) duplicate_vertices: usize,
    /// Triangles with the vertices of an earlier one.
    pub(crate) duplicate_triangles: usize,
    /// Pairs that intersect in more than they share, ascending.
    pub(crate) pairs: Vec<[TriId; 2]>,
    /// Closed, oriented components with negative volume.
    pub(crate) inside_out_components: usize,
    /// Edges with an odd number of triangles, ascending.
    pub(crate) boundary_edges: Vec<EdgeId>,
    /// A point near the first of the pairs.
    pub(crate) first_near: Option<DVec3>,
    pub(crate) seconds: Seconds,
}

impl Findings {
    /// Examines a mesh, stage by stage; `sharing` says when triangles share a vertex; `seconds` may have stages already.
    pub(crate) fn of(
        mesh: &TriMesh,
        sharing: Sharing,
        console: &Console,
        mut seconds: Seconds,
    ) -> Result<Self, Box<Failure>> {
        let topology = console.stage(&mut seconds, "topology", || Topology::of(mesh));
        let (area, volume, bounding_box, inside_out) = console.stage(&mut seconds, "measures", || {
            let whole = topology.is_closed() && topology.is_oriented();
            (
                measure::area(mesh),
                whole.then(|| measure::signed_volume(mesh)),
                measure::bounding_box(mesh).map(|bounds| [bounds.min, bounds.max]),
                measure::inside_out_components(mesh, &topology).len(),
            )
        });
        let (degenerate, twice, triangles_twice) = console.stage(&mut seconds, "duplicates", || {
            let surplus = |classes: usize, members: usize| members - classes;
            let vertices = duplicate_vertices(mesh);
            let triangles = duplicate_triangles(mesh, &topology);
            (
                degenerate_triangles(mesh),
                surplus(vertices.len(), vertices.iter().map(Vec::len).sum()),
                surplus(triangles.len(), triangles.iter().map(Vec::len).sum()),
            )
        });
        let report = |p: Progress| console.progress.report(p.stage, p.done, p.total);
        let monitor = Monitor::new(Some(&report), None);
        let pairs = console
            .stage(&mut seconds, "self-intersections", || {
                Bvh::new(mesh).self_intersections(sharing, &monitor)
            })
            .map_err(|error| Failure::new(Code::Interrupted, error.to_string()))?;
        console.progress.clear();
        let edges = (0..topology.edges().len()).map(EdgeId::from_index);
        let boundary_edges = edges.filter(|&edge| topology.edge_triangles(edge).len() % 2 == 1).collect();
        Ok(Self {
            vertices: mesh.positions().len(),
            triangles: mesh.triangles().len(),
            first_near: pairs.first().map(|&pair| near(mesh, pair)),
            topology,
            volume,
            area,
            bounding_box,
            degenerate,
            duplicate_vertices: twice,
            duplicate_triangles: triangles_twice,
            pairs,
            inside_out_components: inside_out,
            boundary_edges,
            seconds,
        })
    }

    /// Triangles at an edge that is inconsistent or not manifold.
    fn triangles_at_bad_edges(&self) -> impl Iterator<Item = TriId> {
        let bad = self.topology.inconsistent_edges().iter().chain(self.topology.non_manifold_edges());
        bad.flat_map(|&edge| self.topology.edge_triangles(edge))
    }

    /// Triangles at a boundary edge.
    fn triangles_at_boundary(&self) -> impl Iterator<Item = TriId> {
        self.boundary_edges.iter().flat_map(|&edge| self.topology.edge_triangles(edge))
    }

    /// The keys of one file of `check --json`, without `file`.
    pub(crate) fn to_json(&self, with_pairs: bool) -> Map<String, Value> {
        let topology = &self.topology;
        let first = self
            .pairs
            .first()
            .map(|[i, j]| json!({ "triangles": [i.0, j.0], "near": self.first_near.map(|p| p.to_array()) }));
        let mut object = object(json!({
            "vertices": self.vertices,
            "triangles": self.triangles,
            "components": topology.components().len(),
            "closed": topology.is_closed(),
            "oriented": topology.is_oriented(),
            "edge_manifold": topology.is_edge_manifold(),
            "vertex_manifold": topology.is_vertex_manifold(),
            "euler_characteristic": topology.euler_characteristic(),
            "genus": topology.genus(),
            "volume": self.volume,
            "area": self.area,
            "bounding_box": self.bounding_box.map(|corners| corners.map(|p| p.to_array())),
            "degenerate_triangles": self.degenerate.len(),
            "duplicate_vertices": self.duplicate_vertices,
            "duplicate_triangles": self.duplicate_triangles,
            "non_finite_vertices": 0,
            "self_intersecting_pairs": self.pairs.len(),
            "first_pair": first,
            "inside_out_components": self.inside_out_components,
            "boundary_edges": self.boundary_edges.len(),
            "boundary_loops": topology.boundary_loops().len(),
            "inconsistent_edges": topology.inconsistent_edges().len(),
            "non_manifold_edges": topology.non_manifold_edges().len(),
            "non_manifold_vertices": topology.non_manifold_vertices().len(),
            "unused_vertices": topology.unreferenced_vertices().len(),
            "verdict": self.verdict(),
            "seconds": self.seconds.to_json(),
        }));
        if with_pairs {
            let pairs: Vec<[u32; 2]> = self.pairs.iter().map(|pair| pair.map(|id| id.0)).collect();
            object.insert("pairs".to_owned(), json!(pairs));
        }
        object
    }
}

/// The same keys for a soup that is no mesh: what can be counted, and null for what has no answer.
pub(crate) fn json_of_defects(soup: &TriangleSoup, defects: &TriMeshDefects) -> Map<String, Value> {
    object(json!({
        "vertices": soup.positions.len(),
        "triangles": soup.triangles.len(),
        "components": null,
        "closed": null,
        "oriented": null,
        "edge_manifold": null,
        "vertex_manifold": null,
        "euler_characteristic": null,
        "genus": null,
        "volume": null,
        "area": null,
        "bounding_box": null,
        "degenerate_triangles": null,
        "duplicate_vertices": null,
        "non_finite_vertices": defects.non_finite_vertices.len(),
        "self_intersecting_pairs": null,
        "inside_out_components": null,
        "indices_out_of_range": defects.indices_out_of_range.len(),
        "repeated_indices": defects.repeated_indices.len(),
    }))
}

fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// The middle of what the boxes of two triangles have in common: near their intersection, not on it.
fn near(mesh: &TriMesh, pair: [TriId; 2]) -> DVec3 {
    let [a, b] = pair.map(|id| {
        let [p, q, r] = mesh.corners(id);
        [p.min(q).min(r), p.max(q).max(r)]
    });
    // Halves first: the sum of two coordinates near 1e308 is infinite.
    a[0].max(b[0]) * 0.5 + a[1].min(b[1]) * 0.5
}
