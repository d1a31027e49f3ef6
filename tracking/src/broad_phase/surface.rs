//! [`BroadPhase`]: the trees of a surface's elements, and what is asked of them.

use super::motion::Boxes;
use super::tree::{Tree, pairs_between, self_pairs};
use super::{BroadPhaseError, Motion};
use crate::surface::{EventKind, EventLog, MovingSurface, RadialConnectivity, Renumbering};
use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::spatial::Box3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// Boxes of all elements of a surface, to find those near each other.
///
/// Elements that meet by their ids are no candidates: a vertex and a triangle of which it is a corner, two edges with a
/// common end, an edge and a triangle of which it is a side. An edge that shares one vertex with a triangle is a
/// candidate, for the two may overlap in a plane.
///
/// What takes the connectivity of the surface takes that of the state followed; with another one, lists are without
/// meaning, and an id that it never gave out panics.
///
/// ```
/// use welter_meshing::{shapes, spatial::Box3};
/// use welter_tracking::broad_phase::{BroadPhase, Motion};
/// use welter_tracking::surface::MovingSurface;
///
/// let sphere = shapes::sphere(&shapes::Sphere { edge_length: 0.25, ..Default::default() })?;
/// let mut surface = MovingSurface::new(&sphere)?;
/// let mut broad_phase = BroadPhase::new(&surface, Motion::Rest)?;
/// let near = broad_phase.vertex_triangle_pairs(surface.connectivity(), 0.0)?;
///
/// // What is near at rest is so on the way, too.
/// let ends: Vec<_> = surface.positions().iter().map(|&p| 0.999 * p).collect();
/// broad_phase.refresh(&surface, Motion::To(&ends))?;
/// let swept = broad_phase.vertex_triangle_pairs(surface.connectivity(), 0.0)?;
/// assert!(near.iter().all(|pair| swept.contains(pair)));
///
/// // A change of the mesh costs what it touches.
/// broad_phase.refresh(&surface, Motion::Rest)?;
/// let edge = surface.connectivity().edges().next().expect("a sphere has edges");
/// let plan = surface.plan_split(edge, 0.5)?;
/// surface.apply(plan);
/// let log = surface.take_log();
/// broad_phase.follow(&surface, Motion::Rest, &log)?;
/// let middle = log.get(0).expect("one event").vertices[0].vertex;
/// let place = Box3::of([surface.position(middle)]);
/// assert_eq!(broad_phase.vertices_near(&place, 0.0)?, [middle]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct BroadPhase {
    vertices: Tree,
    edges: Tree,
    triangles: Tree,
}

fn checked(distance: f64) -> Result<f64, BroadPhaseError> {
    if distance.is_finite() && distance >= 0.0 {
        Ok(distance)
    } else {
        Err(BroadPhaseError::Distance { distance })
    }
}

impl BroadPhase {
    /// The boxes of a surface.
    ///
    /// # Errors
    /// [`BroadPhaseError::Ends`] or [`BroadPhaseError::End`] for a motion that is none of this surface.
    pub fn new(surface: &MovingSurface, motion: Motion<'_>) -> Result<Self, BroadPhaseError> {
        let boxes = Boxes::new(surface, motion)?;
        let mesh = surface.connectivity();
        boxes.check(mesh.vertices())?;
        let vertices = || Tree::new(mesh.vertices().map(|v| v.0), |v| boxes.vertex(v));
        let edges = || Tree::new(mesh.edges().map(|e| e.0), |e| boxes.edge(e));
        let triangles = || Tree::new(mesh.triangles().map(|t| t.0), |t| boxes.triangle(t));
        let (vertices, (edges, triangles)) = rayon::join(vertices, || rayon::join(edges, triangles));
        Ok(Self { vertices, edges, triangles })
    }

