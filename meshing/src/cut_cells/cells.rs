//! [`CutCells`]: which cells of a grid are cut, which are inside, and where the vertices are.

use std::ops::Range;

use rayon::prelude::*;

use super::CutCell;
use crate::grid::{Grid3, Samples};
use crate::isosurface::{CellCase, CellPoint, IsosurfaceError, MarchingCubes, MixedCells};
use crate::{DVec3, Monitor};

/// One cut cell: its place in its row, its case, and where the list of its samples begins.
#[derive(Clone, Copy, Debug)]
struct Record {
    i: u32,
    first: u32,
    case: CellCase,
}

/// What a cell of the grid is.
#[derive(Clone, Copy, Debug)]
pub enum CellKind<'a> {
    /// All corners are below the level.
    Inside,
    /// No corner is below the level.
    Outside,
    /// The surface passes through.
    Cut(CutCell<'a>),
}

/// The cells of a grid that the surface of samples cuts, and those inside of it.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}, isosurface::MarchingCubes};
/// use welter_meshing::cut_cells::{CellKind, CutCells};
/// let grid = Grid3::new([0.0; 3], 0.5, [4; 3])?;
/// let samples = Samples::of(&grid, &|p: DVec3| p.z - 0.75, &Monitor::none())?;
/// let cells = CutCells::new(&samples, &MarchingCubes::default(), &Monitor::none())?;
/// assert_eq!(cells.len(), 16); // the layer from 0.5 to 1
/// assert!(matches!(cells.kind([1, 2, 0]), CellKind::Inside));
/// let CellKind::Cut(cell) = cells.kind([1, 2, 1]) else { panic!() };
/// assert!((cell.volume() - 0.5 * 0.5 * 0.25).abs() < 1e-16);
/// assert!((cell.area() - 0.25).abs() < 1e-16);
/// assert!((cells.volume() - 2.0 * 2.0 * 0.75).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CutCells {
    grid: Grid3,
    positions: Vec<DVec3>,
    records: Vec<Record>,
    /// Numbers of samples of all records behind one another.
    samples: Vec<u32>,
    /// Where each row of cells begins among the records, and the end.
    rows: Vec<u32>,
    /// Whether the first node of each row of cells is negative.
    begins_inside: Vec<bool>,
}

/// What a layer of cells contributes.
#[derive(Default)]
struct Layer {
    records: Vec<Record>,
    samples: Vec<u32>,
    /// Records of each row.
    rows: Vec<u32>,
}

impl CutCells {
    /// Cuts the cells.
    ///
    /// # Errors
    /// As [`marching_cubes_open`](crate::isosurface::marching_cubes_open); [`IsosurfaceError::TooMany`] too for more than 2^32 samples of cells.
    pub fn new(
        samples: &Samples<3>,
        parameters: &MarchingCubes<'_>,
        monitor: &Monitor<'_>,
    ) -> Result<Self, IsosurfaceError> {
        let grid = *samples.grid();
        let mixed = MixedCells::new(samples, parameters, monitor)?;
        let [_, ny, nz] = grid.cells();
        let stage = monitor.stage("cut cells", u64::from(nz));
        let layers: Vec<Layer> = (0..nz)
            .into_par_iter()
            .map(|k| {
                stage.check()?;
                let layer = layer(&mixed, k, ny);
                stage.advance(1);
                Ok(layer)
            })
            .collect::<Result<_, IsosurfaceError>>()?;
        let count: usize = layers.iter().map(|layer| layer.samples.len()).sum();
        if count > u32::MAX as usize {
            return Err(IsosurfaceError::TooMany { what: "samples of cells", count: count as u64 });
        }
        let mut cells = Self {
            grid,
            positions: Vec::new(),
            records: Vec::with_capacity(layers.iter().map(|layer| layer.records.len()).sum()),
            samples: Vec::with_capacity(count),
            rows: vec![0],
            begins_inside: (0..nz)
                .flat_map(|k| (0..ny).map(move |j| [0, j, k]))
                .map(|n| mixed.is_negative(n))
                .collect(),
        };
        for layer in layers {
            let shift = cells.samples.len() as u32;
            cells.records.extend(layer.records.iter().map(|r| Record { first: r.first + shift, ..*r }));
            cells.samples.extend(layer.samples);
            for count in layer.rows {
                cells.rows.push(cells.rows[cells.rows.len() - 1] + count);
            }
        }
        cells.positions = mixed.positions(monitor)?;
        Ok(cells)
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid3 {
        &self.grid
    }

    /// The vertices of the surface, in the order of [`marching_cubes_open`](crate::isosurface::marching_cubes_open).
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Number of cut cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether no cell is cut.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// The `n`-th cut cell, in the order of cell numbers.
    ///
    /// # Panics
    /// If there are not that many.
    #[must_use]
    pub fn get(&self, n: usize) -> CutCell<'_> {
        assert!(n < self.len(), "cut cell {n} of {}", self.len());
        let row = self.rows.partition_point(|&first| first as usize <= n) - 1;
        self.cell_of(row, n)
    }

