//! The one way in which connectivity changes: triangles get other corners, go, or come.
//!
//! [`RadialConnectivity::plan`] completes a [`Change`] by the pairs of triangles that cancel, and refuses it if
//! the surface would not be admissible afterwards. [`RadialConnectivity::apply`] carries it out.

use super::defects::balanced;
use super::{HalfEdge, NO_EDGE, NO_VERTEX, RadialConnectivity, Refusal};
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// What is to be changed. No triangle is named twice.
#[derive(Clone, Debug, Default)]
pub(crate) struct Change {
    /// Triangles and their new corners, corner by corner.
    pub(crate) recorner: Vec<(TriId, [VertexId; 3])>,
    pub(crate) remove: Vec<TriId>,
    pub(crate) add: Vec<[VertexId; 3]>,
    /// New vertices, the next to be given out.
    pub(crate) births: Vec<VertexId>,
}

impl Change {
    /// Whether a triangle of the surface gets other corners or goes.
    pub(super) fn touches(&self, triangle: TriId) -> bool {
        self.remove.contains(&triangle) || self.recorner.iter().any(|&(changed, _)| changed == triangle)
    }
}

/// An edge on which a change has sides, and its triangles afterwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// The smaller vertex first.
    pub(crate) ends: [VertexId; 2],
    /// Before the change.
    pub(crate) edge: Option<EdgeId>,
    /// How many triangles run from the first end to the second, and back: before and after.
    pub(crate) before: [usize; 2],
    pub(crate) after: [usize; 2],
}

impl Side {
    pub(super) fn total(counts: [usize; 2]) -> usize {
        counts[0] + counts[1]
    }
}

/// A change that keeps the surface admissible.
#[derive(Clone, Debug)]
pub(crate) struct PlannedChange {
    pub(crate) change: Change,
    /// By their ends.
    pub(crate) sides: Vec<Side>,
    /// Pairs that cancel: as they were before the change, `None` for one that the change would have added.
    pub(crate) cancelled: Vec<[Option<TriId>; 2]>,
}

/// The ids that a change gave and took.
#[derive(Clone, Debug)]
pub(crate) struct Applied {
    /// Those of [`Change::add`].
    pub(crate) added: Vec<TriId>,
    /// Of each side, where it has an edge afterwards.
    pub(crate) edges: Vec<Option<EdgeId>>,
    /// Vertices that lost their last triangle, ascending.
    pub(crate) lost: Vec<VertexId>,
}

