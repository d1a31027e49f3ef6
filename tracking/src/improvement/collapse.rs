//! Edge collapses \[Brochu12, section 3.2.4\].
//!
//! Rule: edges shorter than the limit, the shortest first. The vertex that remains goes
//! * to the end that may not be moved, or that ends a surface, or where more than two sheets meet;
//! * else to the end on the sharper feature: corner before ridge before smooth patch, by the eigenvalues of the quadric
//!   metric tensor;
//! * else where the subdivision scheme says, or on a ridge to the middle; both, by default, shifted so that volume is kept
//!   \[Lindstrom98\];
//!
//! and where that is not admitted to the middle, to either end, or nowhere: the collapse is refused.
//!
//! Topology: a collapse is plain if the ends have no common neighbours but the apexes of the edge's triangles, as the link
//! condition \[Dey99\] says. Others would join sheets at an edge. Where changes of topology are switched on, and
//! the edge lies on a ring of three edges that bounds no triangle, the surface is parted along the ring instead
//! (`separation`); but a small tip that a ring bounds is replaced by a triangle first.
//! A tetrahedron that collapses vanishes.

use super::embedding::Replacement;
use super::placement::{self, Feature};
use super::shape::{sharpness, volume_preserving};
use super::split::ordered;
use super::workpiece::Workpiece;
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use welter_meshing::surface::{EdgeId, VertexId};

/// What a collapse comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Plain,
    /// The ends have another common neighbour.
    Ring(VertexId),
    /// Two boundaries, or sheets, would be joined at a vertex.
    Pinch,
}

