//! [`MovingSurface`]: positions, masses, attributes and connectivity that change together.

use super::attributes::AttributeSet;
use super::connectivity::{ConnectivityDefect, OldIds, RadialConnectivity, SurfaceDefects};
use super::log::{EventKind, EventLog};
use super::mass::MassRule;
use glam::DVec3;
use thiserror::Error;
use welter_meshing::surface::{EdgeId, TriId, TriMesh, TriangleSoup, VertexId};

/// A surface whose triangles may change: the state of a tracker.
///
/// ```
/// use welter_meshing::{shapes, surface::EmbeddedMesh};
/// use welter_tracking::surface::{MovingSurface, Rule};
///
/// let sphere = shapes::sphere(&shapes::Sphere { edge_length: 0.5, ..Default::default() })?;
/// let sphere = EmbeddedMesh::new(sphere)?;
/// let mut surface = MovingSurface::new(&sphere)?;
/// let heights = surface.positions().iter().map(|p| p.z).collect();
/// let height = surface.vertex_attributes_mut().add("height", heights, Rule::Interpolate)?;
///
/// let edge = surface.connectivity().edges().next().expect("a sphere has edges");
/// let plan = surface.plan_split(edge, 0.5)?;
/// surface.apply(plan);
///
/// let middle = surface.log().get(0).expect("one event").vertices[0].vertex;
/// let z = surface.vertex_attributes().values(height)[middle.index()];
/// assert_eq!(z, surface.position(middle).z);
/// assert_eq!(surface.check(), Ok(()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MovingSurface {
    pub(super) connectivity: RadialConnectivity,
    pub(super) positions: Vec<DVec3>,
    pub(super) masses: Vec<f64>,
    pub(super) mass_rule: MassRule,
    pub(super) vertex_attributes: AttributeSet<VertexId>,
    pub(super) edge_attributes: AttributeSet<EdgeId>,
    pub(super) triangle_attributes: AttributeSet<TriId>,
    pub(super) log: EventLog,
    /// Counts changes of connectivity, so that a plan is not applied to another state.
    pub(super) revision: u64,
}

/// Why a value of a vertex is refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum VertexValueError {
    /// A coordinate is infinite or not a number.
    #[error("vertex {} would have the position ({}, {}, {})", vertex.0, position.x, position.y, position.z)]
    Position {
        /// Which vertex.
        vertex: VertexId,
        /// The position given.
        position: DVec3,
    },
    /// A mass is not positive.
    #[error("vertex {} would have the mass {mass}, must be positive, or infinite if it is immovable", vertex.0)]
    Mass {
        /// Which vertex.
        vertex: VertexId,
        /// The mass given.
        mass: f64,
    },
}

/// Where a [`MovingSurface`] is broken: a bug of this library.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StateDefect {
    /// Its connectivity is.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityDefect),
    /// A position or a mass is out of range.
    #[error(transparent)]
    Value(#[from] VertexValueError),
    /// An array has not one value for each id.
    #[error("there are {values} {what} for {ids} ids")]
    Length {
        /// Values of what.
        what: &'static str,
        /// How many values there are.
        values: usize,
        /// How many ids.
        ids: usize,
    },
}

/// Old ids of all elements in the order of their new ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renumbering {
    /// The old id of each vertex; ascending.
    pub vertices: Vec<VertexId>,
    /// The old id of each edge. Edges ascend by their vertices, and are directed from the smaller to the larger.
    pub edges: Vec<EdgeId>,
    /// The old id of each triangle; ascending.
    pub triangles: Vec<TriId>,
}

impl MovingSurface {
    /// A surface of unit masses, without attributes, from any mesh that is admissible: an
    /// [`EmbeddedMesh`](welter_meshing::surface::EmbeddedMesh), or one with a boundary. Vertices without triangles are
    /// not in use, but keep their places in the arrays until the surface is compacted.
    ///
    /// # Errors
    /// [`SurfaceDefects`]: every edge and triangle that is not admissible.
    pub fn new(mesh: &TriMesh) -> Result<Self, SurfaceDefects> {
        let connectivity = RadialConnectivity::new(mesh)?;
        Ok(Self {
            positions: mesh.positions().to_vec(),
            masses: vec![1.0; mesh.positions().len()],
            mass_rule: MassRule::default(),
            vertex_attributes: AttributeSet::new(connectivity.vertex_slots()),
            edge_attributes: AttributeSet::new(connectivity.edge_slots()),
            triangle_attributes: AttributeSet::new(connectivity.triangle_slots()),
            log: EventLog::default(),
            revision: 0,
            connectivity,
        })
    }

    /// Triangles, edges and vertices, and which of them meet.
    #[must_use]
    pub fn connectivity(&self) -> &RadialConnectivity {
        &self.connectivity
    }

    /// Positions by vertex id; those of free ids are without meaning, but finite.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The position of a vertex.
    ///
    /// # Panics
    /// If its id was never given out.
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> DVec3 {
        self.positions[vertex.index()]
    }

    /// Moves a vertex. Nothing is asked about intersections here.
    ///
    /// # Errors
    /// [`VertexValueError::Position`] for a coordinate that is not finite.
    ///
    /// # Panics
    /// If its id was never given out.
    pub fn set_position(&mut self, vertex: VertexId, position: DVec3) -> Result<(), VertexValueError> {
        if !position.is_finite() {
            return Err(VertexValueError::Position { vertex, position });
        }
        self.positions[vertex.index()] = position;
        Ok(())
    }

