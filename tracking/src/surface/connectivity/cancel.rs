//! Pairs of triangles that cancel.
//!
//! Two triangles with the same corners and opposite orientation bound nothing: a tetrahedron without volume
//! \[Brochu12, section 3.2.5\]. Where a change would make such a pair both go. Of the same orientation they
//! cannot stand beside each other, and the change is refused.

use super::change::{Change, Side};
use super::{RadialConnectivity, Refusal};
use welter_meshing::surface::{TriId, VertexId};

/// A triangle of the surface after a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Present {
    /// The corners, ascending.
    set: [VertexId; 3],
    /// The corners in their cyclic order, the smallest first.
    corners: [VertexId; 3],
    /// Whether the change leaves it as it is. New ones sort first: of three alike the one that stays is old.
    stays: bool,
    /// `None` for one that is added.
    id: Option<TriId>,
}

impl Present {
    fn new(corners: [VertexId; 3], stays: bool, id: Option<TriId>) -> Self {
        let mut set = corners;
        set.sort_unstable();
        Self { set, corners: rotated(corners), stays, id }
    }
}

/// The same triangle with its smallest corner first.
fn rotated(corners: [VertexId; 3]) -> [VertexId; 3] {
    let [a, b, c] = corners;
    if a < b && a < c {
        corners
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

impl RadialConnectivity {
    /// Takes pairs of triangles that cancel out of a change; `table` holds the edges that it touches, by their ends.
    pub(super) fn cancel(
        &self,
        change: &mut Change,
        table: &[Side],
    ) -> Result<Vec<[Option<TriId>; 2]>, Refusal> {
        let mut present = self.new_and_alike(change, table);
        present.sort_unstable();
        // An old triangle is met once for each new one like it; new ones are all kept.
        present.dedup_by(|a, b| a.stays && a == b);
        let mut cancelled = Vec::new();
        for class in present.chunk_by(|a, b| a.set == b.set).filter(|class| class.len() > 1) {
            let (one, other) = class.split_at(class.partition_point(|t| t.corners == class[0].corners));
            let (few, many) = if one.len() < other.len() { (one, other) } else { (other, one) };
            if many.len() - few.len() > 1 {
                return Err(Refusal::Doubled { corners: many[0].corners });
            }
            for (a, b) in few.iter().zip(many) {
                cancelled.push([a.id, b.id]);
                [a, b].into_iter().for_each(|triangle| withdraw(change, triangle));
            }
        }
        Ok(cancelled)
    }

    /// The triangles that a change makes, and those that it leaves and that have the same corners.
    fn new_and_alike(&self, change: &Change, table: &[Side]) -> Vec<Present> {
        let mut present = Vec::new();
        let changed = change.recorner.iter().map(|&(t, corners)| (Some(t), corners));
        for (id, corners) in changed.chain(change.add.iter().map(|&corners| (None, corners))) {
            let triangle = Present::new(corners, false, id);
            present.push(triangle);
            let edge = |[a, b]: [usize; 2]| {
                let ends = [triangle.set[a], triangle.set[b]];
                table.binary_search_by_key(&ends, |side| side.ends).ok().and_then(|i| table[i].edge)
            };
            let [Some(edge), Some(_), Some(_)] = [[0, 1], [1, 2], [0, 2]].map(edge) else { continue };
            let around = self.around_edge(edge).filter(|&h| self.apex(h) == triangle.set[2]);
            let stay = around.map(|h| h.triangle()).filter(|&t| !change.touches(t));
            present.extend(stay.map(|t| Present::new(self.corners(t), true, Some(t))));
        }
        present
    }
}

/// Makes a change end without a triangle.
fn withdraw(change: &mut Change, triangle: &Present) {
    match triangle.id {
        None => {
            let at = change.add.iter().position(|&corners| rotated(corners) == triangle.corners);
            change.add.remove(at.expect("a triangle that was to be added"));
        }
        Some(t) => {
            change.remove.push(t);
            change.recorner.retain(|&(changed, _)| changed != t);
        }
    }
}
