//! Triangles in the columns of a lattice along the light, found by place.
//!
//! # What it promises
//! Every triangle that a way through the lattice has before or behind it, along the light, is found from the
//! columns that the way passes. Memory is bounded by the triangles: where columns of a voxel's width would
//! hold too many of them, columns are 2, 4, 8, ... voxels wide.
//!
//! # Complexity
//! To make, linear in the triangles and in the columns that hold them.

use std::ops::RangeInclusive;

use glam::DVec3;
use rayon::prelude::*;

use super::prisms::Prism;

/// Entries of all columns, for each triangle and beyond a constant.
const ENTRIES: usize = 16;

/// Entries that there may be besides: so few triangles may fill any lattice of usual size.
const MORE_ENTRIES: usize = 1 << 20;

/// Triangles by columns.
#[derive(Debug)]
pub(super) struct Columns {
    prisms: Vec<Prism>,
    grid: Grid,
    /// Where the entries of each column start, and where the last ends; columns along the first axis stand
    /// together.
    starts: Vec<u32>,
    entries: Vec<u32>,
}

/// Columns across the light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    size: [usize; 2],
    /// In voxels.
    width: f64,
}

impl Grid {
    /// How many columns there are.
    pub(super) fn count(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The middle of a column.
    pub(super) fn middle(&self, column: usize) -> DVec3 {
        let at = |index: usize| (index as f64 + 0.5) * self.width;
        DVec3::new(at(column % self.size[0]), at(column / self.size[0]), 0.0)
    }

    /// Calls `visit` with each column of a box; a box outside is moved to the border.
    #[inline]
    pub(super) fn between(&self, low: DVec3, high: DVec3, mut visit: impl FnMut(usize)) {
        for j in self.span(1, low.y, high.y) {
            for i in self.span(0, low.x, high.x) {
                visit(j * self.size[0] + i);
            }
        }
    }

    /// Calls `visit` with the borders of each row of columns between two coordinates.
    pub(super) fn rows(&self, low: f64, high: f64, mut visit: impl FnMut([f64; 2])) {
        for j in self.span(1, low, high) {
            visit([j, j + 1].map(|j| j as f64 * self.width));
        }
    }

    /// Which columns along an axis lie between two coordinates; those outside are moved to the border.
    #[inline]
    fn span(&self, axis: usize, low: f64, high: f64) -> RangeInclusive<usize> {
        // The casts saturate, and what is no number is 0.
        let at = |v: f64| ((v / self.width) as usize).min(self.size[axis] - 1);
        at(low)..=at(high)
    }

    /// Calls `visit` with each column that a prism, of a triangle with given bounds, may meet.
    pub(super) fn meeting(&self, prism: &Prism, [low, high]: &[DVec3; 2], mut visit: impl FnMut(usize)) {
        for j in self.span(1, low.y, high.y) {
            for i in self.span(0, low.x, high.x) {
                let corner = |i: usize, j: usize| [i as f64 * self.width, j as f64 * self.width];
                if prism.may_meet(corner(i, j), corner(i + 1, j + 1)) {
                    visit(j * self.size[0] + i);
                }
            }
        }
    }
}

impl Columns {
    /// Columns of a lattice with so many voxels across, of triangles in lattice coordinates.
    pub(super) fn new(corners: &[[DVec3; 3]], [nx, ny]: [usize; 2]) -> Self {
        let prism = |triangle: &[DVec3; 3]| {
            let [a, b, c] = *triangle;
            Some((Prism::new(triangle)?, [a.min(b).min(c), a.max(b).max(c)]))
        };
        let found: Vec<(Prism, [DVec3; 2])> =
            corners.par_iter().with_min_len(4096).filter_map(prism).collect();
        let most = (ENTRIES * found.len() + MORE_ENTRIES).min(u32::MAX as usize);
        let mut grid = Grid { size: [nx.max(1), ny.max(1)], width: 1.0 };
        let mut counts = grid.counts(&found, most);
        while counts.is_none() {
            grid = Grid { size: grid.size.map(|n| n.div_ceil(2)), width: 2.0 * grid.width };
            counts = grid.counts(&found, most);
        }
        let mut starts = counts.unwrap_or_default();
        let mut start = 0;
        for count in &mut starts {
            start += std::mem::replace(count, start);
        }
        let mut entries = vec![0; start as usize];
        let mut next = starts.clone();
        for ((prism, bounds), index) in found.iter().zip(0_u32..) {
            grid.meeting(prism, bounds, |column| {
                entries[next[column] as usize] = index;
                next[column] += 1;
            });
        }
        let prisms = found.into_iter().map(|(prism, _)| prism).collect();
        Self { prisms, grid, starts, entries }
    }