    /// Masses by vertex id; infinite for vertices that never move.
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// Gives a vertex a mass; infinite makes it immovable.
    ///
    /// # Errors
    /// [`VertexValueError::Mass`] unless it is above zero.
    ///
    /// # Panics
    /// If its id was never given out.
    pub fn set_mass(&mut self, vertex: VertexId, mass: f64) -> Result<(), VertexValueError> {
        if mass > 0.0 {
            self.masses[vertex.index()] = mass;
            Ok(())
        } else {
            Err(VertexValueError::Mass { vertex, mass })
        }
    }

    /// Sets how masses pass through changes from now on.
    pub fn set_mass_rule(&mut self, rule: MassRule) {
        self.mass_rule = rule;
    }

    /// Attributes of vertices.
    #[must_use]
    pub fn vertex_attributes(&self) -> &AttributeSet<VertexId> {
        &self.vertex_attributes
    }

    /// Attributes of vertices, to add some or change their values.
    #[must_use]
    pub fn vertex_attributes_mut(&mut self) -> &mut AttributeSet<VertexId> {
        &mut self.vertex_attributes
    }

    /// Attributes of edges.
    #[must_use]
    pub fn edge_attributes(&self) -> &AttributeSet<EdgeId> {
        &self.edge_attributes
    }

    /// Attributes of edges, to add some or change their values.
    #[must_use]
    pub fn edge_attributes_mut(&mut self) -> &mut AttributeSet<EdgeId> {
        &mut self.edge_attributes
    }

    /// Attributes of triangles.
    #[must_use]
    pub fn triangle_attributes(&self) -> &AttributeSet<TriId> {
        &self.triangle_attributes
    }

    /// Attributes of triangles, to add some or change their values.
    #[must_use]
    pub fn triangle_attributes_mut(&mut self) -> &mut AttributeSet<TriId> {
        &mut self.triangle_attributes
    }

    /// What happened since the log was last taken.
    #[must_use]
    pub fn log(&self) -> &EventLog {
        &self.log
    }

    /// Takes the log out; a new one begins.
    #[must_use]
    pub fn take_log(&mut self) -> EventLog {
        std::mem::take(&mut self.log)
    }

    /// The surface as a mesh, numbered as [`MovingSurface::compact`] does; without groups and colours.
    #[must_use]
    pub fn to_mesh(&self) -> TriMesh {
        let mut new = vec![u32::MAX; self.connectivity.vertex_slots()];
        let mut positions = Vec::with_capacity(self.connectivity.vertex_count());
        for (i, v) in (0..).zip(self.connectivity.vertices()) {
            new[v.index()] = i;
            positions.push(self.position(v));
        }
        let corners = |t| self.connectivity.corners(t).map(|v| new[v.index()]);
        let triangles = self.connectivity.triangles().map(corners).collect();
        let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
        TriMesh::new(soup).expect("positions are finite and corners differ")
    }

    /// Numbers all elements anew, without gaps: vertices and triangles in their order, edges by their vertices.
    ///
    /// Afterwards the connectivity depends on corners alone, not on what made them: it is that of
    /// [`RadialConnectivity::new`]. So a surface that was stored in between goes on as one that was not. Linear in
    /// the number of elements.
    pub fn compact(&mut self) -> Renumbering {
        let OldIds { vertices, edges, triangles } = self.connectivity.compact();
        // Old ids ascend, so values move down within their arrays.
        for (new, old) in vertices.iter().enumerate() {
            self.positions[new] = self.positions[old.index()];
            self.masses[new] = self.masses[old.index()];
        }
        self.positions.truncate(vertices.len());
        self.masses.truncate(vertices.len());
        self.vertex_attributes.gather(vertices.iter().map(|v| v.index()));
        self.triangle_attributes.gather(triangles.iter().map(|t| t.index()));
        self.edge_attributes.renumber(&edges);
        self.revision += 1;
        self.log.push(EventKind::Compact, [], [], []);
        Renumbering { vertices, edges: edges.into_iter().map(|(edge, _)| edge).collect(), triangles }
    }

    /// Whether every invariant holds, from scratch. Near linear in the number of triangles.
    ///
    /// # Errors
    /// [`StateDefect`]: the first that is found.
    pub fn check(&self) -> Result<(), StateDefect> {
        self.connectivity.check()?;
        let ids = self.connectivity.vertex_slots();
        for (what, values) in [("positions", self.positions.len()), ("masses", self.masses.len())] {
            if values != ids {
                return Err(StateDefect::Length { what, values, ids });
            }
        }
        let attributes = [
            ("values at vertices", self.vertex_attributes.slots(), ids),
            ("values at edges", self.edge_attributes.slots(), self.connectivity.edge_slots()),
            ("values at triangles", self.triangle_attributes.slots(), self.connectivity.triangle_slots()),
        ];
        for (what, values, ids) in attributes {
            if values.is_some_and(|values| values != ids) {
                return Err(StateDefect::Length { what, values: values.unwrap_or(0), ids });
            }
        }
        for vertex in self.connectivity.vertices() {
            let (position, mass) = (self.position(vertex), self.masses[vertex.index()]);
            if !position.is_finite() {
                return Err(VertexValueError::Position { vertex, position }.into());
            }
            if mass.is_nan() || mass <= 0.0 {
                return Err(VertexValueError::Mass { vertex, mass }.into());
            }
        }
        Ok(())
    }
}
