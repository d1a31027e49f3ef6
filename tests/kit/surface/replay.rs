//! [`Replay`]: a surface that knows nothing but the event log.

use std::collections::{BTreeMap, BTreeSet};
use welter_meshing::surface::{EdgeId, TriId, VertexId};
use welter_tracking::surface::{Event, RadialConnectivity};

/// The elements in use, as a log tells them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replay {
    vertices: BTreeSet<VertexId>,
    edges: BTreeMap<EdgeId, [VertexId; 2]>,
    triangles: BTreeMap<TriId, [VertexId; 3]>,
}

impl Replay {
    /// The elements of a surface now.
    #[must_use]
    pub fn of(surface: &RadialConnectivity) -> Self {
        Self {
            vertices: surface.vertices().collect(),
            edges: surface.edges().map(|e| (e, surface.ends(e))).collect(),
            triangles: surface.triangles().map(|t| (t, surface.corners(t))).collect(),
        }
    }

    /// With all elements numbered anew, without gaps: vertices and triangles in their order, edges by their ends.
    #[must_use]
    pub fn compacted(&self) -> Self {
        let new: BTreeMap<VertexId, VertexId> =
            self.vertices.iter().copied().zip((0..).map(VertexId)).collect();
        let mut ends: Vec<[VertexId; 2]> = self.edges.values().map(|ends| ends.map(|v| new[&v])).collect();
        ends.iter_mut().for_each(|ends| ends.sort_unstable());
        ends.sort_unstable();
        let triangles = self.triangles.values().map(|corners| corners.map(|v| new[&v]));
        Self {
            vertices: new.values().copied().collect(),
            edges: (0..).map(EdgeId).zip(ends).collect(),
            triangles: (0..).map(TriId).zip(triangles).collect(),
        }
    }

    /// Applies the changes of an event.
    ///
    /// # Panics
    /// If an element that goes was not there as the event says, or one that comes was.
    pub fn apply(&mut self, event: &Event<'_>) {
        for change in event.vertices {
            let news = if change.born {
                self.vertices.insert(change.vertex)
            } else {
                self.vertices.remove(&change.vertex)
            };
            assert!(news, "{change:?}");
        }
        for change in event.edges.iter().filter(|change| !change.born) {
            assert_eq!(self.edges.remove(&change.edge), Some(change.ends), "{change:?}");
        }
        for change in event.edges.iter().filter(|change| change.born) {
            assert_eq!(self.edges.insert(change.edge, change.ends), None, "{change:?}");
        }
        for change in event.triangles {
            let old = match change.after {
                Some(corners) => self.triangles.insert(change.triangle, corners),
                None => self.triangles.remove(&change.triangle),
            };
            assert_eq!(old, change.before, "{change:?}");
        }
    }
}