    /// Gives all elements new boxes: their positions or the motion have changed. Linear; for elements whose
    /// neighbours have become others it is as [`BroadPhase::new`].
    ///
    /// # Errors
    /// As [`BroadPhase::new`], and [`BroadPhaseError::NotFollowed`] if elements came or went that were not followed;
    /// nothing is changed then.
    pub fn refresh(&mut self, surface: &MovingSurface, motion: Motion<'_>) -> Result<(), BroadPhaseError> {
        let boxes = Boxes::new(surface, motion)?;
        let mesh = surface.connectivity();
        boxes.check(mesh.vertices())?;
        self.check_followed(surface)?;
        let Self { vertices, edges, triangles } = self;
        let refresh_vertices = || vertices.refresh(|v| boxes.vertex(v));
        let refresh_edges = || edges.refresh(|e| boxes.edge(e));
        let refresh_triangles = || triangles.refresh(|t| boxes.triangle(t));
        rayon::join(refresh_vertices, || rayon::join(refresh_edges, refresh_triangles));
        Ok(())
    }

    /// Whether the elements of a surface are those that were followed.
    pub(crate) fn check_followed(&self, surface: &MovingSurface) -> Result<(), BroadPhaseError> {
        let mesh = surface.connectivity();
        for (elements, followed) in [
            ("vertices", self.vertices.holds(mesh.vertex_count(), |v| mesh.has_vertex(VertexId(v)))),
            ("edges", self.edges.holds(mesh.edge_count(), |e| mesh.has_edge(EdgeId(e)))),
            ("triangles", self.triangles.holds(mesh.triangle_count(), |t| mesh.has_triangle(TriId(t)))),
        ] {
            if !followed {
                return Err(BroadPhaseError::NotFollowed { elements });
            }
        }
        Ok(())
    }

    /// Whether there is a finite end for each vertex in use.
    pub(crate) fn check_ends(&self, surface: &MovingSurface, ends: &[DVec3]) -> Result<(), BroadPhaseError> {
        Boxes::new(surface, Motion::To(ends))?.check(surface.connectivity().vertices())
    }

    /// Takes part in the operations of a log, which led to the state that the surface has now.
    ///
    /// Parts of a log may be followed twice, but none left out.
    ///
    /// # Errors
    /// As [`BroadPhase::new`]; nothing is changed then.
    pub fn follow(
        &mut self,
        surface: &MovingSurface,
        motion: Motion<'_>,
        log: &EventLog,
    ) -> Result<(), BroadPhaseError> {
        if log.iter().any(|event| event.kind == EventKind::Compact) {
            *self = Self::new(surface, motion)?;
            return Ok(());
        }
        let mut touched = Touched::default();
        for event in log.iter() {
            touched.vertices.extend(event.vertices.iter().map(|change| change.vertex));
            touched.edges.extend(event.edges.iter().map(|change| change.edge));
            touched.triangles.extend(event.triangles.iter().map(|change| change.triangle));
            match event.kind {
                EventKind::Collapse { kept: vertex, .. } | EventKind::Separate { vertex } => {
                    touched.star(surface.connectivity(), vertex);
                }
                EventKind::Cut { ring, .. } => {
                    ring.iter().for_each(|&v| touched.star(surface.connectivity(), v));
                }
                _ => {}
            }
        }
        self.update(surface, motion, touched)
    }

    /// Takes in that some vertices have moved, or got other ends.
    ///
    /// # Errors
    /// As [`BroadPhase::new`]; nothing is changed then.
    ///
    /// # Panics
    /// If the id of a vertex was never given out.
    pub fn moved(
        &mut self,
        surface: &MovingSurface,
        motion: Motion<'_>,
        vertices: &[VertexId],
    ) -> Result<(), BroadPhaseError> {
        let mut touched = Touched::default();
        vertices.iter().for_each(|&v| touched.star(surface.connectivity(), v));
        self.update(surface, motion, touched)
    }

    /// Takes in that a surface was compacted, all other changes of which were followed. Linear; the boxes are as they
    /// were.
    pub fn renumber(&mut self, renumbering: &Renumbering) {
        let Renumbering { vertices, edges, triangles } = renumbering;
        self.vertices.rename(vertices.iter().map(|v| v.0));
        self.edges.rename(edges.iter().map(|e| e.0));
        self.triangles.rename(triangles.iter().map(|t| t.0));
    }

