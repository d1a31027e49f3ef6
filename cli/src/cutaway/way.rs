//! How far each hexahedron is from one end of its mesh: [`from_one_end`].
//!
//! Method: breadth-first search twice by common vertices; the hexahedron that is farthest from the first is one end.
//! Complexity: O(n) time, 40 bytes a hexahedron.

use welter_meshing::volumetric::HexMesh;
use welter_meshing::{Cancelled, Monitor};

/// Not reached: of another component.
const FAR: u32 = u32::MAX;

/// Steps from one end, by common vertices; of hexahedra in other components than the first, 0.
pub(super) fn from_one_end(mesh: &HexMesh, monitor: &Monitor<'_>) -> Result<Vec<u32>, Cancelled> {
    let around = Around::of(mesh);
    let first = search(mesh, &around, 0, monitor)?;
    let steps = |&(_, &way): &(usize, &u32)| if way == FAR { 0 } else { way };
    // The first of those that are farthest.
    let end = first.iter().enumerate().rev().max_by_key(steps).map_or(0, |(hexahedron, _)| hexahedron);
    let mut way = search(mesh, &around, end as u32, monitor)?;
    way.iter_mut().filter(|way| **way == FAR).for_each(|way| *way = 0);
    Ok(way)
}

/// The hexahedra at each vertex.
struct Around {
    begins: Vec<usize>,
    hexahedra: Vec<u32>,
}

impl Around {
    fn of(mesh: &HexMesh) -> Self {
        let mut begins = vec![0; mesh.nodes().len() + 1];
        for &vertex in mesh.hexahedra().iter().flatten() {
            begins[vertex as usize + 1] += 1;
        }
        for vertex in 0..mesh.nodes().len() {
            begins[vertex + 1] += begins[vertex];
        }
        let mut next = begins.clone();
        let mut hexahedra = vec![0; 8 * mesh.len()];
        for (hexahedron, corners) in mesh.hexahedra().iter().enumerate() {
            for &vertex in corners {
                hexahedra[next[vertex as usize]] = hexahedron as u32;
                next[vertex as usize] += 1;
            }
        }
        Self { begins, hexahedra }
    }

    fn at(&self, vertex: u32) -> &[u32] {
        &self.hexahedra[self.begins[vertex as usize]..self.begins[vertex as usize + 1]]
    }
}

fn search(mesh: &HexMesh, around: &Around, from: u32, monitor: &Monitor<'_>) -> Result<Vec<u32>, Cancelled> {
    let mut way = vec![FAR; mesh.len()];
    let mut seen = vec![false; mesh.nodes().len()];
    let mut front: Vec<u32> = if mesh.is_empty() { Vec::new() } else { vec![from] };
    front.iter().for_each(|&hexahedron| way[hexahedron as usize] = 0);
    let mut steps = 0;
    while !front.is_empty() {
        monitor.check()?;
        steps += 1;
        let mut next = Vec::new();
        for &hexahedron in &front {
            for &vertex in &mesh.hexahedra()[hexahedron as usize] {
                if std::mem::replace(&mut seen[vertex as usize], true) {
                    continue;
                }
                for &neighbour in around.at(vertex) {
                    if way[neighbour as usize] == FAR {
                        way[neighbour as usize] = steps;
                        next.push(neighbour);
                    }
                }
            }
        }
        front = next;
    }
    Ok(way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::grid::Grid3;

    #[test]
    fn a_row_is_counted_from_its_end() {
        let grid = Grid3::new([0.0; 3], 1.0, [4, 1, 1]).expect("a small grid");
        let hexahedra = (0..4).map(|i| [0, 1, 5, 6, 10, 11, 15, 16].map(|v| v + i)).collect();
        let mesh = HexMesh::new(grid, (0..20).collect(), hexahedra, (0..4).collect()).expect("on its cells");
        assert_eq!(from_one_end(&mesh, &Monitor::none()), Ok(vec![3, 2, 1, 0]));
    }
}
