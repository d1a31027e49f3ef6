//! Which pieces of one region hang together though no edge connects them: [`walls`].

use super::frame::{Cut, Frame, in_all_cells};
use super::pieces::Pieces;
use crate::{Cancelled, Monitor};

/// Pairs of pieces of two or more copies, the lower first, sorted, that are on the same side of everything in some cell, see [`Frame`].
pub(super) fn walls(
    cut: &Cut<'_>,
    pieces: &Pieces<'_>,
    monitor: &Monitor<'_>,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    let deep = pieces.deep_cells(cut.grid);
    let add = |pairs: &mut Vec<[u32; 2]>, frame: &Frame, _: [u32; 3], _: usize| {
        for &places in frame.alike() {
            let [a, b] = places.map(|place| frame.piece(place));
            if a != b && pieces.winding(a) > 1 {
                pairs.push([a.min(b), a.max(b)]);
            }
        }
    };
    let mut pairs = in_all_cells(cut, pieces, "regions", monitor, |row| deep[row], add)?.concat();
    pairs.sort_unstable();
    pairs.dedup();
    Ok(pairs)
}
