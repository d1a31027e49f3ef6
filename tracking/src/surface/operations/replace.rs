//! Replacement of triangles by others between vertices in use: what zippering is made of \[Brochu12, section 3.2.6\].
//!
//! Values: each new triangle gets the mean of the removed ones, and an equal share of their sum. Edges and vertices that
//! go leave theirs to their neighbours; new edges begin with zero.

use super::super::connectivity::Refusal;
use super::super::connectivity::change::Change;
use super::super::{EventKind, MovingSurface};
use super::{Plan, TriangleSource, TriangleTarget};
use welter_meshing::surface::{MAX_TRIANGLES, TriId, VertexId};

impl MovingSurface {
    /// Plans the removal of triangles and the addition of others. Either list may be empty; new triangles
    /// that lie on others with opposite orientation cancel with them.
    ///
    /// # Errors
    /// [`Refusal`] if a triangle is not in use or named twice, or the surface would not be admissible.
    pub fn plan_replacement(&self, remove: &[TriId], add: &[[VertexId; 3]]) -> Result<Plan, Refusal> {
        let mut sorted = remove.to_vec();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Refusal::NotInUse { element: "triangle", id: pair[0].0 });
        }
        remove.iter().try_for_each(|&t| self.require_triangle(t))?;
        if self.connectivity.triangle_slots() + add.len() > MAX_TRIANGLES {
            return Err(Refusal::TooLarge);
        }
        let change = Change { remove: remove.to_vec(), add: add.to_vec(), ..Change::default() };
        let mut plan = self.plan(EventKind::Replace, change)?;
        let [sources, targets] = [remove.len(), plan.added().len()].map(|count| count as f64);
        for target in (0..plan.added().len()).map(TriangleTarget::New) {
            for &source in remove {
                let (interpolation, share) = (1.0 / sources, 1.0 / targets);
                plan.triangles.push(TriangleSource { target, source, interpolation, share });
            }
        }
        Ok(plan)
    }
}