fn sides([a, b, c]: [VertexId; 3]) -> [[VertexId; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn ordered([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    [a.min(b), a.max(b)]
}

impl RadialConnectivity {
    /// Completes a change by what cancels, and counts the triangles of each edge afterwards.
    pub(crate) fn plan(&self, mut change: Change) -> Result<PlannedChange, Refusal> {
        for &(t, corners) in &change.recorner {
            self.check_corners(&change, corners)?;
            debug_assert!(self.has_triangle(t));
        }
        for &corners in &change.add {
            self.check_corners(&change, corners)?;
        }
        let mut table = self.touched_edges(&change);
        let cancelled = self.cancel(&mut change, &table)?;
        // What cancels has the sides of triangles that stand in the table already.
        for side in &mut table {
            if let Some(edge) = side.edge {
                side.before = self.directions(edge, side.ends[0]);
                side.after = side.before;
            }
        }
        let place = |table: &[Side], way: [VertexId; 2]| {
            let i = table.binary_search_by_key(&ordered(way), |side| side.ends);
            (i.expect("the table holds every side"), usize::from(way[0] > way[1]))
        };
        let gone = change.recorner.iter().map(|&(t, _)| t).chain(change.remove.iter().copied());
        for way in gone.flat_map(|t| sides(self.corners(t))) {
            let (i, back) = place(&table, way);
            table[i].after[back] -= 1;
        }
        let come = change.recorner.iter().map(|&(_, corners)| corners).chain(change.add.iter().copied());
        for way in come.flat_map(sides) {
            let (i, back) = place(&table, way);
            table[i].after[back] += 1;
        }
        match table.iter().find(|side| !balanced(side.after[0], side.after[1])) {
            Some(&Side { ends: vertices, after: [forward, backward], .. }) => {
                Err(Refusal::Unbalanced { vertices, forward, backward })
            }
            None => Ok(PlannedChange { change, sides: table, cancelled }),
        }
    }

    fn check_corners(&self, change: &Change, corners: [VertexId; 3]) -> Result<(), Refusal> {
        let [a, b, c] = corners;
        let known = |v: &VertexId| self.has_vertex(*v) || change.births.contains(v);
        if a == b || b == c || c == a || !corners.iter().all(known) {
            return Err(Refusal::Corners { corners });
        }
        Ok(())
    }

    /// The edges of all triangles of a change, old and new, ascending; not counted yet.
    fn touched_edges(&self, change: &Change) -> Vec<Side> {
        let mut keys: Vec<([VertexId; 2], EdgeId)> = Vec::with_capacity(6 * change.recorner.len() + 12);
        let gone = change.recorner.iter().map(|&(t, _)| t).chain(change.remove.iter().copied());
        for h in gone.flat_map(|t| (0..3).map(move |k| HalfEdge::of(t, k))) {
            keys.push((ordered([self.tail(h), self.head(h)]), self.edge(h)));
        }
        let come = change.recorner.iter().map(|&(_, corners)| corners).chain(change.add.iter().copied());
        keys.extend(come.flat_map(sides).map(|way| (ordered(way), NO_EDGE)));
        keys.sort_unstable();
        keys.dedup_by_key(|key| key.0);
        let side = |&(ends, edge): &([VertexId; 2], EdgeId)| {
            let between = |[a, b]: [VertexId; 2]| {
                let old = a.index() < self.vertex_slots() && b.index() < self.vertex_slots();
                old.then(|| self.edge_between(a, b)).flatten()
            };
            // Where a side of an old triangle is on the edge its id is known; it sorts first.
            let edge = if edge == NO_EDGE { between(ends) } else { Some(edge) };
            Side { ends, edge, before: [0; 2], after: [0; 2] }
        };
        keys.iter().map(side).collect()
    }

    /// Carries out a plan. Elements that go become free at the end, so that no id changes its meaning within a change.
    ///
    /// `directed` lists, ascending, the ends of new edges in the order in which they are to be directed; other new edges run
    /// from the smaller vertex to the larger.
    pub(crate) fn apply(&mut self, plan: &PlannedChange, directed: &[[VertexId; 2]]) -> Applied {
        let PlannedChange { change, sides: table, .. } = plan;
        for &vertex in &change.births {
            assert_eq!(self.new_vertex(), vertex, "a plan is applied to the surface that it was made for");
        }
        for &(t, corners) in &change.recorner {
            for k in 0..3 {
                let h = HalfEdge::of(t, k);
                if [self.tail(h), self.head(h)] != [corners[k], corners[(k + 1) % 3]] {
                    self.unlink_edge(h);
                }
            }
        }
        for &t in &change.remove {
            (0..3).for_each(|k| self.unlink_edge(HalfEdge::of(t, k)));
        }
        let mut lost = Vec::new();
        for &(t, corners) in &change.recorner {
            for (k, &corner) in corners.iter().enumerate() {
                let h = HalfEdge::of(t, k);
                if self.tail(h) != corner {
                    lost.push(self.tail(h));
                    self.unlink_vertex(h);
                    self.link_vertex(h, corner);
                }
            }
        }
        for &t in &change.remove {
            for k in 0..3 {
                lost.push(self.tail(HalfEdge::of(t, k)));
                self.unlink_vertex(HalfEdge::of(t, k));
            }
        }
        let added: Vec<TriId> = change.add.iter().map(|_| self.new_triangle()).collect();
        for (&t, corners) in added.iter().zip(&change.add) {
            (0..3).for_each(|k| self.link_vertex(HalfEdge::of(t, k), corners[k]));
        }
        let mut edges: Vec<Option<EdgeId>> = table.iter().map(|side| side.edge).collect();
        let come = change.recorner.iter().map(|&(t, _)| t).chain(added.iter().copied());
        for h in come.flat_map(|t| (0..3).map(move |k| HalfEdge::of(t, k))) {
            if self.edge(h) == NO_EDGE {
                let ends = ordered([self.tail(h), self.head(h)]);
                let i =
                    table.binary_search_by_key(&ends, |side| side.ends).expect("the table holds every side");
                let edge = *edges[i].get_or_insert_with(|| {
                    let turned = [ends[1], ends[0]];
                    self.new_edge(if directed.binary_search(&turned).is_ok() { turned } else { ends })
                });
                self.link_edge(h, edge);
            }
        }
        self.free_triangles.extend(&change.remove);
        for (edge, side) in edges.iter_mut().zip(table) {
            if let Some(id) = *edge
                && Side::total(side.after) == 0
            {
                self.edges[id.index()].ends = [NO_VERTEX; 2];
                self.free_edges.push(id);
                *edge = None;
            }
        }
        lost.sort_unstable();
        lost.dedup();
        lost.retain(|&v| !self.has_vertex(v));
        self.free_vertices.extend(&lost);
        Applied { added, edges, lost }
    }
}
