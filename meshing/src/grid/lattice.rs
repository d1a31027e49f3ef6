//! [`Grid`]: where the nodes and the cells of a regular grid are, and how they are numbered.
//!
//! # When nodes are exact
//! Let `g` be the largest power of two of which both the origin and the spacing are multiples. All nodes are multiples of `g`, and so is every
//! `i * spacing`. A multiple of `g` is an `f64` if it is at most `2^53 g` (and `g` at least the smallest number). So
//! `origin + i * spacing` has neither a rounded product nor a rounded sum if the first and last coordinates and their difference
//! are less than `2^53 g`: that is what [`Grid::new`] checks. Its own sums may be rounded, but not to below `2^53 g` from there or
//! above, since that is an `f64`; up to `2^53 g`, from `2^53 g + g`, they may.

use glam::{DVec2, DVec3};

use super::GridError;
use crate::shapes::{MAX_LENGTH, MIN_LENGTH};

/// Most cells along one axis: node numbers along an axis take 21 bits, so that three of them fit into a key of 64 bits.
pub const MAX_CELLS_ALONG_AXIS: u32 = (1 << 21) - 2;

/// Most nodes of a grid: half a terabyte of samples.
pub const MAX_NODES: u64 = 1 << 36;

/// Significant bits of a spacing that [`Grid::covering`] chooses: with them, multiples up to 2^29 are exact.
const SPACING_BITS: u32 = 24;

/// A regular grid of `D` dimensions with the same spacing along each axis, whose nodes have exact coordinates.
///
/// ```
/// use welter_meshing::grid::Grid3;
/// let grid = Grid3::covering([-1.0; 3], [1.0; 3], 0.1, 1)?;
/// assert_eq!(grid.cells(), [22; 3]);
/// assert_eq!(grid.nodes(), [23; 3]);
/// assert!(grid.max()[0] >= 1.0 + grid.spacing());
/// let index = [4, 5, 6];
/// assert_eq!(grid.node_at(grid.node_index(index)), index);
/// assert_eq!(grid.position(index).x, grid.origin()[0] + 4.0 * grid.spacing());
/// # Ok::<(), welter_meshing::grid::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    origin: [f64; D],
    spacing: f64,
    cells: [u32; D],
}

/// A grid of squares.
pub type Grid2 = Grid<2>;

/// A grid of cubes.
pub type Grid3 = Grid<3>;

impl<const D: usize> Grid<D> {
    /// The grid with its first node at `origin` and `cells` cells along each axis.
    ///
    /// # Errors
    /// [`GridError`] for numbers out of range, and if a node has no exact coordinates.
    pub fn new(origin: [f64; D], spacing: f64, cells: [u32; D]) -> Result<Self, GridError> {
        require_spacing(spacing)?;
        require_coordinates(origin)?;
        for (axis, &count) in cells.iter().enumerate() {
            if count == 0 || count > MAX_CELLS_ALONG_AXIS {
                return Err(GridError::Cells { axis, cells: f64::from(count) });
            }
        }
        let nodes: f64 = cells.iter().map(|&n| f64::from(n + 1)).product();
        if nodes > MAX_NODES as f64 {
            return Err(GridError::Nodes { nodes });
        }
        let grid = Self { origin, spacing, cells };
        for axis in 0..D {
            if !exact(origin[axis], spacing, cells[axis]) {
                return Err(GridError::Inexact { axis, origin: origin[axis], spacing });
            }
        }
        Ok(grid)
    }

