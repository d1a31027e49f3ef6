//! The hexahedra of a solid, from its own connectivity: [`Unfolded`].
//!
//! A hexahedron is a connected part of the solid in a cell of the moved grid. Two tetrahedra with a common side are in one part if the side
//! meets the cell. Two parts in neighbouring cells hang together if one tetrahedron is in both: what of it lies in
//! the two cells is convex, so that it passes through their common side. All that is asked is whether a cell meets a triangle, and on
//! which side of a plane a node lies; both are exact.

use welter_meshing::grid::Grid3;
use welter_predicates::Sign;
use welter_predicates::moved_grid::{moved_box_meets_triangle, orient3d_moved};

use super::{Sets, Solid};

/// The hexahedra of a solid.
#[derive(Clone, Debug, Default)]
pub struct Unfolded {
    /// Cell and tetrahedron, sorted, for all pairs that meet.
    pub pairs: Vec<(usize, u32)>,
    /// The hexahedron of each pair.
    pub hexahedra: Vec<usize>,
    /// The cell of each hexahedron, ascending.
    pub cells: Vec<usize>,
    /// Two hexahedra with a common side, the second behind the first along an axis; sorted.
    pub sides: Vec<([usize; 2], usize)>,
}

/// Along an axis, the first and the last cell that may hold a coordinate between two.
pub(super) fn cells_along(grid: &Grid3, axis: usize, low: f64, high: f64) -> std::ops::RangeInclusive<u32> {
    let at = |x: f64| ((x - grid.origin()[axis]) / grid.spacing()).floor();
    let most = f64::from(grid.cells()[axis] - 1);
    ((at(low) - 1.0).clamp(0.0, most) as u32)..=((at(high) + 1.0).clamp(0.0, most) as u32)
}

/// Calls `f` with each cell near a box.
pub(super) fn cells_near(grid: &Grid3, points: &[[f64; 3]], mut f: impl FnMut([u32; 3])) {
    let range = |axis: usize| {
        let values = points.iter().map(|p| p[axis]);
        let (low, high) =
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
        cells_along(grid, axis, low, high)
    };
    for k in range(2) {
        for j in range(1) {
            for i in range(0) {
                f([i, j, k]);
            }
        }
    }
}

/// Whether a triangle meets a cell of the moved grid.
pub(super) fn meets(grid: &Grid3, cell: [u32; 3], triangle: [[f64; 3]; 3]) -> bool {
    moved_box_meets_triangle(grid.node(cell), grid.node(cell.map(|i| i + 1)), triangle)
}

impl Unfolded {
    /// The hexahedra on a grid around the solid, of which no tetrahedron is flat.
    #[must_use]
    pub fn new(solid: &Solid, grid: &Grid3) -> Self {
        let mut unfolded = Self::default();
        for t in 0..solid.tets.len() as u32 {
            let corners = solid.places(solid.tets[t as usize]);
            let sides = [0, 1, 2, 3].map(|side| solid.places(solid.side(t, side)));
            cells_near(grid, &corners, |cell| {
                let beside =
                    |side: &[[f64; 3]; 3]| orient3d_moved(side[0], side[1], side[2], grid.node(cell));
                let within = || sides.iter().all(|side| beside(side) == Sign::Positive);
                if sides.iter().any(|&side| meets(grid, cell, side)) || within() {
                    unfolded.pairs.push((grid.cell_index(cell), t));
                }
            });
        }
        unfolded.pairs.sort_unstable();
        unfolded.connect(solid, grid);
        unfolded.join(grid);
        unfolded
    }

    fn place(&self, cell: usize, tet: u32) -> Option<usize> {
        self.pairs.binary_search(&(cell, tet)).ok()
    }

    /// The hexahedron of a tetrahedron in a cell.
    #[must_use]
    pub fn hexahedron(&self, cell: usize, tet: u32) -> Option<usize> {
        Some(self.hexahedra[self.place(cell, tet)?])
    }

    fn connect(&mut self, solid: &Solid, grid: &Grid3) {
        let mut sets = Sets::new(self.pairs.len());
        for (place, &(cell, t)) in self.pairs.iter().enumerate() {
            for (side, &other) in solid.neighbours[t as usize].iter().enumerate() {
                if other > t
                    && let Some(there) = self.place(cell, other)
                    && meets(grid, grid.cell_at(cell), solid.places(solid.side(t, side)))
                {
                    sets.unite(place, there);
                }
            }
        }
        for place in 0..self.pairs.len() {
            let root = sets.root(place);
            if root == place {
                self.hexahedra.push(self.cells.len());
                self.cells.push(self.pairs[place].0);
            } else {
                self.hexahedra.push(self.hexahedra[root]);
            }
        }
    }

    fn join(&mut self, grid: &Grid3) {
        let mut sides = Vec::new();
        for (place, &(cell, t)) in self.pairs.iter().enumerate() {
            for axis in 0..3 {
                let mut behind = grid.cell_at(cell);
                behind[axis] += 1;
                if behind[axis] < grid.cells()[axis]
                    && let Some(other) = self.hexahedron(grid.cell_index(behind), t)
                {
                    sides.push(([self.hexahedra[place], other], axis));
                }
            }
        }
        sides.sort_unstable();
        sides.dedup();
        self.sides = sides;
    }
}
