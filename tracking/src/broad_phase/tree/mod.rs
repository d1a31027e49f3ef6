//! [`Tree`]: a hierarchy of exact boxes over numbered elements that come, go and move.
//!
//! # What it promises
//! Answers depend on the boxes alone, not on the shape of the tree.
//!
//! # Method
//! Built from the top by medians of the centres along the longest axis. Each node counts its leaves, so the nodes of
//! a subtree fill a known range of the array: building and refreshing cut arrays into disjoint parts and
//! go parallel. Changes are in `change.rs`, queries in `descent.rs`.
//!
//! # Invariants
//! A node's box is the union of its children's, its count their sum; neither child holds more than three quarters of
//! it, so no leaf of n is deeper than log n / log (4/3).

mod change;
mod descent;

pub(super) use descent::{pairs_between, self_pairs};

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::spatial::Box3;

/// No node, and no element.
const NONE: u32 = u32::MAX;

/// Subtrees of fewer leaves are built and refreshed by one thread: some hundred microseconds of work.
const GRAIN: usize = 2048;

/// A refreshed tree whose boxes have grown by this factor, relative to the scene, is built anew: queries visit
/// about that many times as many nodes as they did, while building costs about ten refreshes.
const TOLERATED_GROWTH: f64 = 2.0;

/// A node fills a line of the cache.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Box3,
    /// Of a leaf: its element, and nothing.
    children: [u32; 2],
    parent: u32,
    /// How many leaves are below; 1 for a leaf.
    leaves: u32,
}

impl Node {
    fn leaf(element: u32, bounds: Box3, parent: u32) -> Self {
        Self { bounds, children: [element, NONE], parent, leaves: 1 }
    }

    fn is_leaf(&self) -> bool {
        self.leaves == 1
    }
}

/// What building sorts.
#[derive(Clone, Copy)]
struct Key {
    centre: DVec3,
    element: u32,
}

impl Key {
    fn of(element: u32, bounds: &Box3) -> Self {
        // Halves do not overflow.
        Self { centre: 0.5 * bounds.min + 0.5 * bounds.max, element }
    }
}

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    root: u32,
    /// By element, [`NONE`] for those that are not in the tree.
    leaf_of: Vec<u32>,
    free: Vec<u32>,
    /// [`Tree::size`] when it was built.
    built_size: f64,
}

impl Tree {
    /// The tree of some elements, ascending.
    pub(super) fn new(elements: impl Iterator<Item = u32>, box_of: impl Fn(u32) -> Box3 + Sync) -> Self {
        let elements: Vec<u32> = elements.collect();
        let mut keys: Vec<Key> = elements.par_iter().map(|&e| Key::of(e, &box_of(e))).collect();
        let mut tree =
            Self { nodes: Vec::new(), root: NONE, leaf_of: Vec::new(), free: Vec::new(), built_size: 0.0 };
        if let Some(last) = elements.last() {
            tree.leaf_of = vec![NONE; *last as usize + 1];
            tree.nodes = build(&mut keys, &box_of);
            tree.root = 0;
            tree.find_leaves();
            tree.built_size = tree.size();
        }
        tree
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.get(self.root as usize).map_or(0, |root| root.leaves as usize)
    }

    /// The box of an element that is in the tree.
    pub(super) fn bounds(&self, element: u32) -> Option<&Box3> {
        let leaf = *self.leaf_of.get(element as usize)?;
        self.nodes.get(leaf as usize).map(|node| &node.bounds)
    }

    /// Gives all elements new boxes. Linear, unless the tree has become so much worse that it is built anew.
    pub(super) fn refresh(&mut self, box_of: impl Fn(u32) -> Box3 + Sync) {
        if self.root == NONE {
            return;
        }
        let blank = Node::leaf(NONE, Box3::EMPTY, NONE);
        let mut nodes = vec![blank; 2 * self.len() - 1];
        refit(&self.nodes, self.root, &mut nodes, 0, NONE, &box_of);
        (self.nodes, self.root) = (nodes, 0);
        self.free.clear();
        self.find_leaves();
        if self.size() > TOLERATED_GROWTH * self.built_size {
            let leaves = self.nodes.par_iter().filter(|node| node.is_leaf());
            let mut keys: Vec<Key> = leaves.map(|leaf| Key::of(leaf.children[0], &leaf.bounds)).collect();
            self.nodes = build(&mut keys, &box_of);
            self.find_leaves();
            self.built_size = self.size();
        }
    }