    /// The smallest grid that covers the box from `min` to `max` and `margin` more cells on every side. The spacing is rounded to
    /// 24 significant bits, and the nodes are multiples of it.
    ///
    /// # Errors
    /// [`GridError`] for numbers out of range, and for a box so far from zero that multiples of the spacing there are not exact.
    pub fn covering(min: [f64; D], max: [f64; D], spacing: f64, margin: u32) -> Result<Self, GridError> {
        require_spacing(spacing)?;
        require_coordinates(min)?;
        require_coordinates(max)?;
        let spacing = rounded_to_bits(spacing);
        let (mut origin, mut cells) = ([0.0; D], [0; D]);
        for axis in 0..D {
            let (min, max) = (min[axis], max[axis]);
            if min > max {
                return Err(GridError::Inverted { axis, min, max });
            }
            // The quotients may be rounded past a node: compare the node itself.
            let mut first = (min / spacing).floor();
            first -= f64::from(u8::from(first * spacing > min));
            let mut last = (max / spacing).ceil();
            last += f64::from(u8::from(last * spacing < max));
            last += f64::from(u8::from(last <= first));
            let (first, last) = (first - f64::from(margin), last + f64::from(margin));
            let count = last - first;
            if count > f64::from(MAX_CELLS_ALONG_AXIS) {
                return Err(GridError::Cells { axis, cells: count });
            }
            origin[axis] = first * spacing;
            cells[axis] = count as u32;
        }
        Self::new(origin, spacing, cells)
    }

    /// The coordinates of the first node.
    #[must_use]
    pub fn origin(&self) -> [f64; D] {
        self.origin
    }

    /// The coordinates of the last node.
    #[must_use]
    pub fn max(&self) -> [f64; D] {
        std::array::from_fn(|axis| self.coordinate(axis, self.cells[axis]))
    }

    /// Distance between neighbouring nodes.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Number of cells along each axis.
    #[must_use]
    pub fn cells(&self) -> [u32; D] {
        self.cells
    }

    /// Number of nodes along each axis, one more than cells.
    #[must_use]
    pub fn nodes(&self) -> [u32; D] {
        self.cells.map(|n| n + 1)
    }

    /// Number of cells in all.
    #[must_use]
    pub fn cell_count(&self) -> usize {
        self.cells.iter().map(|&n| n as usize).product()
    }

    /// Number of nodes in all.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.cells.iter().map(|&n| n as usize + 1).product()
    }

    /// Coordinate of the `i`-th node along an axis. Exact for nodes of the grid.
    #[inline]
    #[must_use]
    pub fn coordinate(&self, axis: usize, i: u32) -> f64 {
        self.origin[axis] + f64::from(i) * self.spacing
    }

    /// The coordinates of a node. Exact.
    #[inline]
    #[must_use]
    pub fn node(&self, index: [u32; D]) -> [f64; D] {
        std::array::from_fn(|axis| self.coordinate(axis, index[axis]))
    }

    /// The number of a node among all nodes, x fastest.
    #[inline]
    #[must_use]
    pub fn node_index(&self, index: [u32; D]) -> usize {
        (0..D).rev().fold(0, |number, axis| number * (self.cells[axis] as usize + 1) + index[axis] as usize)
    }

    /// The node with a number: the reverse of [`Grid::node_index`].
    #[inline]
    #[must_use]
    pub fn node_at(&self, mut number: usize) -> [u32; D] {
        std::array::from_fn(|axis| {
            let nodes = self.cells[axis] as usize + 1;
            let i = number % nodes;
            number /= nodes;
            i as u32
        })
    }

    /// The number of a cell among all cells, x fastest. A cell has the index of its first node.
    #[inline]
    #[must_use]
    pub fn cell_index(&self, index: [u32; D]) -> usize {
        (0..D).rev().fold(0, |number, axis| number * self.cells[axis] as usize + index[axis] as usize)
    }

    /// The cell with a number: the reverse of [`Grid::cell_index`].
    #[inline]
    #[must_use]
    pub fn cell_at(&self, mut number: usize) -> [u32; D] {
        std::array::from_fn(|axis| {
            let i = number % self.cells[axis] as usize;
            number /= self.cells[axis] as usize;
            i as u32
        })
    }

    /// The first axis along which the middles between nodes may have no exact coordinates.
    pub(crate) fn axis_of_inexact_middles(&self) -> Option<usize> {
        (0..D).find(|&axis| !exact(self.origin[axis], self.spacing / 2.0, 2 * self.cells[axis]))
    }

    /// The cell whose closed region holds the point or is next to it, and where the point is in that cell, from 0 to 1 along each
    /// axis: points outside of the grid are taken to the nearest point of it; NaN counts as the origin.
    #[must_use]
    pub fn locate(&self, point: [f64; D]) -> ([u32; D], [f64; D]) {
        let (mut cell, mut inside) = ([0; D], [0.0; D]);
        for axis in 0..D {
            let along = (point[axis] - self.origin[axis]) / self.spacing;
            let along = along.clamp(0.0, f64::from(self.cells[axis]));
            let first = (along as u32).min(self.cells[axis] - 1);
            cell[axis] = first;
            inside[axis] = if along.is_nan() { 0.0 } else { along - f64::from(first) };
        }
        (cell, inside)
    }
}

