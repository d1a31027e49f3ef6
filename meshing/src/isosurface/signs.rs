//! [`Signs`]: which nodes of a grid are negative, one bit a node, and which number the sample on an edge has.
//!
//! # Numbers of vertices
//! Row `(j, k)` of nodes along x owns, in this order: the samples on its x-edges, on the y-edges and on the z-edges that begin in it, and, where the grid's
//! wall is capped, its negative nodes on the wall; each by ascending `i`. A number is the row's first number, plus those of earlier
//! kinds in the row, plus the bits before `i`: no table from edges to numbers is kept, and the same edge has the same number from every cell.
//!
//! # Complexity
//! One pass over the samples; of memory 16 bytes a row and 1 bit a node, in words of 64 for each row.

use rayon::prelude::*;

use super::IsosurfaceError;
use crate::Monitor;
use crate::grid::{Grid3, Samples};

/// Kinds of vertices of a row: samples on x-, y- and z-edges, then nodes on the wall.
pub(super) const KINDS: usize = 4;

/// Signs of samples, and the numbers of the vertices of their surface.
pub(super) struct Signs {
    pub(super) grid: Grid3,
    /// Words of a row of nodes.
    words: usize,
    bits: Vec<u64>,
    /// The first number of each kind of each row of nodes.
    first: Vec<[u32; KINDS]>,
    capped: bool,
    pub(super) vertices: usize,
}

/// Two rows of bits of the same length, word by word: where a node is negative and where its neighbour is.
#[derive(Clone, Copy)]
pub(super) struct Word {
    pub(super) here: u64,
    /// The same shifted by one node towards x.
    pub(super) next: u64,
}

impl Signs {
    /// Compares every sample with `level`; a sample that equals it is positive.
    pub(super) fn new(
        samples: &Samples<3>,
        level: f64,
        capped: bool,
        monitor: &Monitor<'_>,
    ) -> Result<Self, IsosurfaceError> {
        let grid = *samples.grid();
        let [nx, ny, nz] = grid.nodes().map(|n| n as usize);
        let words = nx.div_ceil(64);
        let mut bits = vec![0_u64; words * ny * nz];
        let stage = monitor.stage("signs", (ny * nz) as u64);
        let numbers = bits
            .par_chunks_mut(words * ny)
            .zip(samples.values().par_chunks(nx * ny))
            .map(|(bits, values)| {
                stage.check()?;
                let rows = bits.chunks_mut(words).zip(values.chunks(nx));
                let numbers =
                    rows.fold(true, |numbers, (bits, values)| numbers & signs_of_row(values, level, bits));
                stage.advance(ny as u64);
                Ok(numbers)
            })
            .try_reduce(|| true, |a, b| Ok::<_, IsosurfaceError>(a & b))?;
        if !numbers {
            samples.require_numbers()?;
        }
        let mut signs = Self { grid, words, bits, first: Vec::new(), capped, vertices: 0 };
        signs.number_vertices()?;
        Ok(signs)
    }

    /// Whether negative nodes on the grid's wall are vertices.
    pub(super) fn is_capped(&self) -> bool {
        self.capped
    }

    /// The bits of a row; row `(j, k)` has number `j + ny * k`.
    #[inline]
    pub(super) fn row(&self, row: usize) -> &[u64] {
        &self.bits[row * self.words..(row + 1) * self.words]
    }

    /// Word `w` of a row, and the row shifted by one node.
    #[inline]
    pub(super) fn word(&self, row: usize, w: usize) -> Word {
        let bits = self.row(row);
        let after = bits.get(w + 1).copied().unwrap_or(0);
        Word { here: bits[w], next: bits[w] >> 1 | after << 63 }
    }

    /// Which bits of word `w` stand for a node that has a neighbour towards x.
    #[inline]
    pub(super) fn inner_mask(&self, w: usize) -> u64 {
        let cells = self.grid.cells()[0] as usize;
        mask_below(cells.saturating_sub(64 * w))
    }

    /// Whether a node is negative.
    #[inline]
    pub(super) fn is_negative(&self, [i, j, k]: [u32; 3]) -> bool {
        self.row(self.row_of(j, k))[i as usize / 64] >> (i % 64) & 1 == 1
    }

    #[inline]
    pub(super) fn row_of(&self, j: u32, k: u32) -> usize {
        j as usize + self.grid.nodes()[1] as usize * k as usize
    }

