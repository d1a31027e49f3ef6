//! Vertices in groups that merge: [`Groups`].

use welter_meshing::surface::VertexId;

/// A union-find structure over vertices; groups are named by their smallest vertex.
pub(super) struct Groups {
    above: Vec<u32>,
}

impl Groups {
    pub(super) fn new(vertices: usize) -> Self {
        Self { above: (0..vertices as u32).collect() }
    }

    /// The name of a vertex's group.
    pub(super) fn of(&mut self, v: VertexId) -> VertexId {
        let mut at = v.0;
        while self.above[at as usize] != at {
            let above = self.above[at as usize];
            self.above[at as usize] = self.above[above as usize];
            at = above;
        }
        VertexId(at)
    }

    pub(super) fn merge(&mut self, a: VertexId, b: VertexId) {
        let (a, b) = (self.of(a), self.of(b));
        self.above[a.max(b).index()] = a.min(b).0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_named_by_their_smallest_vertex_in_whatever_order_they_merge() {
        let name = |merges: &[[u32; 2]]| {
            let mut groups = Groups::new(8);
            merges.iter().for_each(|&[a, b]| groups.merge(VertexId(a), VertexId(b)));
            (0..8).map(|v| groups.of(VertexId(v)).0).collect::<Vec<_>>()
        };
        let expected = [0, 1, 2, 1, 1, 0, 2, 7];
        assert_eq!(name(&[[3, 4], [1, 4], [5, 0], [6, 2]]), expected);
        assert_eq!(name(&[[6, 2], [1, 3], [0, 5], [4, 1], [3, 4]]), expected);
    }
}