impl Grid<3> {
    /// The coordinates of a node as a vector. Exact.
    #[inline]
    #[must_use]
    pub fn position(&self, index: [u32; 3]) -> DVec3 {
        DVec3::from_array(self.node(index))
    }
}

impl Grid<2> {
    /// The coordinates of a node as a vector. Exact.
    #[inline]
    #[must_use]
    pub fn position(&self, index: [u32; 2]) -> DVec2 {
        DVec2::from_array(self.node(index))
    }
}

fn require_spacing(spacing: f64) -> Result<(), GridError> {
    if (MIN_LENGTH..=MAX_LENGTH).contains(&spacing) { Ok(()) } else { Err(GridError::Spacing { spacing }) }
}

fn require_coordinates<const D: usize>(point: [f64; D]) -> Result<(), GridError> {
    match point.iter().position(|c| c.is_nan() || c.abs() > MAX_LENGTH) {
        Some(axis) => Err(GridError::Coordinate { axis, value: point[axis] }),
        None => Ok(()),
    }
}

/// The nearest number of [`SPACING_BITS`] significant bits; `spacing` is far from overflow.
fn rounded_to_bits(spacing: f64) -> f64 {
    let shift = f64::MANTISSA_DIGITS - SPACING_BITS;
    let half = 1_u64 << (shift - 1);
    f64::from_bits((spacing.to_bits() + half) & !((1 << shift) - 1))
}

/// Whether all nodes along an axis have exact coordinates: see the head.
fn exact(origin: f64, spacing: f64, cells: u32) -> bool {
    let granule = lowest_bit(origin).map_or(lowest_bit(spacing), |o| lowest_bit(spacing).map(|s| o.min(s)));
    let Some(granule) = granule else { return false };
    let length = f64::from(cells) * spacing;
    let reach = origin.abs().max((origin + length).abs()).max(length);
    // The granule may be below the smallest normal number only where coordinates are as small; spacings are not.
    reach < libm::ldexp(1.0, granule + 53)
}

