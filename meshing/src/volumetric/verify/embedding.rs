//! Whether whoever walks along the surface stays in the mesh.

use rayon::prelude::*;
use welter_predicates::moved_grid::moved_box_meets_segment;

use super::{Finding, Findings};
use crate::surface::{ClosedOrientedMesh, TriId};
use crate::volumetric::VolumeMesh;
use crate::volumetric::pairing::Pairing;
use crate::volumetric::precursors::cell_box;
use crate::{Cancelled, Monitor};

/// Triangles that a thread takes at a time.
const CHUNK: usize = 1024;

pub(super) fn check(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<Findings, Cancelled> {
    let count = surface.triangles().len();
    let stage = monitor.stage("check of the embedding", count as u64);
    let walk = Walk::new(surface, volume);
    let lists: Vec<Findings> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            stage.check()?;
            let triangles = chunk * CHUNK..count.min((chunk + 1) * CHUNK);
            let mut findings = Findings::default();
            for t in triangles.clone() {
                walk.sides(t as u32, &mut findings);
                walk.edges(t as u32, &mut findings);
            }
            stage.advance(triangles.len() as u64);
            Ok(findings)
        })
        .collect::<Result<_, Cancelled>>()?;
    let mut findings = Findings::merge(lists);
    if volume.hosts.disagreements > 0 {
        findings.add(Finding::Vertices { count: volume.hosts.disagreements });
    }
    Ok(findings)
}

/// The hexahedra of each triangle.
struct Walk<'a> {
    surface: &'a ClosedOrientedMesh,
    volume: &'a VolumeMesh,
    pairing: Pairing,
    /// Where those of each triangle begin, and the end.
    starts: Vec<usize>,
    hexahedra: Vec<u32>,
}

impl<'a> Walk<'a> {
    fn new(surface: &'a ClosedOrientedMesh, volume: &'a VolumeMesh) -> Self {
        let mut starts = vec![0; surface.triangles().len() + 1];
        for pair in &volume.hosts.triangles {
            starts[pair[1] as usize + 1] += 1;
        }
        for t in 1..starts.len() {
            starts[t] += starts[t - 1];
        }
        let mut free = starts.clone();
        let mut hexahedra = vec![0; volume.hosts.triangles.len()];
        for pair in &volume.hosts.triangles {
            hexahedra[free[pair[1] as usize]] = pair[0];
            free[pair[1] as usize] += 1;
        }
        Self { surface, volume, pairing: Pairing::new(surface), starts, hexahedra }
    }

    /// The hexahedra of a triangle, in the order of their cells.
    fn of(&self, triangle: u32) -> &[u32] {
        &self.hexahedra[self.starts[triangle as usize]..self.starts[triangle as usize + 1]]
    }

    /// The hexahedron of a triangle on a cell.
    fn on_cell(&self, triangle: u32, cell: u64) -> Option<u32> {
        let cells = self.volume.mesh.cells();
        let list = self.of(triangle);
        let place = list.partition_point(|&h| cells[h as usize] < cell);
        list.get(place).copied().filter(|&h| cells[h as usize] == cell)
    }

    /// The hexahedra of a triangle in neighbouring cells have the side between in common.
    fn sides(&self, triangle: u32, findings: &mut Findings) {
        let mesh = &self.volume.mesh;
        let [nx, ny, _] = mesh.grid().cells().map(u64::from);
        let list = self.of(triangle);
        for (place, &h) in list.iter().enumerate() {
            let cell = mesh.cells()[h as usize];
            if let Some(&next) = list.get(place + 1)
                && mesh.cells()[next as usize] == cell
            {
                findings.add(Finding::Side { triangle, hexahedra: [h, next] });
            }
            let index = mesh.grid().cell_at(cell as usize);
            for (axis, step) in [1, nx, nx * ny].into_iter().enumerate() {
                if index[axis] + 1 == mesh.grid().cells()[axis] {
                    continue;
                }
                let Some(other) = self.on_cell(triangle, cell + step) else { continue };
                let [a, b] = [h, other].map(|h| mesh.hexahedra()[h as usize]);
                let mut upper = (0..8).filter(|corner| corner >> axis & 1 == 1);
                if upper.any(|corner| a[corner] != b[corner ^ 1 << axis]) {
                    findings.add(Finding::Side { triangle, hexahedra: [h, other] });
                }
            }
        }
    }

    /// In each cell that an edge of a triangle meets the triangle across is in the same hexahedron.
    fn edges(&self, triangle: u32, findings: &mut Findings) {
        let mesh = &self.volume.mesh;
        let corners = self.surface.corners(TriId(triangle)).map(|p| p.to_array());
        for k in 0..3 {
            let neighbour = self.pairing.neighbour(triangle, k);
            if neighbour < triangle {
                continue;
            }
            for &h in self.of(triangle) {
                let cell = mesh.cells()[h as usize];
                let other = self.on_cell(neighbour, cell);
                if other == Some(h) {
                    continue;
                }
                let [min, max] = cell_box(mesh.grid(), mesh.grid().cell_at(cell as usize));
                if moved_box_meets_segment(min, max, [corners[k], corners[(k + 1) % 3]]) {
                    let hexahedra = [h, other.unwrap_or(u32::MAX)];
                    findings.add(Finding::Edge { triangles: [triangle, neighbour], hexahedra });
                }
            }
        }
    }
}
