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
/// about that many times as many nodes as they did, while building costs about five refreshes.
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
    /// Whether each node is followed by all of its first child's subtree, then all of the second's.
    ordered: bool,
    /// [`Extent::size`] when it was built.
    built_size: f64,
}

impl Tree {
    /// The tree of some elements, ascending.
    pub(super) fn new(elements: impl Iterator<Item = u32>, box_of: impl Fn(u32) -> Box3 + Sync) -> Self {
        let elements: Vec<u32> = elements.collect();
        let mut keys: Vec<Key> = elements.par_iter().map(|&e| Key::of(e, &box_of(e))).collect();
        let mut tree = Self {
            nodes: Vec::new(),
            root: NONE,
            leaf_of: Vec::new(),
            free: Vec::new(),
            ordered: true,
            built_size: 0.0,
        };
        if let Some(last) = elements.last() {
            tree.leaf_of = vec![NONE; *last as usize + 1];
            tree.build_all(&mut keys, &box_of);
        }
        tree
    }

    fn build_all(&mut self, keys: &mut [Key], box_of: &(impl Fn(u32) -> Box3 + Sync)) {
        (self.nodes, self.built_size) = build(keys, box_of);
        (self.root, self.ordered) = (0, true);
        self.free.clear();
        self.find_leaves();
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.get(self.root as usize).map_or(0, |root| root.leaves as usize)
    }

    /// The box of an element that is in the tree.
    pub(super) fn bounds(&self, element: u32) -> Option<&Box3> {
        let leaf = *self.leaf_of.get(element as usize)?;
        self.nodes.get(leaf as usize).map(|node| &node.bounds)
    }

    /// Whether exactly the elements in use, `count` of them, are in the tree.
    pub(super) fn holds(&self, count: usize, in_use: impl Fn(u32) -> bool + Sync) -> bool {
        let known = |(element, &leaf): (usize, &u32)| leaf == NONE || in_use(element as u32);
        self.len() == count && self.leaf_of.par_iter().enumerate().all(known)
    }

    /// Gives all elements new boxes. Linear, unless the tree has become so much worse that it is built anew.
    pub(super) fn refresh(&mut self, box_of: impl Fn(u32) -> Box3 + Sync) {
        if self.root == NONE {
            return;
        }
        let size = if self.ordered {
            refit(&mut self.nodes, &box_of).size
        } else {
            let mut nodes = blank(self.len());
            let size = refit_in_order(&self.nodes, self.root, &mut nodes, [0, NONE], &box_of).size;
            (self.nodes, self.root, self.ordered) = (nodes, 0, true);
            self.free.clear();
            self.find_leaves();
            size
        };
        if size > TOLERATED_GROWTH * self.built_size {
            let leaves = self.nodes.par_iter().filter(|node| node.is_leaf());
            let mut keys: Vec<Key> = leaves.map(|leaf| Key::of(leaf.children[0], &leaf.bounds)).collect();
            self.build_all(&mut keys, &box_of);
        }
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

/// What is told of a subtree when its boxes are made.
#[derive(Clone, Copy)]
struct Extent {
    bounds: Box3,
    /// The sum of its nodes' sizes as parts of its root's: about how many of them a query of no size visits.
    size: f64,
}

impl Extent {
    fn leaf(bounds: Box3) -> Self {
        Self { bounds, size: 1.0 }
    }

    fn of(a: &Self, b: &Self) -> Self {
        let bounds = a.bounds.union(&b.bounds);
        let whole = half_girth(&bounds);
        let part =
            |child: &Self| if whole > 0.0 { child.size * (half_girth(&child.bounds) / whole) } else { 0.0 };
        Self { bounds, size: 1.0 + (part(a) + part(b)) }
    }
}

fn blank(leaves: usize) -> Vec<Node> {
    vec![Node::leaf(NONE, Box3::EMPTY, NONE); 2 * leaves - 1]
}

/// Both, on two threads if there is enough to do.
fn both<T: Send>(leaves: usize, a: impl FnOnce() -> T + Send, b: impl FnOnce() -> T + Send) -> (T, T) {
    if leaves < GRAIN { (a(), b()) } else { rayon::join(a, b) }
}

/// The nodes of a tree in order, and its size.
fn build(keys: &mut [Key], box_of: &(impl Fn(u32) -> Box3 + Sync)) -> (Vec<Node>, f64) {
    assert!(keys.len() < 1 << 31, "nodes are numbered by 32 bits");
    let mut nodes = blank(keys.len());
    let size = build_below(keys, &mut nodes, [0, NONE], box_of).size;
    (nodes, size)
}

/// Fills `nodes`, whose first has the number and the parent given.
fn build_below(
    keys: &mut [Key],
    nodes: &mut [Node],
    [at, parent]: [u32; 2],
    box_of: &(impl Fn(u32) -> Box3 + Sync),
) -> Extent {
    if let [key] = keys {
        let bounds = box_of(key.element);
        nodes[0] = Node::leaf(key.element, bounds, parent);
        return Extent::leaf(bounds);
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
    let (a, b) = both(
        leaves,
        || build_below(low, left, [children[0], at], box_of),
        || build_below(high, right, [children[1], at], box_of),
    );
    let extent = Extent::of(&a, &b);
    this[0] = Node { bounds: extent.bounds, children, parent, leaves: leaves as u32 };
    extent
}

/// Gives the nodes of an ordered subtree new boxes.
fn refit(nodes: &mut [Node], box_of: &(impl Fn(u32) -> Box3 + Sync)) -> Extent {
    let (this, below) = nodes.split_at_mut(1);
    if this[0].is_leaf() {
        this[0].bounds = box_of(this[0].children[0]);
        return Extent::leaf(this[0].bounds);
    }
    let (left, right) = below.split_at_mut(2 * below[0].leaves as usize - 1);
    let (a, b) = both(this[0].leaves as usize, || refit(left, box_of), || refit(right, box_of));
    let extent = Extent::of(&a, &b);
    this[0].bounds = extent.bounds;
    extent
}

/// Copies the subtree at `from` of `old` in order into `nodes`, whose first has the number and the parent given,
/// with new boxes.
fn refit_in_order(
    old: &[Node],
    from: u32,
    nodes: &mut [Node],
    [at, parent]: [u32; 2],
    box_of: &(impl Fn(u32) -> Box3 + Sync),
) -> Extent {
    let Node { children: [first, second], leaves, .. } = old[from as usize];
    if leaves == 1 {
        let bounds = box_of(first);
        nodes[0] = Node::leaf(first, bounds, parent);
        return Extent::leaf(bounds);
    }
    let (this, below) = nodes.split_at_mut(1);
    let (left, right) = below.split_at_mut(2 * old[first as usize].leaves as usize - 1);
    let children = [at + 1, at + 1 + left.len() as u32];
    let (a, b) = both(
        leaves as usize,
        || refit_in_order(old, first, left, [children[0], at], box_of),
        || refit_in_order(old, second, right, [children[1], at], box_of),
    );
    let extent = Extent::of(&a, &b);
    this[0] = Node { bounds: extent.bounds, children, parent, leaves };
    extent
}

#[cfg(test)]
mod tests;
