//! Which pieces between two crossings of an edge hang together though no edge connects them: [`walls`].

use super::frame::{Cut, Frame, in_all_cells};
use super::pieces::Pieces;
use crate::{Cancelled, Monitor};

/// Pairs of pieces that lie between the same two sheets in some cell, see [`Frame`].
pub(super) fn walls(
    cut: &Cut<'_>,
    pieces: &Pieces<'_>,
    monitor: &Monitor<'_>,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    let add = |pairs: &mut Vec<[u32; 2]>, frame: &Frame, _: [u32; 3], _: usize| {
        for place in 8..frame.places() {
            let part = frame.part(place);
            if part != place as u32 {
                pairs.push([frame.piece(part), frame.piece(place as u32)]);
            }
        }
    };
    Ok(in_all_cells(cut, pieces, "regions", monitor, add)?.concat())
}
