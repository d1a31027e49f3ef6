//! How much smoke the light has passed, from the surface itself.
//!
//! # What it computes
//! For a point, the length of smoke between it and the light. For a short straight way inside the smoke, the
//! mean of the share of the light that arrives, by the weight of what the eye sees of it.
//!
//! # What it promises
//! The surface is a polyhedron, so along a way the length of smoke before it is linear between the edges of
//! the triangles that the light passes. These pieces are found and each is integrated in closed form: the
//! mean is exact up to rounding, and up to where parts of the surface before the way intersect each other
//! within a piece.
//!
//! # What it does not promise
//! Speed: time is that of all triangles in the columns that a way passes, wherever they lie along the light.
//!
//! # Method
//! Each triangle is a prism along the light ([`Prism`](super::prisms::Prism)). Triangles before a piece are
//! sorted along the light, which tells the winding number between them, and that the density.

use glam::DVec3;

use super::InteriorRule;
use super::columns::Columns;

/// Pieces of a way shorter than this part of it are left out.
const SLIVER: f64 = 1.0 / (1_u64 << 24) as f64;

/// How far a light ray that meets an edge is moved, in voxels.
const BESIDE: f64 = 1.0 / (1_u64 << 30) as f64;

/// Triangles of the smoke's surface by columns.
#[derive(Debug)]
pub(super) struct LightPaths {
    columns: Columns,
    rule: InteriorRule,
    /// Most triangles of a column for a mean.
    most: usize,
    /// Optical depth of a voxel full of smoke.
    optical_depth: f64,
}

/// Memory for a way.
#[derive(Debug, Default)]
pub(super) struct Before {
    found: Vec<u32>,
    spans: Vec<Span>,
    ends: Vec<f64>,
    /// Depths below the surface at both ends of a piece, and which way light goes there.
    layers: Vec<Layer>,
}

/// A triangle that light passes on its way to a part of a way.
#[derive(Clone, Copy, Debug)]
struct Span {
    part: [f64; 2],
    /// How far behind the triangle both ends of the part are.
    depths: [f64; 2],
    sign: i32,
}

impl Span {
    /// How far behind the triangle a place of the part is.
    #[inline]
    fn depth(&self, at: f64) -> f64 {
        let [start, end] = self.part;
        let part = (at - start) / (end - start);
        self.depths[0] + part * (self.depths[1] - self.depths[0])
    }
}

#[derive(Clone, Copy, Debug)]
struct Layer {
    depths: [f64; 2],
    sign: i32,
}

impl LightPaths {
    /// From triangles in lattice coordinates, in a lattice with so many voxels across the light.
    pub(super) fn new(
        corners: &[[DVec3; 3]],
        across: [usize; 2],
        rule: InteriorRule,
        most: usize,
        optical_depth: f64,
    ) -> Self {
        Self { columns: Columns::new(corners, across), rule, most, optical_depth }
    }

    /// The share of the light that arrives at a point, if the surface balances along the light there: up to
    /// rounding at its edges, and there beside them.
    pub(super) fn transmittance(&self, point: DVec3, before: &mut Before) -> Option<f64> {
        let beside = [DVec3::ZERO, DVec3::new(0.62, 0.31, 0.0), DVec3::new(-0.45, 0.71, 0.0)];
        let length = beside.iter().find_map(|&step| self.length(point + BESIDE * step, before))?;
        Some(libm::exp(-self.optical_depth * length))
    }

    fn length(&self, point: DVec3, before: &mut Before) -> Option<f64> {
        before.layers.clear();
        let mut balance = 0;
        for &index in self.columns.at(point.x, point.y) {
            let prism = self.columns.prism(index);
            if prism.is_below(point) {
                balance += prism.sign;
                let depth = prism.depth(point);
                if depth > 0.0 {
                    before.layers.push(Layer { depths: [depth; 2], sign: prism.sign });
                }
            }
        }
        let [length, _] = before.lengths(self.rule);
        (balance == 0).then_some(length)
    }

    /// The mean share of the light on a way inside the smoke, by the weight of what is seen of it through its
    /// own optical depth; only the light on the given parts of the way is counted. None if a column
    /// that the way passes has too many triangles.
    pub(super) fn mean(
        &self,
        [from, to]: [DVec3; 2],
        optical_depth: f64,
        lit: &[[f64; 2]],
        before: &mut Before,
    ) -> Option<f64> {
        if !self.columns.along(from, to, self.most, &mut before.found) {
            return None;
        }
        before.spans.clear();
        before.ends.clear();
        for &index in &before.found {
            let prism = self.columns.prism(index);
            let Some(part) = prism.below(from, to) else { continue };
            // At the ends of the part, where the triangle is, so that its plane is not followed beyond it.
            let depths = part.map(|at| prism.depth(from + at * (to - from)));
            if depths[0] + depths[1] > 0.0 {
                before.spans.push(Span { part, depths, sign: prism.sign });
                before.ends.extend(part);
            }
        }
        before.ends.extend([0.0, 1.0]);
        before.ends.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        let mut start = 0.0;
        for at in 1..before.ends.len() {
            let end = before.ends[at];
            if end - start < SLIVER {
                continue;
            }
            for part in lit {
                let piece = [part[0].max(start), part[1].min(end)];
                if piece[0] < piece[1] {
                    before.cover(piece);
                    let lengths = before.lengths(self.rule);
                    sum += integral(piece, optical_depth, lengths.map(|l| self.optical_depth * l));
                }
            }
            start = end;
        }
        let whole = -libm::expm1(-optical_depth);
        Some(if whole > 0.0 { sum / whole } else { 0.0 })
    }
}

impl Before {
    /// Makes the layers of a piece of the way.
    fn cover(&mut self, piece: [f64; 2]) {
        let middle = 0.5 * (piece[0] + piece[1]);
        self.layers.clear();
        let over = self.spans.iter().filter(|span| span.part[0] <= middle && middle <= span.part[1]);
        self.layers
            .extend(over.map(|span| Layer { depths: piece.map(|at| span.depth(at)), sign: span.sign }));
    }

    /// Length of smoke, times density, before both ends of a piece.
    fn lengths(&mut self, rule: InteriorRule) -> [f64; 2] {
        let middle = |layer: &Layer| layer.depths[0] + layer.depths[1];
        self.layers.sort_unstable_by(|a, b| middle(b).total_cmp(&middle(a)).then(b.sign.cmp(&a.sign)));
        let mut lengths = [0.0_f64; 2];
        let mut winding = 0;
        for (at, layer) in self.layers.iter().enumerate() {
            winding += layer.sign;
            let density = rule.density(f64::from(winding));
            let next = self.layers.get(at + 1).map_or([0.0; 2], |next| next.depths);
            for k in 0..2 {
                lengths[k] += density * (layer.depths[k] - next[k]);
            }
        }
        // Depths are no longer in order where triangles intersect within the piece.
        lengths.map(|length| length.max(0.0))
    }
}

/// The integral of `exp(-t u) exp(-(what the light has passed)) t du` over a piece of a way, the latter linear
/// between its ends.
fn integral(piece: [f64; 2], t: f64, passed: [f64; 2]) -> f64 {
    let whole = piece.map(|u| t * u);
    let ends = [whole[0] + passed[0], whole[1] + passed[1]];
    let most = ends[0].min(ends[1]);
    let change = (ends[1] - ends[0]).abs();
    // (1 - exp(-x)) / x
    let mean = if change > 0.0 { -libm::expm1(-change) / change } else { 1.0 };
    (whole[1] - whole[0]) * libm::exp(-most) * mean
}
