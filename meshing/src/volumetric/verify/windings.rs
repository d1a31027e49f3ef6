//! Whether cells have as many hexahedra as the surface winds around them.

use rayon::prelude::*;

use super::{Finding, Findings};
use crate::distance::grid_winding_numbers;
use crate::surface::ClosedOrientedMesh;
use crate::volumetric::VolumeMesh;
use crate::{Cancelled, Monitor};

/// What was found, and how many cells were compared.
pub(super) fn check(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<(Findings, u64), Cancelled> {
    let mesh = &volume.mesh;
    let grid = *mesh.grid();
    let numbers = grid_winding_numbers(surface, &grid, monitor)?;
    let mut touched: Vec<u64> =
        volume.hosts.triangles.iter().map(|pair| mesh.cells()[pair[0] as usize]).collect();
    touched.dedup();
    let [nx, ny, nz] = grid.cells();
    let stage = monitor.stage("check of copies", u64::from(nz));
    let layers: Vec<(Findings, u64)> = (0..nz)
        .into_par_iter()
        .map(|k| {
            stage.check()?;
            let (mut findings, mut compared) = (Findings::default(), 0);
            let first = grid.cell_index([0, 0, k]) as u64;
            let mut place = mesh.cells().partition_point(|&cell| cell < first);
            let mut touch = touched.partition_point(|&cell| cell < first);
            for j in 0..ny {
                let row = grid.node_index([0, j, k]);
                let first = grid.cell_index([0, j, k]) as u64;
                for i in 0..nx {
                    let cell = first + u64::from(i);
                    let before = place;
                    while mesh.cells().get(place) == Some(&cell) {
                        place += 1;
                    }
                    if touched.get(touch) == Some(&cell) {
                        touch += 1;
                        continue;
                    }
                    compared += 1;
                    let (hexahedra, winding) = ((place - before) as u32, numbers.numbers()[row + i as usize]);
                    if i64::from(hexahedra) != i64::from(winding) {
                        findings.add(Finding::Copies { cell: [i, j, k], hexahedra, winding });
                    }
                }
            }
            stage.advance(1);
            Ok((findings, compared))
        })
        .collect::<Result<_, Cancelled>>()?;
    let compared = layers.iter().map(|(_, compared)| compared).sum();
    Ok((Findings::merge(layers.into_iter().map(|(findings, _)| findings)), compared))
}
