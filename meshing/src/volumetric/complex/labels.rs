//! Connected components by common vertices: [`ComponentLabels`].

use rayon::prelude::*;

use super::super::shared_union_find::SharedUnionFind;
use crate::{Cancelled, Monitor};

/// No component: of a vertex that nothing uses.
pub(in crate::volumetric) const NONE: u32 = u32::MAX;

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
/// The elements are united in parallel, since the roots do not depend on the order, and numbered one after the other.
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
    let mut of_vertex = vec![NONE; vertices];
    let mut of = Vec::with_capacity(elements.len());
    let mut count = 0;
    for block in elements.chunks(BLOCK) {
        monitor.check()?;
        for element in block {
            let label = &mut of_vertex[sets.root(element[0]) as usize];
            if *label == NONE {
                *label = count;
                count += 1;
            }
            of.push(*label);
        }
    }
    // A root is the smallest of its set, so it has its label before the others ask for it.
    for vertex in 0..vertices {
        of_vertex[vertex] = of_vertex[sets.root(vertex as u32) as usize];
    }
    Ok((ComponentLabels { of, count: count as usize }, of_vertex))
}
