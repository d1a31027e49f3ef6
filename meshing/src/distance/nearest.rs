//! [`Nearest`]: the closest triangles of eight points at a time.
//!
//! # What it promises
//! For each point the distance and the triangle of [`Bvh::closest_point`], bit for bit, if that distance is within the band.
//!
//! # Method
//! One descent of the hierarchy for eight neighbouring points. All bounds are in single precision, in the frame of the
//! hierarchy: cylinders around its nodes ([`Cap`]) and then the triangles themselves ([`FlatTriangle`]) are compared with a
//! limit for each point, the least distance found so far and some tolerance. Triangles within the limit of some point
//! are kept, and those still within it at the end are computed in double precision as `spatial::closest` does. The
//! limits start from the triangles found for the eight points before.
//!
//! # Why nothing is lost
//! Let t be the tolerance, T the triangle that wins, S the one with the least single-precision distance s that is no sliver. In
//! double precision T is not farther than S. No distance in double precision is less than the true one by more than
//! roundings, since its point is a convex combination of the corners; and that of S is not more than 2^-34 too large. So the true distance of T
//! is at most that of S and 2^-33, with t at least 2^-17. True distances differ from those in single precision by at most
//! 122/128 t, so T has at most s + 122/64 t and a little, less than s + 2 t. Cylinders, whose values exceed true
//! distances by less than t/3, are compared with s + 3 t.

use glam::{DVec3, Vec3A, Vec4};
use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;

use super::caps::{Below, Cap, caps};
use super::flat::{FlatTriangle, LANES, Lanes, Points, square_root, tolerance};
use crate::spatial::closest::triangle_distance;
use crate::spatial::{Box3, Bvh};
use crate::surface::TriId;

/// Relative roundings of a square, its root and their comparison, with much to spare.
const ROUNDING: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// Largest coordinate in the frame of points that are looked at in single precision: there the tolerance is a part in 500 of
/// the scene.
pub(super) const FARTHEST: f64 = 256.0;

/// A hierarchy whose triangles are ready for many points.
pub(super) struct Prepared<'a> {
    pub(super) bvh: &'a Bvh<'a>,
    /// In the order of leaves.
    flat: Vec<FlatTriangle>,
    /// The corners in the same order, so that one look finds what is next to it.
    corners: Vec<[DVec3; 3]>,
    /// In the order of nodes.
    caps: Vec<Cap>,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(bvh: &'a Bvh<'a>) -> Self {
        let tree = bvh.tree();
        let leaves = tree.bvh.primitive_indices.par_iter().with_min_len(1024);
        let corners: Vec<_> = leaves.map(|&t| bvh.mesh().corners(TriId(t))).collect();
        let placed = |leaf: u32| corners[leaf as usize].map(|p| tree.frame.place(p));
        let all = 0..corners.len() as u32;
        let flat =
            || all.into_par_iter().with_min_len(1024).map(|leaf| FlatTriangle::of(placed(leaf))).collect();
        let (flat, caps) = rayon::join(flat, || caps(&tree.bvh, placed));
        Self { bvh, flat, corners, caps }
    }

    fn id(&self, leaf: u32) -> TriId {
        TriId(self.bvh.tree().bvh.primitive_indices[leaf as usize])
    }
}

/// The closest triangle of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) distance: f64,
    pub(super) triangle: TriId,
}

/// A search for closest triangles, with the room it works in and the triangles found last.
pub(super) struct Nearest<'a> {
    prepared: &'a Prepared<'a>,
    tolerance: f32,
    /// The largest limit, from the band.
    band: f32,
    stack: Vec<u32>,
    kept: Vec<(u32, [f32; LANES])>,
    seeds: Vec<u32>,
}

impl<'a> Nearest<'a> {
    /// For points at most `reach` from the middle of the frame along each axis, and distances of at most `band`.
    pub(super) fn new(prepared: &'a Prepared<'a>, reach: f64, band: f64) -> Self {
        let tolerance = tolerance(reach.max(1.0)) as f32;
        let band = prepared.bvh.tree().frame.scaled(band);
        // Beyond any distance there is (points within FARTHEST), and far from overflow when squared.
        let band = (band.min(1e6) as f32 + 2.0 * tolerance) * ROUNDING;
        Self {
            prepared,
            tolerance,
            band,
            stack: Vec::with_capacity(64),
            kept: Vec::with_capacity(64),
            seeds: Vec::with_capacity(LANES),
        }
    }

