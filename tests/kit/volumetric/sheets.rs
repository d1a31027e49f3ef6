//! Hexahedra glued to each other one by one: [`Sheets`], and random ones.

use welter_meshing::grid::Grid3;
use welter_meshing::volumetric::{HexMesh, QUADRILATERALS};

use crate::entropy::Entropy;

/// Hexahedra on the cells of a grid, each with eight vertices of its own until they are glued.
#[derive(Clone, Debug)]
pub struct Sheets {
    grid: Grid3,
    cells: Vec<[u32; 3]>,
    /// For corner `8 h + c` another corner of the same vertex, lower or the same.
    same: Vec<usize>,
}

impl Sheets {
    /// Nothing yet, on a grid of unit cells.
    #[must_use]
    pub fn new(cells: [u32; 3]) -> Self {
        Self {
            grid: Grid3::new([0.0; 3], 1.0, cells).expect("small grids are exact"),
            cells: Vec::new(),
            same: Vec::new(),
        }
    }

    /// One more hexahedron on a cell.
    pub fn add(&mut self, cell: [u32; 3]) -> usize {
        self.cells.push(cell);
        self.same.extend(self.same.len()..self.same.len() + 8);
        self.cells.len() - 1
    }

    fn vertex(&self, mut corner: usize) -> usize {
        while self.same[corner] != corner {
            corner = self.same[corner];
        }
        corner
    }

    fn node(&self, corner: usize) -> [u32; 3] {
        std::array::from_fn(|axis| self.cells[corner / 8][axis] + (corner >> axis & 1) as u32)
    }

    /// Makes one vertex of two corners at the same node.
    pub fn unite(&mut self, a: usize, b: usize) {
        assert_eq!(self.node(a), self.node(b), "corners at different nodes");
        let (a, b) = (self.vertex(a), self.vertex(b));
        self.same[a.max(b)] = a.min(b);
    }

    /// Glues two hexahedra where their cells meet; those on the same cell become one.
    pub fn join(&mut self, a: usize, b: usize) {
        for i in 8 * a..8 * a + 8 {
            for j in 8 * b..8 * b + 8 {
                if self.node(i) == self.node(j) {
                    self.unite(i, j);
                }
            }
        }
    }

    /// Glues one side of two hexahedra on the same cell.
    pub fn join_side(&mut self, a: usize, b: usize, side: usize) {
        for corner in QUADRILATERALS[side] {
            self.unite(8 * a + corner, 8 * b + corner);
        }
    }

    /// A sheet with a hexahedron on each of the cells, all glued where they meet.
    pub fn sheet(&mut self, cells: impl IntoIterator<Item = [u32; 3]>) -> Vec<usize> {
        let sheet: Vec<usize> = cells.into_iter().map(|cell| self.add(cell)).collect();
        for (i, &a) in sheet.iter().enumerate() {
            sheet[..i].iter().for_each(|&b| self.join(a, b));
        }
        sheet
    }

    /// A path of hexahedra, each glued to the next only.
    pub fn path(&mut self, cells: impl IntoIterator<Item = [u32; 3]>) -> Vec<usize> {
        let path: Vec<usize> = cells.into_iter().map(|cell| self.add(cell)).collect();
        path.windows(2).for_each(|pair| self.join(pair[0], pair[1]));
        path
    }

    /// The mesh: hexahedra by cell, those on the same one as they were added.
    #[must_use]
    pub fn build(&self) -> HexMesh {
        let mut order: Vec<usize> = (0..self.cells.len()).collect();
        order.sort_by_key(|&h| self.grid.cell_index(self.cells[h]));
        let mut number = vec![None; self.same.len()];
        let mut nodes = Vec::new();
        let mut hexahedra = Vec::new();
        for &h in &order {
            hexahedra.push([0, 1, 2, 3, 4, 5, 6, 7].map(|c| {
                *number[self.vertex(8 * h + c)].get_or_insert_with(|| {
                    nodes.push(self.grid.node_index(self.node(8 * h + c)) as u64);
                    nodes.len() as u32 - 1
                })
            }));
        }
        let cells = order.iter().map(|&h| self.grid.cell_index(self.cells[h]) as u64).collect();
        HexMesh::new(self.grid, nodes, hexahedra, cells).expect("corners are at the nodes of their cells")
    }
}

/// A random complex on a small grid: a sheet with holes, walks whose hexahedra are glued to the ones before them, single hexahedra, up to
/// `most` on a cell; and then some more glued at random: where they meet, on one side, or at a corner.
#[must_use]
pub fn random(entropy: &mut Entropy<'_>, most: u8) -> HexMesh {
    let grids = [[1, 1, 2], [5, 3, 1], [2, 1, 4], [3, 3, 2], [3, 3, 3], [1, 4, 4]];
    let mut sheets = Sheets::new(entropy.pick(&grids));
    let grid = sheets.grid;
    // A sheet without random holes has one at a cell that may be an inner one.
    let holes = entropy.pick(&[0, 20, 60, 255]);
    let cells = (0..grid.cell_count()).map(|n| grid.cell_at(n));
    sheets.sheet(cells.filter(|&cell| if holes == 0 { cell != [1; 3] } else { entropy.byte() >= holes }));
    for _ in 0..entropy.below(3) {
        let steps = entropy.below(14);
        let mut at = [0, 1, 2].map(|axis| u32::from(entropy.byte()) % grid.cells()[axis]);
        let mut walk = vec![at];
        for _ in 0..steps {
            let axis = usize::from(entropy.below(3));
            let to = if entropy.below(2) == 0 { at[axis].saturating_sub(1) } else { at[axis] + 1 };
            at[axis] = to.min(grid.cells()[axis] - 1);
            if walk.last() != Some(&at) {
                walk.push(at);
            }
        }
        sheets.path(walk);
    }
    for cell in 0..grid.cell_count() {
        for _ in 0..entropy.below(most + 1) {
            if entropy.below(3) == 0 {
                sheets.add(grid.cell_at(cell));
            }
        }
    }
    sheets.glue_at_random(entropy);
    sheets.build()
}

impl Sheets {
    fn glue_at_random(&mut self, entropy: &mut Entropy<'_>) {
        let count = self.cells.len();
        let meet =
            |a: usize, b: usize| (0..3).all(|axis| self.cells[a][axis].abs_diff(self.cells[b][axis]) < 2);
        let pairs: Vec<_> =
            (0..count).flat_map(|a| (0..a).map(move |b| (a, b))).filter(|&(a, b)| meet(a, b)).collect();
        if pairs.is_empty() {
            return;
        }
        for _ in 0..entropy.pick(&[0, 2, 4, 8, 24]) {
            let (a, b) = pairs[entropy.word() as usize % pairs.len()];
            if self.cells[a] != self.cells[b] {
                self.join(a, b);
            } else {
                self.join_side(a, b, usize::from(entropy.below(6)));
            }
        }
        for _ in 0..entropy.below(4) {
            let a = entropy.word() as usize % self.same.len();
            if let Some(b) = (0..a).find(|&b| self.node(a) == self.node(b)) {
                self.unite(a, b);
            }
        }
    }
}
