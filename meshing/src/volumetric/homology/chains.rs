//! A complex as chains modulo 2: [`Chains`], the faces of each cell.

/// The cells of dimension 0 to 3 of a complex, by number within each dimension, and what their boundaries are.
pub(super) struct Chains {
    /// How many cells of each dimension there are.
    pub(super) counts: [usize; 4],
    /// How many faces each cell has, by dimension.
    arity: [usize; 4],
    /// The faces of each cell, of the dimension below, one cell after the other.
    faces: [Vec<u32>; 4],
    /// The component of each cell of dimension 0; of a vertex that no cell has, none.
    of_vertex: Vec<u32>,
}

impl Chains {
    /// Cells of dimension 1, 2 and 3 by their faces, with the component of each vertex.
    pub(super) fn new<const F: usize, const C: usize>(
        of_vertex: Vec<u32>,
        edges: Vec<[u32; 2]>,
        faces: Vec<[u32; F]>,
        cells: Vec<[u32; C]>,
    ) -> Self {
        Self {
            counts: [of_vertex.len(), edges.len(), faces.len(), cells.len()],
            arity: [0, 2, F, C],
            faces: [Vec::new(), edges.into_flattened(), faces.into_flattened(), cells.into_flattened()],
            of_vertex,
        }
    }

    /// The faces of a cell.
    pub(super) fn faces(&self, dimension: usize, cell: usize) -> &[u32] {
        let arity = self.arity[dimension];
        &self.faces[dimension][arity * cell..arity * (cell + 1)]
    }

    /// The component of a cell.
    pub(super) fn component(&self, dimension: usize, cell: usize) -> u32 {
        let vertex = (1..=dimension).rev().fold(cell, |cell, d| self.faces(d, cell)[0] as usize);
        self.of_vertex[vertex]
    }

    /// For the cells of a dimension below 3, those of the next dimension that have them as faces.
    pub(super) fn cofaces(&self, dimension: usize) -> Cofaces {
        let mut starts = vec![0_u32; self.counts[dimension] + 2];
        for &face in &self.faces[dimension + 1] {
            starts[face as usize + 2] += 1;
        }
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut cells = vec![0; self.faces[dimension + 1].len()];
        for cell in 0..self.counts[dimension + 1] {
            for &face in self.faces(dimension + 1, cell) {
                let slot = &mut starts[face as usize + 1];
                cells[*slot as usize] = cell as u32;
                *slot += 1;
            }
        }
        Cofaces { starts, cells }
    }
}

/// The cells around each cell of a dimension.
pub(super) struct Cofaces {
    starts: Vec<u32>,
    cells: Vec<u32>,
}

impl Cofaces {
    /// The cells of which a cell is a face, ascending.
    pub(super) fn of(&self, cell: usize) -> &[u32] {
        &self.cells[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}
