//! The stages of a round of isotropic remeshing \[Botsch04\]: split long edges, collapse short ones, flip
//! towards six neighbours, smooth and project.

use super::connectivity::HalfEdge;
use super::workpiece::Workpiece;
use crate::field::ScalarField;
use crate::surface::VertexId;
use crate::{Cancelled, DVec3, Stage};

/// Longest edge, in target lengths: its halves are as far below the target as it is above, by ratio
/// \[Botsch04\].
pub(super) const LONG_REL: f64 = 4.0 / 3.0;

/// Shortest edge, in target lengths \[Botsch04\].
pub(super) const SHORT_REL: f64 = 4.0 / 5.0;

/// Sharpness that regular rounds may bring about: an angle of 20 degrees. The improvement at the end has less
/// to do then.
const ROUND_SHARPNESS: f64 = 0.939_692_620_785_908_4;

/// Moves below this many target lengths are not made: a third of all, and without them angles and lengths
/// measured the same.
const STILL_REL: f64 = 1.0 / 32.0;

/// Sweeps of splitting: each halves the longest edges, from any ratio of two lengths that is allowed.
const MOST_SPLIT_SWEEPS: usize = 64;

/// How often the way is halved when a move is refused.
const SHORTER_MOVES: usize = 2;

/// How many elements are looked at before the monitor is asked: few, because one change of nearly flat triangles may cost milliseconds of
/// exact arithmetic; asking costs a load.
pub(super) const BETWEEN_CHECKS: usize = 8;

