//! Carrying out a plan: connectivity, values, log.

use super::super::attributes::transfer::{Departure, Entry, Transfer};
use super::super::connectivity::change::Applied;
use super::super::connectivity::{HalfEdge, RadialConnectivity};
use super::super::{EdgeChange, EventKind, MovingSurface, TriangleChange, VertexChange};
use super::{EdgeSource, Outcome, Plan, TriangleTarget};
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// Elements that go, each with the neighbours that would take over its values.
struct Departures {
    vertices: Vec<Departure>,
    edges: Vec<Departure>,
    triangles: Vec<Departure>,
}

impl MovingSurface {
    /// Carries out a plan and writes it into the log.
    ///
    /// # Panics
    /// If the surface has changed since the plan was made.
    pub fn apply(&mut self, plan: Plan) -> Outcome {
        assert_eq!(plan.revision, self.revision, "a plan is for one state of a surface");
        let mut departures = Departures::of(&self.connectivity, &plan);
        if !self.edge_attributes.is_empty() {
            departures.edges = Departures::of_edges(&self.connectivity, &plan);
        }
        let change = &plan.change.change;
        let before: Vec<TriangleChange> = {
            let corners = |t| Some(self.connectivity.corners(t));
            let changed = change.recorner.iter().map(|&(triangle, after)| TriangleChange {
                triangle,
                before: corners(triangle),
                after: Some(after),
            });
            let gone = change.remove.iter().map(|&triangle| TriangleChange {
                triangle,
                before: corners(triangle),
                after: None,
            });
            changed.chain(gone).collect()
        };
        let old_ends: Vec<Option<[VertexId; 2]>> =
            plan.change.sides.iter().map(|side| side.edge.map(|edge| self.connectivity.ends(edge))).collect();
        let mut directed: Vec<[VertexId; 2]> = plan.edges.iter().map(|source| source.target).collect();
        directed.sort_unstable();
        let applied = self.connectivity.apply(&plan.change, &directed);
        self.revision += 1;

        self.transfer_vertices(&plan, &departures, &applied);
        self.transfer_edges(&plan, &departures, &applied);
        self.transfer_triangles(&plan, &departures, &applied);

        let born = change.births.iter().map(|&vertex| VertexChange { vertex, born: true });
        let lost = applied.lost.iter().map(|&vertex| VertexChange { vertex, born: false });
        let mut edges = Vec::new();
        for ((side, &after), &ends) in plan.change.sides.iter().zip(&applied.edges).zip(&old_ends) {
            match (side.edge, after) {
                (Some(edge), None) => edges.extend(ends.map(|ends| EdgeChange { edge, ends, born: false })),
                (None, Some(edge)) => {
                    edges.push(EdgeChange { edge, ends: self.connectivity.ends(edge), born: true });
                }
                _ => {}
            }
        }
        let come = applied.added.iter().zip(&change.add);
        let come =
            come.map(|(&triangle, &after)| TriangleChange { triangle, before: None, after: Some(after) });
        self.log.push(plan.kind, born.chain(lost), edges, before.into_iter().chain(come));
        Outcome { vertices: plan.change.change.births, triangles: applied.added }
    }

    fn transfer_vertices(&mut self, plan: &Plan, departures: &Departures, applied: &Applied) {
        let births = plan.change.change.births.iter().map(|v| v.0).collect();
        let lives = |v| self.connectivity.has_vertex(VertexId(v));
        let transfer = Transfer::complete(plan.vertices.clone(), births, &departures.vertices, lives);
        let slots = self.connectivity.vertex_slots();
        let masses: Vec<(u32, f64)> = transfer
            .rows
            .chunk_by(|a, b| a.target == b.target)
            .map(|row| {
                let born = transfer.births.contains(&row[0].target);
                (row[0].target, self.mass_rule.apply(row, &self.masses, born))
            })
            .collect();
        self.masses.resize(slots, 1.0);
        let merged = match plan.kind {
            EventKind::Collapse { kept, removed, .. } if self.masses[removed.index()].is_infinite() => {
                Some(kept)
            }
            _ => None,
        };
        masses.into_iter().for_each(|(v, mass)| self.masses[v as usize] = mass);
        if let Some(immovable) = merged {
            self.masses[immovable.index()] = f64::INFINITY;
        }
        self.positions.resize(slots, glam::DVec3::ZERO);
        for &(v, position) in &plan.positions {
            self.positions[v.index()] = position;
        }
        debug_assert!(applied.lost.iter().all(|&v| !self.connectivity.has_vertex(v)));
        self.vertex_attributes.transfer(&transfer, slots);
    }

