//! How much smoke the light has passed, from the surface itself.
//!
//! # What it computes
//! For a point, the length of smoke between it and the light. For a short straight way inside the smoke, the
//! mean of the share of the light that arrives, by the weight of what the eye sees of it.
//!
//! # What it promises
//! The surface is a polyhedron, so along a way the length of smoke before it is linear between the edges of
//! the triangles that the light passes, and the places where these intersect each other. These pieces are
//! found and each is integrated in closed form: the mean is exact up to rounding, unless more than
//! [`MOST_SPLITS`] triangles that the light passes intersect each other before one piece.
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

/// A column may have so many times the triangles that columns may have in the mean: sheets have more of them
/// at their rims.
const CROWD: usize = 4;

/// Most places where a piece is divided because triangles before it intersect.
const MOST_SPLITS: usize = 64;

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
    /// Pieces that are still to be integrated, the next one last.
    pieces: Vec<[f64; 2]>,
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

/// A triangle before a piece: how far behind it both ends of the piece are.
#[derive(Clone, Copy, Debug)]
struct Layer {
    depths: [f64; 2],
    sign: i32,
}

impl LightPaths {
    /// From triangles in lattice coordinates, in a lattice with so many voxels across the light; for means, up
    /// to `traced` triangles in the usual column.
    pub(super) fn new(
        corners: &[[DVec3; 3]],
        across: [usize; 2],
        rule: InteriorRule,
        traced: usize,
        optical_depth: f64,
    ) -> Self {
        let most = traced.saturating_mul(CROWD);
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
                    sum += self.piece(piece, optical_depth, before);
                }
            }
            start = end;
        }
        let whole = -libm::expm1(-optical_depth);
        Some(if whole > 0.0 { sum / whole } else { 0.0 })
    }

    /// What is seen of a piece of a way between whose ends all triangles before it are the same.
    fn piece(&self, piece: [f64; 2], optical_depth: f64, before: &mut Before) -> f64 {
        let (mut sum, mut splits) = (0.0, 0);
        before.pieces.clear();
        before.pieces.push(piece);
        while let Some(piece) = before.pieces.pop() {
            before.cover(piece);
            let lengths = before.lengths(self.rule);
            let crossing = if splits < MOST_SPLITS { before.crossing() } else { None };
            if let Some(part) = crossing {
                splits += 1;
                let at = piece[0] + part * (piece[1] - piece[0]);
                before.pieces.extend([[at, piece[1]], [piece[0], at]]);
            } else {
                sum += integral(piece, optical_depth, lengths.map(|l| self.optical_depth * l));
            }
        }
        sum
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

    /// Where in the piece two layers, neighbours in the order of its middle, intersect.
    fn crossing(&self) -> Option<f64> {
        self.layers.windows(2).find_map(|pair| {
            let [start, end] = [0, 1].map(|k| pair[0].depths[k] - pair[1].depths[k]);
            let at = start / (start - end);
            let inside = (start < 0.0) != (end < 0.0) && at > SLIVER && at < 1.0 - SLIVER;
            inside.then_some(at)
        })
    }

    /// Sorts the layers along the light. Length of smoke, times density, before both ends of a piece.
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
        // Rounding, or triangles that still intersect, may put them out of order at an end.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces of an octahedron, outward.
    fn octahedron(center: DVec3, radius: f64) -> Vec<[DVec3; 3]> {
        let face = |bits: u32| {
            let sign = |axis: u32| if bits >> axis & 1 == 1 { -radius } else { radius };
            let [x, y, z] = [sign(0) * DVec3::X, sign(1) * DVec3::Y, sign(2) * DVec3::Z];
            let corners = if bits.count_ones().is_multiple_of(2) { [x, y, z] } else { [y, x, z] };
            corners.map(|corner| center + corner)
        };
        (0..8).map(face).collect()
    }

    /// Two that overlap, one of them partly inside out, over a large one.
    fn pile() -> Vec<[DVec3; 3]> {
        let mut all = octahedron(DVec3::new(10.0, 10.0, 12.0), 9.0);
        all.extend(octahedron(DVec3::new(8.6, 10.2, 4.0), 3.1));
        all.extend(octahedron(DVec3::new(10.9, 9.5, 3.2), 2.7).iter().map(|&[a, b, c]| [a, c, b]));
        all
    }

    fn paths(rule: InteriorRule) -> LightPaths {
        LightPaths::new(&pile(), [20, 20], rule, usize::MAX, 0.3)
    }

    const RULES: [InteriorRule; 4] =
        [InteriorRule::NonZero, InteriorRule::Positive, InteriorRule::Odd, InteriorRule::Multiplicity];

    #[test]
    fn the_light_at_a_point_has_passed_what_lies_before_it() {
        let mut before = Before::default();
        // Along the axis of the large one, and its edge-on corners and edges, from 3 to 21.
        let large = LightPaths::new(&pile()[..8], [20, 20], InteriorRule::NonZero, usize::MAX, 0.3);
        for (x, y, z, length) in [
            (10.0, 10.0, 12.0, 9.0),
            (10.0, 10.0, 25.0, 18.0),
            (12.0, 10.0, 12.0, 7.0),
            (12.0, 13.0, 30.0, 8.0),
        ] {
            let light = large.transmittance(DVec3::new(x, y, z), &mut before).expect("in balance");
            assert!((light - libm::exp(-0.3 * length)).abs() < 1e-9, "{x} {y} {z}: {light}");
        }
        assert_eq!(large.transmittance(DVec3::new(10.0, 10.0, 2.0), &mut before), Some(1.0));
        // There the small ones go from 2.5 to 5.5 and, inside out, from 1.9 to 4.5; so it winds -1, 0, 1, 2 and
        // 1 times between 1.9, 2.5, 3, 4.5, 5.5 and the point.
        for (rule, length) in RULES.into_iter().zip([4.1, 3.5, 3.1, 5.1]) {
            let light = paths(rule).transmittance(DVec3::new(10.0, 10.0, 6.5), &mut before);
            let light = light.expect("in balance");
            assert!((light - libm::exp(-0.3 * length)).abs() < 1e-8, "{rule:?}: {light}");
        }
    }

    #[test]
    fn the_mean_is_that_of_many_points() {
        let mut state = 9_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (mut before, mut varied) = (Before::default(), 0);
        for round in 0..40 {
            let paths = paths(RULES[round % 4]);
            let mut point = || DVec3::new(10.0 + 7.0 * random(), 10.0 + 7.0 * random(), 12.0 + random());
            let (from, to, t) = (point(), point(), 0.7);
            let parts = if round % 3 == 0 { vec![[0.1, 0.4], [0.75, 1.0]] } else { vec![[0.0, 1.0]] };
            let mean = paths.mean([from, to], t, &parts, &mut before).expect("there is no limit");
            let count = 20_000;
            let (mut sum, mut whole, mut least, mut most) = (0.0, 0.0, 1.0_f64, 0.0_f64);
            for k in 0..count {
                let at = (f64::from(k) + 0.5) / f64::from(count);
                let weight = libm::exp(-t * at);
                whole += weight;
                if parts.iter().any(|part| part[0] <= at && at <= part[1]) {
                    let light = paths.transmittance(from + at * (to - from), &mut before);
                    let light = light.expect("in balance");
                    (least, most) = (least.min(light), most.max(light));
                    sum += weight * light;
                }
            }
            assert!((mean - sum / whole).abs() < 2e-5, "{round}: {mean} {}", sum / whole);
            varied += usize::from(most > 1.5 * least);
        }
        assert!(varied > 20, "{varied}");
    }

    #[test]
    fn crowded_columns_have_no_mean() {
        let crowded = LightPaths::new(&pile(), [20, 20], InteriorRule::NonZero, 1, 0.3);
        let (from, to) = (DVec3::new(10.0, 10.0, 12.0), DVec3::new(10.5, 10.0, 12.0));
        assert_eq!(crowded.mean([from, to], 0.1, &[[0.0, 1.0]], &mut Before::default()), None);
    }
}
