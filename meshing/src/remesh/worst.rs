//! The last stage: triangles with small angles, sharpest first.
//!
//! # Method
//! For each triangle below the goal: flip one of its edges, move one of its corners, or collapse its shortest
//! edge, whichever is the first that leaves all triangles concerned blunter than the sharpest of them was. So
//! the sharpest triangle of a neighbourhood never gets sharper, and the stage ends. A corner is moved by a
//! pattern search in its tangent plane: towards the mean of the neighbours, then along eight directions with
//! halving steps, and the best place is projected.

use super::connectivity::HalfEdge;
use super::rounds::{BETWEEN_CHECKS, LONG_REL};
use super::shape::{blunter, sharpest, sharpness};
use super::workpiece::Workpiece;
use crate::field::ScalarField;
use crate::surface::{TriId, VertexId};
use crate::{Cancelled, DVec3, Stage};

/// What the stage did.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Improved {
    pub(super) flips: u64,
    pub(super) moves: u64,
    pub(super) collapses: u64,
}

impl Improved {
    pub(super) fn any(self) -> bool {
        self.flips + self.moves + self.collapses > 0
    }
}

/// First and last step of the pattern search, in target lengths.
const STEPS_REL: [f64; 2] = [0.25, 1.0 / 64.0];

/// Most patterns of one search: four times as many as halvings.
const MOST_PATTERNS: usize = 20;

impl<F: ScalarField> Workpiece<'_, F> {
    /// One pass over the triangles whose smallest angle has a larger cosine than `goal`.
    pub(super) fn improve_worst(&mut self, goal: f64, stage: &Stage<'_>) -> Result<Improved, Cancelled> {
        let measured = self.mesh.triangles().map(|t| (sharpness(self.corners(t)), t));
        let mut worst: Vec<(f64, TriId)> = measured.filter(|&(s, _)| s > goal).collect();
        worst.sort_unstable_by(|(p, s), (q, t)| q.total_cmp(p).then(s.cmp(t)));
        let mut done = Improved::default();
        for (i, &(_, t)) in worst.iter().enumerate() {
            if i % BETWEEN_CHECKS == 0 {
                stage.check()?;
            }
            // An earlier change may have removed or improved it.
            if self.mesh.has_triangle(t) && sharpness(self.corners(t)) > goal {
                self.improve(t, &mut done);
            }
        }
        Ok(done)
    }

    fn improve(&mut self, t: TriId, done: &mut Improved) {
        let sides = [0, 1, 2].map(|k| HalfEdge::of(t, k));
        if sides.iter().any(|&h| self.flip_if_blunter(h)) {
            done.flips += 1;
            return;
        }
        let mut moved = false;
        for v in self.mesh.corners(t) {
            if self.relax(v) {
                done.moves += 1;
                moved = true;
            }
        }
        if !moved {
            let shortest = sides.into_iter().min_by(|&g, &h| self.squared(g).total_cmp(&self.squared(h)));
            done.collapses += u64::from(shortest.is_some_and(|h| self.collapse_if_blunter(h)));
        }
    }

    fn flip_if_blunter(&mut self, h: HalfEdge) -> bool {
        let pair = [h, self.mesh.opposite(h)].map(|h| self.corners(h.triangle()));
        let before = sharpest(pair.into_iter());
        self.try_flip(h, before - 1e-6)
    }

    fn collapse_if_blunter(&mut self, h: HalfEdge) -> bool {
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let before = self.sharpest_at(a).max(self.sharpest_at(b));
        let longest = LONG_REL * self.length;
        let targets = [self.middle(h).0, self.at(a), self.at(b)];
        targets.into_iter().any(|target| self.try_collapse(h, target, before - 1e-6, longest))
    }

    /// Moves a vertex to where the sharpest of its triangles is blunter.
    fn relax(&mut self, v: VertexId) -> bool {
        let before = self.sharpest_at(v);
        let normal = self.normals[v.index()];
        let (s, t) = tangents(normal);
        let start = self.at(v);
        let there = |way: DVec3| {
            let place = |w: VertexId| if w == v { start + way } else { self.at(w) };
            sharpest(self.mesh.around(v).map(|h| self.mesh.corners(h.triangle()).map(place)))
        };
        let (mut best, mut way) = (before, DVec3::ZERO);
        let mean = self.towards_neighbours(v);
        if blunter(there(mean), best) {
            (best, way) = (there(mean), mean);
        }
        let mut step = STEPS_REL[0] * self.length;
        for _ in 0..MOST_PATTERNS {
            if step < STEPS_REL[1] * self.length {
                break;
            }
            let ahead = [s, t, -s, -t, s + t, t - s, -s - t, s - t].map(|d| way + step * d);
            let found = ahead.into_iter().map(|way| (there(way), way)).min_by(|p, q| p.0.total_cmp(&q.0));
            match found {
                Some((value, there)) if blunter(value, best) => (best, way) = (value, there),
                _ => step *= 0.5,
            }
        }
        way != DVec3::ZERO && self.move_along(v, way, before - 1e-6)
    }
}

/// Two unit vectors that are orthogonal to a unit vector and to each other.
fn tangents(normal: DVec3) -> (DVec3, DVec3) {
    let least = normal.abs();
    let axis = if least.x <= least.y && least.x <= least.z {
        DVec3::X
    } else if least.y <= least.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let s = normal.cross(axis).normalize_or_zero();
    (s, normal.cross(s))
}
