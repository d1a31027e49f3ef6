//! Connected components by common vertices: [`ComponentLabels`].

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::super::shared_union_find::SharedUnionFind;
use crate::{Cancelled, Monitor};

/// No component: of a vertex that nothing uses.
pub(in crate::volumetric) const NONE: u32 = u32::MAX;

/// How many sets are looked through before a search tree is asked; any number is right.
const FEW: usize = 8;

/// Elements between two looks at the monitor.
const BLOCK: usize = 1 << 16;

/// The component of each hexahedron or tetrahedron. Components are numbered in the order of their first members.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComponentLabels {
    of: Vec<u32>,
    count: usize,
}

impl ComponentLabels {
    /// The component of each hexahedron or tetrahedron.
    #[must_use]
    pub fn of(&self) -> &[u32] {
        &self.of
    }

    /// How many components there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }
}

/// Labels elements of `N` vertices each, and the vertices too: `NONE` where no element has one.
///
/// The elements are united in parallel, since the roots do not depend on the order.
pub(in crate::volumetric) fn label<const N: usize>(
    elements: &[[u32; N]],
    vertices: usize,
    monitor: &Monitor<'_>,
) -> Result<(ComponentLabels, Vec<u32>), Cancelled> {
    let stage = monitor.stage("components", elements.len() as u64);
    let sets = SharedUnionFind::new(vertices);
    elements.par_chunks(BLOCK).try_for_each(|block| {
        stage.check()?;
        for element in block {
            element[1..].iter().for_each(|&v| sets.unite(element[0], v));
        }
        stage.advance(block.len() as u64);
        Ok(())
    })?;
    // The sets of the elements of each block, in their order: few, as a rule.
    let mut of = vec![0; elements.len()];
    let of_blocks: Vec<Vec<u32>> = of
        .par_chunks_mut(BLOCK)
        .zip(elements.par_chunks(BLOCK))
        .map(|(of, block)| {
            let (mut list, mut known) = (Vec::<u32>::new(), BTreeSet::new());
            for (of, element) in of.iter_mut().zip(block) {
                *of = sets.root(element[0]);
                // The last few are looked at first: neighbours are of few sets.
                if !list[list.len().saturating_sub(FEW)..].contains(of) && known.insert(*of) {
                    list.push(*of);
                }
            }
            list
        })
        .collect();
    monitor.check()?;
    let of_vertex: Vec<AtomicU32> =
        (0..vertices).into_par_iter().with_min_len(BLOCK).map(|_| AtomicU32::new(NONE)).collect();
    let label_of = |vertex: u32| of_vertex[vertex as usize].load(Relaxed);
    let mut count = 0;
    for root in of_blocks.into_iter().flatten() {
        if label_of(root) == NONE {
            of_vertex[root as usize].store(count, Relaxed);
            count += 1;
        }
    }
    of.par_iter_mut().with_min_len(BLOCK).for_each(|of| *of = label_of(*of));
    monitor.check()?;
    // Labels of roots stay as they are, so that it does not matter who is first.
    of_vertex.par_iter().enumerate().with_min_len(BLOCK).for_each(|(vertex, label)| {
        label.store(label_of(sets.root(vertex as u32)), Relaxed);
    });
    let of_vertex = of_vertex.into_iter().map(AtomicU32::into_inner).collect();
    Ok((ComponentLabels { of, count: count as usize }, of_vertex))
}
