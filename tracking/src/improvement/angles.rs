//! Passes over triangles with a large or a small angle, whose edges may all be of fair length.
//!
//! Rule: the side opposite of a large angle is split near its middle, which halves the angle; the side opposite of a small
//! one is collapsed. Sweeps over all triangles in the order of their ids; triangles that come of a sweep wait for the next
//! call. Fallbacks are those of splits and collapses.

use super::shape::cosine_at;
use super::workpiece::Workpiece;
use welter_meshing::surface::{EdgeId, TriId};

impl Workpiece<'_> {
    /// Splits sides opposite of angles above the limit, unless they are short already.
    pub(crate) fn split_large_angles(&mut self) {
        let limit = libm::cos(self.parameters.large_angle.to_radians());
        let shortest = 2.0 * self.parameters.min_edge_rel;
        for t in self.triangles_by_angle(|cosines| cosines.iter().any(|&c| c < limit)) {
            let Some((edge, _)) = self.side_opposite(t, |cosine| -cosine) else { continue };
            let (mesh, places) = (self.surface.connectivity(), self.places(t));
            // It may have changed since.
            if !cosines(places).iter().any(|&c| c < limit) || self.relative_length(mesh.ends(edge)) < shortest
            {
                continue;
            }
            self.split(edge);
        }
    }

    /// Collapses sides opposite of angles below the limit.
    pub(crate) fn collapse_small_angles(&mut self) {
        let limit = libm::cos(self.parameters.small_angle.to_radians());
        for t in self.triangles_by_angle(|cosines| cosines.iter().any(|&c| c > limit)) {
            let Some((edge, cosine)) = self.side_opposite(t, |cosine| cosine) else { continue };
            if cosine > limit {
                self.collapse(edge);
            }
        }
    }

    fn triangles_by_angle(&self, wanted: impl Fn([f64; 3]) -> bool) -> Vec<TriId> {
        let mesh = self.surface.connectivity();
        mesh.triangles().filter(|&t| wanted(cosines(self.places(t)))).collect()
    }

    /// The side opposite of the corner whose cosine ranks highest, with that cosine.
    fn side_opposite(&self, t: TriId, rank: impl Fn(f64) -> f64) -> Option<(EdgeId, f64)> {
        let mesh = self.surface.connectivity();
        if !mesh.has_triangle(t) {
            return None;
        }
        let cosines = cosines(self.places(t));
        let k = (0..3).max_by(|&i, &j| rank(cosines[i]).total_cmp(&rank(cosines[j])))?;
        let [b, c] = [(k + 1) % 3, (k + 2) % 3].map(|k| mesh.corners(t)[k]);
        Some((mesh.edge_between(b, c)?, cosines[k]))
    }
}

fn cosines([a, b, c]: [glam::DVec3; 3]) -> [f64; 3] {
    [cosine_at([a, b, c]), cosine_at([b, c, a]), cosine_at([c, a, b])]
}