    /// Takes in new boxes of some triangles at rest, in use or not, and leaves vertices and edges as they were: what
    /// suffices while triangles alone are asked for. [`BroadPhase::follow`] with the whole log makes up for it.
    pub(crate) fn set_triangles(&mut self, surface: &MovingSurface, triangles: impl Iterator<Item = TriId>) {
        let mesh = surface.connectivity();
        for t in triangles {
            let bounds = || Box3::of(mesh.corners(t).map(|v| surface.position(v)));
            set(&mut self.triangles, t.0, mesh.has_triangle(t), bounds);
        }
    }

    /// Whether a condition holds for all triangles whose boxes meet a box; asked in no particular order.
    pub(crate) fn all_triangles_near(
        &self,
        bounds: &Box3,
        mut holds: impl FnMut(TriId, &Box3) -> bool,
    ) -> bool {
        self.triangles.all_near(bounds, 0.0, |t, own| holds(TriId(t), own))
    }

    fn update(
        &mut self,
        surface: &MovingSurface,
        motion: Motion<'_>,
        touched: Touched,
    ) -> Result<(), BroadPhaseError> {
        let boxes = Boxes::new(surface, motion)?;
        let mesh = surface.connectivity();
        let Touched { vertices, edges, triangles } = touched.once();
        let edge_ends = edges.iter().filter(|&&e| mesh.has_edge(e)).flat_map(|&e| mesh.ends(e));
        let corners = triangles.iter().filter(|&&t| mesh.has_triangle(t)).flat_map(|&t| mesh.corners(t));
        boxes.check(
            vertices.iter().copied().filter(|&v| mesh.has_vertex(v)).chain(edge_ends).chain(corners),
        )?;
        for VertexId(v) in vertices {
            set(&mut self.vertices, v, mesh.has_vertex(VertexId(v)), || boxes.vertex(v));
        }
        for EdgeId(e) in edges {
            set(&mut self.edges, e, mesh.has_edge(EdgeId(e)), || boxes.edge(e));
        }
        for TriId(t) in triangles {
            set(&mut self.triangles, t, mesh.has_triangle(TriId(t)), || boxes.triangle(t));
        }
        Ok(())
    }

    /// All vertices and triangles whose boxes are within a distance, sorted; without the corners of a triangle.
    /// `mesh` is the surface that was followed, here and below.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`], as all that are given one.
    pub fn vertex_triangle_pairs(
        &self,
        mesh: &RadialConnectivity,
        distance: f64,
    ) -> Result<Vec<(VertexId, TriId)>, BroadPhaseError> {
        self.vertex_triangle_pairs_that(mesh, distance, |_, _| true)
    }

