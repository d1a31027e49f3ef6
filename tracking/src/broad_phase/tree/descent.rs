//! Elements near a box, and pairs of elements near each other.
//!
//! Pairs come from one simultaneous descent of two trees, or of a tree against itself, cut into tasks breadth first
//! before it goes parallel. The number of tasks does not depend on the number of threads.

use super::super::gap::apart;
use super::{NONE, Node, Tree};
use rayon::prelude::*;
use welter_meshing::spatial::Box3;

/// Into how many tasks a descent is cut at least, where it has as many: enough to keep dozens of threads busy.
const TASKS: usize = 512;

impl Tree {
    /// The elements whose boxes are within a distance of a box and that are to be kept, ascending.
    pub(in crate::broad_phase) fn near(
        &self,
        bounds: &Box3,
        distance: f64,
        keep: impl Fn(u32) -> bool,
    ) -> Vec<u32> {
        let mut found = Vec::new();
        self.all_near(bounds, distance, |element, _| {
            if keep(element) {
                found.push(element);
            }
            true
        });
        found.sort_unstable();
        found
    }

    /// Whether a condition holds for all elements whose boxes are within a distance of a box. It is asked in no
    /// particular order, and not after it fails.
    pub(in crate::broad_phase) fn all_near(
        &self,
        bounds: &Box3,
        distance: f64,
        mut holds: impl FnMut(u32, &Box3) -> bool,
    ) -> bool {
        // Deep enough for any tree of fewer than 2^32 leaves that is balanced as this one; others grow on the heap.
        let mut stack: Vec<u32> = Vec::with_capacity(64);
        stack.extend(Some(self.root).filter(|&root| root != NONE));
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            if apart(&node.bounds, bounds, distance) {
                continue;
            }
            if !node.is_leaf() {
                stack.extend(node.children);
            } else if !holds(node.children[0], &node.bounds) {
                return false;
            }
        }
        true
    }
}

/// All pairs of elements of one tree whose boxes are within a distance and that are to be kept, the smaller first, sorted.
pub(in crate::broad_phase) fn self_pairs(
    tree: &Tree,
    distance: f64,
    keep: impl Fn(u32, u32) -> bool + Sync,
) -> Vec<[u32; 2]> {
    Descent { trees: [tree, tree], same: true, distance }
        .pairs(|a, b| keep(a, b).then(|| [a.min(b), a.max(b)]))
}

/// All pairs of an element of one tree and one of another whose boxes are within a distance and that are to be kept, sorted.
pub(in crate::broad_phase) fn pairs_between(
    a: &Tree,
    b: &Tree,
    distance: f64,
    keep: impl Fn(u32, u32) -> bool + Sync,
) -> Vec<[u32; 2]> {
    Descent { trees: [a, b], same: false, distance }.pairs(|a, b| keep(a, b).then_some([a, b]))
}

struct Descent<'a> {
    trees: [&'a Tree; 2],
    /// Whether a tree is descended against itself: then a pair of the same node stands for all pairs below it.
    same: bool,
    distance: f64,
}

impl Descent<'_> {
    fn nodes(&self, [i, j]: [u32; 2]) -> [&Node; 2] {
        [&self.trees[0].nodes[i as usize], &self.trees[1].nodes[j as usize]]
    }

    fn stands_for_itself(&self, [i, j]: [u32; 2]) -> bool {
        self.same && i == j
    }

    /// Puts the parts of a pair that may have something to tell on a stack. Of two inner nodes both are opened, which takes
    /// half the steps of opening the larger one, and keeps their sizes alike as well.
    #[inline]
    fn open(&self, at: [u32; 2], parts: &mut Vec<[u32; 2]>) {
        let [a, b] = self.nodes(at);
        if self.stands_for_itself(at) {
            let [first, second] = a.children;
            for child in [first, second] {
                if !self.trees[0].nodes[child as usize].is_leaf() {
                    parts.push([child, child]);
                }
            }
            self.push([first, second], parts);
            return;
        }
        match (a.is_leaf(), b.is_leaf()) {
            (true, _) => b.children.iter().for_each(|&child| self.push([at[0], child], parts)),
            (false, true) => a.children.iter().for_each(|&child| self.push([child, at[1]], parts)),
            (false, false) => {
                for first in a.children {
                    b.children.iter().for_each(|&second| self.push([first, second], parts));
                }
            }
        }
    }

    #[inline]
    fn push(&self, at: [u32; 2], parts: &mut Vec<[u32; 2]>) {
        let [a, b] = self.nodes(at);
        if !apart(&a.bounds, &b.bounds, self.distance) {
            parts.push(at);
        }
    }

    fn pairs(&self, pair: impl Fn(u32, u32) -> Option<[u32; 2]> + Sync) -> Vec<[u32; 2]> {
        let found: Vec<Vec<[u32; 2]>> =
            self.tasks().into_par_iter().with_max_len(1).map(|task| self.run(task, &pair)).collect();
        let mut pairs = found.concat();
        pairs.par_sort_unstable();
        pairs
    }

    /// Pairs of nodes whose boxes are near, or of a node with itself; not of a leaf with itself.
    fn tasks(&self) -> Vec<[u32; 2]> {
        let roots = self.trees.map(|tree| tree.root);
        let mut tasks = Vec::new();
        if roots.contains(&NONE) {
            return tasks;
        }
        if self.stands_for_itself(roots) {
            let alone = self.trees[0].nodes[roots[0] as usize].is_leaf();
            tasks.extend((!alone).then_some(roots));
        } else {
            self.push(roots, &mut tasks);
        }
        let mut opened = true;
        while opened && tasks.len() < TASKS {
            opened = false;
            let mut next = Vec::with_capacity(4 * tasks.len());
            for task in tasks {
                if self.nodes(task).iter().all(|node| node.is_leaf()) {
                    next.push(task);
                } else {
                    self.open(task, &mut next);
                    opened = true;
                }
            }
            tasks = next;
        }
        tasks
    }

    fn run(&self, task: [u32; 2], pair: &(impl Fn(u32, u32) -> Option<[u32; 2]> + Sync)) -> Vec<[u32; 2]> {
        let (mut found, mut stack) = (Vec::new(), vec![task]);
        while let Some(at) = stack.pop() {
            let [a, b] = self.nodes(at);
            if a.is_leaf() && b.is_leaf() {
                found.extend(pair(a.children[0], b.children[0]));
            } else {
                self.open(at, &mut stack);
            }
        }
        found
    }
}
