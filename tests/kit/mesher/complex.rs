//! How hexahedra hang together, without places: [`Complex`].

use std::collections::BTreeMap;

use welter_meshing::volumetric::{HexMesh, QUADRILATERALS};

use super::{Sets, Unfolded};

/// Hexahedra by the numbers of their corners, and who lies across each side.
#[derive(Clone, Debug)]
pub struct Complex {
    /// The cell of each hexahedron.
    pub cells: Vec<u64>,
    /// Its corners.
    pub corners: Vec<[u32; 8]>,
    /// Across each side the other hexahedra: one, if the body does not fall apart behind the side.
    pub across: Vec<[Vec<u32>; 6]>,
    /// The component of each hexahedron, connected through sides.
    pub component_of: Vec<usize>,
    /// The Euler characteristic of each component.
    pub characteristics: Vec<i64>,
    /// How many sides more than two hexahedra have, or two of one cell.
    pub forks: usize,
    /// Sides that hexahedra have in a wrong way.
    pub faults: Vec<String>,
}

impl Complex {
    /// That of a mesh.
    #[must_use]
    pub fn of_mesh(mesh: &HexMesh) -> Self {
        Self::new(mesh.cells().to_vec(), mesh.hexahedra().to_vec())
    }

    /// That of hexahedra with common sides: corners are one where sides are.
    #[must_use]
    pub fn of_unfolded(unfolded: &Unfolded) -> Self {
        let mut sets = Sets::new(8 * unfolded.cells.len());
        for &([a, b], axis) in &unfolded.sides {
            for corner in (0..8).filter(|corner| corner >> axis & 1 == 1) {
                sets.unite(8 * a + corner, 8 * b + (corner ^ 1 << axis));
            }
        }
        let corners = (0..unfolded.cells.len()).map(|h| std::array::from_fn(|c| sets.root(8 * h + c) as u32));
        Self::new(unfolded.cells.iter().map(|&cell| cell as u64).collect(), corners.collect())
    }

    /// That of hexahedra by their cells and the numbers of their corners.
    #[must_use]
    pub fn new(cells: Vec<u64>, corners: Vec<[u32; 8]>) -> Self {
        let count = cells.len();
        let mut sides: BTreeMap<[u32; 4], Vec<(usize, usize)>> = BTreeMap::new();
        for (h, corners) in corners.iter().enumerate() {
            for (side, quadrilateral) in QUADRILATERALS.iter().enumerate() {
                let mut key = quadrilateral.map(|c| corners[c]);
                key.sort_unstable();
                sides.entry(key).or_default().push((h, side));
            }
        }
        let (mut across, mut faults, mut forks) = (vec![<[Vec<u32>; 6]>::default(); count], Vec::new(), 0);
        let mut sets = Sets::new(count);
        for owners in sides.values() {
            let lower = owners[0].1 & !1;
            if owners.iter().any(|(_, side)| side & !1 != lower) {
                faults.push(format!("hexahedra and sides {owners:?} share one side"));
            }
            let on = |upper: usize| owners.iter().filter(move |(_, side)| side & 1 == upper);
            for &(a, side) in on(0) {
                for &(b, other) in on(1) {
                    across[a][side].push(b as u32);
                    across[b][other].push(a as u32);
                    sets.unite(a, b);
                }
            }
            // Two on one side with none across have their corners in common by way of forks next to them.
            let alone = on(0).count() == 0 || on(1).count() == 0;
            forks += usize::from(owners.len() > 2 || alone && owners.len() > 1);
        }
        let mut component_of = Vec::with_capacity(count);
        let mut components = 0;
        for h in 0..count {
            let root = sets.root(h);
            component_of.push(if root == h { components } else { component_of[root] });
            components += usize::from(root == h);
        }
        let mut characteristics = vec![0i64; components];
        let (mut vertices, mut edges) = (BTreeMap::new(), BTreeMap::new());
        for (h, corners) in corners.iter().enumerate() {
            characteristics[component_of[h]] -= 1;
            for c in 0..8usize {
                vertices.insert(corners[c], component_of[h]);
                for axis in (0..3).filter(|axis| c >> axis & 1 == 0) {
                    edges.insert([corners[c], corners[c | 1 << axis]], component_of[h]);
                }
            }
        }
        vertices.values().for_each(|&c| characteristics[c] += 1);
        edges.values().for_each(|&c| characteristics[c] -= 1);
        for owners in sides.values() {
            characteristics[component_of[owners[0].0]] += 1;
        }
        Self { cells, corners, across, component_of, characteristics, forks, faults }
    }

    /// How many sides lie between one hexahedron and each; `None` if there is no way.
    #[must_use]
    pub fn distances(&self, from: usize) -> Vec<Option<u32>> {
        let mut distances = vec![None; self.cells.len()];
        distances[from] = Some(0);
        let mut queue = std::collections::VecDeque::from([from]);
        while let Some(h) = queue.pop_front() {
            for next in self.across[h].iter().flatten().copied() {
                if distances[next as usize].is_none() {
                    distances[next as usize] = distances[h].map(|d| d + 1);
                    queue.push_back(next as usize);
                }
            }
        }
        distances
    }
}
