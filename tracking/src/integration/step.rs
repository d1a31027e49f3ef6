//! The state that the stages of a resolution work on: [`Step`], ends that change and the pairs that collide on the way to
//! them.
//!
//! # What it promises
//! * After [`Step::detect`], [`Step::colliding`] holds exactly the pairs of elements without a common vertex that touch
//!   on the straight ways from the surface to the current ends, sorted; but for pairs that do not move at all, which an
//!   embedded surface keeps apart. Or the step is crowded: there are more of them than the limit, or of pairs that take
//!   exact integers to tell, which are slow, or of pairs to ask about.
//! * Only pairs with a vertex whose end has changed since are asked about again.
//! * Nothing depends on the number of threads: detection collects and sorts, changes are made in order.
//!
//! # Complexity
//! The first detection, and those after many changes, as the pairs of the broad phase; others as the stars of the
//! vertices whose ends have changed, and what is near them.

use super::contact::{Contact, ElementPair};
use super::{IntegrationError, IntegrationParameters, IntegrationReport};
use crate::broad_phase::{BroadPhase, Motion};
use crate::surface::MovingSurface;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use welter_meshing::Monitor;
use welter_meshing::surface::{EdgeId, TriId, VertexId};
use welter_predicates::ccd;

/// A vertex changed with its star costs the broad phase some dozen times as much as in a refreshment of all, and
/// asking around it more than in a descent of all.
const MANY: usize = 16;

/// The least weight of the movable vertices of a contact with immovable ones through which it is pushed: with less, they
/// would go more than so many times as far as the point of contact.
const LEAST_LEVER: f64 = 1.0 / 64.0;

pub(super) struct Step<'a> {
    pub(super) surface: &'a MovingSurface,
    pub(super) parameters: &'a IntegrationParameters,
    pub(super) report: IntegrationReport,
    broad_phase: &'a mut BroadPhase,
    monitor: &'a Monitor<'a>,
    ends: Vec<DVec3>,
    /// By vertex: what it gives way in comparison with the lightest one; 0 for an immovable one.
    mobility: Vec<f64>,
    /// By vertex: whether its end has changed since collisions were detected.
    changed: Vec<bool>,
    changes: Vec<VertexId>,
    /// Whether collisions have been detected for these ends but for the changes.
    detected: bool,
    colliding: Vec<ElementPair>,
    crowded: bool,
}

impl<'a> Step<'a> {
    pub(super) fn new(
        surface: &'a MovingSurface,
        broad_phase: &'a mut BroadPhase,
        parameters: &'a IntegrationParameters,
        monitor: &'a Monitor<'a>,
    ) -> Self {
        let mesh = surface.connectivity();
        let lightest = mesh.vertices().fold(f64::INFINITY, |m, v| m.min(surface.masses()[v.index()]));
        let mobility = |&mass: &f64| if mass.is_finite() { (lightest / mass).min(1.0) } else { 0.0 };
        Self {
            surface,
            parameters,
            report: IntegrationReport::default(),
            broad_phase,
            monitor,
            ends: surface.positions().to_vec(),
            mobility: surface.masses().iter().map(mobility).collect(),
            changed: vec![false; mesh.vertex_slots()],
            changes: Vec::new(),
            detected: false,
            colliding: Vec::new(),
            crowded: false,
        }
    }

    /// Begins anew with other ends.
    pub(super) fn begin(&mut self, ends: Vec<DVec3>) {
        self.ends = ends;
        self.forget_changes();
        (self.detected, self.crowded) = (false, false);
        self.colliding.clear();
    }

    pub(super) fn ends(&self) -> &[DVec3] {
        &self.ends
    }

    pub(super) fn into_ends(self) -> (Vec<DVec3>, IntegrationReport) {
        (self.ends, self.report)
    }

    /// The pairs that collide, as of the last detection.
    pub(super) fn colliding(&self) -> &[ElementPair] {
        &self.colliding
    }

    /// Whether there were too many collisions to list them.
    pub(super) fn is_crowded(&self) -> bool {
        self.crowded
    }

    pub(super) fn collides(&self) -> bool {
        self.crowded || !self.colliding.is_empty()
    }

    pub(super) fn mobility(&self, v: VertexId) -> f64 {
        self.mobility[v.index()]
    }

    pub(super) fn displacement(&self, v: VertexId) -> DVec3 {
        self.ends[v.index()] - self.surface.position(v)
    }

    /// Gives a vertex an end, unless that is not finite.
    pub(super) fn set_end(&mut self, v: VertexId, end: DVec3) {
        if !end.is_finite() || end == self.ends[v.index()] {
            return;
        }
        self.ends[v.index()] = end;
        if self.detected && !self.changed[v.index()] {
            self.changed[v.index()] = true;
            self.changes.push(v);
        }
    }

    /// The relative displacement of the points of contact.
    pub(super) fn relative(&self, contact: &Contact) -> DVec3 {
        contact.weighted(contact.vertices.map(|v| self.displacement(v)))
    }

