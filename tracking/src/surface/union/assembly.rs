//! The surface of the pieces that stay, with all that belongs to it: [`Assembly`].
//!
//! # Ids
//! In between, elements have ids as after any other operation: what stays keeps its own, and what comes has those after all that there
//! were. So the log tells of the union as of other operations, between two events that close gaps.

use glam::DVec3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

use super::super::connectivity::{RadialConnectivity, SurfaceDefects};
use super::super::{EdgeChange, EventKind, MovingSurface, TriangleChange, VertexChange};
use super::UnionObstacle;
use super::error::Stop;
use super::inheritance::Inheritance;
use super::overlay::Overlay;
use super::piercing::Crossings;
use super::refinement::Refinement;

/// The pieces that stay, before the surface is changed.
pub(super) struct Assembly<'a> {
    pub(super) overlay: &'a Overlay,
    pub(super) crossings: &'a Crossings,
    pub(super) refinement: &'a Refinement,
    /// By piece.
    pub(super) stays: &'a [bool],
    pub(super) ids: Ids,
    /// The connectivity afterwards, without gaps.
    pub(super) connectivity: RadialConnectivity,
}

/// Which elements there are afterwards.
pub(super) struct Ids {
    /// Vertices of the refinement that stay or come; ascending.
    pub(super) vertices: Vec<VertexId>,
    /// In between: their ids.
    pub(super) between: Vec<VertexId>,
    /// Pieces that are whole triangles of the surface and stay, then those that come.
    pub(super) pieces: Vec<u32>,
    /// In between: their ids.
    pub(super) triangles: Vec<TriId>,
}

impl<'a> Assembly<'a> {
    pub(super) fn new(
        overlay: &'a Overlay,
        crossings: &'a Crossings,
        refinement: &'a Refinement,
        stays: &'a [bool],
    ) -> Result<Self, Stop> {
        let ids = Ids::new(overlay, crossings, refinement, stays);
        let mut new = vec![VertexId(u32::MAX); refinement.positions.len()];
        for (i, &v) in ids.vertices.iter().enumerate() {
            new[v.index()] = VertexId::from_index(i);
        }
        let corners = |&piece: &u32| refinement.pieces[piece as usize].corners.map(|v| new[v.index()]);
        let corners = ids.pieces.iter().map(corners).collect();
        let connectivity = RadialConnectivity::canonical(ids.vertices.len(), corners);
        let boundary = |mesh: &RadialConnectivity| mesh.edges().filter(|&e| mesh.is_boundary(e)).count();
        let closed = boundary(&connectivity) == boundary(&overlay.connectivity);
        if !closed || !SurfaceDefects::of(&connectivity).is_empty() {
            return Err(Stop::Degenerate(UnionObstacle::Parts));
        }
        Ok(Self { overlay, crossings, refinement, stays, ids, connectivity })
    }

    /// The corners of the triangles afterwards, with their positions.
    pub(super) fn mesh(&self) -> Option<welter_meshing::surface::TriMesh> {
        let positions = self.ids.vertices.iter().map(|v| self.refinement.positions[v.index()]).collect();
        let corners: Vec<[VertexId; 3]> =
            self.connectivity.triangles().map(|t| self.connectivity.corners(t)).collect();
        super::overlay::mesh_of(positions, &corners)
    }

    /// The volume of what came less that of what went, seen from a vertex of the shape: where both are cut they fit together.
    pub(super) fn added_volume(&self) -> f64 {
        let mesh = &self.overlay.mesh;
        let eye = mesh.positions()[self.overlay.vertices];
        let volume = |corners: [DVec3; 3]| {
            let [a, b, c] = corners.map(|corner| corner - eye);
            a.dot(b.cross(c)) / 6.0
        };
        let [_, kept] = self.kept();
        let came = self.ids.pieces[kept..].iter().map(|&piece| {
            volume(
                self.refinement.pieces[piece as usize].corners.map(|v| self.refinement.positions[v.index()]),
            )
        });
        let mut kept = self.ids.triangles[..kept].iter().peekable();
        let went =
            (0..self.overlay.triangles).map(TriId::from_index).filter(|t| kept.next_if_eq(&t).is_none());
        came.sum::<f64>() - went.map(|t| volume(mesh.corners(t))).sum::<f64>()
    }

    /// How many vertices and triangles stay as they are.
    pub(super) fn kept(&self) -> [usize; 2] {
        let vertices = self.ids.between.partition_point(|v| v.index() < self.overlay.vertices);
        let triangles = self.ids.triangles.partition_point(|t| t.index() < self.overlay.triangles);
        [vertices, triangles]
    }

