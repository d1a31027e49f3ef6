//! Where a mesh is cut open if nothing is asked for: [`through_overlap`].

use crate::render::Cut;
use welter_meshing::volumetric::{HexMesh, VolumeMesh};

/// An axis across the shortest side is taken if a layer across it has at least this share of the most sheets that a layer has: such a
/// cut shows the most of the mesh.
const ENOUGH: f64 = 0.5;

/// The plane through the middle of a layer of cells with the most hexahedra where the volume lies over itself. Without any, that through
/// the middle of the shortest side. Of equal layers, the one nearest to the middle of those.
///
/// Hexahedra that share a cell only because it is too large, as beside a narrow gap, are not counted.
pub(crate) fn through_overlap(volume: &VolumeMesh) -> Cut {
    let is_deep =
        |h: usize| volume.windings.get(volume.regions[h] as usize).is_some_and(|&winding| winding > 1);
    through_most(&volume.mesh, is_deep)
}

/// The plane through the layer with the most hexahedra that count.
fn through_most(mesh: &HexMesh, counts: impl Fn(usize) -> bool) -> Cut {
    let grid = mesh.grid();
    let cells = grid.cells();
    let mut layers = cells.map(|count| vec![0_u32; count as usize]);
    for (_, &cell) in mesh.cells().iter().enumerate().filter(|&(h, _)| counts(h)) {
        let cell = grid.cell_at(cell as usize);
        (0..3).for_each(|axis| layers[axis][cell[axis] as usize] += 1);
    }
    let most = [0, 1, 2].map(|axis| layers[axis].iter().copied().max().unwrap_or(0));
    let shortest = (0..3).min_by_key(|&axis| cells[axis]).unwrap_or(2);
    let largest = most.into_iter().max().unwrap_or(0);
    let enough = f64::from(most[shortest]) >= ENOUGH * f64::from(largest);
    let axis = if enough { shortest } else { (0..3).find(|&axis| most[axis] == largest).unwrap_or(shortest) };
    let layer = if largest == 0 {
        cells[axis] / 2
    } else {
        let equal: Vec<u32> =
            (0..).zip(&layers[axis]).filter(|&(_, &n)| n == most[axis]).map(|(layer, _)| layer).collect();
        equal[equal.len() / 2]
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

    /// Counts all on these cells.
    fn cut(cells: &[u64], counted: &[u64]) -> Cut {
        through_most(&blocks(cells.to_vec()), |h| counted.contains(&cells[h]))
    }

    /// The cell (i, j, k) of the grid of 3 x 4 x 5.
    fn cell([i, j, k]: [u64; 3]) -> u64 {
        i + 3 * (j + 4 * k)
    }

    #[test]
    fn the_plane_goes_where_the_most_lie_over_one_another() {
        let deep = [[1, 0, 3], [1, 1, 3], [1, 2, 3]].map(cell);
        let all: Vec<u64> = [0].into_iter().chain(deep.into_iter().flat_map(|cell| [cell, cell])).collect();
        assert_eq!(cut(&all, &deep), Cut { axis: 0, value: 1.5 });
        // Along x, each layer has but a third of what those of the other axes have.
        let deep = [[0, 2, 3], [1, 2, 3], [2, 2, 3]].map(cell);
        let all: Vec<u64> = deep.into_iter().flat_map(|cell| [cell, cell]).collect();
        assert_eq!(cut(&all, &deep), Cut { axis: 1, value: 2.5 });
    }

    #[test]
    fn a_plane_across_the_shortest_side_needs_half_of_the_most() {
        // Two in one layer across x, three in one across z.
        let deep = [[1, 2, 3], [1, 1, 3], [2, 0, 3]].map(cell);
        let all: Vec<u64> = [2, 1, 0].into_iter().flat_map(|k: usize| [deep[k], deep[k]]).collect();
        assert_eq!(cut(&all, &deep), Cut { axis: 0, value: 1.5 });
    }

    #[test]
    fn without_overlap_it_goes_through_the_middle_of_the_shortest_side() {
        assert_eq!(cut(&[0, 1], &[]), Cut { axis: 0, value: 1.5 });
        // One cell that two hexahedra share beside a gap is no overlap.
        let shared = cell([2, 3, 4]);
        assert_eq!(cut(&[0, 1, shared, shared], &[]), Cut { axis: 0, value: 1.5 });
    }
}
