//! [`BoxTree`]: a bounding volume hierarchy over any boxes.
//!
//! # What it computes
//! For boxes numbered from 0: the pairs that meet, within one tree or between two, and the boxes that meet a box.
//!
//! # What it promises
//! * Answers are about the closed `f64` boxes given, exactly, wherever they lie (1e308, subnormal, far from the origin):
//!   the nodes' `f32` boxes come from an order-preserving map (`Frame`), which never parts boxes that meet.
//! * Answers do not depend on the shape of the tree nor on the number of threads.
//! * A refitted tree answers like a new one; only its speed may differ.
//!
//! # What it does not promise
//! Speed where more boxes than a few share the same 2^-24 of the scene.
//!
//! # Method
//! The hierarchy is built by locally ordered clustering \[Meister18\] and refitted bottom-up by `obvhs`, over its own
//! nodes. Clustering merges mutually nearest neighbours and needs a pass for each merge where all distances tie (equal boxes,
//! regular strips), so the boxes it is shown are displaced by a small hash of their number; afterwards the true boxes
//! are put into the leaves and the nodes refitted.
//! Pairs come from one simultaneous descent of the tree against itself, cut into tasks breadth first before it goes parallel.
//!
//! # Complexity
//! Build O(n log n); pairs O(n + k) in practice for k meeting mapped boxes, O(n^2) at worst.
//!
//! # Invariants
//! Every leaf holds one box; children have larger indices than their parent; a parent's box is the union of its children's.

use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rayon::prelude::*;

use super::descent::{Met, sort_pairs};
use super::frame::Frame;
use super::{Box3, descent};
use crate::{Cancelled, Monitor};

/// Boxes a chunk of parallel work.
const CHUNK: usize = 4096;

/// Neighbours on either side that clustering compares: the next setting up (14) takes half as long again to build and
/// visits the same number of nodes within a few per cent.
const SEARCH: PlocSearchDistance = PlocSearchDistance::Low;

/// Clustering passes that compare direct neighbours only: there most merges happen, with little to gain.
const QUICK_PASSES: usize = 2;

/// Displacement of the boxes shown to clustering, as a part of their largest side and of the frame. Large enough that
/// `f32` tells displaced equal boxes apart, small enough to keep the order of neighbours.
const JITTER: [f32; 2] = [1.0 / 32.0, 1.0 / 65536.0];

/// A bounding volume hierarchy over numbered `f64` boxes.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, spatial::{Box3, BoxTree}};
/// let unit = |x: f64| Box3 { min: DVec3::new(x, 0.0, 0.0), max: DVec3::new(x + 1.0, 1.0, 1.0) };
/// let boxes = [unit(0.0), unit(1.0), unit(5.0)];
/// let tree = BoxTree::new(&boxes);
/// assert_eq!(tree.self_pairs(&boxes, &Monitor::none()), Ok(vec![[0, 1]]));
/// assert_eq!(tree.meeting(&boxes, &unit(5.5)), [2]);
/// ```
#[derive(Clone)]
pub struct BoxTree {
    pub(crate) bvh: Bvh2,
    pub(crate) frame: Frame,
}

impl std::fmt::Debug for BoxTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BoxTree").field("boxes", &self.len()).field("frame", &self.frame).finish()
    }
}

/// Bit for bit the same hierarchy.
impl PartialEq for BoxTree {
    fn eq(&self, other: &Self) -> bool {
        let same = |a: &Bvh2Node, b: &Bvh2Node| {
            let bits = |v: Vec3A| v.to_array().map(f32::to_bits);
            let corners = |n: &Bvh2Node| [bits(n.aabb().min), bits(n.aabb().max)];
            (a.prim_count, a.first_index, corners(a)) == (b.prim_count, b.first_index, corners(b))
        };
        let (a, b) = (&self.bvh, &other.bvh);
        self.frame == other.frame
            && a.primitive_indices == b.primitive_indices
            && a.nodes.len() == b.nodes.len()
            && a.nodes.iter().zip(&b.nodes).all(|(a, b)| same(a, b))
    }
}