/// The exponent of the lowest set bit of a number; `None` for zero.
fn lowest_bit(x: f64) -> Option<i32> {
    if x == 0.0 {
        return None;
    }
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let significand = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    Some(exponent.max(1) - 1075 + significand.trailing_zeros() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_covering_grid_covers_and_its_nodes_are_exact() {
        for (min, max, spacing, margin) in [
            ([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0], 0.1, 0),
            ([0.3, 1e6, -2e-3], [0.3, 1e6 + 3.0, 5.0], 0.037, 2),
            ([-1e-9, 0.0, 7.0], [1e-9, 1e-8, 7.0 + 1e-7], 1e-9 / 3.0, 1),
        ] {
            let Ok(grid) = Grid3::covering(min, max, spacing, margin) else {
                assert_eq!(min[2], 7.0, "only the last box is too far away for its spacing");
                continue;
            };
            assert!((grid.spacing() - spacing).abs() <= spacing * 2f64.powi(-24));
            for axis in 0..3 {
                let reach = f64::from(margin) * grid.spacing();
                assert!(grid.origin()[axis] <= min[axis] - reach && grid.max()[axis] >= max[axis] + reach);
                for i in 0..grid.cells()[axis] {
                    // The difference of neighbours is the spacing itself: no node was rounded.
                    let step = grid.coordinate(axis, i + 1) - grid.coordinate(axis, i);
                    assert_eq!(step, grid.spacing());
                }
            }
        }
    }

    #[test]
    fn inexact_grids_are_refused() {
        assert!(matches!(Grid3::new([0.0; 3], 0.1, [1000; 3]), Err(GridError::Inexact { axis: 0, .. })));
        assert!(matches!(Grid2::new([0.0, 1e-20], 0.125, [8; 2]), Err(GridError::Inexact { axis: 1, .. })));
        assert!(Grid2::new([-0.5, 1e6], 0.125, [8; 2]).is_ok());
        assert!(matches!(
            Grid2::new([f64::NAN, 0.0], 1.0, [1; 2]),
            Err(GridError::Coordinate { axis: 0, .. })
        ));
        assert!(matches!(Grid2::new([0.0; 2], f64::INFINITY, [1; 2]), Err(GridError::Spacing { .. })));
        assert!(matches!(Grid2::new([0.0; 2], 1.0, [1, 0]), Err(GridError::Cells { axis: 1, .. })));
        assert!(matches!(Grid2::covering([1.0; 2], [0.0; 2], 1.0, 0), Err(GridError::Inverted { .. })));
        assert!(matches!(Grid2::covering([0.0; 2], [1e70; 2], 1e-70, 0), Err(GridError::Cells { .. })));
    }

    #[test]
    fn a_grid_is_refused_if_its_last_node_is_rounded_to_where_the_last_exact_one_would_be() {
        let limit = 2f64.powi(53);
        // The last node is 2^53 + 1: as a sum, as a product, and as a product that the sum hides.
        for (origin, spacing, cells) in [
            (limit - 2.0, 1.0, 3),
            (0.0, 3_002_399_751_580_331.0, 3),
            (-limit, 3_002_399_751_580_331.0, 3),
            (-limit - 2.0, 1.0, 2),
        ] {
            let of = |scale: f64| Grid2::new([0.0, origin * scale], spacing * scale, [1, cells]);
            for scale in [1.0, 0.25, 2f64.powi(100), 2f64.powi(-180)] {
                assert!(matches!(of(scale), Err(GridError::Inexact { axis: 1, .. })), "{origin} {spacing}");
            }
        }
        let nearest = Grid2::new([limit - 4.0, 1.0 - limit], 1.0, [3, 3]).unwrap();
        assert_eq!(nearest.max(), [limit - 1.0, 4.0 - limit]);
    }

    #[test]
    fn numbers_and_indices_are_reverses() {
        let grid = Grid3::new([0.0; 3], 0.5, [3, 4, 5]).unwrap();
        assert!((0..grid.node_count()).all(|n| grid.node_index(grid.node_at(n)) == n));
        assert!((0..grid.cell_count()).all(|n| grid.cell_index(grid.cell_at(n)) == n));
        assert_eq!(grid.node_at(1), [1, 0, 0]);
    }

    #[test]
    fn points_are_located_in_a_cell_that_holds_them() {
        let grid = Grid2::new([1.0, 2.0], 0.5, [4, 4]).unwrap();
        assert_eq!(grid.locate([1.75, 2.0]), ([1, 0], [0.5, 0.0]));
        assert_eq!(grid.locate([3.0, 9.0]), ([3, 3], [1.0, 1.0]));
        assert_eq!(grid.locate([-1.0, f64::NAN]), ([0, 0], [0.0, 0.0]));
    }
}
