//! Operations as plans: each file makes the plan of one, `apply.rs` carries plans out.

mod apply;
mod collapse;
mod cut;
mod flip;
mod replace;
mod separate;
mod split;

use super::attributes::transfer::Entry;
use super::connectivity::change::{Change, PlannedChange};
use super::connectivity::{Consequences, Refusal};
use super::{EventKind, MovingSurface, VertexValueError};
use glam::DVec3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// An operation that keeps the surface admissible, made for one state of it.
#[derive(Clone, Debug)]
#[must_use]
pub struct Plan {
    revision: u64,
    kind: EventKind,
    change: PlannedChange,
    /// New places of new and old vertices.
    positions: Vec<(VertexId, DVec3)>,
    vertices: Vec<Entry>,
    edges: Vec<EdgeSource>,
    triangles: Vec<TriangleSource>,
}

impl Plan {
    /// Which operation it is, with the ids that it gives.
    #[must_use]
    pub fn kind(&self) -> EventKind {
        self.kind
    }

    /// Where vertices would be put that are new or move.
    #[must_use]
    pub fn positions(&self) -> &[(VertexId, DVec3)] {
        &self.positions
    }

    /// Puts a vertex that is new or moves elsewhere than on the straight line of which the plan was made. Values are passed on
    /// as planned.
    ///
    /// # Errors
    /// [`VertexValueError::Position`] for a coordinate that is not finite.
    ///
    /// # Panics
    /// If the plan neither makes nor moves the vertex.
    pub fn place(&mut self, vertex: VertexId, position: DVec3) -> Result<(), VertexValueError> {
        let entry = self.positions.iter_mut().find(|(v, _)| *v == vertex);
        let (_, place) = entry.expect("a vertex that the plan makes or moves");
        if !position.is_finite() {
            return Err(VertexValueError::Position { vertex, position });
        }
        *place = position;
        Ok(())
    }

    /// The triangles that would get other corners, with those corners.
    #[must_use]
    pub fn changed(&self) -> &[(TriId, [VertexId; 3])] {
        &self.change.change.recorner
    }

    /// The triangles that would go.
    #[must_use]
    pub fn removed(&self) -> &[TriId] {
        &self.change.change.remove
    }

    /// The corners of the triangles that would come.
    #[must_use]
    pub fn added(&self) -> &[[VertexId; 3]] {
        &self.change.change.add
    }
}

/// What an operation gave.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The new vertices.
    pub vertices: Vec<VertexId>,
    /// The new triangles, in the order of [`Plan::added`].
    pub triangles: Vec<TriId>,
}

/// A source of an edge's values. The target is named by its ends, in the order of the source's.
#[derive(Clone, Copy, Debug)]
struct EdgeSource {
    target: [VertexId; 2],
    source: EdgeId,
    interpolation: f64,
    share: f64,
}

#[derive(Clone, Copy, Debug)]
enum TriangleTarget {
    Old(TriId),
    /// A place in the list of added triangles.
    New(usize),
}

#[derive(Clone, Copy, Debug)]
struct TriangleSource {
    target: TriangleTarget,
    source: TriId,
    interpolation: f64,
    share: f64,
}

impl MovingSurface {
    /// What a plan would do beyond itself: how callers tell changes of topology from others. Costs as much as the
    /// stars of the vertices that it touches.
    ///
    /// # Panics
    /// If the surface has changed since the plan was made.
    #[must_use]
    pub fn consequences(&self, plan: &Plan) -> Consequences {
        assert_eq!(plan.revision, self.revision, "a plan is for one state of a surface");
        self.connectivity.consequences(&plan.change)
    }

    fn plan(&self, kind: EventKind, change: Change) -> Result<Plan, Refusal> {
        let change = self.connectivity.plan(change)?;
        Ok(Plan {
            revision: self.revision,
            kind,
            change,
            positions: Vec::new(),
            vertices: Vec::new(),
            edges: Vec::new(),
            triangles: Vec::new(),
        })
    }

    fn require_edge(&self, edge: EdgeId) -> Result<(), Refusal> {
        let known = self.connectivity.has_edge(edge);
        if known { Ok(()) } else { Err(Refusal::NotInUse { element: "edge", id: edge.0 }) }
    }

    fn require_vertex(&self, vertex: VertexId) -> Result<(), Refusal> {
        let known = self.connectivity.has_vertex(vertex);
        if known { Ok(()) } else { Err(Refusal::NotInUse { element: "vertex", id: vertex.0 }) }
    }

    fn require_triangle(&self, triangle: TriId) -> Result<(), Refusal> {
        let known = self.connectivity.has_triangle(triangle);
        if known { Ok(()) } else { Err(Refusal::NotInUse { element: "triangle", id: triangle.0 }) }
    }

    /// The point of a fraction of the way from one vertex to another; the ends themselves are exact.
    fn between(&self, from: VertexId, to: VertexId, fraction: f64) -> DVec3 {
        let (a, b) = (self.position(from), self.position(to));
        if fraction == 0.0 {
            return a;
        }
        if fraction == 1.0 {
            return b;
        }
        // Rounding may leave the segment's box, at the end of the range even the finite numbers.
        (a * (1.0 - fraction) + b * fraction).clamp(a.min(b), a.max(b))
    }
}

/// A vertex in the place of another.
fn renamed<const N: usize>(corners: [VertexId; N], from: VertexId, to: VertexId) -> [VertexId; N] {
    corners.map(|v| if v == from { to } else { v })
}
