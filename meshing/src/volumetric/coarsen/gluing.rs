//! Which corners of the coarse hexahedra are one vertex: [`glue`]; and the mesh of them: [`assemble`].

use std::collections::BTreeMap;

use super::super::complex::NONE;
use super::super::faces::Face;
use super::super::hex_mesh::corner_node;
use super::super::shared_union_find::SharedUnionFind;
use super::super::{HexMesh, QUADRILATERALS};
use super::groups::{Groups, for_each_face};
use crate::grid::Grid3;
use crate::{Cancelled, Monitor};

/// Corners of the groups, `8 g + c`, united by the faces of the fine hexahedra.
///
/// * Hexahedra on both sides of a face, in different coarse cells: the sides of their coarse hexahedra where those meet are one.
/// * Hexahedra on one side of a face only: the same sides of their coarse hexahedra are one, even where the face is inside of the
///   coarse cell.
///
/// Hexahedra on the same side of a face that has others on the other side need no rule of their own: if those are in another coarse cell,
/// all have the side in common with the same ones, and if they are in the same, they are in one group.
pub(super) fn glue(
    mesh: &HexMesh,
    groups: &Groups,
    monitor: &Monitor<'_>,
) -> Result<SharedUnionFind, Cancelled> {
    let corners = SharedUnionFind::new(8 * groups.cells.len());
    for_each_face(mesh, "gluing coarse hexahedra", monitor, |face| {
        if let ([below, ..], [above, ..]) = (face.below, face.above)
            && groups.of[*below] == groups.of[*above]
        {
            return;
        }
        let mut members = members(face).map(|(hexahedron, side)| (groups.of[hexahedron], side));
        let Some((first, side)) = members.next() else { return };
        for (group, other) in members {
            for corner in QUADRILATERALS[side] {
                let same = if side == other { corner } else { corner ^ (1 << face.axis) };
                corners.unite(8 * first + corner as u32, 8 * group + same as u32);
            }
        }
    })?;
    Ok(corners)
}

/// The hexahedra at a face, each with the side that it is of them.
fn members<'a>(face: &'a Face<'_>) -> impl Iterator<Item = (usize, usize)> + 'a {
    let below = face.below.iter().map(|&hexahedron| (hexahedron, 2 * face.axis + 1));
    below.chain(face.above.iter().map(|&hexahedron| (hexahedron, 2 * face.axis)))
}

/// The mesh of the groups with their corners as glued, and the hexahedron of each group. Groups of which all corners are those of
/// another one are one hexahedron. Vertices are numbered in the order in which hexahedra have them.
pub(super) fn assemble(
    coarse: Grid3,
    groups: &Groups,
    corners: &SharedUnionFind,
    monitor: &Monitor<'_>,
) -> Result<(HexMesh, Vec<u32>), Cancelled> {
    let mut number = vec![NONE; 8 * groups.cells.len()];
    let (mut nodes, mut hexahedra, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    let mut hexahedron_of = Vec::with_capacity(groups.cells.len());
    let mut on_cell = BTreeMap::new();
    for run in groups.cells.chunk_by(|a, b| a == b) {
        monitor.check()?;
        on_cell.clear();
        let at = coarse.cell_at(run[0] as usize);
        for group in hexahedron_of.len()..hexahedron_of.len() + run.len() {
            let vertices = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| {
                let vertex = &mut number[corners.root((8 * group + corner) as u32) as usize];
                if *vertex == NONE {
                    *vertex = nodes.len() as u32;
                    nodes.push(coarse.node_index(corner_node(at, corner)) as u64);
                }
                *vertex
            });
            let mut next = || {
                hexahedra.push(vertices);
                cells.push(run[0]);
                hexahedra.len() as u32 - 1
            };
            hexahedron_of.push(if run.len() == 1 {
                next()
            } else {
                *on_cell.entry(vertices).or_insert_with(next)
            });
        }
    }
    Ok((HexMesh::by_construction(coarse, nodes, hexahedra, cells), hexahedron_of))
}
