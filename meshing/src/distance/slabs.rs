//! [`Slabs`]: which triangles may meet which layers of nodes.

use super::winding::nodes_within;
use crate::grid::Grid3;
use crate::spatial::Box3;
use crate::surface::{TriId, TriMesh};

/// For each slab, some layers of nodes in z, the triangles with nodes of it within their extent along z, ascending.
pub(super) struct Slabs {
    starts: Vec<usize>,
    triangles: Vec<TriId>,
}

impl Slabs {
    pub(super) fn of(mesh: &TriMesh, grid: &Grid3, layers: usize) -> Self {
        let slabs = (grid.nodes()[2] as usize).div_ceil(layers);
        let ranges: Vec<[u32; 2]> = (0..mesh.triangles().len())
            .map(|t| {
                let around = Box3::of(mesh.corners(TriId::from_index(t)));
                match nodes_within(grid, 2, around.min.z, around.max.z) {
                    Some([first, end]) => [first / layers as u32, (end - 1) / layers as u32 + 1],
                    None => [0, 0],
                }
            })
            .collect();
        let mut starts = vec![0; slabs + 1];
        for &[first, end] in &ranges {
            (first..end).for_each(|slab| starts[slab as usize + 1] += 1);
        }
        (0..slabs).for_each(|slab| starts[slab + 1] += starts[slab]);
        let mut triangles = vec![TriId(0); starts[slabs]];
        let mut free = starts.clone();
        for (t, &[first, end]) in ranges.iter().enumerate() {
            for slab in first..end {
                triangles[free[slab as usize]] = TriId::from_index(t);
                free[slab as usize] += 1;
            }
        }
        Self { starts, triangles }
    }

    pub(super) fn triangles(&self, slab: usize) -> &[TriId] {
        &self.triangles[self.starts[slab]..self.starts[slab + 1]]
    }
}
