//! How long vertices can move on straight lines before a triangle turns over: [`StepLimit`].

use std::cmp::Ordering;

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::TriId;

use crate::flows::PIECE;
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;

/// A surface, the unit in which to compute, and the part of its area that a triangle keeps.
pub(super) struct StepLimit<'s> {
    pub(super) surface: &'s MovingSurface,
    pub(super) scale: &'s Scale,
    pub(super) area_kept: f64,
}

/// After so many halvings a vertex that is held back does not move at all.
const MAX_HALVINGS: u32 = 10;

impl StepLimit<'_> {
    /// The first fraction of a motion at which a triangle falls to the area to be kept, and which; 1 if none does.
    pub(super) fn first(&self, motion: &[DVec3]) -> (f64, Option<TriId>) {
        let earlier = |a: (f64, u32), b: (f64, u32)| {
            if a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)) == Ordering::Greater { b } else { a }
        };
        let (fraction, triangle) = (0..self.surface.connectivity().triangle_slots() as u32)
            .into_par_iter()
            .with_min_len(PIECE)
            .map(|t| (self.fraction(TriId(t), motion), t))
            .reduce(|| (1.0, u32::MAX), earlier);
        (fraction, (fraction < 1.0).then_some(TriId(triangle)))
    }

    /// Shortens the displacements of vertices of triangles that would turn over until none does, and says of how many.
    ///
    /// Each is halved, and after some halvings made zero. A triangle whose vertices all rest does not turn over, so
    /// this ends.
    pub(super) fn hold(&self, motion: &mut [DVec3]) -> usize {
        let mut halvings = vec![0_u32; motion.len()];
        loop {
            let turning: Vec<TriId> = (0..self.surface.connectivity().triangle_slots() as u32)
                .into_par_iter()
                .with_min_len(PIECE)
                .map(TriId)
                .filter(|&t| self.fraction(t, motion) < 1.0)
                .collect();
            if turning.is_empty() {
                return halvings.iter().filter(|&&halvings| halvings > 0).count();
            }
            let mut held: Vec<usize> = turning
                .iter()
                .flat_map(|&t| self.surface.connectivity().corners(t))
                .map(|v| v.index())
                .collect();
            held.sort_unstable();
            held.dedup();
            for v in held {
                halvings[v] += 1;
                let rests = halvings[v] > MAX_HALVINGS;
                motion[v] = if rests { DVec3::ZERO } else { 0.5 * motion[v] };
            }
        }
    }

    /// Up to which fraction of a motion a triangle keeps its area. Triangles without area have none to lose.
    fn fraction(&self, triangle: TriId, motion: &[DVec3]) -> f64 {
        let mesh = self.surface.connectivity();
        if !mesh.has_triangle(triangle) {
            return 1.0;
        }
        let corners = mesh.corners(triangle);
        let [a, b, c] = corners.map(|v| self.surface.position(v));
        let [da, db, dc] = corners.map(|v| self.scale.scaled(motion[v.index()]));
        let (e, f) = (self.scale.difference(b, a), self.scale.difference(c, a));
        let (de, df) = (db - da, dc - da);
        let normal = e.cross(f);
        let square = normal.length_squared();
        if square == 0.0 {
            return 1.0;
        }
        let linear = normal.dot(e.cross(df) + de.cross(f));
        let quadratic = normal.dot(de.cross(df));
        first_root((1.0 - self.area_kept) * square, linear, quadratic)
    }
}

/// The first root of `constant + linear t + quadratic t^2` in [0, 1], or 1; for a constant above 0.
fn first_root(constant: f64, linear: f64, quadratic: f64) -> f64 {
    if !(linear.is_finite() && quadratic.is_finite()) {
        return 0.0;
    }
    let discriminant = linear * linear - 4.0 * quadratic * constant;
    if discriminant.is_nan() {
        return 0.0;
    }
    if discriminant < 0.0 {
        return 1.0;
    }
    // The roots are half / quadratic and constant / half.
    let half = -0.5 * (linear + discriminant.sqrt().copysign(linear));
    let root = if half > 0.0 { constant / half } else { half / quadratic };
    if (0.0..1.0).contains(&root) { root } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_roots() {
        // (1 - 2 t)(1 - 3 t), (1 - 2 t)(1 + t), (1 - t/2)(1 - t/3), (1 - 2 t), 1, 1 + t^2, (1 - 4 t^2)
        let cases = [
            ([1.0, -5.0, 6.0], 1.0 / 3.0),
            ([1.0, -1.0, -2.0], 0.5),
            ([6.0, -5.0, 1.0], 1.0),
            ([1.0, -2.0, 0.0], 0.5),
            ([1.0, 0.0, 0.0], 1.0),
            ([1.0, 0.0, 1.0], 1.0),
            ([1.0, 0.0, -4.0], 0.5),
            ([1.0, 3.0, 2.0], 1.0),
            ([1.0, 1.0, -6.0], 0.5),
            ([1.0, -1e-300, 0.0], 1.0),
            ([1.0, f64::INFINITY, 0.0], 0.0),
            ([1.0, f64::NAN, 0.0], 0.0),
        ];
        for ([constant, linear, quadratic], root) in cases {
            let found = first_root(constant, linear, quadratic);
            assert!((found - root).abs() < 1e-15, "{constant} {linear} {quadratic}: {found}, not {root}");
        }
    }
}
