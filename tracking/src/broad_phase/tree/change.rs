//! One element comes, goes or moves.
//!
//! A new leaf goes down to where boxes grow least, to the smaller side where that ties. Where a side of a node then holds
//! more than three quarters of its leaves, the highest such subtree is built anew, as in a scapegoat tree: it takes
//! about a third as many changes as the subtree has leaves to unbalance it again, so a change costs O(log^2 n) amortised.

use super::{GRAIN, Key, NONE, Node, Tree, build, half_girth};
use rayon::prelude::*;
use welter_meshing::spatial::Box3;

impl Tree {
    /// Gives an element a box; takes it in if it is not in the tree.
    pub(in crate::broad_phase) fn set(&mut self, element: u32, bounds: Box3) {
        let leaf = self.leaf_of.get(element as usize).copied().unwrap_or(NONE);
        if leaf == NONE {
            self.insert(element, bounds);
            return;
        }
        let parent = self.nodes[leaf as usize].parent;
        if parent != NONE && !self.nodes[parent as usize].bounds.meets(&bounds) {
            // It has left its place.
            self.remove(element);
            self.insert(element, bounds);
            return;
        }
        self.nodes[leaf as usize].bounds = bounds;
        self.settle(parent);
    }

    /// Gives the elements other names: `old[new]`, for all that are in the tree. Memory is passed in its order: to follow the
    /// branches would wait for most nodes of a large tree.
    pub(in crate::broad_phase) fn rename(&mut self, old: impl ExactSizeIterator<Item = u32> + Clone) {
        let mut new = vec![NONE; self.leaf_of.len()];
        for (name, before) in (0..).zip(old.clone()) {
            if let Some(new) = new.get_mut(before as usize) {
                *new = name;
            }
        }
        let leaf_of = |before: u32| self.leaf_of.get(before as usize).copied().unwrap_or(NONE);
        self.leaf_of = old.map(leaf_of).collect();
        self.nodes.par_iter_mut().with_min_len(GRAIN).for_each(|node| {
            if node.is_leaf() && node.children[0] != NONE {
                node.children[0] = new[node.children[0] as usize];
            }
        });
    }

    /// Takes an element out, if it is in the tree.
    pub(in crate::broad_phase) fn remove(&mut self, element: u32) {
        let leaf = self.leaf_of.get(element as usize).copied().unwrap_or(NONE);
        if leaf == NONE {
            return;
        }
        self.ordered = false;
        self.leaf_of[element as usize] = NONE;
        self.free.push(leaf);
        self.nodes[leaf as usize].children[0] = NONE;
        let parent = self.nodes[leaf as usize].parent;
        if parent == NONE {
            self.root = NONE;
            return;
        }
        let Node { children: [first, second], parent: above, .. } = self.nodes[parent as usize];
        let sibling = if first == leaf { second } else { first };
        self.free.push(parent);
        self.nodes[sibling as usize].parent = above;
        self.hang(above, parent, sibling);
        self.settle(above);
    }

    fn insert(&mut self, element: u32, bounds: Box3) {
        if self.leaf_of.len() <= element as usize {
            self.leaf_of.resize(element as usize + 1, NONE);
        }
        self.ordered = false;
        let leaf = self.place(Node::leaf(element, bounds, NONE));
        self.leaf_of[element as usize] = leaf;
        if self.root == NONE {
            self.root = leaf;
            return;
        }
        let mut beside = self.root;
        while !self.nodes[beside as usize].is_leaf() {
            let cost = |child: u32| {
                let node = &self.nodes[child as usize];
                (half_girth(&node.bounds.union(&bounds)) - half_girth(&node.bounds), node.leaves)
            };
            let [first, second] = self.nodes[beside as usize].children;
            let ((a, fewer), (b, more)) = (cost(first), cost(second));
            beside = if a.total_cmp(&b).then(fewer.cmp(&more)).is_le() { first } else { second };
        }
        let above = self.nodes[beside as usize].parent;
        // Its box is made below.
        let joint = self.place(Node { bounds, children: [beside, leaf], parent: above, leaves: 2 });
        self.nodes[beside as usize].parent = joint;
        self.nodes[leaf as usize].parent = joint;
        self.hang(above, beside, joint);
        self.settle(joint);
    }

    /// Puts a node into a free place.
    fn place(&mut self, node: Node) -> u32 {
        if let Some(place) = self.free.pop() {
            self.nodes[place as usize] = node;
            return place;
        }
        assert!(self.nodes.len() < NONE as usize, "nodes are numbered by 32 bits");
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// Makes `new` the child of `parent` that `old` was.
    fn hang(&mut self, parent: u32, old: u32, new: u32) {
        if parent == NONE {
            self.root = new;
        } else {
            for child in &mut self.nodes[parent as usize].children {
                if *child == old {
                    *child = new;
                }
            }
        }
    }

    /// Corrects a node and those above it, as far as something changes, and balances them.
    fn settle(&mut self, mut at: u32) {
        let mut unbalanced = NONE;
        while at != NONE {
            let Node { children: [first, second], bounds, parent, leaves } = self.nodes[at as usize];
            let (a, b) = (self.nodes[first as usize], self.nodes[second as usize]);
            let (new_bounds, new_leaves) = (a.bounds.union(&b.bounds), a.leaves + b.leaves);
            // A new joint has its box still to be made, but its parent then differs in leaves.
            if new_leaves == leaves && new_bounds == bounds && leaves > 2 {
                break;
            }
            self.nodes[at as usize].bounds = new_bounds;
            self.nodes[at as usize].leaves = new_leaves;
            if 4 * u64::from(a.leaves.max(b.leaves)) > 3 * u64::from(new_leaves) {
                unbalanced = at;
            }
            at = parent;
        }
        if unbalanced != NONE {
            self.build_again(unbalanced);
        }
    }

    /// Builds a subtree of two leaves or more anew, in its own places.
    fn build_again(&mut self, top: u32) {
        let parent = self.nodes[top as usize].parent;
        let (mut places, mut elements) = (vec![top], Vec::new());
        let mut next = 0;
        while let Some(&place) = places.get(next) {
            let Node { children, leaves, .. } = self.nodes[place as usize];
            if leaves == 1 {
                elements.push((children[0], place));
            } else {
                places.extend(children);
            }
            next += 1;
        }
        let mut keys: Vec<Key> =
            elements.iter().map(|&(e, place)| Key::of(e, &self.nodes[place as usize].bounds)).collect();
        let (nodes, leaf_of) = (&self.nodes, &self.leaf_of);
        let (built, _) = build(&mut keys, &|e: u32| nodes[leaf_of[e as usize] as usize].bounds);
        for (mut node, &place) in built.into_iter().zip(&places) {
            node.parent = if place == top { parent } else { places[node.parent as usize] };
            if node.is_leaf() {
                self.leaf_of[node.children[0] as usize] = place;
            } else {
                node.children = node.children.map(|child| places[child as usize]);
            }
            self.nodes[place as usize] = node;
        }
    }
}
