//! Counts and Betti numbers by sets and dense elimination: [`Homology`].

use std::collections::{BTreeMap, BTreeSet};

use welter_meshing::volumetric::{HexMesh, TetMesh};

/// What there is to know of each component, in the order of their first elements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Homology {
    /// The component of each element.
    pub labels: Vec<u32>,
    /// Numbers of vertices, edges, faces and elements.
    pub counts: Vec<[u64; 4]>,
    /// The Betti numbers modulo 2.
    pub betti: Vec<[u64; 4]>,
}

type Cell = BTreeSet<u32>;

/// Of hexahedra.
#[must_use]
pub fn homology_of_hexahedra(mesh: &HexMesh) -> Homology {
    let corners: Vec<usize> = (0..8).collect();
    // The edges and sides: all corners that agree in two or one of their bits.
    let faces_of = |bits: u32| -> Vec<Vec<usize>> {
        let masks = (0..8_usize).filter(|mask| mask.count_ones() == bits);
        let all: BTreeSet<Vec<usize>> = masks
            .flat_map(|mask| {
                corners
                    .iter()
                    .map(move |c| (0..8).filter(|d| (c ^ d) & mask == 0).collect())
                    .collect::<Vec<_>>()
            })
            .collect();
        all.into_iter().collect()
    };
    let elements: Vec<Vec<u32>> = mesh.hexahedra().iter().map(|h| h.to_vec()).collect();
    of_elements(&elements, &faces_of(2), &faces_of(1))
}

/// Of tetrahedra.
#[must_use]
pub fn homology_of_tetrahedra(mesh: &TetMesh) -> Homology {
    let edges: Vec<Vec<usize>> = (0..4).flat_map(|a| (0..a).map(move |b| vec![a, b])).collect();
    let triangles: Vec<Vec<usize>> = (0..4).map(|a| (0..4).filter(|&b| b != a).collect()).collect();
    let elements: Vec<Vec<u32>> = mesh.tetrahedra.iter().map(|t| t.to_vec()).collect();
    of_elements(&elements, &edges, &triangles)
}

fn of_elements(elements: &[Vec<u32>], edges: &[Vec<usize>], faces: &[Vec<usize>]) -> Homology {
    let labels = components(elements);
    let mut homology = Homology { counts: Vec::new(), betti: Vec::new(), labels };
    let components = homology.labels.iter().max().map_or(0, |&last| last + 1);
    for component in 0..components {
        let members: Vec<&Vec<u32>> =
            (0..elements.len()).filter(|&e| homology.labels[e] == component).map(|e| &elements[e]).collect();
        let sides = |element: &Vec<u32>, sides: &[Vec<usize>]| -> Vec<Cell> {
            sides.iter().map(|side| side.iter().map(|&corner| element[corner]).collect()).collect()
        };
        let distinct = |of: &[Vec<usize>]| -> Vec<Cell> {
            let all: BTreeSet<Cell> = members.iter().flat_map(|element| sides(element, of)).collect();
            all.into_iter().collect()
        };
        let vertices: Vec<Cell> = {
            let all: BTreeSet<u32> = members.iter().flat_map(|element| element.iter().copied()).collect();
            all.into_iter().map(|v| Cell::from([v])).collect()
        };
        let (edges, faces) = (distinct(edges), distinct(faces));
        let elements: Vec<Cell> = members.iter().map(|element| element.iter().copied().collect()).collect();
        let levels = [&vertices, &edges, &faces, &elements];
        let ranks: Vec<u64> = (1..4).map(|k| rank(levels[k], levels[k - 1])).collect();
        let counts = levels.map(|level| level.len() as u64);
        homology.counts.push(counts);
        homology.betti.push([
            counts[0] - ranks[0],
            counts[1] - ranks[0] - ranks[1],
            counts[2] - ranks[1] - ranks[2],
            counts[3] - ranks[2],
        ]);
    }
    homology
}

/// Labels spread until nothing changes.
fn components(elements: &[Vec<u32>]) -> Vec<u32> {
    let mut label: Vec<usize> = (0..elements.len()).collect();
    loop {
        let mut of_vertex: BTreeMap<u32, usize> = BTreeMap::new();
        for (element, vertices) in elements.iter().enumerate() {
            for &v in vertices {
                let least = of_vertex.entry(v).or_insert(label[element]);
                *least = (*least).min(label[element]);
            }
        }
        let before = label.clone();
        for (element, vertices) in elements.iter().enumerate() {
            label[element] = vertices.iter().map(|v| of_vertex[v]).min().expect("an element has vertices");
        }
        if label == before {
            break;
        }
    }
    let distinct: Vec<usize> = label.iter().copied().collect::<BTreeSet<_>>().into_iter().collect();
    label.iter().map(|l| distinct.binary_search(l).expect("it is one of them") as u32).collect()
}

/// The rank of the boundary of cells, modulo 2: Gaussian elimination of whole rows. A cell has those faces whose vertices it has.
fn rank(cells: &[Cell], faces: &[Cell]) -> u64 {
    let mut rows: Vec<Vec<bool>> =
        cells.iter().map(|cell| faces.iter().map(|face| face.is_subset(cell)).collect()).collect();
    let mut rank = 0;
    for column in 0..faces.len() {
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][column]) else { continue };
        rows.swap(rank, pivot);
        let pivot_row = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            if row[column] {
                row.iter_mut().zip(&pivot_row).for_each(|(a, b)| *a ^= b);
            }
        }
        rank += 1;
    }
    rank as u64
}
