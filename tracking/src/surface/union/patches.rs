//! Parts of a surface, joined across some of its edges: [`Patches`].

use super::super::RadialConnectivity;
use welter_meshing::surface::{EdgeId, TriId};

use super::super::HalfEdge;

/// Which part each triangle belongs to.
#[derive(Debug)]
pub(super) struct Patches {
    /// By triangle.
    of: Vec<u32>,
    /// The first triangle of each part; ascending.
    first: Vec<TriId>,
}

const NONE: u32 = u32::MAX;

impl Patches {
    /// The parts of triangles, all in use, that are joined across the edges that a function allows. Linear.
    pub(super) fn new(mesh: &RadialConnectivity, joined: impl Fn(EdgeId) -> bool) -> Self {
        let mut of = vec![NONE; mesh.triangle_slots()];
        let mut first = Vec::new();
        let mut open = Vec::new();
        for start in mesh.triangles() {
            if of[start.index()] != NONE {
                continue;
            }
            let part = first.len() as u32;
            first.push(start);
            of[start.index()] = part;
            open.push(start);
            while let Some(t) = open.pop() {
                for edge in (0..3).map(|k| mesh.edge(HalfEdge::of(t, k))).filter(|&edge| joined(edge)) {
                    for next in mesh.around_edge(edge).map(HalfEdge::triangle) {
                        if of[next.index()] == NONE {
                            of[next.index()] = part;
                            open.push(next);
                        }
                    }
                }
            }
        }
        Self { of, first }
    }

    pub(super) fn of(&self, triangle: TriId) -> usize {
        self.of[triangle.index()] as usize
    }

    pub(super) fn count(&self) -> usize {
        self.first.len()
    }

    /// The smallest triangle of a part.
    pub(super) fn first(&self, part: usize) -> TriId {
        self.first[part]
    }
}
