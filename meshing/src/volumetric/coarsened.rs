//! Volumetric meshes on larger cells: [`VolumeMesh::coarsened`].

use super::{
    BettiLimits, CoarsenError, Coarsening, Host, Hosts, TopologyReport, VolumeMesh, coarsen_checked,
};
use crate::Monitor;

impl VolumeMesh {
    /// The mesh on cells twice as large, \[Gagniere22\] 3.8, with all that it carries; and what that did to its topology.
    ///
    /// Labels are those of the first of the finer hexahedra. Betti numbers are not compared: the Euler characteristics are.
    ///
    /// # Errors
    /// As [`coarsen`](super::coarsen).
    pub fn coarsened(&self, monitor: &Monitor<'_>) -> Result<(Self, TopologyReport), CoarsenError> {
        let none = BettiLimits { most_cells: 0, ..BettiLimits::default() };
        let (Coarsening { mesh, coarse_of }, report) = coarsen_checked(&self.mesh, &none, monitor)?;
        let mut regions = vec![u32::MAX; mesh.len()];
        let mut copies = vec![0; mesh.len()];
        for (fine, &coarse) in coarse_of.iter().enumerate().rev() {
            if self.regions[fine] != u32::MAX {
                (regions[coarse as usize], copies[coarse as usize]) = (self.regions[fine], self.copies[fine]);
            }
        }
        let mut triangles: Vec<[u32; 2]> =
            self.hosts.triangles.iter().map(|&[h, t]| [coarse_of[h as usize], t]).collect();
        triangles.sort_unstable();
        triangles.dedup();
        let vertices = self.hosts.vertices.iter().map(|host| self.in_larger(host, &coarse_of)).collect();
        let hosts = Hosts { vertices, triangles, disagreements: self.hosts.disagreements };
        let volume = Self {
            mesh,
            regions,
            copies,
            hosts,
            windings: self.windings.clone(),
            coarsenings: self.coarsenings + 1,
            ..*self
        };
        Ok((volume, report))
    }

    /// A host in the hexahedron twice as large.
    fn in_larger(&self, host: &Host, coarse_of: &[u32]) -> Host {
        if host.hexahedron == u32::MAX {
            return *host;
        }
        let cell = self.mesh.grid().cell_at(self.mesh.cells()[host.hexahedron as usize] as usize);
        // Both grids have their first node in common.
        let at = std::array::from_fn(|axis| 0.5 * (f64::from(cell[axis] & 1) + host.at[axis]));
        Host { hexahedron: coarse_of[host.hexahedron as usize], at }
    }
}