    /// Begins with points in a box; whether there may be triangles within the band of them.
    pub(super) fn begin(&mut self, around: &Box3) -> bool {
        let tree = self.prepared.bvh.tree();
        let [low, high] = [around.min, around.max].map(|p| Vec3A::from_array(tree.frame.map(p)));
        let gap = |node: &Bvh2Node| {
            let (min, max) = (node.aabb().min, node.aabb().max);
            (min - high).max(low - max).max(Vec3A::ZERO).length_squared()
        };
        let limit = self.band * self.band * ROUNDING;
        let nodes = &tree.bvh.nodes;
        self.stack.clear();
        self.stack.extend(nodes.first().map(|_| 0));
        while let Some(index) = self.stack.pop() {
            let node = &nodes[index as usize];
            if gap(node) > limit {
                continue;
            }
            if node.is_leaf() {
                self.seeds.push(node.first_index);
                return true;
            }
            let [a, b] = [node.first_index, node.first_index + 1];
            let ordered = if gap(&nodes[b as usize]) < gap(&nodes[a as usize]) { [a, b] } else { [b, a] };
            self.stack.extend(ordered);
        }
        false
    }

    /// The closest triangles of the points within the band: at `None` there is none, or it may be farther.
    pub(super) fn of(&mut self, at: &[DVec3; LANES]) -> [Option<Found>; LANES] {
        let frame = &self.prepared.bvh.tree().frame;
        let placed = at.map(|p| frame.map(p));
        let axis = |k: usize| Lanes::of(std::array::from_fn(|lane| placed[lane][k]));
        let points = Points { x: axis(0), y: axis(1), z: axis(2) };
        let least = self.descend(&points);
        let limits = self.limits(least, 2.0).to_array();
        let mut found = [None; LANES];
        self.seeds.clear();
        for lane in 0..LANES {
            if let Some((found_here, leaf)) = self.settle(at[lane], lane, limits[lane]) {
                found[lane] = Some(found_here);
                if !self.seeds.contains(&leaf) {
                    self.seeds.push(leaf);
                }
            }
        }
        found
    }

    /// Collects the triangles within the limits of some of the points; returns the least squared distances.
    fn descend(&mut self, points: &Points) -> Lanes {
        let caps = &self.prepared.caps;
        let mut least = Lanes::splat(f32::INFINITY);
        for &seed in &self.seeds {
            let seed = &self.prepared.flat[seed as usize];
            if !seed.sliver {
                least = least.min(seed.squared_distances(points));
            }
        }
        let mut limits = self.limits(least, 3.0);
        self.kept.clear();
        self.stack.clear();
        match caps.first().map(|root| root.below) {
            Some(Below::Children(first)) => self.stack.push(first),
            Some(Below::Leaf(leaf)) => self.look_at(leaf, points, &mut least, &mut limits),
            None => {}
        }
        while let Some(first) = self.stack.pop() {
            let pair = &caps[first as usize..][..2];
            // Both at once: neither waits for the other.
            let [a, b] = [pair[0].squared_distances(points), pair[1].squared_distances(points)];
            let near = [a.any_at_most(limits), b.any_at_most(limits)];
            for (cap, near) in pair.iter().zip(near) {
                match cap.below {
                    _ if !near => {}
                    Below::Children(first) => self.stack.push(first),
                    Below::Leaf(leaf) => self.look_at(leaf, points, &mut least, &mut limits),
                }
            }
        }
        least
    }

    /// Keeps a triangle if it is within the limit of some point, and lowers the limits.
    #[inline(always)]
    fn look_at(&mut self, leaf: u32, points: &Points, least: &mut Lanes, limits: &mut Lanes) {
        let flat = &self.prepared.flat[leaf as usize];
        let squares = flat.squared_distances(points);
        if squares.any_at_most(*limits) {
            self.kept.push((leaf, squares.to_array()));
            if !flat.sliver {
                *least = least.min(squares);
                *limits = self.limits(*least, 3.0);
            }
        }
    }

    /// What squared distances a triangle may have that is not farther than the nearest so far.
    fn limits(&self, least: Lanes, tolerances: f32) -> Lanes {
        let (band, slack) = (Vec4::splat(self.band), Vec4::splat(tolerances * self.tolerance));
        least.map(|square| {
            let limit = (square_root(square) + slack).min(band);
            limit * limit * ROUNDING
        })
    }

    /// The closest of the triangles kept for a point, in double precision, the lowest of those at the same distance; and its leaf.
    fn settle(&self, at: DVec3, lane: usize, limit: f32) -> Option<(Found, u32)> {
        let bvh = self.prepared.bvh;
        let local = bvh.tree().frame.about(at);
        let mut best: Option<(f64, TriId, u32)> = None;
        for (leaf, _) in self.kept.iter().filter(|(_, squares)| squares[lane] <= limit) {
            let leaf = *leaf;
            let triangle = self.prepared.id(leaf);
            let distance = triangle_distance(self.prepared.corners[leaf as usize].map(|p| local.place(p)));
            if best
                .is_none_or(|(least, lowest, _)| distance < least || (distance == least && triangle < lowest))
            {
                best = Some((distance, triangle, leaf));
            }
        }
        best.map(|(distance, triangle, leaf)| (Found { distance: local.length(distance), triangle }, leaf))
    }
}
