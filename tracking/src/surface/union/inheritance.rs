//! Where values come from in a union: [`Inheritance`].
//!
//! # Rules
//! * A new vertex on an edge of the surface is a mean of the ends of the edge, one on an edge of the shape of the corners of the triangle
//!   that is pierced, with the weights of its place: so values are continuous along the curves. Vertices, edges and triangles of the shape come
//!   from nothing, as those of a mesh that is added.
//! * A part of a triangle or of an edge that was cut is a mean of that alone, and has the share of its area or length. Edges within
//!   triangles come from nothing.
//! * A vertex shares with the new vertices that name it, itself counted with weight one.
//! * What goes leaves its share to the nearest element that stays, by the number of edges between them (triangles: across which they are
//!   neighbours); of equally near ones to that of the smallest id. A component that goes as a whole takes it along.

use std::collections::BTreeMap;

use welter_meshing::surface::{EdgeId, TriId, VertexId};

use super::super::attributes::transfer::{Entry, Transfer};
use super::super::{HalfEdge, MovingSurface, RadialConnectivity};
use super::assembly::{Assembly, Edges};

const NONE: u32 = u32::MAX;

/// The rows of all three kinds of elements, by ids in between.
pub(super) struct Inheritance {
    vertices: Transfer,
    edges: Transfer,
    triangles: Transfer,
    /// How many ids there are in between.
    slots: [usize; 3],
    /// How many vertices there were.
    before: usize,
}

impl Inheritance {
    pub(super) fn new(assembly: &Assembly<'_>, before: &RadialConnectivity, edges: &Edges) -> Self {
        let ids = &assembly.ids;
        let slots = |old: usize, last: Option<u32>| last.map_or(old, |last| old.max(last as usize + 1));
        let slots = [
            slots(before.vertex_slots(), ids.between.last().map(|v| v.0)),
            edges.slots,
            slots(before.triangle_slots(), ids.triangles.last().map(|t| t.0)),
        ];
        let mut between = vec![NONE; assembly.refinement.positions.len()];
        for (&v, &id) in ids.vertices.iter().zip(&ids.between) {
            between[v.index()] = id.0;
        }
        let complete = |entries: Vec<Entry>, old: usize, slots: usize| {
            Transfer::complete(entries, (old as u32..slots as u32).collect(), &[], |_| true)
        };
        Self {
            vertices: complete(vertex_entries(assembly, &between), before.vertex_slots(), slots[0]),
            edges: complete(edge_entries(assembly, before, edges, &between), before.edge_slots(), slots[1]),
            triangles: complete(triangle_entries(assembly), before.triangle_slots(), slots[2]),
            slots,
            before: before.vertex_slots(),
        }
    }

    /// Values by ids in between.
    pub(super) fn apply(&self, surface: &mut MovingSurface) {
        let rows = self.vertices.rows.chunk_by(|a, b| a.target == b.target);
        let masses: Vec<(u32, f64)> = rows
            .map(|row| {
                let born = row[0].target as usize >= self.before;
                (row[0].target, surface.mass_rule.apply(row, &surface.masses, born))
            })
            .collect();
        surface.masses.resize(self.slots[0], 1.0);
        masses.into_iter().for_each(|(v, mass)| surface.masses[v as usize] = mass);
        surface.vertex_attributes.transfer(&self.vertices, self.slots[0]);
        surface.edge_attributes.transfer(&self.edges, self.slots[1]);
        surface.triangle_attributes.transfer(&self.triangles, self.slots[2]);
    }
}

