//! The depths at which the ray of a pixel crosses surfaces: an A-buffer \[Carpenter84\], tile by tile.
//!
//! # What it promises
//! Every crossing of every pixel's ray, with its direction, in the order of depth, and of equal depths in the
//! order of the triangles. The number of crossings held at a time is bounded by [`MOST`] or, where the ray of
//! a single pixel has more, by the triangles; whatever the size of the image.
//!
//! # Method
//! A tile whose pixels may be covered too often, by the bounding boxes of the triangles, is halved; others
//! are rasterised, crossings sorted to pixels by counting, and by depth within each.

use super::project::Piece;
use super::raster::Window;

/// Crossings in a tile, unless it is a single pixel.
pub(super) const MOST: u64 = 1 << 19;

/// A ray meets the smoke's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Distance along the line of sight of the middle of the image.
    pub(super) depth: f64,
    pub(super) age: f32,
    /// Which piece of a triangle; ties of the depth are broken by it.
    pub(super) piece: u32,
    /// The pixel, counted in its tile.
    pub(super) pixel: u32,
    /// 1 where the ray enters, -1 where it leaves.
    pub(super) sign: i32,
}

/// Crossings of the pixels of one tile after the other; keeps its memory.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    found: Vec<Crossing>,
    sorted: Vec<Crossing>,
    ends: Vec<u32>,
}

/// Calls `visit` with each tile into which a window has to be divided, and the pieces that may cover it,
/// ascending.
pub(super) fn divide(
    window: &Window,
    pieces: &[Piece],
    candidates: &[u32],
    visit: &mut impl FnMut(&Window, &[u32]),
) {
    let footprint = |&piece: &u32| &pieces[piece as usize].footprint;
    let inside: Vec<u32> = candidates
        .iter()
        .copied()
        .filter(|piece| !footprint(piece).window().meet(window).is_empty())
        .collect();
    let most: u64 = inside.iter().map(|piece| footprint(piece).window().meet(window).area()).sum();
    if most <= MOST || window.area() <= 1 {
        visit(window, &inside);
        return;
    }
    let [columns, rows] = [&window.x, &window.y].map(|side| side.end - side.start);
    let mut halves = [window.clone(), window.clone()];
    if columns >= rows {
        let middle = window.x.start + columns / 2;
        (halves[0].x.end, halves[1].x.start) = (middle, middle);
    } else {
        let middle = window.y.start + rows / 2;
        (halves[0].y.end, halves[1].y.start) = (middle, middle);
    }
    for half in &halves {
        divide(half, pieces, &inside, visit);
    }
}

impl Crossings {
    /// Finds and sorts the crossings of a tile.
    pub(super) fn find(&mut self, tile: &Window, pieces: &[Piece], candidates: &[u32]) {
        self.found.clear();
        let columns = tile.x.end - tile.x.start;
        for &index in candidates {
            let piece = &pieces[index as usize];
            let sign = if piece.enters() { 1 } else { -1 };
            piece.footprint.cover(tile, |x, y, weights| {
                let (depth, age) = piece.at(weights);
                let pixel = (y - tile.y.start) * columns + (x - tile.x.start);
                self.found.push(Crossing { depth, age: age as f32, piece: index, pixel, sign });
            });
        }
        self.sort(tile.area() as usize);
    }

    /// The crossings of a pixel, counted in the tile, from near to far.
    pub(super) fn of(&self, pixel: usize) -> &[Crossing] {
        let start = if pixel == 0 { 0 } else { self.ends[pixel - 1] };
        &self.sorted[start as usize..self.ends[pixel] as usize]
    }

    fn sort(&mut self, pixels: usize) {
        self.ends.clear();
        self.ends.resize(pixels, 0);
        for crossing in &self.found {
            self.ends[crossing.pixel as usize] += 1;
        }
        let mut start = 0;
        for end in &mut self.ends {
            start += std::mem::replace(end, start);
        }
        self.sorted.clear();
        self.sorted.extend_from_slice(&self.found);
        // Each end counts from the start of its pixel's crossings to their end.
        for crossing in &self.found {
            let end = &mut self.ends[crossing.pixel as usize];
            self.sorted[*end as usize] = *crossing;
            *end += 1;
        }
        let mut start = 0;
        for &end in &self.ends {
            let of_pixel = &mut self.sorted[start as usize..end as usize];
            if of_pixel.len() > 1 {
                of_pixel
                    .sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth).then_with(|| a.piece.cmp(&b.piece)));
            }
            start = end;
        }
    }
}
