//! Where edges of one side pierce triangles of the other: [`Crossings`].
//!
//! # What it computes
//! For two triangles that cross, the two ends of their common segment: each is where an edge of one pierces the other.
//!
//! # Method
//! Whether an edge pierces a triangle is decided exactly, and so is on which side of a segment its triangle lies above the other one. With
//! `P` where the edge from `a` to `b` of a triangle `A` pierces a triangle `B`, and `Q` the other end of their segment:
//! * in `A`, what is left of the way from `P` to `Q` lies above `B` iff `a` does: the edge has its triangle on its left, so `a` is left
//!   of that way;
//! * in `B`, what is left of it lies above `A` iff `b` lies above `B`. With normals `n_A` and `n_B` the way is along `v = l n_A x n_B`. It
//!   leads into `A`, so `v . (n_A x (b - a)) = l |n_A|^2 (n_B . (b - a))` is positive, and `l` has the sign of `n_B . (b - a)`. What is
//!   left of it in `B` is along `n_B x v`, and `n_A . (n_B x v) = l |n_A x n_B|^2`.
//!
//! Places are rounded: the part of the way along the edge first, from the distances of its ends to the plane, then the weights of the
//! corners of the triangle, from areas around that point. Nothing depends on their being exact but the check of the result.

use std::collections::BTreeMap;

use glam::DVec3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};
use welter_predicates::intersection::{SegmentTriangle, segment_triangle};

use super::UnionObstacle;
use super::error::Stop;
use super::overlay::Overlay;
use crate::quadric::scale::Scale;

/// Fractions are multiples of this, so that one minus a fraction is exact.
const GRAIN: f64 = 1.0 / 9_007_199_254_740_992.0;

/// Where an edge pierces a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piercing {
    pub(super) triangle: TriId,
    /// The ends of the edge, the smaller id first.
    pub(super) ends: [VertexId; 2],
    /// How far from the first end to the second; a multiple of 2^-53, above 0 and below 1.
    pub(super) fraction: f64,
    pub(super) position: DVec3,
    /// The weights of the second and the third corner of the triangle.
    pub(super) weights: [f64; 2],
}

/// A segment that two triangles have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    /// Two piercings.
    pub(super) ends: [u32; 2],
    /// The other triangle.
    pub(super) other: TriId,
    /// Whether this triangle is above the other on the left of the way from the first end to the second.
    pub(super) left_above: bool,
}

/// What a triangle is cut by.
#[derive(Clone, Debug, Default)]
pub(super) struct Cut {
    pub(super) segments: Vec<Segment>,
    /// Piercings inside the triangle.
    pub(super) inside: Vec<u32>,
}

/// All piercings, and what they cut.
#[derive(Debug)]
pub(super) struct Crossings {
    pub(super) piercings: Vec<Piercing>,
    /// The triangles that are to be cut, also those that have piercings on their edges alone.
    pub(super) cuts: BTreeMap<TriId, Cut>,
    /// The piercings of an edge, from its first end to its second.
    pub(super) on_edge: BTreeMap<EdgeId, Vec<u32>>,
    /// How many segments there are.
    pub(super) segments: usize,
}

/// One end of a common segment, before piercings are numbered.
#[derive(Clone, Copy)]
struct End {
    key: (EdgeId, TriId),
    /// By triangle of the pair: whether it is above the other on the left of the way that begins here.
    left_above: [bool; 2],
}