    /// Those of [`BroadPhase::vertex_triangle_pairs`] that pass a test, which is made within the parallel search, once
    /// for each pair, in no order that may be relied upon. Pairs that fail are not stored.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn vertex_triangle_pairs_that(
        &self,
        mesh: &RadialConnectivity,
        distance: f64,
        test: impl Fn(VertexId, TriId) -> bool + Sync,
    ) -> Result<Vec<(VertexId, TriId)>, BroadPhaseError> {
        let keep = |v, t| !is_corner(mesh, v, t) && test(VertexId(v), TriId(t));
        let pairs = pairs_between(&self.vertices, &self.triangles, checked(distance)?, keep);
        Ok(pairs.into_par_iter().map(|[v, t]| (VertexId(v), TriId(t))).collect())
    }

    /// All pairs of edges whose boxes are within a distance, the smaller id first, sorted; without those with a common end.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edge_edge_pairs(
        &self,
        mesh: &RadialConnectivity,
        distance: f64,
    ) -> Result<Vec<[EdgeId; 2]>, BroadPhaseError> {
        self.edge_edge_pairs_that(mesh, distance, |_, _| true)
    }

    /// Those of [`BroadPhase::edge_edge_pairs`] that pass a test, as [`BroadPhase::vertex_triangle_pairs_that`]. The test
    /// is given the edges in either order.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edge_edge_pairs_that(
        &self,
        mesh: &RadialConnectivity,
        distance: f64,
        test: impl Fn(EdgeId, EdgeId) -> bool + Sync,
    ) -> Result<Vec<[EdgeId; 2]>, BroadPhaseError> {
        let keep = |a, b| !have_common_end(mesh, a, b) && test(EdgeId(a), EdgeId(b));
        let pairs = self_pairs(&self.edges, checked(distance)?, keep);
        Ok(pairs.into_par_iter().map(|pair| pair.map(EdgeId)).collect())
    }

    /// All pairs of triangles whose boxes are within a distance and that pass a test, the smaller id first, sorted; also
    /// those that share vertices. The test as in [`BroadPhase::edge_edge_pairs_that`].
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn triangle_pairs_that(
        &self,
        distance: f64,
        test: impl Fn(TriId, TriId) -> bool + Sync,
    ) -> Result<Vec<[TriId; 2]>, BroadPhaseError> {
        let keep = |a, b| test(TriId(a), TriId(b));
        let pairs = self_pairs(&self.triangles, checked(distance)?, keep);
        Ok(pairs.into_par_iter().map(|pair| pair.map(TriId)).collect())
    }

    /// All edges and triangles whose boxes are within a distance, sorted; without the sides of a triangle.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edge_triangle_pairs(
        &self,
        mesh: &RadialConnectivity,
        distance: f64,
    ) -> Result<Vec<(EdgeId, TriId)>, BroadPhaseError> {
        let keep = |e, t| !is_side(mesh, e, t);
        let pairs = pairs_between(&self.edges, &self.triangles, checked(distance)?, keep);
        Ok(pairs.into_par_iter().map(|[e, t]| (EdgeId(e), TriId(t))).collect())
    }

    /// The vertices whose boxes are within a distance of a box, ascending. The box may be infinite; nothing is near an
    /// empty one.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn vertices_near(&self, bounds: &Box3, distance: f64) -> Result<Vec<VertexId>, BroadPhaseError> {
        let near = self.vertices.near(bounds, checked(distance)?, |_| true);
        Ok(near.into_iter().map(VertexId).collect())
    }

    /// The edges whose boxes are within a distance of a box, as [`BroadPhase::vertices_near`].
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edges_near(&self, bounds: &Box3, distance: f64) -> Result<Vec<EdgeId>, BroadPhaseError> {
        let near = self.edges.near(bounds, checked(distance)?, |_| true);
        Ok(near.into_iter().map(EdgeId).collect())
    }

    /// The triangles whose boxes are within a distance of a box, as [`BroadPhase::vertices_near`].
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn triangles_near(&self, bounds: &Box3, distance: f64) -> Result<Vec<TriId>, BroadPhaseError> {
        let near = self.triangles.near(bounds, checked(distance)?, |_| true);
        Ok(near.into_iter().map(TriId).collect())
    }

    /// The triangles that [`BroadPhase::vertex_triangle_pairs`] has with one vertex; none for a vertex not in use.
    /// The same holds for the elements below.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn triangles_near_vertex(
        &self,
        mesh: &RadialConnectivity,
        vertex: VertexId,
        distance: f64,
    ) -> Result<Vec<TriId>, BroadPhaseError> {
        let keep = |t| !is_corner(mesh, vertex.0, t);
        let near = beside(&self.triangles, self.vertices.bounds(vertex.0), checked(distance)?, keep);
        Ok(near.into_iter().map(TriId).collect())
    }

    /// The vertices that [`BroadPhase::vertex_triangle_pairs`] has with one triangle.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn vertices_near_triangle(
        &self,
        mesh: &RadialConnectivity,
        triangle: TriId,
        distance: f64,
    ) -> Result<Vec<VertexId>, BroadPhaseError> {
        let keep = |v| !is_corner(mesh, v, triangle.0);
        let near = beside(&self.vertices, self.triangles.bounds(triangle.0), checked(distance)?, keep);
        Ok(near.into_iter().map(VertexId).collect())
    }

    /// The edges that [`BroadPhase::edge_edge_pairs`] has with one edge.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edges_near_edge(
        &self,
        mesh: &RadialConnectivity,
        edge: EdgeId,
        distance: f64,
    ) -> Result<Vec<EdgeId>, BroadPhaseError> {
        // An edge has both ends in common with itself.
        let keep = |e| !have_common_end(mesh, edge.0, e);
        let near = beside(&self.edges, self.edges.bounds(edge.0), checked(distance)?, keep);
        Ok(near.into_iter().map(EdgeId).collect())
    }

    /// The triangles that [`BroadPhase::edge_triangle_pairs`] has with one edge.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn triangles_near_edge(
        &self,
        mesh: &RadialConnectivity,
        edge: EdgeId,
        distance: f64,
    ) -> Result<Vec<TriId>, BroadPhaseError> {
        let keep = |t| !is_side(mesh, edge.0, t);
        let near = beside(&self.triangles, self.edges.bounds(edge.0), checked(distance)?, keep);
        Ok(near.into_iter().map(TriId).collect())
    }

    /// The edges that [`BroadPhase::edge_triangle_pairs`] has with one triangle.
    ///
    /// # Errors
    /// [`BroadPhaseError::Distance`].
    pub fn edges_near_triangle(
        &self,
        mesh: &RadialConnectivity,
        triangle: TriId,
        distance: f64,
    ) -> Result<Vec<EdgeId>, BroadPhaseError> {
        let keep = |e| !is_side(mesh, e, triangle.0);
        let near = beside(&self.edges, self.triangles.bounds(triangle.0), checked(distance)?, keep);
        Ok(near.into_iter().map(EdgeId).collect())
    }
}