impl<F: ScalarField> Workpiece<'_, F> {
    /// Splits edges longer than [`LONG_REL`], longest first, until none is left or no split is accepted.
    pub(super) fn split_long(&mut self, stage: &Stage<'_>) -> Result<u64, Cancelled> {
        let limit = LONG_REL * self.length;
        let mut splits = 0;
        for _ in 0..MOST_SPLIT_SWEEPS {
            let mut long = self.edges_by_length(|squared| squared > limit * limit);
            long.reverse();
            let before = splits;
            for (i, &h) in long.iter().enumerate() {
                if i % BETWEEN_CHECKS == 0 {
                    stage.check()?;
                }
                // An earlier split may have made this half-edge one of a shorter edge.
                splits += u64::from(self.squared(h) > limit * limit && self.try_split(h));
            }
            self.rebuild();
            if splits == before {
                break;
            }
        }
        Ok(splits)
    }

    /// Collapses edges shorter than [`SHORT_REL`], shortest first.
    pub(super) fn collapse_short(&mut self, stage: &Stage<'_>) -> Result<u64, Cancelled> {
        let limit = SHORT_REL * self.length;
        let mut collapses = 0;
        for (i, h) in self.edges_by_length(|squared| squared < limit * limit).into_iter().enumerate() {
            if i % BETWEEN_CHECKS == 0 {
                stage.check()?;
            }
            if self.mesh.has_triangle(h.triangle()) && self.squared(h) < limit * limit {
                collapses += u64::from(self.collapse_anyhow(h));
            }
        }
        Ok(collapses)
    }

    /// Collapses an edge into its middle, or else into one of its ends.
    fn collapse_anyhow(&mut self, h: HalfEdge) -> bool {
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)];
        let worst = self.sharpest_at(a).max(self.sharpest_at(b)).max(ROUND_SHARPNESS);
        let longest = LONG_REL * self.length;
        let targets = [self.middle(h).0, self.at(a), self.at(b)];
        targets.into_iter().any(|target| self.try_collapse(h, target, worst, longest))
    }

    /// Flips edges where that brings the numbers of neighbours nearer to six, or leaves them as near and
    /// makes the sharper triangle blunter.
    pub(super) fn flip_edges(&mut self, stage: &Stage<'_>) -> Result<u64, Cancelled> {
        let mut valences: Vec<i64> =
            (0..self.positions.len() as u32).map(|v| self.mesh.valence(VertexId(v)) as i64).collect();
        let mut flips = 0;
        for (i, h) in self.mesh.edges().collect::<Vec<_>>().into_iter().enumerate() {
            if i % BETWEEN_CHECKS == 0 {
                stage.check()?;
            }
            let o = self.mesh.opposite(h);
            let ends = [self.mesh.tail(h), self.mesh.head(h)].map(VertexId::index);
            let apexes = [self.mesh.apex(h), self.mesh.apex(o)].map(VertexId::index);
            // The sum of squared excesses changes by 2 (excess of apexes - excess of ends) + 4.
            let excess = |pair: [usize; 2]| pair.iter().map(|&v| valences[v] - 6).sum::<i64>();
            let change = excess(apexes) - excess(ends) + 2;
            let before = self.sharpest_of(&[h, o].map(|h| self.mesh.corners(h.triangle())));
            let worst = match change {
                ..0 => before.max(ROUND_SHARPNESS),
                0 => before - 1e-6,
                _ => continue,
            };
            if self.try_flip(h, worst) {
                flips += 1;
                ends.iter().for_each(|&v| valences[v] -= 1);
                apexes.iter().for_each(|&v| valences[v] += 1);
            }
        }
        Ok(flips)
    }

    /// Moves each vertex towards the mean of its neighbours within the tangent plane, then onto the surface.
    pub(super) fn smooth(&mut self, stage: &Stage<'_>) -> Result<u64, Cancelled> {
        let mut moves = 0;
        for v in (0..self.positions.len() as u32).map(VertexId) {
            if v.index() % BETWEEN_CHECKS == 0 {
                stage.check()?;
            }
            if !self.mesh.has_vertex(v) {
                continue;
            }
            let along = self.towards_neighbours(v);
            if along.length_squared() > (STILL_REL * self.length).powi(2) {
                let worst = self.sharpest_at(v).max(ROUND_SHARPNESS);
                moves += u64::from(self.move_along(v, along, worst));
            }
        }
        Ok(moves)
    }

    /// The way to the mean of a vertex's neighbours, without its part along the normal.
    pub(super) fn towards_neighbours(&self, v: VertexId) -> DVec3 {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for w in self.mesh.neighbours(v) {
            sum += self.at(w) - self.at(v);
            count += 1.0;
        }
        let normal = self.normals[v.index()];
        let way = sum / count;
        way - normal * normal.dot(way)
    }

    /// Moves a vertex along its tangent plane and back onto the surface; by halves where that is refused.
    pub(super) fn move_along(&mut self, v: VertexId, way: DVec3, worst: f64) -> bool {
        let (start, normal, slope) = (self.at(v), self.normals[v.index()], self.slopes[v.index()]);
        let mut share = 1.0;
        for _ in 0..=SHORTER_MOVES {
            if let Some(target) = self.project(start + share * way, normal, slope)
                && self.try_move(v, target, worst)
            {
                return true;
            }
            share *= 0.5;
        }
        false
    }

    /// Brings the vertices onto the surface that are not. Returns how many were moved, and how many stayed
    /// off.
    pub(super) fn project_all(&mut self, stage: &Stage<'_>) -> Result<[u64; 2], Cancelled> {
        let (mut moves, mut off) = (0, 0);
        for v in (0..self.positions.len() as u32).map(VertexId) {
            if v.index() % BETWEEN_CHECKS == 0 {
                stage.check()?;
            }
            if !self.mesh.has_vertex(v) {
                continue;
            }
            let (start, normal, slope) = (self.at(v), self.normals[v.index()], self.slopes[v.index()]);
            let worst = self.sharpest_at(v).max(ROUND_SHARPNESS);
            match self.project(start, normal, slope) {
                Some(target) if target == start => {}
                Some(target) if self.try_move(v, target, worst) => moves += 1,
                _ => off += 1,
            }
        }
        Ok([moves, off])
    }

    /// The edges whose squared length is one of those, shortest first.
    fn edges_by_length(&self, of_those: impl Fn(f64) -> bool) -> Vec<HalfEdge> {
        let measured = self.mesh.edges().map(|h| (self.squared(h), h));
        let mut edges: Vec<(f64, HalfEdge)> = measured.filter(|&(squared, _)| of_those(squared)).collect();
        edges.sort_unstable_by(|(p, g), (q, h)| p.total_cmp(q).then(g.cmp(h)));
        edges.into_iter().map(|(_, h)| h).collect()
    }
}