impl Workpiece<'_> {
    /// Collapses all edges that are too short.
    pub(crate) fn collapse_short_edges(&mut self) {
        let limit = self.parameters.min_edge_rel;
        let mesh = self.surface.connectivity();
        let short = |e: EdgeId| {
            let ends = mesh.ends(e);
            let length = self.relative_length(ends);
            (length < limit).then_some(Reverse((ordered(length), e.0, ends)))
        };
        let mut heap: BinaryHeap<_> = mesh.edges().filter_map(short).collect();
        while let Some(Reverse((length, e, ends))) = heap.pop() {
            let edge = EdgeId(e);
            let mesh = self.surface.connectivity();
            let stands = mesh.has_edge(edge) && mesh.ends(edge) == ends;
            if !stands || ordered(self.relative_length(ends)) != length {
                continue;
            }
            let Some(kept) = self.collapse(edge) else { continue };
            let mesh = self.surface.connectivity();
            for e in mesh.edges_at(kept) {
                let ends = mesh.ends(e);
                let length = self.relative_length(ends);
                if length < limit {
                    heap.push(Reverse((ordered(length), e.0, ends)));
                }
            }
        }
    }

    /// Collapses an edge; the vertex that remains, unless it is refused.
    pub(crate) fn collapse(&mut self, edge: EdgeId) -> Option<VertexId> {
        match self.kind_of_collapse(edge) {
            Kind::Plain => {}
            Kind::Ring(third) => {
                let [a, b] = self.surface.connectivity().ends(edge);
                if self.cap_tip([a, b, third]) {
                    // The edge is still there, and what stood in its way is not.
                    let stands = self.surface.connectivity().has_edge(edge);
                    return if stands { self.collapse(edge) } else { None };
                }
                if self.topology.enabled {
                    self.part_along_ring([a, b, third]);
                } else {
                    self.report.refused.topology += 1;
                }
                return None;
            }
            Kind::Pinch => {
                self.report.refused.topology += 1;
                return None;
            }
        }
        let [a, b] = self.surface.connectivity().ends(edge);
        let Some(Choice { kept, place }) = self.choose(edge) else {
            self.report.refused.shape += 1;
            return None;
        };
        let removed = if kept == a { b } else { a };
        let (pk, pr) = (self.at(kept), self.at(removed));
        let middle = 0.5 * pk + 0.5 * pr;
        // Where it may go off the edge.
        let kept_volume = |p: DVec3| match self.parameters.keeps_volume {
            true => volume_preserving(&self.triangles_of([a, b]), p),
            false => p,
        };
        let places: Vec<DVec3> = match place {
            Place::AtKept => vec![pk],
            Place::OnLine => vec![middle, pk, pr],
            Place::OnRidge => vec![kept_volume(middle), middle, pk, pr],
            Place::Free => {
                let scheme = placement::of_collapse(self, edge).unwrap_or(middle);
                vec![kept_volume(scheme), kept_volume(middle), middle, pk, pr]
            }
        };
        // What is refused last is told.
        let mut reason = Reason::Shape;
        for place in places {
            match self.collapse_to(edge, kept, place) {
                Ok(()) => return Some(kept),
                Err(why) => reason = why,
            }
        }
        let refused = &mut self.report.refused;
        match reason {
            Reason::Shape => refused.shape += 1,
            Reason::Volume => refused.volume += 1,
            Reason::Topology => refused.topology += 1,
            Reason::Intersection => refused.intersection += 1,
        }
        None
    }

    fn collapse_to(&mut self, edge: EdgeId, kept: VertexId, place: DVec3) -> Result<(), Reason> {
        let mut plan = self.surface.plan_collapse(edge, kept, 0.5).map_err(|_| Reason::Topology)?;
        plan.place(kept, place).map_err(|_| Reason::Shape)?;
        let cancelled = plan.removed().len() > self.surface.connectivity().edge_triangles(edge);
        // Nothing would be left of a small open sheet.
        let vanishes =
            plan.removed().len() == self.triangles_of(self.surface.connectivity().ends(edge)).len();
        if (cancelled || vanishes) && !self.topology.enabled {
            return Err(Reason::Topology);
        }
        let replacement = Replacement::new(self.surface, &plan);
        let after = replacement.places(self.surface);
        self.keeps_shape(&replacement, &after)?;
        if !self.small_volume(&replacement.before, place, self.parameters.max_volume_change_rel) {
            return Err(Reason::Volume);
        }
        if !self.keeps_embedded(&replacement, place) {
            return Err(Reason::Intersection);
        }
        if cancelled {
            self.report.cancelled += self.surface.consequences(&plan).cancelled.len() as u64;
        }
        self.carry_out(plan, &replacement);
        self.report.collapses += 1;
        Ok(())
    }

    /// Where the triangles are that have one of two vertices.
    fn triangles_of(&self, [a, b]: [VertexId; 2]) -> Vec<[DVec3; 3]> {
        let mesh = self.surface.connectivity();
        let others = mesh.star(b).filter(|h| ![mesh.head(*h), mesh.apex(*h)].contains(&a));
        mesh.star(a).chain(others).map(|h| self.places(h.triangle())).collect()
    }

    /// Whether the triangles that come are neither turned over, nor too sharp, nor with edges that would be split again.
    fn keeps_shape(&self, replacement: &Replacement, after: &[[DVec3; 3]]) -> Result<(), Reason> {
        if !self.keeps_normals(&replacement.before, after) {
            return Err(Reason::Shape);
        }
        let worst = |triangles: &[[DVec3; 3]]| triangles.iter().map(|&t| sharpness(t)).fold(0.0, f64::max);
        let (was, is) = (worst(&replacement.before), worst(after));
        let limit = self.parameters.max_edge_rel * self.length;
        let fits = |(corners, places): (&[VertexId; 3], &[DVec3; 3])| {
            (0..3).all(|k| {
                let [i, j] = [k, (k + 1) % 3];
                let scale = self.sizing.of([corners[i], corners[j]]);
                places[i].distance(places[j]) <= limit * scale
            })
        };
        let sharp = is > was && is > SHARP;
        if sharp || !replacement.after.iter().zip(after).all(fits) {
            return Err(Reason::Shape);
        }
        Ok(())
    }

    fn kind_of_collapse(&self, edge: EdgeId) -> Kind {
        let mesh = self.surface.connectivity();
        let [a, b] = mesh.ends(edge);
        let apexes: Vec<VertexId> = mesh.around_edge(edge).map(|h| mesh.apex(h)).collect();
        let mut beside: Vec<VertexId> = mesh.star(a).flat_map(|h| [mesh.head(h), mesh.apex(h)]).collect();
        beside.sort_unstable();
        beside.dedup();
        let mut shared: Vec<VertexId> = mesh
            .star(b)
            .flat_map(|h| [mesh.head(h), mesh.apex(h)])
            .filter(|v| *v != a && !apexes.contains(v) && beside.binary_search(v).is_ok())
            .collect();
        shared.sort_unstable();
        if let Some(&third) = shared.first() {
            return if apexes.len() == 2 { Kind::Ring(third) } else { Kind::Pinch };
        }
        let joined = apexes.len() != 1 && self.is_special(a) && self.is_special(b);
        if joined { Kind::Pinch } else { Kind::Plain }
    }

    /// Whether the special edges of a vertex (those of another number of triangles than two) are other than two that go straight
    /// on, up to 30 degrees.
    fn ends_a_line(&self, v: VertexId) -> bool {
        let mesh = self.surface.connectivity();
        let special = mesh.edges_at(v).into_iter().filter(|&e| self.two_sides(e).is_none());
        let ways: Vec<DVec3> = special.map(|e| self.at(mesh.other_end(e, v)) - self.at(v)).collect();
        match ways[..] {
            [p, q] => -p.dot(q) < STRAIGHT * p.length() * q.length(),
            _ => true,
        }
    }

    /// Which end remains, and where it may go; nothing if neither may be moved.
    fn choose(&self, edge: EdgeId) -> Option<Choice> {
        let [a, b] = self.surface.connectivity().ends(edge);
        let fixed = [a, b].map(|v| self.immovable(v));
        if fixed == [true, true] {
            return None;
        }
        let choice = |kept, place| Some(Choice { kept, place });
        if fixed[0] || fixed[1] {
            return choice(if fixed[0] { a } else { b }, Place::AtKept);
        }
        let on_edge = self.two_sides(edge).is_none();
        let special = [a, b].map(|v| self.is_special(v));
        match special {
            [true, true] if on_edge => {
                return match [a, b].map(|v| self.ends_a_line(v)) {
                    [true, true] => None,
                    [true, false] => choice(a, Place::AtKept),
                    [false, true] => choice(b, Place::AtKept),
                    [false, false] => choice(a, Place::OnLine),
                };
            }
            [true, false] => return choice(a, Place::AtKept),
            [false, true] => return choice(b, Place::AtKept),
            _ => {}
        }
        let features = [a, b].map(|v| Feature::of(self, v));
        if features[0] != features[1] {
            return choice(if features[0] > features[1] { a } else { b }, Place::AtKept);
        }
        match features[0] {
            Feature::Smooth => choice(a, Place::Free),
            Feature::Ridge => choice(a, Place::OnRidge),
            Feature::Corner => choice(a, Place::OnLine),
        }
    }
}

/// Above this [`sharpness`] a collapse may not make the worst triangle worse: angles below 15 degrees or so.
const SHARP: f64 = 16.0;

/// Cosine of 30 degrees.
const STRAIGHT: f64 = 0.866_025_403_784_438_6;

#[derive(Clone, Copy, Debug)]
enum Reason {
    Shape,
    Volume,
    Topology,
    Intersection,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    AtKept,
    OnLine,
    OnRidge,
    Free,
}

#[derive(Clone, Copy, Debug)]
struct Choice {
    kept: VertexId,
    place: Place,
}