    /// The vertices of one kind in word `w` of a row, as bits.
    #[inline]
    pub(super) fn kind(&self, kind: usize, row: usize, w: usize) -> u64 {
        let [nx, ny, nz] = self.grid.nodes().map(|n| n as usize);
        let (j, k) = (row % ny, row / ny);
        let Word { here, next } = self.word(row, w);
        match kind {
            0 => (here ^ next) & self.inner_mask(w),
            1 if j + 1 < ny => here ^ self.row(row + 1)[w],
            2 if k + 1 < nz => here ^ self.row(row + ny)[w],
            3 if self.capped => {
                let on_wall = j == 0 || k == 0 || j + 1 == ny || k + 1 == nz;
                let ends =
                    if w == 0 { 1 } else { 0 } | if (nx - 1) / 64 == w { 1 << ((nx - 1) % 64) } else { 0 };
                if on_wall { here } else { here & ends }
            }
            _ => 0,
        }
    }

    /// Calls `visit` with the place of each vertex of one kind in a row, in order.
    #[inline]
    pub(super) fn for_each(&self, kind: usize, row: usize, mut visit: impl FnMut(u32)) {
        for w in 0..self.words {
            let mut bits = self.kind(kind, row, w);
            while bits != 0 {
                visit(64 * w as u32 + bits.trailing_zeros());
                bits &= bits - 1;
            }
        }
    }

    /// The first number of a kind in a row.
    #[inline]
    pub(super) fn first(&self, row: usize, kind: usize) -> u32 {
        self.first[row][kind]
    }

    /// The numbers of the vertices that a row owns.
    pub(super) fn vertices_of_row(&self, row: usize) -> std::ops::Range<usize> {
        let end = self.first.get(row + 1).map_or(self.vertices, |next| next[0] as usize);
        self.first[row][0] as usize..end
    }

    /// The number of the vertex of a kind at a node, by counting the bits of its row before it.
    pub(super) fn vertex(&self, kind: usize, node: [u32; 3]) -> u32 {
        let row = self.row_of(node[1], node[2]);
        let before = (0..node[0] as usize / 64).map(|w| self.kind(kind, row, w).count_ones()).sum();
        self.vertex_after(before, kind, node)
    }

    /// How many vertices of a kind lie in a row before each of its words.
    pub(super) fn vertices_before_words(&self, kind: usize, row: usize) -> Vec<u32> {
        let counts = (0..self.words).map(|w| self.kind(kind, row, w).count_ones());
        counts.scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count))).collect()
    }

    /// The number of the vertex of a kind at a node, with `before` of the kind before its word.
    #[inline]
    pub(super) fn vertex_after(&self, before: u32, kind: usize, [i, j, k]: [u32; 3]) -> u32 {
        let row = self.row_of(j, k);
        let (w, bit) = (i as usize / 64, i as usize % 64);
        self.first[row][kind] + before + (self.kind(kind, row, w) & mask_below(bit)).count_ones()
    }

    fn number_vertices(&mut self) -> Result<(), IsosurfaceError> {
        let rows = self.bits.len() / self.words;
        let counts: Vec<[u32; KINDS]> = (0..rows)
            .into_par_iter()
            .with_min_len(256)
            .map(|row| {
                std::array::from_fn(|kind| {
                    (0..self.words).map(|w| self.kind(kind, row, w).count_ones()).sum()
                })
            })
            .collect();
        let total: u64 = counts.iter().flatten().map(|&n| u64::from(n)).sum();
        if total > u64::from(u32::MAX) {
            return Err(IsosurfaceError::TooMany { what: "vertices", count: total });
        }
        let mut number = 0;
        self.first = counts;
        for first in self.first.iter_mut().flatten() {
            let count = *first;
            *first = number;
            number += count;
        }
        self.vertices = number as usize;
        Ok(())
    }
}

/// The lowest `n` bits; all of them from 64 on.
#[inline]
pub(super) fn mask_below(n: usize) -> u64 {
    if n >= 64 { u64::MAX } else { (1 << n) - 1 }
}

/// Writes the signs of a row into bits and tells whether all values are numbers.
fn signs_of_row(values: &[f64], level: f64, bits: &mut [u64]) -> bool {
    let mut numbers = true;
    for (word, values) in bits.iter_mut().zip(values.chunks(64)) {
        let mut negative = 0;
        for (byte, values) in values.chunks(8).enumerate() {
            let mut below = 0_u8;
            for (bit, &value) in values.iter().enumerate() {
                below |= u8::from(value < level) << bit;
                numbers &= !value.is_nan();
            }
            negative |= u64::from(below) << (8 * byte);
        }
        *word = negative;
    }
    numbers
}