fn vertex_entries(assembly: &Assembly<'_>, between: &[u32]) -> Vec<Entry> {
    let Assembly { overlay, crossings, refinement, .. } = assembly;
    let first_new = overlay.mesh.positions().len();
    let mut named: Vec<(u32, u32, f64)> = Vec::new();
    for (i, piercing) in crossings.piercings.iter().enumerate() {
        let target = between[first_new + i];
        if target == NONE {
            continue;
        }
        if overlay.side(piercing.triangle) == 1 {
            let weights = [1.0 - piercing.fraction, piercing.fraction];
            named.extend(piercing.ends.iter().zip(weights).map(|(v, weight)| (v.0, target, weight)));
        } else {
            let [second, third] = piercing.weights;
            let weights = [1.0 - second - third, second, third];
            let corners = overlay.connectivity.corners(piercing.triangle);
            named.extend(corners.iter().zip(weights).map(|(v, weight)| (v.0, target, weight)));
        }
    }
    // Stable: of each source in the order of its targets.
    named.sort_by_key(|&(source, target, _)| (source, target));
    let mut entries = Vec::with_capacity(2 * named.len());
    // What sources keep, or leave if they go.
    let mut rest: BTreeMap<u32, f64> = BTreeMap::new();
    for row in named.chunk_by(|a, b| a.0 == b.0) {
        let whole = 1.0 + row.iter().map(|&(_, _, weight)| weight).sum::<f64>();
        let given = row.iter().map(|&(_, _, weight)| weight / whole).sum::<f64>();
        entries.extend(
            row.iter().map(|&(source, target, weight)| Entry::new(target, source, weight, weight / whole)),
        );
        rest.insert(row[0].0, 1.0 - given);
    }
    let stays: Vec<bool> = between.iter().map(|&id| id != NONE).collect();
    let own = 0..overlay.vertices as u32;
    let mesh = &refinement.connectivity;
    let heirs = heirs(own.clone(), &stays, |v, reach| {
        mesh.star(VertexId(v)).for_each(|h| [mesh.head(h), mesh.apex(h)].iter().for_each(|&v| reach(v.0)));
    });
    for source in own {
        let rest = rest.get(&source).copied();
        if stays[source as usize] {
            entries.extend(rest.map(|share| Entry::new(source, source, 1.0, share)));
        } else if let Some(heir) = heirs.get(source) {
            entries.push(Entry::new(between[heir as usize], source, 0.0, rest.unwrap_or(1.0)));
        }
    }
    entries
}

fn triangle_entries(assembly: &Assembly<'_>) -> Vec<Entry> {
    let Assembly { overlay, crossings, refinement, stays, ids, .. } = assembly;
    let mesh = &refinement.connectivity;
    let own = refinement.pieces.partition_point(|piece| piece.origin.index() < overlay.triangles);
    let mut between = vec![NONE; refinement.pieces.len()];
    for (&piece, &id) in ids.pieces.iter().zip(&ids.triangles) {
        between[piece as usize] = id.0;
    }
    let heirs = heirs(0..own as u32, stays, |t, reach| {
        let around = (0..3).map(|k| HalfEdge::of(TriId(t), k)).flat_map(|h| mesh.around_edge(mesh.edge(h)));
        around.for_each(|h| reach(h.triangle().0));
    });
    let mut entries = Vec::new();
    for (i, piece) in (0_u32..).zip(&refinement.pieces[..own]) {
        let cut = crossings.cuts.contains_key(&piece.origin);
        if stays[i as usize] {
            if cut {
                entries.push(Entry::new(between[i as usize], piece.origin.0, 1.0, piece.share));
            }
        } else if let Some(heir) = heirs.get(i) {
            entries.push(Entry::new(between[heir as usize], piece.origin.0, 0.0, piece.share));
        }
    }
    entries
}