    /// Changes the relative displacement of a contact by so much along a direction, by an impulse on its four vertices.
    /// False if none of them can move.
    pub(super) fn push(&mut self, contact: &Contact, direction: DVec3, change: f64) -> bool {
        let Some(yielding) = self.yielding(contact) else { return false };
        for (i, &v) in contact.vertices.iter().enumerate() {
            let share = contact.weights[i] * self.mobility(v) / yielding;
            if share != 0.0 {
                self.set_end(v, self.ends[v.index()] + (share * change) * direction);
            }
        }
        true
    }

    /// How much the relative displacement changes for a unit impulse; none if the contact does not give way.
    pub(super) fn yielding(&self, contact: &Contact) -> Option<f64> {
        let mobility = contact.vertices.map(|v| self.mobility(v));
        let squares: [f64; 4] =
            std::array::from_fn(|i| contact.weights[i] * contact.weights[i] * mobility[i]);
        let yielding = (squares[0] + squares[1]) + (squares[2] + squares[3]);
        let most = mobility.into_iter().fold(0.0, f64::max);
        (yielding > LEAST_LEVER * LEAST_LEVER * most).then_some(yielding)
    }

    /// The places of a pair's vertices at the beginning and at the end.
    pub(super) fn places(&self, vertices: [VertexId; 4]) -> [[DVec3; 4]; 2] {
        [vertices.map(|v| self.surface.position(v)), vertices.map(|v| self.ends[v.index()])]
    }

    /// Whether the end of one of the vertices has changed since collisions were detected.
    pub(super) fn has_changed(&self, vertices: &[VertexId]) -> bool {
        vertices.iter().any(|v| self.changed[v.index()])
    }

    /// The first contact of a pair on the way to the current ends.
    pub(super) fn impact(&self, pair: ElementPair) -> Option<Contact> {
        let vertices = pair.vertices(self.surface.connectivity());
        let [from, to] = self.places(vertices);
        pair.impact(vertices, from, to)
    }

    /// Finds the pairs that collide. Does nothing if they are known.
    pub(super) fn detect(&mut self) -> Result<(), IntegrationError> {
        self.monitor.check()?;
        if self.detected && self.changes.is_empty() {
            return Ok(());
        }
        let mesh = self.surface.connectivity();
        let limit = self.limit();
        let found = if !self.detected || MANY * self.changes.len() > mesh.vertex_count() {
            self.broad_phase.refresh(self.surface, Motion::To(&self.ends))?;
            self.found_everywhere(limit)?
        } else {
            self.changes.sort_unstable();
            self.broad_phase.moved(self.surface, Motion::To(&self.ends), &self.changes)?;
            self.found_around_changes(limit)?
        };
        self.monitor.check()?;
        let changed = &self.changed;
        self.colliding.retain(|pair| !pair.vertices(mesh).iter().any(|v| changed[v.index()]));
        self.colliding.extend(found.pairs);
        self.colliding.sort_unstable();
        self.crowded = found.too_many || self.colliding.len() > limit;
        if self.crowded {
            self.colliding.clear();
        }
        self.detected = !self.crowded;
        self.forget_changes();
        Ok(())
    }

    fn forget_changes(&mut self) {
        for v in self.changes.drain(..) {
            self.changed[v.index()] = false;
        }
    }

    fn limit(&self) -> usize {
        let vertices = self.surface.connectivity().vertex_count().max(FEW);
        vertices.saturating_mul(self.parameters.most_collisions_per_vertex as usize)
    }

    /// Whether a pair is to be asked about and collides.
    fn touches(&self, pair: ElementPair, counter: &Counter<'_>) -> bool {
        let vertices = pair.vertices(self.surface.connectivity());
        if self.detected && !self.has_changed(&vertices) {
            return false;
        }
        let [from, to] = self.places(vertices);
        if from == to {
            return false;
        }
        counter.ask();
        if counter.is_full() {
            return false;
        }
        let (touches, stage) = pair.collides(from, to);
        if stage == ccd::Stage::Exact {
            counter.count(EXACT);
        } else if touches {
            counter.count(1);
        }
        touches
    }

    /// By descents of all; of the changes, if there was a detection before.
    fn found_everywhere(&self, limit: usize) -> Result<Found, IntegrationError> {
        let (mesh, counter) = (self.surface.connectivity(), Counter::new(limit, self.monitor));
        let vertex_triangle = |v, t| self.touches(ElementPair::VertexTriangle(v, t), &counter);
        let edge_edge = |a, b| self.touches(ElementPair::edges(a, b), &counter);
        let vertex_triangle = self.broad_phase.vertex_triangle_pairs_that(mesh, 0.0, vertex_triangle)?;
        let edge_edge = self.broad_phase.edge_edge_pairs_that(mesh, 0.0, edge_edge)?;
        let vertex_triangle = vertex_triangle.into_iter().map(|(v, t)| ElementPair::VertexTriangle(v, t));
        let edge_edge = edge_edge.into_iter().map(|[a, b]| ElementPair::EdgeEdge(a, b));
        Ok(Found { pairs: vertex_triangle.chain(edge_edge).collect(), too_many: counter.is_over() })
    }

