//! Which pieces between two crossings of an edge hang together though no edge connects them: [`walls`].

use rayon::prelude::*;

use super::frame::{Cut, Frame};
use super::pieces::Pieces;
use crate::{Cancelled, Monitor};

/// Cells that a thread takes at a time.
const CHUNK: usize = 1024;

/// Pairs of pieces that lie between the same two sheets in some cell, see [`Frame`].
pub(super) fn walls(
    cut: &Cut<'_>,
    pieces: &Pieces<'_>,
    monitor: &Monitor<'_>,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    let cells = cells_cut_twice(cut);
    let stage = monitor.stage("thin walls", cells.len() as u64);
    let pairs: Vec<Vec<[u32; 2]>> = cells
        .par_chunks(CHUNK)
        .map(|chunk| {
            stage.check()?;
            let (mut pairs, mut frame) = (Vec::new(), Frame::default());
            for &(number, cell) in chunk {
                frame.fill(cut, pieces, cell, number);
                for place in 8..frame.places() {
                    let part = frame.part(place);
                    if part != place as u32 {
                        pairs.push([frame.piece(part), frame.piece(place as u32)]);
                    }
                }
            }
            stage.advance(chunk.len() as u64);
            Ok(pairs)
        })
        .collect::<Result<_, Cancelled>>()?;
    Ok(pairs.concat())
}

/// The cells around the edges that the surface cuts more than once, by number and index.
fn cells_cut_twice(cut: &Cut<'_>) -> Vec<(usize, [u32; 3])> {
    let ny = cut.grid.nodes()[1] as usize;
    let mut cells = Vec::new();
    for (axis, rows) in cut.crossings.axes.iter().enumerate() {
        for row in 0..rows.count() {
            for pair in rows.row(row).windows(2).filter(|pair| pair[0].i == pair[1].i) {
                let node = [pair[0].i, (row % ny) as u32, (row / ny) as u32];
                for below in 0..4 {
                    let mut cell = node;
                    cell[(axis + 1) % 3] = cell[(axis + 1) % 3].wrapping_sub(below & 1);
                    cell[(axis + 2) % 3] = cell[(axis + 2) % 3].wrapping_sub(below >> 1);
                    let row = cell[1] as usize + ny * cell[2] as usize;
                    if (0..3).all(|axis| cell[axis] < cut.grid.cells()[axis])
                        && let Some(number) = cut.extension.cell_at(row, cell[0])
                    {
                        cells.push((number, cell));
                    }
                }
            }
        }
    }
    cells.sort_unstable();
    cells.dedup();
    cells
}