    /// Whether columns of a voxel's width would have no more than so many entries, by the boxes around the
    /// triangles.
    pub(super) fn entries_at_most(corners: &[[DVec3; 3]], [nx, ny]: [usize; 2], most: usize) -> bool {
        let grid = Grid { size: [nx.max(1), ny.max(1)], width: 1.0 };
        let mut sum = 0;
        corners.iter().all(|[a, b, c]| {
            let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
            let across = |axis: usize| {
                let columns = grid.span(axis, low[axis], high[axis]);
                columns.end() + 1 - columns.start()
            };
            sum += across(0) * across(1);
            sum <= most
        })
    }

    pub(super) fn grid(&self) -> &Grid {
        &self.grid
    }

    pub(super) fn prism(&self, index: u32) -> &Prism {
        &self.prisms[index as usize]
    }

    /// The triangles of the column that holds a point, ascending; a point outside is moved to the border.
    #[inline]
    pub(super) fn at(&self, x: f64, y: f64) -> &[u32] {
        let (i, j) = (*self.grid.span(0, x, x).start(), *self.grid.span(1, y, y).start());
        self.column(i, j)
    }

    fn column(&self, i: usize, j: usize) -> &[u32] {
        let column = j * self.grid.size[0] + i;
        &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize]
    }

    /// Finds the triangles of all columns that the box around a way may pass, ascending; false if one of the
    /// columns has more than `most`.
    #[inline]
    pub(super) fn along(&self, from: DVec3, to: DVec3, most: usize, found: &mut Vec<u32>) -> bool {
        found.clear();
        let (low, high) = (from.min(to), from.max(to));
        let mut several = false;
        for j in self.grid.span(1, low.y, high.y) {
            for i in self.grid.span(0, low.x, high.x) {
                let column = self.column(i, j);
                if column.len() > most {
                    return false;
                }
                several |= !found.is_empty() && !column.is_empty();
                found.extend_from_slice(column);
            }
        }
        if several {
            found.sort_unstable();
            found.dedup();
        }
        true
    }
}

impl Grid {
    /// How many prisms each column may meet, and a 0 at the end; none if they are more than so many together
    /// and columns can be wider.
    fn counts(&self, found: &[(Prism, [DVec3; 2])], most: usize) -> Option<Vec<u32>> {
        let mut counts = vec![0_u32; self.size[0] * self.size[1] + 1];
        let mut sum = 0;
        for (prism, bounds) in found {
            self.meeting(prism, bounds, |column| {
                counts[column] += 1;
                sum += 1;
            });
            if sum > most && self.size != [1, 1] {
                return None;
            }
        }
        Some(counts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(count: usize, spread: f64) -> Vec<[DVec3; 3]> {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let triangle = |_| {
            let middle = 4.0 + 12.0 * DVec3::new(random(), random(), random());
            [0, 1, 2].map(|_| middle + spread * (DVec3::new(random(), random(), random()) - 0.5))
        };
        (0..count).map(triangle).collect()
    }

    #[test]
    fn whatever_a_way_meets_is_found() {
        let corners = triangles(300, 6.0);
        let columns = Columns::new(&corners, [20, 20]);
        let (mut found, mut met) = (Vec::new(), 0);
        for way in triangles(400, 1.5) {
            let (from, to) = (way[0], way[1]);
            assert!(columns.along(from, to, usize::MAX, &mut found));
            assert!(found.is_sorted_by(|a, b| a < b));
            for (index, corners) in (0_u32..).zip(&corners) {
                let prism = Prism::new(corners).expect("no triangle stands upright by chance");
                assert_eq!(prism, *columns.prism(index));
                if prism.below(from, to).is_some() {
                    met += 1;
                    assert!(found.binary_search(&index).is_ok(), "{from} {to} {index}");
                }
                if prism.is_below(from) {
                    assert!(columns.at(from.x, from.y).contains(&index), "{from} {index}");
                }
            }
        }
        assert!(met > 1000, "{met}");
    }

    #[test]
    fn large_triangles_make_wide_columns() {
        let corners = triangles(400, 4000.0);
        let columns = Columns::new(&corners, [512, 512]);
        assert!(columns.grid.width > 1.0 && columns.entries.len() <= 400 * ENTRIES + MORE_ENTRIES);
        assert!(columns.at(17.0, 500.0).len() > 10);
        assert!(Columns::new(&[], [3, 2]).at(1.0, f64::NAN).is_empty());
    }
}
