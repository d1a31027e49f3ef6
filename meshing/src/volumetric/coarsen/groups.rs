//! Which fine hexahedra make one coarse one: [`Groups`].

use rayon::prelude::*;

use super::super::HexMesh;
use super::super::faces::{self, Face};
use super::super::neighbours::pieces;
use super::super::shared_union_find::SharedUnionFind;
use crate::grid::Grid3;
use crate::{Cancelled, Monitor};

/// The fine hexahedra in groups: those of one coarse cell that hang together by faces between hexahedra that are not coincident.
pub(super) struct Groups {
    /// The group of each fine hexahedron.
    pub(super) of: Vec<u32>,
    /// The coarse cell of each group, ascending; groups of the same cell in the order of their first hexahedra.
    pub(super) cells: Vec<u64>,
}

impl Groups {
    pub(super) fn of(mesh: &HexMesh, coarse: &Grid3, monitor: &Monitor<'_>) -> Result<Self, Cancelled> {
        let sets = SharedUnionFind::new(mesh.len());
        for_each_face(mesh, "grouping hexahedra", monitor, |face| {
            let ([first, ..], [above, ..]) = (face.below, face.above) else { return };
            if coarse_cell(mesh, coarse, *first) == coarse_cell(mesh, coarse, *above) {
                let both = face.below.iter().chain(face.above);
                both.for_each(|&hexahedron| sets.unite(*first as u32, hexahedron as u32));
            }
        })?;
        let mut of: Vec<u32> = (0..mesh.len() as u32).into_par_iter().map(|h| sets.root(h)).collect();
        drop(sets);
        let mut firsts: Vec<(u64, u32)> = (0..mesh.len())
            .into_par_iter()
            .filter(|&h| of[h] == h as u32)
            .map(|h| (coarse_cell(mesh, coarse, h), h as u32))
            .collect();
        monitor.check()?;
        firsts.par_sort_unstable();
        let mut number = vec![0; mesh.len()];
        for (group, &(_, first)) in firsts.iter().enumerate() {
            number[first as usize] = group as u32;
        }
        of.par_iter_mut().for_each(|group| *group = number[*group as usize]);
        Ok(Self { of, cells: firsts.into_iter().map(|(cell, _)| cell).collect() })
    }
}

/// The number of the coarse cell that holds a fine hexahedron.
fn coarse_cell(mesh: &HexMesh, coarse: &Grid3, hexahedron: usize) -> u64 {
    coarse.cell_index(mesh.grid().cell_at(mesh.cells()[hexahedron] as usize).map(|i| i / 2)) as u64
}

/// Visits the faces of all pieces, several at a time.
pub(super) fn for_each_face(
    mesh: &HexMesh,
    name: &'static str,
    monitor: &Monitor<'_>,
    each: impl Fn(&Face<'_>) + Sync,
) -> Result<(), Cancelled> {
    let stage = monitor.stage(name, mesh.len() as u64);
    pieces(mesh).into_par_iter().try_for_each(|piece| {
        stage.check()?;
        let hexahedra = piece.len() as u64;
        faces::visit(mesh, piece, &each);
        stage.advance(hexahedra);
        Ok(())
    })
}
