//! The cells of a complex by number: [`of_hexahedra`], [`of_tetrahedra`].

use rayon::prelude::*;

use super::super::complex::{TRIANGLES, ascending};
use super::super::neighbours::pieces;
use super::super::{HexMesh, QUADRILATERALS, TetMesh, edges, faces};
use super::chains::Chains;
use crate::{Cancelled, Monitor};

/// The chains of hexahedra; there must be fewer than 2^32 cells of each dimension.
pub(super) fn of_hexahedra(
    mesh: &HexMesh,
    of_vertex: Vec<u32>,
    monitor: &Monitor<'_>,
) -> Result<Chains, Cancelled> {
    let stage = monitor.stage("numbering cells", mesh.len() as u64);
    let mut edge_of = vec![[0; edges::EDGES]; mesh.len()];
    let mut face_of = vec![[0; 6]; mesh.len()];
    let (mut edge_ends, mut face_edges) = (Vec::new(), Vec::new());
    for piece in pieces(mesh) {
        stage.check()?;
        edges::visit(mesh, piece.clone(), |(hexahedron, edge), earlier| {
            edge_of[hexahedron][edge] = match earlier {
                Some((other, same)) => edge_of[other][same],
                None => {
                    edge_ends.push(edges::corners(edge).map(|c| mesh.hexahedra()[hexahedron][c]));
                    edge_ends.len() as u32 - 1
                }
            };
        });
        stage.advance(piece.len() as u64);
    }
    for piece in pieces(mesh) {
        stage.check()?;
        faces::visit(mesh, piece, |face| {
            let number = face_edges.len() as u32;
            let members = face.below.iter().map(|&h| (h, 2 * face.axis + 1));
            let members = members.chain(face.above.iter().map(|&h| (h, 2 * face.axis)));
            for (at, (hexahedron, side)) in members.enumerate() {
                face_of[hexahedron][side] = number;
                if at == 0 {
                    let corners = QUADRILATERALS[side];
                    face_edges.push(
                        [0, 1, 2, 3]
                            .map(|k| edge_of[hexahedron][edges::between(corners[k], corners[(k + 1) % 4])]),
                    );
                }
            }
        });
    }
    Ok(Chains::new(of_vertex, edge_ends, face_edges, face_of))
}

/// The chains of tetrahedra; there must be fewer than 2^32 cells of each dimension.
pub(super) fn of_tetrahedra(
    mesh: &TetMesh,
    of_vertex: Vec<u32>,
    monitor: &Monitor<'_>,
) -> Result<Chains, Cancelled> {
    let (triangles, cells) = distinct(&mesh.tetrahedra, &TRIANGLES, monitor)?;
    let (edge_ends, triangle_edges) = distinct(&triangles, &[[0, 1], [0, 2], [1, 2]], monitor)?;
    Ok(Chains::new(of_vertex, edge_ends, triangle_edges, cells))
}

/// Sides of `M` vertices, and which of them each simplex of `S` sides has.
type Sides<const M: usize, const S: usize> = (Vec<[u32; M]>, Vec<[u32; S]>);

/// The different sides of all simplices, by their vertices, ascending; and which of them each simplex has.
fn distinct<const N: usize, const S: usize, const M: usize>(
    simplices: &[[u32; N]],
    sides: &[[usize; M]; S],
    monitor: &Monitor<'_>,
) -> Result<Sides<M, S>, Cancelled> {
    monitor.check()?;
    let side = |simplex: &[u32; N], corners: [usize; M]| ascending(corners.map(|corner| simplex[corner]));
    let mut all = Vec::with_capacity(simplices.len() * S);
    for simplex in simplices {
        all.extend(sides.iter().map(|&corners| side(simplex, corners)));
    }
    all.par_sort_unstable();
    all.dedup();
    monitor.check()?;
    let number = |side| all.binary_search(&side).expect("the list holds every side") as u32;
    let of =
        simplices.par_iter().map(|simplex| sides.map(|corners| number(side(simplex, corners)))).collect();
    Ok((all, of))
}