    /// The sum of the nodes' sizes as parts of the root's: about how many of them a query of no size visits. For a
    /// tree whose nodes are all in use.
    fn size(&self) -> f64 {
        let whole = half_girth(&self.nodes[self.root as usize].bounds);
        if whole == 0.0 {
            return 0.0;
        }
        let part = |nodes: &[Node]| nodes.iter().map(|node| half_girth(&node.bounds) / whole).sum::<f64>();
        // Parts of fixed size, summed in order, for the same bits by any number of threads.
        self.nodes.par_chunks(2 * GRAIN).map(part).collect::<Vec<f64>>().iter().sum()
    }

    fn find_leaves(&mut self) {
        for (i, node) in (0..).zip(&self.nodes) {
            if node.is_leaf() {
                self.leaf_of[node.children[0] as usize] = i;
            }
        }
    }
}

/// An eighth of the sum of the sides: it does not overflow, as areas would.
fn half_girth(bounds: &Box3) -> f64 {
    (0.125 * bounds.max - 0.125 * bounds.min).element_sum()
}

/// The nodes of a tree, the root first.
fn build(keys: &mut [Key], box_of: &(impl Fn(u32) -> Box3 + Sync)) -> Vec<Node> {
    assert!(keys.len() < 1 << 31, "nodes are numbered by 32 bits");
    let mut nodes = vec![Node::leaf(NONE, Box3::EMPTY, NONE); 2 * keys.len() - 1];
    build_below(keys, &mut nodes, 0, NONE, box_of);
    nodes
}

/// Fills `nodes`, whose first has the number `at`.
fn build_below(
    keys: &mut [Key],
    nodes: &mut [Node],
    at: u32,
    parent: u32,
    box_of: &(impl Fn(u32) -> Box3 + Sync),
) -> Box3 {
    if let [key] = keys {
        let bounds = box_of(key.element);
        nodes[0] = Node::leaf(key.element, bounds, parent);
        return bounds;
    }
    let leaves = keys.len();
    let centres = Box3::of(keys.iter().map(|key| key.centre));
    let axis = (0.5 * centres.max - 0.5 * centres.min).max_position();
    let middle = leaves / 2;
    keys.select_nth_unstable_by(middle, |a, b| {
        a.centre[axis].total_cmp(&b.centre[axis]).then(a.element.cmp(&b.element))
    });
    let (low, high) = keys.split_at_mut(middle);
    let (this, below) = nodes.split_at_mut(1);
    let (left, right) = below.split_at_mut(2 * middle - 1);
    let children = [at + 1, at + 2 * middle as u32];
    let mut build_low = || build_below(low, left, children[0], at, box_of);
    let mut build_high = || build_below(high, right, children[1], at, box_of);
    let boxes = if leaves < GRAIN { (build_low(), build_high()) } else { rayon::join(build_low, build_high) };
    let bounds = boxes.0.union(&boxes.1);
    this[0] = Node { bounds, children, parent, leaves: leaves as u32 };
    bounds
}

/// Copies the subtree at `from` of `old` into `nodes`, whose first has the number `at`, with new boxes.
fn refit(
    old: &[Node],
    from: u32,
    nodes: &mut [Node],
    at: u32,
    parent: u32,
    box_of: &(impl Fn(u32) -> Box3 + Sync),
) -> Box3 {
    let Node { children: [first, second], leaves, .. } = old[from as usize];
    if leaves == 1 {
        let bounds = box_of(first);
        nodes[0] = Node::leaf(first, bounds, parent);
        return bounds;
    }
    let (this, below) = nodes.split_at_mut(1);
    let (left, right) = below.split_at_mut(2 * old[first as usize].leaves as usize - 1);
    let children = [at + 1, at + 1 + left.len() as u32];
    let mut refit_left = || refit(old, first, left, children[0], at, box_of);
    let mut refit_right = || refit(old, second, right, children[1], at, box_of);
    let boxes = if (leaves as usize) < GRAIN {
        (refit_left(), refit_right())
    } else {
        rayon::join(refit_left, refit_right)
    };
    let bounds = boxes.0.union(&boxes.1);
    this[0] = Node { bounds, children, parent, leaves };
    bounds
}

#[cfg(test)]
mod tests;