    /// All cut cells, in the order of cell numbers.
    pub fn iter(&self) -> impl Iterator<Item = CutCell<'_>> {
        (0..self.rows.len() - 1).flat_map(move |row| self.in_row(row).map(move |n| self.cell_of(row, n)))
    }

    /// What a cell of the grid is. O(log n) in the cut cells of its row.
    ///
    /// # Panics
    /// If the grid has no such cell.
    #[must_use]
    pub fn kind(&self, index: [u32; 3]) -> CellKind<'_> {
        let [i, j, k] = index;
        let [nx, ny, nz] = self.grid.cells();
        assert!(i < nx && j < ny && k < nz, "cell {index:?} of a grid of {:?}", self.grid.cells());
        let row = j as usize + ny as usize * k as usize;
        let range = self.in_row(row);
        let before = self.records[range.clone()].partition_point(|record| record.i < i);
        let n = range.start + before;
        if n < range.end && self.records[n].i == i {
            return CellKind::Cut(self.cell_of(row, n));
        }
        let inside =
            if before == 0 { self.begins_inside[row] } else { ends_inside(self.records[n - 1].case) };
        if inside { CellKind::Inside } else { CellKind::Outside }
    }

    /// The cells whose corners are all below the level, as runs along x: `j`, `k` and the range of `i`.
    pub fn inside_runs(&self) -> impl Iterator<Item = ([u32; 2], Range<u32>)> + '_ {
        let [nx, ny, _] = self.grid.cells();
        (0..self.rows.len() - 1).flat_map(move |row| {
            let mut runs = Vec::new();
            let (mut start, mut inside) = (0, self.begins_inside[row]);
            for record in &self.records[self.in_row(row)] {
                if inside && start < record.i {
                    runs.push(start..record.i);
                }
                (start, inside) = (record.i + 1, ends_inside(record.case));
            }
            if inside && start < nx {
                runs.push(start..nx);
            }
            let at = [row as u32 % ny, row as u32 / ny];
            runs.into_iter().map(move |run| (at, run))
        })
    }

    /// Number of cells whose corners are all below the level.
    #[must_use]
    pub fn inside_count(&self) -> u64 {
        self.inside_runs().map(|(_, run)| u64::from(run.end - run.start)).sum()
    }

    /// Volume of the part of the grid below the level.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let cut: f64 = self.iter().map(|cell| cell.volume()).sum();
        self.inside_count() as f64 * self.grid.spacing().powi(3) + cut
    }

    /// Area of the surface, the grid's wall excluded.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.iter().map(|cell| cell.area()).sum()
    }

    fn in_row(&self, row: usize) -> Range<usize> {
        self.rows[row] as usize..self.rows[row + 1] as usize
    }

    fn cell_of(&self, row: usize, n: usize) -> CutCell<'_> {
        let Record { i, first, case } = self.records[n];
        let ny = self.grid.cells()[1] as usize;
        let end = self.records.get(n + 1).map_or(self.samples.len(), |next| next.first as usize);
        CutCell {
            cells: self,
            index: [i, (row % ny) as u32, (row / ny) as u32],
            case,
            samples: &self.samples[first as usize..end],
        }
    }
}

/// Whether the cell behind a cut one, which is not cut itself, is negative: its corners are those on the upper side.
fn ends_inside(case: CellCase) -> bool {
    case.is_negative(1)
}

fn layer(mixed: &MixedCells<'_>, k: u32, ny: u32) -> Layer {
    let mut layer = Layer { rows: vec![0; ny as usize], ..Layer::default() };
    mixed.for_each_in_layer(k, |[i, j, _], case, numbers| {
        layer.rows[j as usize] += 1;
        layer.records.push(Record { i, first: layer.samples.len() as u32, case });
        for edge in 0..12 {
            let [a, b] = CellPoint::Edge(edge).ends();
            if case.is_negative(a) != case.is_negative(b) {
                layer.samples.push(numbers[usize::from(edge)]);
            }
        }
    });
    layer
}
