//! Whether cells have as many hexahedra as the surface winds around them.

use rayon::prelude::*;

use super::{Finding, Findings};
use crate::distance::grid_winding_numbers;
use crate::grid::Grid3;
use crate::surface::ClosedOrientedMesh;
use crate::volumetric::VolumeMesh;
use crate::{Cancelled, Monitor};

/// Nodes of the layers that are looked at together: 128 MB of winding numbers, where those of a whole grid around a slender body may be
/// a thousand times the memory of its mesh.
const MOST_NODES: u64 = 1 << 25;

/// Layers that are looked at together at least, so that several threads have work.
const LEAST_LAYERS: u64 = 8;

/// What was found, and how many cells were compared.
pub(in crate::volumetric) fn check(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<(Findings, u64), Cancelled> {
    let mesh = &volume.mesh;
    let grid = *mesh.grid();
    let mut touched: Vec<u64> =
        volume.hosts.triangles.iter().map(|pair| mesh.cells()[pair[0] as usize]).collect();
    touched.dedup();
    let [nx, ny, nz] = grid.cells();
    let nodes_of_layer = u64::from(nx + 1) * u64::from(ny + 1);
    let together = (MOST_NODES / nodes_of_layer).max(LEAST_LAYERS).min(u64::from(nz)) as u32;
    let (mut lists, mut compared) = (Vec::new(), 0);
    for below in (0..nz).step_by(together as usize) {
        let origin = grid.node([0, 0, below]);
        let layers = together.min(nz - below);
        let part =
            Grid3::new(origin, grid.spacing(), [nx, ny, layers]).expect("some layers of a grid are one");
        let numbers = grid_winding_numbers(surface, &part, monitor)?;
        let stage = monitor.stage("check of copies", u64::from(layers));
        let found: Vec<(Findings, u64)> = (0..layers)
            .into_par_iter()
            .map(|k| {
                stage.check()?;
                let layer = Layer { volume, touched: &touched, k: below + k };
                let first = part.node_index([0, 0, k]);
                let found = layer.check(&numbers.numbers()[first..first + 2 * nodes_of_layer as usize]);
                stage.advance(1);
                Ok(found)
            })
            .collect::<Result<_, Cancelled>>()?;
        compared += found.iter().map(|(_, compared)| compared).sum::<u64>();
        lists.push(Findings::merge(found.into_iter().map(|(findings, _)| findings)));
    }
    Ok((Findings::merge(lists), compared))
}

/// A layer of cells.
struct Layer<'a> {
    volume: &'a VolumeMesh,
    /// The cells that the surface meets.
    touched: &'a [u64],
    k: u32,
}

impl Layer<'_> {
    /// Compares with the winding numbers of the nodes below the layer and above. Returns how many cells had to have exactly as many.
    fn check(&self, numbers: &[i32]) -> (Findings, u64) {
        let mesh = &self.volume.mesh;
        let [nx, ny, _] = mesh.grid().cells();
        let (row, layer) = (nx as usize + 1, numbers.len() / 2);
        let (mut findings, mut compared) = (Findings::default(), 0);
        let mut cell = mesh.grid().cell_index([0, 0, self.k]) as u64;
        let mut place = mesh.cells().partition_point(|&c| c < cell);
        let mut touch = self.touched.partition_point(|&c| c < cell);
        for j in 0..ny {
            for i in 0..nx {
                let before = place;
                while mesh.cells().get(place) == Some(&cell) {
                    place += 1;
                }
                let hexahedra = (place - before) as u32;
                let node = j as usize * row + i as usize;
                let is_touched = self.touched.get(touch) == Some(&cell);
                let winding = if is_touched {
                    touch += 1;
                    let corners =
                        [0, 1, row, row + 1].map(|c| numbers[node + c].max(numbers[layer + node + c]));
                    corners.into_iter().fold(0, i32::max)
                } else {
                    compared += 1;
                    numbers[node]
                };
                let difference = i64::from(hexahedra) - i64::from(winding);
                if difference < 0 || (difference > 0 && !is_touched) {
                    findings.add(Finding::Copies { cell: [i, j, self.k], hexahedra, winding });
                }
                cell += 1;
            }
        }
        (findings, compared)
    }
}