    /// By what is near the changed vertices and the elements at them.
    fn found_around_changes(&self, limit: usize) -> Result<Found, IntegrationError> {
        let (mesh, counter) = (self.surface.connectivity(), Counter::new(limit, self.monitor));
        let mut triangles: Vec<TriId> = Vec::new();
        let mut edges: Vec<EdgeId> = Vec::new();
        for &v in &self.changes {
            for h in mesh.star(v) {
                triangles.push(h.triangle());
                edges.extend([mesh.edge(h), mesh.edge(h.previous())]);
            }
        }
        triangles.sort_unstable();
        triangles.dedup();
        edges.sort_unstable();
        edges.dedup();
        let at_vertex = |&v: &VertexId| -> Result<Vec<ElementPair>, IntegrationError> {
            let near = self.broad_phase.triangles_near_vertex(mesh, v, 0.0)?;
            Ok(self.those_that_touch(near.into_iter().map(|t| ElementPair::VertexTriangle(v, t)), &counter))
        };
        let at_triangle = |&t: &TriId| -> Result<Vec<ElementPair>, IntegrationError> {
            let near = self.broad_phase.vertices_near_triangle(mesh, t, 0.0)?;
            // Those of changed vertices are found above.
            let near = near.into_iter().filter(|v| !self.changed[v.index()]);
            Ok(self.those_that_touch(near.map(|v| ElementPair::VertexTriangle(v, t)), &counter))
        };
        let at_edge = |&e: &EdgeId| -> Result<Vec<ElementPair>, IntegrationError> {
            let near = self.broad_phase.edges_near_edge(mesh, e, 0.0)?;
            // Of two edges at changed vertices the smaller one asks.
            let near = near.into_iter().filter(|&f| e < f || !self.has_changed(&mesh.ends(f)));
            Ok(self.those_that_touch(near.map(|f| ElementPair::edges(e, f)), &counter))
        };
        let at_vertices: Vec<_> = self.changes.par_iter().map(at_vertex).collect::<Result<_, _>>()?;
        let at_triangles: Vec<_> = triangles.par_iter().map(at_triangle).collect::<Result<_, _>>()?;
        let at_edges: Vec<_> = edges.par_iter().map(at_edge).collect::<Result<_, _>>()?;
        let pairs = [at_vertices, at_triangles, at_edges].into_iter().flatten().flatten().collect();
        Ok(Found { pairs, too_many: counter.is_over() })
    }

    fn those_that_touch(
        &self,
        pairs: impl Iterator<Item = ElementPair>,
        counter: &Counter<'_>,
    ) -> Vec<ElementPair> {
        pairs.filter(|&pair| self.touches(pair, counter)).collect()
    }
}

/// As so many collisions counts a pair that takes exact integers to tell, whether it collides or not: it costs 100 microseconds,
/// some thirty times as much as others. Four, so that a crowd of them costs a vertex half a millisecond.
const EXACT: usize = 4;

/// Surfaces of fewer vertices have the limits of one of so many: they cost next to nothing.
const FEW: usize = 64;

/// So many pairs that are asked about count as one collision: a surface that moves by much more than its size has all of its
/// pairs asked about, which is quadratic. Of a step of an edge length, a vertex asks about one hundred pairs or less.
const ASKED: usize = 64;

/// What a detection finds.
struct Found {
    pairs: Vec<ElementPair>,
    /// Not all of them were asked about.
    too_many: bool,
}

/// Counts what is found, what takes exact integers to tell, and what is asked, to stop when there is too much of it. Whether it becomes full
/// does not depend on the order.
struct Counter<'a> {
    found: AtomicUsize,
    asked: AtomicUsize,
    limit: usize,
    monitor: &'a Monitor<'a>,
}

impl<'a> Counter<'a> {
    fn new(limit: usize, monitor: &'a Monitor<'a>) -> Self {
        Self { found: AtomicUsize::new(0), asked: AtomicUsize::new(0), limit, monitor }
    }

    fn is_over(&self) -> bool {
        self.found.load(Ordering::Relaxed) > self.limit
            || self.asked.load(Ordering::Relaxed) / ASKED > self.limit
    }

    /// More than the limit; or nobody wants to know any more.
    fn is_full(&self) -> bool {
        self.is_over() || self.monitor.is_cancelled()
    }

    fn ask(&self) {
        self.asked.fetch_add(1, Ordering::Relaxed);
    }

    fn count(&self, pairs: usize) {
        self.found.fetch_add(pairs, Ordering::Relaxed);
    }
}
