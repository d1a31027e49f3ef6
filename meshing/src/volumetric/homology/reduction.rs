//! Pairs of cells that can be left out without changing homology: [`Reduction`].
//!
//! A cell `t` with a face `s` can be left out together with it, and nothing else changes, if `s` is the face of no other cell that is left
//! (a collapse) or if `t` has no other face that is left (a coreduction): in the general step of \[Kaczynski98\] the correction
//! of the other boundaries is empty then. Coreductions begin once a vertex of each component has been left out, which takes one from the
//! first Betti number of that component \[Mrozek09\]. Each cell is left out once, so the time is linear.

use std::collections::VecDeque;

use super::super::complex::NONE;
use super::chains::{Chains, Cofaces};
use crate::{Cancelled, Monitor};

/// Pairs taken between two looks at the monitor.
const BATCH: u32 = 1 << 14;

/// A complex of which cells are left out.
pub(super) struct Reduction<'a> {
    chains: &'a Chains,
    cofaces: [Cofaces; 3],
    left: [Vec<bool>; 4],
    /// How many faces and how many cofaces of each cell are left.
    faces: [Vec<u8>; 4],
    around: [Vec<u32>; 4],
    /// Cells, by dimension and number, that came to have one coface or one face.
    collapses: VecDeque<(u8, u32)>,
    coreductions: VecDeque<(u8, u32)>,
}

impl<'a> Reduction<'a> {
    /// Nothing left out yet, but for vertices that no cell has.
    pub(super) fn new(chains: &'a Chains) -> Self {
        let cofaces = [0, 1, 2].map(|dimension| chains.cofaces(dimension));
        let each = [0, 1, 2, 3];
        let mut left = each.map(|d| vec![true; chains.counts[d]]);
        for (vertex, left) in left[0].iter_mut().enumerate() {
            *left = chains.component(0, vertex) != NONE;
        }
        let around = each.map(|d| {
            (0..chains.counts[d]).map(|cell| cofaces.get(d).map_or(0, |c| c.of(cell).len() as u32)).collect()
        });
        let faces =
            each.map(|d| (0..chains.counts[d]).map(|cell| chains.faces(d, cell).len() as u8).collect());
        Self {
            chains,
            cofaces,
            left,
            faces,
            around,
            collapses: VecDeque::new(),
            coreductions: VecDeque::new(),
        }
    }

    /// Leaves out all that collapses and coreductions can, and a vertex of each of the components.
    pub(super) fn run(&mut self, components: usize, monitor: &Monitor<'_>) -> Result<(), Cancelled> {
        for dimension in (0..3).rev() {
            for cell in 0..self.chains.counts[dimension] {
                if self.around[dimension][cell] == 1 {
                    self.collapses.push_back((dimension as u8, cell as u32));
                }
            }
        }
        self.collapse(monitor)?;
        let mut begun = vec![false; components];
        for vertex in 0..self.chains.counts[0] {
            let component = self.chains.component(0, vertex);
            if self.left[0][vertex] && !begun[component as usize] {
                begun[component as usize] = true;
                self.leave_out(0, vertex);
            }
        }
        while !(self.collapses.is_empty() && self.coreductions.is_empty()) {
            self.coreduce(monitor)?;
            self.collapse(monitor)?;
        }
        Ok(())
    }

    /// The cells of a dimension that are left, ascending.
    pub(super) fn left(&self, dimension: usize) -> Vec<u32> {
        (0..self.chains.counts[dimension] as u32).filter(|&c| self.left[dimension][c as usize]).collect()
    }

    fn collapse(&mut self, monitor: &Monitor<'_>) -> Result<(), Cancelled> {
        let mut taken = 0_u32;
        while let Some((dimension, cell)) = self.collapses.pop_front() {
            let (dimension, cell) = (dimension as usize, cell as usize);
            if !self.left[dimension][cell] || self.around[dimension][cell] != 1 {
                continue;
            }
            let around = self.cofaces[dimension].of(cell);
            let other = around.iter().find(|&&c| self.left[dimension + 1][c as usize]);
            let other = *other.expect("one coface is counted as left");
            self.leave_out(dimension + 1, other as usize);
            self.leave_out(dimension, cell);
            taken += 1;
            if taken.is_multiple_of(BATCH) {
                monitor.check()?;
            }
        }
        Ok(())
    }

    fn coreduce(&mut self, monitor: &Monitor<'_>) -> Result<(), Cancelled> {
        let mut taken = 0_u32;
        while let Some((dimension, cell)) = self.coreductions.pop_front() {
            let (dimension, cell) = (dimension as usize, cell as usize);
            if !self.left[dimension][cell] || self.faces[dimension][cell] != 1 {
                continue;
            }
            let faces = self.chains.faces(dimension, cell);
            let other = faces.iter().find(|&&f| self.left[dimension - 1][f as usize]);
            let other = *other.expect("one face is counted as left");
            self.leave_out(dimension, cell);
            self.leave_out(dimension - 1, other as usize);
            taken += 1;
            if taken.is_multiple_of(BATCH) {
                monitor.check()?;
            }
        }
        Ok(())
    }

    fn leave_out(&mut self, dimension: usize, cell: usize) {
        self.left[dimension][cell] = false;
        for &face in self.chains.faces(dimension, cell) {
            let around = &mut self.around[dimension - 1][face as usize];
            *around -= 1;
            if *around == 1 && self.left[dimension - 1][face as usize] {
                self.collapses.push_back((dimension as u8 - 1, face));
            }
        }
        if dimension == 3 {
            return;
        }
        for &coface in self.cofaces[dimension].of(cell) {
            let faces = &mut self.faces[dimension + 1][coface as usize];
            *faces -= 1;
            if *faces == 1 && self.left[dimension + 1][coface as usize] {
                self.coreductions.push_back((dimension as u8 + 1, coface));
            }
        }
    }
}
