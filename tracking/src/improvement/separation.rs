//! Where surfaces part \[Brochu12, section 3.2.5\]: singular vertices, and rings of three edges.
//!
//! Singular vertices: each fan but the first gets a vertex of its own, pulled towards its neighbours. Rules and fallbacks are
//! alike: how far the parts go is a ladder of distances, and where none is admitted the surface is left as it is, until
//! something around it has changed.
//!
//! Rings of three edges that bound no triangle are cut where an edge of theirs would collapse \[Wojtan10\]: both parts are
//! closed by a triangle, so that no edge with more than two triangles comes about.

use super::parting::SHIFTS;
use super::workpiece::Workpiece;
use glam::DVec3;
use welter_meshing::surface::VertexId;

impl Workpiece<'_> {
    /// Separates the vertices that changes may have made singular.
    pub(crate) fn separate_singular_vertices(&mut self) {
        let mut suspects = std::mem::take(&mut self.suspects);
        suspects.sort_unstable();
        suspects.dedup();
        for v in suspects {
            if self.surface.connectivity().has_vertex(v) {
                self.separate(v);
            }
        }
    }

    fn separate(&mut self, v: VertexId) {
        if self.surface.connectivity().fans(v).len() < 2 {
            return;
        }
        let Ok(Some(plan)) = self.surface.plan_separation(v) else {
            self.report.refused.topology += 1;
            return;
        };
        let here = self.at(v);
        let births: Vec<VertexId> = plan.positions().iter().map(|&(birth, _)| birth).collect();
        let means: Vec<DVec3> = births
            .iter()
            .map(|&birth| {
                let own = plan.changed().iter().filter(|(_, corners)| corners.contains(&birth));
                let others = own.flat_map(|(_, corners)| *corners).filter(|&w| w != birth);
                mean(others.map(|w| self.at(w) - here))
            })
            .collect();
        for shift in SHIFTS {
            let mut plan = plan.clone();
            let shifted: Vec<(VertexId, DVec3)> =
                births.iter().zip(&means).map(|(&birth, &way)| (birth, here + shift * way)).collect();
            if shifted.iter().any(|&(birth, place)| plan.place(birth, place).is_err())
                || !self.may_part(&plan, &shifted)
            {
                continue;
            }
            let changed: Vec<_> = plan.changed().iter().map(|&(t, _)| t).collect();
            self.surface.apply(plan);
            self.broad_phase.set_triangles(self.surface, changed.into_iter());
            births.iter().for_each(|&birth| self.sizing.copied(birth, v));
            self.report.separations += 1;
            return;
        }
        self.report.refused.intersection += 1;
    }

    /// Cuts the surface along a ring of three edges. Whether it did.
    pub(crate) fn part_along_ring(&mut self, ring: [VertexId; 3]) -> bool {
        if ring.iter().any(|&v| self.immovable(v)) {
            self.report.refused.topology += 1;
            return false;
        }
        let Ok(plan) = self.surface.plan_cut(ring) else {
            self.report.refused.topology += 1;
            return false;
        };
        let mesh = self.surface.connectivity();
        let births: Vec<VertexId> =
            plan.positions().iter().map(|&(v, _)| v).filter(|v| !ring.contains(v)).collect();
        let ways: Vec<[DVec3; 2]> = (0..3)
            .map(|k| {
                let here = self.at(ring[k]);
                let moves = |t| plan.changed().iter().any(|&(changed, _)| changed == t);
                let side = |moved: bool| {
                    let own = mesh.star(ring[k]).filter(|h| moves(h.triangle()) == moved);
                    let others = own.flat_map(|h| [mesh.head(h), mesh.apex(h)]).filter(|v| !ring.contains(v));
                    mean(others.map(|v| self.at(v) - here))
                };
                [side(false), side(true)]
            })
            .collect();
        for shift in SHIFTS {
            let mut plan = plan.clone();
            let shifted: Vec<(VertexId, DVec3)> = (0..3)
                .flat_map(|k| {
                    [(ring[k], ways[k][0]), (births[k], ways[k][1])]
                        .map(|(v, way)| (v, self.at(ring[k]) + shift * way))
                })
                .collect();
            if shifted.iter().any(|&(v, place)| plan.place(v, place).is_err())
                || !self.may_part(&plan, &shifted)
            {
                continue;
            }
            let touched: Vec<_> = ring
                .iter()
                .flat_map(|&v| self.surface.connectivity().star(v))
                .map(|h| h.triangle())
                .collect();
            let outcome = self.surface.apply(plan);
            self.broad_phase.set_triangles(self.surface, touched.into_iter().chain(outcome.triangles));
            births.iter().zip(ring).for_each(|(&birth, v)| self.sizing.copied(birth, v));
            self.report.separations += 1;
            return true;
        }
        self.report.refused.intersection += 1;
        false
    }
}

/// The mean of some vectors, zero of none.
fn mean(vectors: impl Iterator<Item = DVec3>) -> DVec3 {
    let (sum, count) = vectors.fold((DVec3::ZERO, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    if count > 0.0 { sum / count } else { DVec3::ZERO }
}