fn edge_entries(
    assembly: &Assembly<'_>,
    before: &RadialConnectivity,
    edges: &Edges,
    between: &[u32],
) -> Vec<Entry> {
    let Assembly { overlay, crossings, refinement, stays, ids, connectivity, .. } = assembly;
    let mesh = &refinement.connectivity;
    let first_new = overlay.mesh.positions().len();
    let used = |edge: EdgeId| mesh.around_edge(edge).any(|h| stays[h.triangle().index()]);
    let used: Vec<bool> = mesh.edges().map(used).collect();
    let id = |edge: EdgeId| {
        let place = |v: VertexId| ids.vertices.binary_search(&v).ok().map(VertexId::from_index);
        let [a, b] = mesh.ends(edge);
        Some(edges.between[connectivity.edge_between(place(a)?, place(b)?)?.index()].0)
    };
    // The parts of each edge of the surface.
    let mut parts: Vec<(EdgeId, EdgeId, f64, bool)> = Vec::new();
    for edge in before.edges() {
        let [low, high] = before.ends(edge);
        let in_overlay = overlay.connectivity.edge_between(low, high);
        let list = in_overlay.and_then(|edge| crossings.on_edge.get(&edge)).map_or(&[][..], Vec::as_slice);
        let mut chain = vec![(low, 0.0)];
        chain.extend(list.iter().map(|&i| {
            let vertex = VertexId::from_index(first_new + i as usize);
            (vertex, crossings.piercings[i as usize].fraction)
        }));
        chain.push((high, 1.0));
        for pair in chain.windows(2) {
            let [(a, from), (b, to)] = [pair[0], pair[1]];
            if let Some(part) = mesh.edge_between(a, b) {
                let reversed = between[a.index()] > between[b.index()];
                parts.push((edge, part, to - from, reversed));
            }
        }
    }
    let mut gone: Vec<u32> = parts.iter().map(|part| part.1.0).collect();
    gone.sort_unstable();
    let heirs = heirs(gone, &used, |edge, reach| {
        let near = mesh.ends(EdgeId(edge)).into_iter().flat_map(|v| mesh.edges_at(v));
        near.for_each(|edge| reach(edge.0));
    });
    let mut entries = Vec::new();
    for (source, part, share, reversed) in parts {
        if used[part.index()] {
            if let Some(target) = id(part).filter(|&target| share < 1.0 || target != source.0) {
                let mut entry = Entry::new(target, source.0, 1.0, share);
                entry.reversed = reversed;
                entries.push(entry);
            }
        } else if let Some(target) = heirs.get(part.0).and_then(|heir| id(EdgeId(heir))) {
            entries.push(Entry::new(target, source.0, 0.0, share));
        }
    }
    entries
}

/// For elements that go, the nearest that stay.
struct Heirs(BTreeMap<u32, u32>);

impl Heirs {
    fn get(&self, id: u32) -> Option<u32> {
        self.0.get(&id).copied()
    }
}

/// The heirs of those of some elements that go, from a function that tells neighbours. Breadth first from all that stay beside one that
/// goes, so linear in the number of those that go.
fn heirs(
    elements: impl IntoIterator<Item = u32>,
    stays: &[bool],
    neighbours: impl Fn(u32, &mut dyn FnMut(u32)),
) -> Heirs {
    let mut found: BTreeMap<u32, u32> = BTreeMap::new();
    let gone: Vec<u32> = elements.into_iter().filter(|&id| !stays[id as usize]).collect();
    let mut wave: Vec<(u32, u32)> = Vec::new();
    for &id in &gone {
        let mut nearest = NONE;
        neighbours(id, &mut |next| {
            if stays[next as usize] {
                nearest = nearest.min(next);
            }
        });
        if nearest != NONE {
            wave.push((id, nearest));
        }
    }
    found.extend(wave.iter().copied());
    while !wave.is_empty() {
        let mut next: BTreeMap<u32, u32> = BTreeMap::new();
        for &(id, heir) in &wave {
            neighbours(id, &mut |beside| {
                if !stays[beside as usize] && !found.contains_key(&beside) {
                    next.entry(beside).and_modify(|other| *other = heir.min(*other)).or_insert(heir);
                }
            });
        }
        wave = next.into_iter().collect();
        found.extend(wave.iter().copied());
    }
    Heirs(found)
}