impl BoxTree {
    /// Builds the hierarchy of `boxes`: finite, not empty.
    ///
    /// # Panics
    /// From 2^31 boxes on (100 GB of nodes).
    #[must_use]
    pub fn new(boxes: &[Box3]) -> Self {
        Self::over(boxes.len(), |i| boxes[i])
    }

    /// Builds the hierarchy of `count` boxes given by number.
    pub(crate) fn over(count: usize, box_of: impl Fn(usize) -> Box3 + Sync) -> Self {
        assert!(count < 1 << 31, "nodes are numbered by 32 bits");
        let frame = Frame::of(scene(count, &box_of));
        let leaves = map_boxes(&frame, count, &box_of);
        let shown: Vec<Aabb> = leaves.par_iter().enumerate().with_min_len(CHUNK).map(displaced).collect();
        let indices = (0..leaves.len() as u32).collect();
        let mut bvh = PlocBuilder::new().build(SEARCH, &shown, indices, SortPrecision::U64, QUICK_PASSES);
        drop(shown);
        fit(&mut bvh, &leaves);
        Self { bvh, frame }
    }

    /// Number of boxes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bvh.primitive_indices.len()
    }

    /// Whether there is no box.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Keeps the hierarchy and makes it one of `boxes`, which have moved.
    ///
    /// # Panics
    /// If the number of boxes differs.
    pub fn refit(&mut self, boxes: &[Box3]) {
        assert_eq!(boxes.len(), self.len(), "a refit keeps the number of boxes");
        self.refit_over(|i| boxes[i]);
    }

    /// [`BoxTree::refit`] with boxes given by number.
    pub(crate) fn refit_over(&mut self, box_of: impl Fn(usize) -> Box3 + Sync) {
        self.frame = Frame::of(scene(self.len(), &box_of));
        let leaves = map_boxes(&self.frame, self.len(), &box_of);
        fit(&mut self.bvh, &leaves);
    }

    /// The same hierarchy in the frame of another tree.
    pub(crate) fn in_frame(&self, frame: Frame, box_of: impl Fn(usize) -> Box3 + Sync) -> Self {
        let leaves = map_boxes(&frame, self.len(), &box_of);
        let mut bvh = self.bvh.clone();
        fit(&mut bvh, &leaves);
        Self { bvh, frame }
    }

    /// All pairs `[i, j]`, `i < j`, of boxes that meet, sorted. `boxes` are those of the last build or refit.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn self_pairs(&self, boxes: &[Box3], monitor: &Monitor<'_>) -> Result<Vec<[u32; 2]>, Cancelled> {
        let mut pairs =
            descent::self_pairs(self, monitor, "pairs of boxes", |i, j, met, out: &mut Vec<[u32; 2]>| {
                if met == Met::Surely || boxes[i as usize].meets(&boxes[j as usize]) {
                    out.push([i.min(j), i.max(j)]);
                }
            })?;
        sort_pairs(&mut pairs, |i| i);
        Ok(pairs)
    }

    /// All pairs `[i, j]` of a box `i` of this tree and a box `j` of `other` that meet, sorted.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn pairs_with(
        &self,
        boxes: &[Box3],
        other: &Self,
        other_boxes: &[Box3],
        monitor: &Monitor<'_>,
    ) -> Result<Vec<[u32; 2]>, Cancelled> {
        let other = other.in_frame(self.frame, |i| other_boxes[i]);
        let mut pairs = descent::pairs_between(
            self,
            &other,
            monitor,
            "pairs of boxes",
            |i, j, met, out: &mut Vec<[u32; 2]>| {
                if met == Met::Surely || boxes[i as usize].meets(&other_boxes[j as usize]) {
                    out.push([i, j]);
                }
            },
        )?;
        sort_pairs(&mut pairs, |i| i);
        Ok(pairs)
    }

    /// The boxes that meet `query`, ascending.
    #[must_use]
    pub fn meeting(&self, boxes: &[Box3], query: &Box3) -> Vec<u32> {
        let mut found = Vec::new();
        self.visit_meeting(query, |i| {
            if boxes[i as usize].meets(query) {
                found.push(i);
            }
        });
        found.sort_unstable();
        found
    }

    /// Visits every box whose mapped box meets the mapped `query`: among them all that meet it.
    pub(crate) fn visit_meeting(&self, query: &Box3, mut visit: impl FnMut(u32)) {
        if query.is_empty() {
            return;
        }
        let query = map_box(&self.frame, query);
        self.visit(|node| overlap(node.aabb(), &query), &mut visit);
    }

    /// Visits the boxes of all leaves that are `kept` together with all their ancestors.
    pub(crate) fn visit(&self, kept: impl Fn(&Bvh2Node) -> bool, mut visit: impl FnMut(u32)) {
        let nodes = &self.bvh.nodes;
        let mut stack: Vec<&Bvh2Node> = Vec::with_capacity(64);
        stack.extend(nodes.first().filter(|root| kept(root)));
        while let Some(node) = stack.pop() {
            if node.is_leaf() {
                visit(self.box_index(node));
            } else {
                let children = &nodes[node.first_index as usize..][..2];
                stack.extend(children.iter().filter(|child| kept(child)));
            }
        }
    }

    /// The number of the box in a leaf.
    #[inline]
    pub(crate) fn box_index(&self, leaf: &Bvh2Node) -> u32 {
        self.bvh.primitive_indices[leaf.first_index as usize]
    }
}

