//! Where a mesh is cut open if nothing is asked for: [`through_overlap`].

use crate::render::Cut;
use welter_meshing::volumetric::HexMesh;

/// The plane through the middle of a layer of cells that has the most hexahedra beyond one for each cell. Without any, that through the
/// middle of the shortest side. Of equal layers, the one nearest to the middle of those.
pub(crate) fn through_overlap(mesh: &HexMesh) -> Cut {
    let grid = mesh.grid();
    let mut surplus = grid.cells().map(|count| vec![0_u32; count as usize]);
    for pair in mesh.cells().windows(2).filter(|pair| pair[0] == pair[1]) {
        let cell = grid.cell_at(pair[0] as usize);
        (0..3).for_each(|axis| surplus[axis][cell[axis] as usize] += 1);
    }
    let most = surplus.iter().flatten().copied().max().unwrap_or(0);
    let (axis, layer) = if most == 0 {
        let cells = grid.cells();
        let axis = (0..3).min_by_key(|&axis| cells[axis]).unwrap_or(2);
        (axis, cells[axis] / 2)
    } else {
        let axis = (0..3).find(|&axis| surplus[axis].contains(&most)).unwrap_or(2);
        let equal: Vec<u32> =
            (0..).zip(&surplus[axis]).filter(|&(_, &n)| n == most).map(|(layer, _)| layer).collect();
        (axis, equal[equal.len() / 2])
    };
    // Between two layers: all of the layer is seen.
    let value = 0.5 * grid.coordinate(axis, layer) + 0.5 * grid.coordinate(axis, layer + 1);
    Cut { axis, value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::grid::Grid3;

    fn blocks(cells: Vec<u64>) -> HexMesh {
        let grid = Grid3::new([0.0; 3], 1.0, [3, 4, 5]).expect("a small grid");
        let mut nodes = Vec::new();
        let mut hexahedra = Vec::new();
        for &cell in &cells {
            let [i, j, k] = grid.cell_at(cell as usize);
            let node = |c: u32| grid.node_index([i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)]) as u64;
            let first = nodes.len() as u32;
            nodes.extend((0..8).map(node));
            hexahedra.push(std::array::from_fn(|c| first + c as u32));
        }
        HexMesh::new(grid, nodes, hexahedra, cells).expect("on their cells")
    }

    #[test]
    fn the_plane_goes_where_the_most_lie_over_one_another() {
        // Cells (1, 2, 3) and (2, 2, 3), each twice: both are in the layers y = 2 and z = 3.
        let cell = |i: u64| i + 3 * (2 + 4 * 3);
        let cut = through_overlap(&blocks(vec![0, cell(1), cell(1), cell(2), cell(2)]));
        assert_eq!(cut, Cut { axis: 1, value: 2.5 });
    }

    #[test]
    fn without_overlap_it_goes_through_the_middle_of_the_shortest_side() {
        assert_eq!(through_overlap(&blocks(vec![0, 1])), Cut { axis: 0, value: 1.5 });
    }
}