/// Elements whose boxes may have changed, whether they are in use or not.
#[derive(Default)]
struct Touched {
    vertices: Vec<VertexId>,
    edges: Vec<EdgeId>,
    triangles: Vec<TriId>,
}

impl Touched {
    fn star(&mut self, mesh: &RadialConnectivity, vertex: VertexId) {
        self.vertices.push(vertex);
        for h in mesh.star(vertex) {
            self.edges.extend([mesh.edge(h), mesh.edge(h.previous())]);
            self.triangles.push(h.triangle());
        }
    }

    /// Each element once, ascending.
    fn once(mut self) -> Self {
        fn sort<T: Ord>(ids: &mut Vec<T>) {
            ids.sort_unstable();
            ids.dedup();
        }
        sort(&mut self.vertices);
        sort(&mut self.edges);
        sort(&mut self.triangles);
        self
    }
}

fn set(tree: &mut Tree, element: u32, in_use: bool, bounds: impl FnOnce() -> Box3) {
    if in_use {
        tree.set(element, bounds());
    } else {
        tree.remove(element);
    }
}

fn beside(tree: &Tree, bounds: Option<&Box3>, distance: f64, keep: impl Fn(u32) -> bool) -> Vec<u32> {
    bounds.map_or_else(Vec::new, |bounds| tree.near(bounds, distance, keep))
}

fn is_corner(mesh: &RadialConnectivity, vertex: u32, triangle: u32) -> bool {
    mesh.corners(TriId(triangle)).contains(&VertexId(vertex))
}

fn have_common_end(mesh: &RadialConnectivity, a: u32, b: u32) -> bool {
    let ends = mesh.ends(EdgeId(a));
    mesh.ends(EdgeId(b)).iter().any(|end| ends.contains(end))
}

fn is_side(mesh: &RadialConnectivity, edge: u32, triangle: u32) -> bool {
    let corners = mesh.corners(TriId(triangle));
    mesh.ends(EdgeId(edge)).iter().all(|end| corners.contains(end))
}