impl Crossings {
    /// The crossings of pairs of triangles that meet.
    pub(super) fn new(overlay: &Overlay, pairs: &[[TriId; 2]]) -> Result<Self, Stop> {
        let ends: Vec<[End; 2]> =
            pairs.iter().map(|&pair| ends_of(overlay, pair)).collect::<Result<_, _>>()?;
        let mut keys: Vec<(EdgeId, TriId)> = ends.iter().flatten().map(|end| end.key).collect();
        keys.sort_unstable();
        keys.dedup();
        let piercings: Vec<Piercing> =
            keys.iter().map(|&key| placed(overlay, key)).collect::<Result<_, _>>()?;
        let number = |end: &End| keys.binary_search(&end.key).expect("every key is listed") as u32;

        let mut cuts: BTreeMap<TriId, Cut> = BTreeMap::new();
        for (pair, ends) in pairs.iter().zip(&ends) {
            for side in 0..2 {
                // The way back has the other side on its left.
                if ends[0].left_above[side] == ends[1].left_above[side] {
                    return Err(Stop::Degenerate(UnionObstacle::Parts));
                }
                let [first, last] = [&ends[0], &ends[1]].map(number);
                let left_above = ends[0].left_above[side];
                let segment = Segment { ends: [first, last], other: pair[1 - side], left_above };
                cuts.entry(pair[side]).or_default().segments.push(segment);
            }
        }
        let mut on_edge: BTreeMap<EdgeId, Vec<u32>> = BTreeMap::new();
        for (i, &(edge, triangle)) in (0_u32..).zip(&keys) {
            on_edge.entry(edge).or_default().push(i);
            cuts.entry(triangle).or_default().inside.push(i);
            for h in overlay.connectivity.around_edge(edge) {
                cuts.entry(h.triangle()).or_default();
            }
        }
        for list in on_edge.values_mut() {
            let fraction = |i: u32| piercings[i as usize].fraction;
            list.sort_by(|&a, &b| fraction(a).total_cmp(&fraction(b)).then(a.cmp(&b)));
            if list.windows(2).any(|pair| fraction(pair[0]) == fraction(pair[1])) {
                return Err(Stop::Degenerate(UnionObstacle::Order));
            }
        }
        Ok(Self { piercings, cuts, on_edge, segments: pairs.len() })
    }
}

/// The ends of the common segment of two triangles, which are to be in general position.
fn ends_of(overlay: &Overlay, pair: [TriId; 2]) -> Result<[End; 2], Stop> {
    let mut found = Vec::with_capacity(2);
    for side in 0..2 {
        let [own, other] = [pair[side], pair[1 - side]];
        let corners = overlay.mesh.corners(own);
        let edges = overlay.edges(own);
        for k in 0..3 {
            let ends = [corners[k], corners[(k + 1) % 3]];
            match segment_triangle(ends, overlay.mesh.corners(other)) {
                SegmentTriangle::Disjoint => {}
                case if case.is_proper() => {
                    let mut left_above = [false; 2];
                    left_above[side] = overlay.is_above(other, ends[0]);
                    left_above[1 - side] = overlay.is_above(other, ends[1]);
                    found.push(End { key: (edges[k], other), left_above });
                }
                _ => return Err(Stop::Degenerate(UnionObstacle::GeneralPosition)),
            }
        }
    }
    <[End; 2]>::try_from(found).map_err(|_| Stop::Degenerate(UnionObstacle::GeneralPosition))
}

/// The place of a piercing, rounded.
fn placed(overlay: &Overlay, (edge, triangle): (EdgeId, TriId)) -> Result<Piercing, Stop> {
    let [a, b] = overlay.connectivity.ends(edge);
    let ends = [a.min(b), a.max(b)];
    let [p, q] = ends.map(|v| overlay.position(v));
    let corners = overlay.mesh.corners(triangle);
    let extent = [q, corners[0], corners[1], corners[2]].map(|c| (c - p).abs().max_element());
    let scale = Scale::of_length(extent.into_iter().fold(0.0, f64::max), 1.0);
    let [c0, c1, c2] = corners.map(|corner| scale.difference(corner, p));
    let way = scale.difference(q, p);
    let normal = (c1 - c0).cross(c2 - c0);
    let (begin, end) = (normal.dot(-c0), normal.dot(way - c0));
    let fraction = (begin / (begin - end) / GRAIN).round() * GRAIN;
    if !(fraction > 0.0 && fraction < 1.0) {
        return Err(Stop::Degenerate(UnionObstacle::Order));
    }
    let [c0, c1, c2] = [c0, c1, c2].map(|c| c - way * fraction);
    let areas = [normal.dot(c1.cross(c2)), normal.dot(c2.cross(c0)), normal.dot(c0.cross(c1))];
    let sum = areas[0] + areas[1] + areas[2];
    let weights = [areas[1] / sum, areas[2] / sum];
    if !weights.iter().all(|weight| weight.is_finite()) {
        return Err(Stop::Degenerate(UnionObstacle::Order));
    }
    // As in splits: rounding may leave the segment's box, at the end of the range even the finite numbers.
    let position = (p * (1.0 - fraction) + q * fraction).clamp(p.min(q), p.max(q));
    Ok(Piercing { triangle, ends, fraction, position, weights })
}