/// Whether two closed mapped boxes meet.
#[inline]
pub(crate) fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (a.min.cmple(b.max) & b.min.cmple(a.max)).all()
}

fn map_box(frame: &Frame, b: &Box3) -> Aabb {
    Aabb::new(Vec3A::from_array(frame.map(b.min)), Vec3A::from_array(frame.map(b.max)))
}

fn map_boxes(frame: &Frame, count: usize, box_of: &(impl Fn(usize) -> Box3 + Sync)) -> Vec<Aabb> {
    (0..count).into_par_iter().with_min_len(CHUNK).map(|i| map_box(frame, &box_of(i))).collect()
}

/// The smallest box around all. (A union of boxes does not depend on the order in which they are joined.)
fn scene(count: usize, box_of: &(impl Fn(usize) -> Box3 + Sync)) -> Box3 {
    let joined = |range: std::ops::Range<usize>| range.fold(Box3::EMPTY, |all, i| all.union(&box_of(i)));
    let chunks: Vec<Box3> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| joined(chunk * CHUNK..((chunk + 1) * CHUNK).min(count)))
        .collect();
    chunks.iter().fold(Box3::EMPTY, |all, b| all.union(b))
}

/// The box shown to clustering in place of box `index`.
fn displaced((index, b): (usize, &Aabb)) -> Aabb {
    let amplitude = b.diagonal().max_element() * JITTER[0] + JITTER[1];
    // A bijection of 64-bit integers that spreads consecutive numbers [Steele14].
    let mut hash = (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let part = |shift: u32| ((hash >> shift) & 0x1f_ffff) as f32 / 0x1f_ffff as f32;
    let shift = Vec3A::new(part(0), part(21), part(42)) * amplitude;
    Aabb::new(b.min + shift, b.max + shift)
}

/// Puts the true boxes into the leaves and refits their ancestors.
fn fit(bvh: &mut Bvh2, leaves: &[Aabb]) {
    let Bvh2 { nodes, primitive_indices, .. } = &mut *bvh;
    nodes.par_iter_mut().with_min_len(CHUNK).filter(|node| node.is_leaf()).for_each(|leaf| {
        leaf.set_aabb(leaves[primitive_indices[leaf.first_index as usize] as usize]);
    });
    bvh.refit_all();
}
