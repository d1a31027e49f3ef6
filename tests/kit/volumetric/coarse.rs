//! Coarsening by all pairs of hexahedra: [`coarse_by_pairs`].

use std::collections::BTreeMap;

use welter_meshing::grid::Grid3;
use welter_meshing::volumetric::{HexMesh, QUADRILATERALS};

/// The coarse mesh and the coarse hexahedron of each fine one, by the text of \[Gagniere22\] 3.8: one coarse hexahedron for each fine one,
/// corners united pair by pair, and then one hexahedron for all with the same vertices. In the order of cells and first fine hexahedra.
#[must_use]
pub fn coarse_by_pairs(mesh: &HexMesh) -> (HexMesh, Vec<u32>) {
    let (fine, count) = (mesh.grid(), mesh.len());
    let cells = fine.cells().map(|n| n / 2 + n % 2);
    let coarse = Grid3::new(fine.origin(), 2.0 * fine.spacing(), cells).expect("small grids are exact");
    let at: Vec<[u32; 3]> = mesh.cells().iter().map(|&cell| fine.cell_at(cell as usize)).collect();
    let cell: Vec<usize> = at.iter().map(|at| coarse.cell_index(at.map(|i| i / 2))).collect();
    let side = |h: usize, side: usize| QUADRILATERALS[side].map(|corner| mesh.hexahedra()[h][corner]);
    let mut vertex: Vec<usize> = (0..8 * count).collect();
    let mut unite = |a: usize, b: usize| {
        let (from, to) = (vertex[a].max(vertex[b]), vertex[a].min(vertex[b]));
        vertex.iter_mut().filter(|v| **v == from).for_each(|v| *v = to);
    };
    for (a, b) in (0..count).flat_map(|a| (0..a).map(move |b| (a, b))) {
        for (s, t) in (0..6).flat_map(|s| (0..6).map(move |t| (s, t))) {
            let sorted = |mut vertices: [u32; 4]| {
                vertices.sort_unstable();
                vertices
            };
            if sorted(side(a, s)) != sorted(side(b, t)) {
                continue;
            }
            let coincident = at[a] == at[b];
            if coincident {
                // The analogous sides of both.
                assert_eq!(s, t);
                QUADRILATERALS[s].iter().for_each(|corner| unite(8 * a + corner, 8 * b + corner));
            } else if cell[a] == cell[b] {
                (0..8).for_each(|corner| unite(8 * a + corner, 8 * b + corner));
            } else {
                // The sides on which the coarse cells meet.
                let axis = s / 2;
                for corner in QUADRILATERALS[s] {
                    unite(8 * a + corner, 8 * b + (corner ^ (1 << axis)));
                }
            }
        }
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&h| cell[h]);
    let (mut nodes, mut hexahedra, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    let (mut number, mut hexahedron, mut of) = (BTreeMap::new(), BTreeMap::new(), vec![0; count]);
    for h in order {
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|c| vertex[8 * h + c]);
        of[h] = *hexahedron.entry(corners).or_insert_with(|| {
            hexahedra.push([0, 1, 2, 3, 4, 5, 6, 7].map(|c: usize| {
                *number.entry(corners[c]).or_insert_with(|| {
                    let node = at[h].map(|i| i / 2);
                    let node = [0, 1, 2].map(|axis| node[axis] + (c >> axis & 1) as u32);
                    nodes.push(coarse.node_index(node) as u64);
                    nodes.len() as u32 - 1
                })
            }));
            cells.push(cell[h] as u64);
            hexahedra.len() as u32 - 1
        });
    }
    (HexMesh::new(coarse, nodes, hexahedra, cells).expect("corners are at the nodes of their cells"), of)
}
