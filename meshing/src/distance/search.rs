//! [`Search`]: the closest triangles of the nodes of a grid, slab by slab, block by block, eight by eight.

use super::flat::{LANES, tolerance};
use super::nearest::{FARTHEST, Found, Nearest, Prepared};
use crate::grid::Grid3;
use crate::spatial::{Box3, Bvh};
use crate::surface::TriId;
use crate::{Cancelled, DVec3, Stage};

/// Layers of nodes that one thread takes at a time: of 4 a grid of 128^3 has tasks enough for 16 threads, and a block of them
/// is not much flatter than a cube.
pub(super) const LAYERS: usize = 4;

/// Nodes along x and y of a block, which begins a search afresh and is passed over as a whole where no triangle is near.
const BLOCK: usize = 8;

/// Spacing over tolerance from which single precision tells neighbouring nodes apart well enough to be of use.
const RESOLVED: f64 = 16.0;

/// A search for the closest triangles of the nodes of a grid.
pub(super) struct Search<'a> {
    grid: &'a Grid3,
    band: f64,
    bvh: &'a Bvh<'a>,
    /// For eight nodes at a time, with the largest coordinate of a node in the frame; else they are taken one by one.
    prepared: Option<(Prepared<'a>, f64)>,
}

impl<'a> Search<'a> {
    pub(super) fn new(bvh: &'a Bvh<'a>, grid: &'a Grid3, band: f64) -> Self {
        let frame = &bvh.tree().frame;
        let ends = [DVec3::from_array(grid.origin()), DVec3::from_array(grid.max())];
        let reach = ends.map(|p| frame.place(p).abs().max_element()).into_iter().fold(1.0, f64::max);
        let resolved = frame.scaled(grid.spacing()) >= RESOLVED * tolerance(reach) && reach <= FARTHEST;
        Self { grid, band, bvh, prepared: resolved.then(|| (Prepared::new(bvh), reach)) }
    }

    /// Enters what is found for the layers of nodes from `first` on; `closest` is empty or as long as `values`.
    pub(super) fn slab(
        &self,
        first: usize,
        values: &mut [f64],
        closest: &mut [Option<TriId>],
        stage: &Stage<'_>,
    ) -> Result<(), Cancelled> {
        let [nx, ny, _] = self.grid.nodes().map(|n| n as usize);
        let layers = values.len() / (nx * ny);
        let mut enter = |[i, j, k]: [usize; 3], found: Option<Found>| {
            let Some(found) = found.filter(|found| found.distance <= self.band) else { return };
            let place = (k - first) * nx * ny + j * nx + i;
            values[place] = found.distance;
            if let Some(closest) = closest.get_mut(place) {
                *closest = Some(found.triangle);
            }
        };
        let Some((prepared, reach)) = &self.prepared else {
            return self.one_by_one(first..first + layers, &mut enter, stage);
        };
        let mut nearest = Nearest::new(prepared, *reach, self.band);
        for j in (0..ny).step_by(BLOCK) {
            stage.check()?;
            for i in (0..nx).step_by(BLOCK) {
                let low = [i, j, first];
                let high = [(i + BLOCK).min(nx), (j + BLOCK).min(ny), first + layers];
                if nearest.begin(&Box3 { min: self.at(low), max: self.at(high.map(|end| end - 1)) }) {
                    self.block(low, high, &mut nearest, &mut enter);
                }
            }
        }
        Ok(())
    }

    /// Cubes of eight nodes, each next to the one before.
    fn block(
        &self,
        low: [usize; 3],
        high: [usize; 3],
        nearest: &mut Nearest<'_>,
        enter: &mut impl FnMut([usize; 3], Option<Found>),
    ) {
        let halves = [0, 1, 2].map(|axis: usize| (high[axis] - low[axis]).div_ceil(2));
        let there_and_back = |i: usize, count: usize, back: usize| {
            if back.is_multiple_of(2) { i } else { count - 1 - i }
        };
        for c in 0..halves[2] {
            for b in 0..halves[1] {
                let y = there_and_back(b, halves[1], c);
                for a in 0..halves[0] {
                    let x = there_and_back(a, halves[0], c * halves[1] + b);
                    let corner = [low[0] + 2 * x, low[1] + 2 * y, low[2] + 2 * c];
                    // Past the last node of an odd number the last one stands in.
                    let nodes: [[usize; 3]; LANES] = std::array::from_fn(|lane| {
                        [0, 1, 2].map(|axis| (corner[axis] + (lane >> axis & 1)).min(high[axis] - 1))
                    });
                    let found = nearest.of(&nodes.map(|node| self.at(node)));
                    nodes.into_iter().zip(found).for_each(|(node, found)| enter(node, found));
                }
            }
        }
    }

    fn one_by_one(
        &self,
        layers: std::ops::Range<usize>,
        enter: &mut impl FnMut([usize; 3], Option<Found>),
        stage: &Stage<'_>,
    ) -> Result<(), Cancelled> {
        let [nx, ny, _] = self.grid.nodes().map(|n| n as usize);
        for k in layers {
            for j in 0..ny {
                stage.check()?;
                for i in 0..nx {
                    let closest = self.bvh.closest_point(self.at([i, j, k]));
                    let found = closest.map(|c| Found { distance: c.distance, triangle: c.triangle });
                    enter([i, j, k], found);
                }
            }
        }
        Ok(())
    }

    fn at(&self, node: [usize; 3]) -> DVec3 {
        self.grid.position(node.map(|i| i as u32))
    }
}