    fn transfer_edges(&mut self, plan: &Plan, departures: &Departures, applied: &Applied) {
        let slots = self.connectivity.edge_slots();
        if self.edge_attributes.is_empty() {
            self.edge_attributes.transfer(&Transfer::default(), slots);
            return;
        }
        let sides = &plan.change.sides;
        let resolved = |&EdgeSource { target: [a, b], source, interpolation, share }: &EdgeSource| {
            let at = sides.binary_search_by_key(&[a.min(b), a.max(b)], |side| side.ends);
            let target = at.ok().and_then(|i| applied.edges[i]);
            let mut entry =
                Entry::new(target.map_or(u32::MAX, |edge| edge.0), source.0, interpolation, share);
            entry.reversed = target.is_some_and(|edge| self.connectivity.ends(edge) != [a, b]);
            entry
        };
        let entries = plan.edges.iter().map(resolved).collect();
        let births = sides.iter().zip(&applied.edges).filter(|(side, _)| side.edge.is_none());
        let births = births.filter_map(|(_, after)| after.map(|edge| edge.0)).collect();
        let lives = |e| self.connectivity.has_edge(EdgeId(e));
        let transfer = Transfer::complete(entries, births, &departures.edges, lives);
        self.edge_attributes.transfer(&transfer, slots);
    }

    fn transfer_triangles(&mut self, plan: &Plan, departures: &Departures, applied: &Applied) {
        let slots = self.connectivity.triangle_slots();
        if self.triangle_attributes.is_empty() {
            self.triangle_attributes.transfer(&Transfer::default(), slots);
            return;
        }
        let entries = plan.triangles.iter().map(|source| {
            let target = match source.target {
                TriangleTarget::Old(t) => t,
                TriangleTarget::New(i) => applied.added[i],
            };
            Entry::new(target.0, source.source.0, source.interpolation, source.share)
        });
        let births = applied.added.iter().map(|t| t.0).collect();
        let lives = |t| self.connectivity.has_triangle(TriId(t));
        let transfer = Transfer::complete(entries.collect(), births, &departures.triangles, lives);
        self.triangle_attributes.transfer(&transfer, slots);
    }
}

impl Departures {
    fn of(mesh: &RadialConnectivity, plan: &Plan) -> Self {
        let change = &plan.change.change;
        let removed = |t: &TriId| change.remove.contains(t);
        let sides = |t: TriId| (0..3).map(move |k| HalfEdge::of(t, k));
        let triangles = change.remove.iter().map(|&t| {
            let beside = sides(t).flat_map(|h| mesh.around_edge(mesh.edge(h))).map(HalfEdge::triangle);
            let heirs: Vec<u32> = beside.filter(|t| !removed(t)).map(|t| t.0).collect();
            let mut others = Vec::new();
            if heirs.is_empty() {
                let near = mesh.corners(t).into_iter().flat_map(|v| mesh.star(v)).map(HalfEdge::triangle);
                others.extend(near.filter(|t| !removed(t)).map(|t| t.0));
            }
            Departure { id: t.0, heirs: sorted(heirs), others: sorted(others) }
        });
        // A vertex goes if each of its triangles goes or loses it.
        let leaving = change
            .recorner
            .iter()
            .flat_map(|&(t, new)| mesh.corners(t).into_iter().filter(move |v| !new.contains(v)));
        let mut leaving: Vec<VertexId> =
            leaving.chain(change.remove.iter().flat_map(|&t| mesh.corners(t))).collect();
        leaving.sort_unstable();
        let last = leaving.chunk_by(|a, b| a == b).filter(|run| run.len() == mesh.vertex_triangles(run[0]));
        let vertices = last.map(|run| {
            let beside = mesh.star(run[0]).flat_map(|h| [mesh.head(h), mesh.apex(h)]);
            Departure { id: run[0].0, heirs: sorted(beside.map(|v| v.0).collect()), others: Vec::new() }
        });
        Self { vertices: vertices.collect(), edges: Vec::new(), triangles: triangles.collect() }
    }

    /// The edges that go and may need heirs. Where nothing cancels those do not that share with another edge.
    fn of_edges(mesh: &RadialConnectivity, plan: &Plan) -> Vec<Departure> {
        let shared = plan.edges.iter().filter(|source| source.share != 0.0).map(|source| source.source);
        let mut shared: Vec<EdgeId> = shared.collect();
        shared.sort_unstable();
        let alone = |edge: &EdgeId| !plan.change.cancelled.is_empty() || shared.binary_search(edge).is_err();
        let gone = plan.change.sides.iter().filter(|side| side.after == [0, 0]);
        let departure = |edge: EdgeId| {
            let beside = mesh.around_edge(edge).flat_map(|h| [h.next(), h.previous()]);
            let heirs = sorted(beside.map(|h| mesh.edge(h).0).collect());
            let near = mesh.ends(edge).into_iter().flat_map(|v| mesh.edges_at(v)).map(|e| e.0);
            Departure { id: edge.0, heirs, others: sorted(near.collect()) }
        };
        gone.filter_map(|side| side.edge).filter(alone).map(departure).collect()
    }
}

fn sorted(mut ids: Vec<u32>) -> Vec<u32> {
    ids.sort_unstable();
    ids.dedup();
    ids
}
