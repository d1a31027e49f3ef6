//! [`Workpiece`]: a surface under improvement, and what all operations ask of a change.

use super::embedding::Replacement;
use super::report::ImprovementReport;
use super::shape::{six_volumes, unit_normal};
use super::sizing::Sizing;
use super::{ImprovementParameters, TopologyParameters};
use crate::broad_phase::BroadPhase;
use crate::surface::{HalfEdge, MovingSurface, Outcome, Plan};
use glam::DVec3;
use welter_meshing::spatial::Box3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// See the module.
pub(crate) struct Workpiece<'a> {
    pub(crate) surface: &'a mut MovingSurface,
    /// None where the surface may intersect itself: then no change is asked whether it keeps it embedded.
    pub(crate) broad_phase: Option<&'a mut BroadPhase>,
    pub(crate) parameters: &'a ImprovementParameters,
    pub(crate) topology: &'a TopologyParameters,
    /// The reference length of the tracker.
    pub(crate) length: f64,
    pub(crate) sizing: Sizing,
    /// Cosine of the largest turn of a normal.
    pub(crate) least_agreement: f64,
    /// Cosine of the crease angle.
    pub(crate) crease_cosine: f64,
    pub(crate) report: ImprovementReport,
}

impl Workpiece<'_> {
    #[inline]
    pub(crate) fn at(&self, v: VertexId) -> DVec3 {
        self.surface.position(v)
    }

    #[inline]
    pub(crate) fn places(&self, t: TriId) -> [DVec3; 3] {
        self.surface.connectivity().corners(t).map(|v| self.at(v))
    }

    /// The length of an edge over the one that is aimed at there: 1 for the reference without adaption.
    #[inline]
    pub(crate) fn relative_length(&self, [a, b]: [VertexId; 2]) -> f64 {
        self.at(a).distance(self.at(b)) / (self.length * self.sizing.of([a, b]))
    }

    /// Whether a vertex is never moved.
    #[inline]
    pub(crate) fn immovable(&self, v: VertexId) -> bool {
        self.surface.masses()[v.index()].is_infinite()
    }

    /// The two half-edges of an edge that has just two triangles.
    pub(crate) fn two_sides(&self, edge: EdgeId) -> Option<[HalfEdge; 2]> {
        let mut around = self.surface.connectivity().around_edge(edge);
        let sides = [around.next()?, around.next()?];
        around.next().is_none().then_some(sides)
    }

    /// Whether a vertex is at the end of a surface, or where more than two sheets meet: an edge of it has another number of
    /// triangles than two.
    pub(crate) fn is_special(&self, v: VertexId) -> bool {
        let mesh = self.surface.connectivity();
        mesh.star(v).any(|h| {
            self.two_sides(mesh.edge(h)).is_none() || self.two_sides(mesh.edge(h.previous())).is_none()
        })
    }

    /// Whether no triangle that comes is degenerate or turned away from all that go.
    pub(crate) fn keeps_normals(&self, before: &[[DVec3; 3]], after: &[[DVec3; 3]]) -> bool {
        let normals: Vec<DVec3> = before.iter().map(|&t| unit_normal(t)).collect();
        after.iter().all(|&t| {
            let normal = unit_normal(t);
            let agrees = |n: &DVec3| n.dot(normal) >= self.least_agreement && *n != DVec3::ZERO;
            normal != DVec3::ZERO && normals.iter().any(agrees)
        })
    }

    /// Whether the volume between triangles and a tip is at most a part of the cube of the reference length.
    pub(crate) fn small_volume(&self, before: &[[DVec3; 3]], tip: DVec3, part: f64) -> bool {
        // Of lengths over the reference, so that nothing underflows.
        let scaled = |p: DVec3| (p - tip) / self.length;
        let volume =
            before.iter().map(|t| t.map(scaled)).map(|t| six_volumes(&[t], DVec3::ZERO)).sum::<f64>();
        volume.abs() <= 6.0 * part
    }

    /// Carries out a change that was admitted.
    pub(crate) fn carry_out(&mut self, plan: Plan, replacement: &Replacement) -> Outcome {
        let outcome = self.surface.apply(plan);
        let touched = replacement.old.iter().chain(&outcome.triangles).copied();
        self.follow_triangles(touched);
        outcome
    }

    /// Takes in that some triangles came, went or have other corners.
    pub(crate) fn follow_triangles(&mut self, touched: impl Iterator<Item = TriId>) {
        if let Some(broad_phase) = &mut self.broad_phase {
            broad_phase.set_triangles(self.surface, touched);
        }
    }

    /// Whether a change keeps the surface embedded, where that is asked for; `tip` is a corner of all new triangles.
    pub(crate) fn keeps_embedded(&self, replacement: &Replacement, tip: DVec3) -> bool {
        self.broad_phase
            .as_deref()
            .is_none_or(|broad_phase| replacement.keeps_embedded(self.surface, broad_phase, tip))
    }

    /// Whether something holds for all triangles whose boxes are near, where the surface is to stay embedded.
    pub(crate) fn all_triangles_near(&self, around: &Box3, holds: impl FnMut(TriId, &Box3) -> bool) -> bool {
        self.broad_phase.as_deref().is_none_or(|broad_phase| broad_phase.all_triangles_near(around, holds))
    }
}
