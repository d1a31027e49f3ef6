//! The surface and the shape, one after the other, before they are cut: [`Overlay`].

use glam::DVec3;
use welter_meshing::spatial::{Box3, self_intersections};
use welter_meshing::surface::{ClosedOrientedMesh, TriId, TriMesh, TriangleSoup, VertexId};
use welter_meshing::{Monitor, surface::EdgeId};
use welter_predicates::{Sign, orient3d};

use super::super::{HalfEdge, MovingSurface, RadialConnectivity};
use super::error::Stop;
use super::patches::Patches;
use super::{Body, UnionError, UnionObstacle};

/// Both as one mesh: vertices and triangles of the shape follow those of the surface.
#[derive(Debug)]
pub(super) struct Overlay {
    pub(super) mesh: TriMesh,
    pub(super) connectivity: RadialConnectivity,
    /// How many vertices and triangles the surface has.
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    /// By triangle, whether it is of a component with a boundary.
    pub(super) open: Vec<bool>,
    /// Around all of the surface, and of the shape.
    pub(super) boxes: [Box3; 2],
}

impl Overlay {
    /// A compacted surface, and a shape that is moved by a shift.
    pub(super) fn new(surface: &MovingSurface, shape: &Body, shift: DVec3) -> Result<Self, Stop> {
        let (vertices, triangles) = (surface.positions().len(), surface.connectivity().triangle_count());
        let mut positions = surface.positions().to_vec();
        let moved = |&p: &DVec3| if shift == DVec3::ZERO { p } else { p + shift };
        positions.extend(shape.positions.iter().map(moved));
        let mut corners: Vec<[VertexId; 3]> =
            surface.connectivity().triangles().map(|t| surface.connectivity().corners(t)).collect();
        let offset = |v: VertexId| VertexId::from_index(v.index() + vertices);
        corners.extend(shape.triangles.iter().map(|corners| corners.map(offset)));
        let boxes =
            [&positions[..vertices], &positions[vertices..]].map(|part| Box3::of(part.iter().copied()));
        let connectivity = RadialConnectivity::canonical(positions.len(), corners.clone());
        let components = Patches::new(&connectivity, |_| true);
        let mut with_boundary = vec![false; components.count()];
        for edge in connectivity.edges().filter(|&edge| connectivity.is_boundary(edge)) {
            let half_edge = connectivity.around_edge(edge).next().expect("an edge in use");
            with_boundary[components.of(half_edge.triangle())] = true;
        }
        let open = connectivity.triangles().map(|t| with_boundary[components.of(t)]).collect();
        // Only a shift can lead beyond the range of numbers.
        let mesh = mesh_of(positions, &corners).ok_or(Stop::Degenerate(UnionObstacle::Range))?;
        Ok(Self { mesh, connectivity, vertices, triangles, open, boxes })
    }

    /// 0 for a triangle of the surface, 1 for one of the shape.
    pub(super) fn side(&self, triangle: TriId) -> usize {
        usize::from(triangle.index() >= self.triangles)
    }

    pub(super) fn position(&self, vertex: VertexId) -> DVec3 {
        self.mesh.positions()[vertex.index()]
    }

    pub(super) fn edges(&self, triangle: TriId) -> [EdgeId; 3] {
        [0, 1, 2].map(|k| self.connectivity.edge(HalfEdge::of(triangle, k)))
    }

    /// Whether a point lies strictly on the side to which the normal of a triangle points.
    pub(super) fn is_above(&self, triangle: TriId, point: DVec3) -> bool {
        let [a, b, c] = self.mesh.corners(triangle);
        orient3d(a, b, c, point) == Sign::Negative
    }

    /// The pairs of a triangle of the surface and one of the shape that meet.
    pub(super) fn meeting(&self, shifted: bool, monitor: &Monitor<'_>) -> Result<Vec<[TriId; 2]>, Stop> {
        let (mut within, mut between) = (Vec::new(), Vec::new());
        for pair in self_intersections(&self.mesh, monitor)? {
            let [a, b] = pair.map(|t| self.side(t));
            if a == b { &mut within } else { &mut between }.push(pair);
        }
        if !within.is_empty() {
            // A shift may have rounded the shape so.
            let all_of_shape = within.iter().all(|pair| self.side(pair[0]) == 1);
            let error = UnionError::SelfIntersection { pairs: within };
            return Err(if shifted && all_of_shape {
                Stop::Degenerate(UnionObstacle::Intersection)
            } else {
                error.into()
            });
        }
        match between.iter().find(|pair| self.open[pair[0].index()]) {
            Some(&[triangle, _]) => Err(UnionError::Sheet { triangle }.into()),
            None => Ok(between),
        }
    }

    /// The triangles of the closed components of one side, as a mesh, with their ids.
    pub(super) fn closed(&self, side: usize) -> (ClosedOrientedMesh, Vec<TriId>) {
        let of_side = |t: &TriId| self.side(*t) == side && !self.open[t.index()];
        let ids: Vec<TriId> = self.connectivity.triangles().filter(of_side).collect();
        let corners: Vec<[VertexId; 3]> = ids.iter().map(|&t| self.connectivity.corners(t)).collect();
        let mesh = mesh_of(self.mesh.positions().to_vec(), &corners).expect("a part of a mesh");
        (ClosedOrientedMesh::new(mesh).expect("components without boundary, whose edges are balanced"), ids)
    }
}

/// A mesh; none if a position is not finite.
pub(super) fn mesh_of(positions: Vec<DVec3>, corners: &[[VertexId; 3]]) -> Option<TriMesh> {
    let triangles = corners.iter().map(|corners| corners.map(|v| v.0)).collect();
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).ok()
}
