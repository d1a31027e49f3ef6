//! Simultaneous descent of a hierarchy against itself or another: the candidates of pair queries.
//!
//! # What it promises
//! * Every pair of leaves whose mapped boxes meet is visited exactly once.
//! * The visits' output is collected in an order that depends on the trees alone, not on the threads.
//!
//! # Method
//! A task is a pair of nodes whose boxes meet, or a node against itself. The first tasks are split breadth first until
//! there are [`TASKS`]; each is then finished depth first by one thread into its own vector.

use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;

use super::tree::{BoxTree, overlap};
use crate::{Cancelled, Monitor, Stage};

/// Tasks to split the work into: enough to keep the threads of large machines even, few enough that the breadth-first
/// part stays negligible.
const TASKS: usize = 2048;

/// Steps of a task between two looks at the monitor.
const STEPS_A_LOOK: u32 = 1 << 14;

/// Two nodes to compare, of the same tree or of two; equal nodes of the same tree stand for all pairs below.
type Task = (u32, u32);

/// Calls `visit(i, j, met, out)` once for each two different boxes whose mapped boxes meet, in either order, and joins `out`.
pub(crate) fn self_pairs<T: Send>(
    tree: &BoxTree,
    monitor: &Monitor<'_>,
    stage: &'static str,
    visit: impl Fn(u32, u32, Met, &mut Vec<T>) + Sync,
) -> Result<Vec<T>, Cancelled> {
    Descent { left: tree, right: tree, same: true }.run(monitor, stage, visit)
}

/// Calls `visit(i, j, met, out)` once for each box `i` of `left` and `j` of `right` whose mapped boxes meet, and joins `out`.
/// Both trees are in the same frame.
pub(crate) fn pairs_between<T: Send>(
    left: &BoxTree,
    right: &BoxTree,
    monitor: &Monitor<'_>,
    stage: &'static str,
    visit: impl Fn(u32, u32, Met, &mut Vec<T>) + Sync,
) -> Result<Vec<T>, Cancelled> {
    debug_assert_eq!(left.frame, right.frame);
    Descent { left, right, same: false }.run(monitor, stage, visit)
}

/// What mapped boxes that meet say of the exact boxes. The map keeps order, so coordinates that are mapped to different
/// numbers are in the same strict order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Met {
    /// The exact boxes meet.
    Surely,
    /// Some coordinates are mapped to the same number: the exact boxes may be apart.
    Perhaps,
}

impl Met {
    #[inline]
    fn of(a: &Bvh2Node, b: &Bvh2Node) -> Self {
        let (a, b) = (a.aabb(), b.aabb());
        if (a.min.cmplt(b.max) & b.min.cmplt(a.max)).all() { Self::Surely } else { Self::Perhaps }
    }
}

/// Sorts pairs of numbers in parallel.
pub(crate) fn sort_pairs<T: Copy + Send>(pairs: &mut [[T; 2]], number: impl Fn(T) -> u32 + Sync) {
    pairs.par_sort_unstable_by_key(|&[i, j]| u64::from(number(i)) << 32 | u64::from(number(j)));
}

struct Descent<'t> {
    left: &'t BoxTree,
    right: &'t BoxTree,
    /// Whether `left` and `right` are one tree: then a node may meet itself.
    same: bool,
}