    /// Changes the surface, which is compacted and was not changed since.
    pub(super) fn apply(self, surface: &mut MovingSurface) {
        let edges = Edges::new(&self, &surface.connectivity);
        self.log(surface, &edges);
        let inheritance = Inheritance::new(&self, &surface.connectivity, &edges);
        inheritance.apply(surface);

        let Ids { vertices, between, triangles, .. } = self.ids;
        let positions = &self.refinement.positions;
        surface.positions = vertices.iter().map(|v| positions[v.index()]).collect();
        surface.masses = between.iter().map(|v| surface.masses[v.index()]).collect();
        surface.vertex_attributes.gather(between.iter().map(|v| v.index()));
        surface.triangle_attributes.gather(triangles.iter().map(|t| t.index()));
        let old: Vec<(EdgeId, bool)> = edges.between.iter().map(|&edge| (edge, false)).collect();
        surface.edge_attributes.renumber(&old);
        surface.connectivity = self.connectivity;
        surface.revision += 1;
        surface.log.push(EventKind::Compact, [], [], []);
    }

    fn log(&self, surface: &mut MovingSurface, edges: &Edges) {
        let [kept_vertices, kept_triangles] = self.kept();
        let born = |&vertex: &VertexId| VertexChange { vertex, born: true };
        let gone = |vertex: VertexId| VertexChange { vertex, born: false };
        let missing = |count: usize, kept: Vec<u32>| {
            let mut kept = kept.into_iter().peekable();
            (0..count as u32).filter(move |&id| kept.next_if_eq(&id).is_none())
        };
        let kept = self.ids.between[..kept_vertices].iter().map(|v| v.0).collect();
        let lost = missing(self.overlay.vertices, kept);
        let vertices: Vec<VertexChange> = self.ids.between[kept_vertices..]
            .iter()
            .map(born)
            .chain(lost.map(|v| gone(VertexId(v))))
            .collect();
        let mesh = &surface.connectivity;
        let kept = self.ids.triangles[..kept_triangles].iter().map(|t| t.0).collect();
        let lost = missing(self.overlay.triangles, kept).map(|t| {
            let triangle = TriId(t);
            TriangleChange { triangle, before: Some(mesh.corners(triangle)), after: None }
        });
        let come = (kept_triangles..self.ids.triangles.len()).map(|i| {
            let corners = self.connectivity.corners(TriId::from_index(i));
            let after = Some(corners.map(|v| self.ids.between[v.index()]));
            TriangleChange { triangle: self.ids.triangles[i], before: None, after }
        });
        let triangles: Vec<TriangleChange> = lost.chain(come).collect();
        surface.log.push(EventKind::Unite, vertices, edges.changes.iter().copied(), triangles);
    }
}

impl Ids {
    fn new(overlay: &Overlay, crossings: &Crossings, refinement: &Refinement, stays: &[bool]) -> Self {
        let mut used = vec![false; refinement.positions.len()];
        let [mut pieces, mut come] = [Vec::new(), Vec::new()];
        let mut triangles = Vec::new();
        for (i, piece) in (0_u32..).zip(&refinement.pieces).filter(|&(i, _)| stays[i as usize]) {
            piece.corners.into_iter().for_each(|v| used[v.index()] = true);
            if overlay.side(piece.origin) == 0 && Refinement::is_whole(piece, crossings) {
                pieces.push(i);
                triangles.push(piece.origin);
            } else {
                come.push(i);
            }
        }
        triangles.extend((overlay.triangles..).map(TriId::from_index).take(come.len()));
        pieces.append(&mut come);
        let vertices: Vec<VertexId> =
            (0..used.len()).filter(|&v| used[v]).map(VertexId::from_index).collect();
        let own = vertices.partition_point(|v| v.index() < overlay.vertices);
        let mut between = vertices[..own].to_vec();
        between.extend((overlay.vertices..).map(VertexId::from_index).take(vertices.len() - own));
        Self { vertices, between, pieces, triangles }
    }
}

/// The edges afterwards.
pub(super) struct Edges {
    /// Their ids in between, by their ids afterwards.
    pub(super) between: Vec<EdgeId>,
    /// How many ids there are in between.
    pub(super) slots: usize,
    /// What went and came, by ends.
    changes: Vec<EdgeChange>,
}

impl Edges {
    fn new(assembly: &Assembly<'_>, before: &RadialConnectivity) -> Self {
        let after = &assembly.connectivity;
        let mut slots = before.edge_slots();
        let mut between = Vec::with_capacity(after.edge_slots());
        let mut changes = Vec::new();
        // Both lists ascend by ends, and directions are from the smaller vertex to the larger.
        let mut old = before.edges().map(|edge| (before.ends(edge), edge)).peekable();
        let gone = |(ends, edge): ([VertexId; 2], EdgeId)| EdgeChange { edge, ends, born: false };
        for edge in after.edges() {
            let ends = after.ends(edge).map(|v| assembly.ids.between[v.index()]);
            while let Some(lost) = old.next_if(|&(other, _)| other < ends) {
                changes.push(gone(lost));
            }
            if let Some((_, kept)) = old.next_if(|&(other, _)| other == ends) {
                between.push(kept);
            } else {
                let edge = EdgeId::from_index(slots);
                slots += 1;
                between.push(edge);
                changes.push(EdgeChange { edge, ends, born: true });
            }
        }
        changes.extend(old.map(gone));
        Self { between, slots, changes }
    }
}
