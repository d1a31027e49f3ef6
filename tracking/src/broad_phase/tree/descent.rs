//! Elements near a box, and pairs of elements near each other.
//!
//! Pairs come from one simultaneous descent of two trees, or of a tree against itself, cut into tasks breadth first
//! before it goes parallel. The number of tasks does not depend on the number of threads.

use super::super::gap::apart;
use super::{NONE, Tree, half_girth};
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

/// What comes of a pair of nodes.
enum Step {
    Nothing,
    Leaves,
    Two([[u32; 2]; 2]),
    Three([[u32; 2]; 3]),
}

impl Descent<'_> {
    #[inline]
    fn step(&self, [i, j]: [u32; 2]) -> Step {
        let [a, b] = [&self.trees[0].nodes[i as usize], &self.trees[1].nodes[j as usize]];
        if self.same && i == j {
            let [first, second] = a.children;
            return match a.is_leaf() {
                true => Step::Nothing,
                false => Step::Three([[first, first], [second, second], [first, second]]),
            };
        }
        if apart(&a.bounds, &b.bounds, self.distance) {
            return Step::Nothing;
        }
        // The larger is opened, so that both become small together.
        match (a.is_leaf(), b.is_leaf()) {
            (true, true) => Step::Leaves,
            (false, leaf) if leaf || half_girth(&a.bounds) >= half_girth(&b.bounds) => {
                Step::Two(a.children.map(|child| [child, j]))
            }
            _ => Step::Two(b.children.map(|child| [i, child])),
        }
    }

    fn pairs(&self, pair: impl Fn(u32, u32) -> Option<[u32; 2]> + Sync) -> Vec<[u32; 2]> {
        let roots = self.trees.map(|tree| tree.root);
        if roots.contains(&NONE) {
            return Vec::new();
        }
        let found: Vec<Vec<[u32; 2]>> =
            self.tasks(roots).into_par_iter().with_max_len(1).map(|task| self.run(task, &pair)).collect();
        let mut pairs = found.concat();
        pairs.par_sort_unstable();
        pairs
    }

    fn tasks(&self, roots: [u32; 2]) -> Vec<[u32; 2]> {
        let mut tasks = vec![roots];
        let mut open = true;
        while open && tasks.len() < TASKS {
            open = false;
            let mut next = Vec::with_capacity(3 * tasks.len());
            for task in tasks {
                match self.step(task) {
                    Step::Nothing => continue,
                    Step::Leaves => next.push(task),
                    Step::Two(tasks) => next.extend(tasks),
                    Step::Three(tasks) => next.extend(tasks),
                }
                open |= next.last() != Some(&task);
            }
            tasks = next;
        }
        tasks
    }

    fn run(&self, task: [u32; 2], pair: &(impl Fn(u32, u32) -> Option<[u32; 2]> + Sync)) -> Vec<[u32; 2]> {
        let (mut found, mut stack) = (Vec::new(), vec![task]);
        while let Some(at) = stack.pop() {
            match self.step(at) {
                Step::Nothing => {}
                Step::Leaves => {
                    let element = |k: usize| self.trees[k].nodes[at[k] as usize].children[0];
                    found.extend(pair(element(0), element(1)));
                }
                Step::Two(parts) => stack.extend(parts),
                Step::Three(parts) => stack.extend(parts),
            }
        }
        found
    }
}