impl Descent<'_> {
    fn run<T: Send>(
        &self,
        monitor: &Monitor<'_>,
        stage: &'static str,
        visit: impl Fn(u32, u32, Met, &mut Vec<T>) + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        let tasks = self.split();
        let stage = monitor.stage(stage, tasks.len() as u64);
        let found: Vec<Vec<T>> =
            tasks.into_par_iter().map(|task| self.finish(task, &stage, &visit)).collect::<Result<_, _>>()?;
        let mut all = Vec::with_capacity(found.iter().map(Vec::len).sum());
        found.into_iter().for_each(|part| all.extend(part));
        Ok(all)
    }

    fn roots(&self) -> Option<Task> {
        let (left, right) = (self.left.bvh.nodes.first()?, self.right.bvh.nodes.first()?);
        overlap(left.aabb(), right.aabb()).then_some((0, 0))
    }

    /// Splits the pair of roots breadth first.
    fn split(&self) -> Vec<Task> {
        let mut tasks: Vec<Task> = self.roots().into_iter().collect();
        loop {
            let mut next = Vec::with_capacity(4 * tasks.len());
            let mut split_any = false;
            for &task in &tasks {
                if self.is_final(task) {
                    next.push(task);
                } else {
                    split_any = true;
                    self.expand(task, &mut next);
                }
            }
            tasks = next;
            if !split_any || tasks.len() >= TASKS {
                return tasks;
            }
        }
    }

    fn is_final(&self, (i, j): Task) -> bool {
        self.left.bvh.nodes[i as usize].is_leaf() && self.right.bvh.nodes[j as usize].is_leaf()
    }

    /// Replaces a task of which one node is not a leaf by its parts: of two inner nodes both are split, which keeps
    /// their sizes alike and takes half the steps of splitting the larger one.
    #[inline]
    fn expand(&self, (i, j): Task, out: &mut Vec<Task>) {
        let (a, b) = (&self.left.bvh.nodes[i as usize], &self.right.bvh.nodes[j as usize]);
        if self.same && i == j {
            let [l, r] = children(self.left, a);
            out.extend([l, r].into_iter().filter(|(_, child)| !child.is_leaf()).map(|(c, _)| (c, c)));
            if overlap(l.1.aabb(), r.1.aabb()) {
                out.push((l.0, r.0));
            }
        } else if b.is_leaf() {
            let meeting =
                children(self.left, a).into_iter().filter(|(_, child)| overlap(child.aabb(), b.aabb()));
            out.extend(meeting.map(|(c, _)| (c, j)));
        } else if a.is_leaf() {
            let meeting =
                children(self.right, b).into_iter().filter(|(_, child)| overlap(a.aabb(), child.aabb()));
            out.extend(meeting.map(|(c, _)| (i, c)));
        } else {
            let [l, r] = children(self.right, b);
            for (c, child) in children(self.left, a) {
                if overlap(child.aabb(), l.1.aabb()) {
                    out.push((c, l.0));
                }
                if overlap(child.aabb(), r.1.aabb()) {
                    out.push((c, r.0));
                }
            }
        }
    }

    /// Finishes one task depth first.
    fn finish<T>(
        &self,
        task: Task,
        stage: &Stage<'_>,
        visit: &impl Fn(u32, u32, Met, &mut Vec<T>),
    ) -> Result<Vec<T>, Cancelled> {
        let mut found = Vec::new();
        let mut stack = vec![task];
        let mut steps = 0u32;
        stage.check()?;
        while let Some((i, j)) = stack.pop() {
            steps = steps.wrapping_add(1);
            if steps.is_multiple_of(STEPS_A_LOOK) {
                stage.check()?;
            }
            let (a, b) = (&self.left.bvh.nodes[i as usize], &self.right.bvh.nodes[j as usize]);
            if a.is_leaf() && b.is_leaf() {
                if !self.same || i != j {
                    visit(self.left.box_index(a), self.right.box_index(b), Met::of(a, b), &mut found);
                }
            } else {
                self.expand((i, j), &mut stack);
            }
        }
        stage.advance(1);
        Ok(found)
    }
}

/// The children of an inner node, with their indices.
#[inline]
fn children<'t>(tree: &'t BoxTree, node: &Bvh2Node) -> [(u32, &'t Bvh2Node); 2] {
    let first = node.first_index;
    let pair = &tree.bvh.nodes[first as usize..first as usize + 2];
    [(first, &pair[0]), (first + 1, &pair[1])]
}
