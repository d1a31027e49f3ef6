//! Which samples a triangle covers, and with which weights of its corners.
//!
//! # What it promises
//! Corners lie on a grid of 2^[`SUBDIVISION_BITS`] steps a sample and every decision is made in integers: a
//! sample on an edge that triangles share belongs to one side of it, for all of them the same (the top-left
//! rule, which is that of a sample moved by an infinitesimal step left and a smaller one up). So the signed
//! crossings of a ray with a closed surface add up to zero, whatever the snapping of its vertices does to its
//! triangles. Weights are from 0 to 1 and add up to 1 within rounding, so that what is interpolated never
//! leaves the range of the corners.
//!
//! # Method
//! Edge functions \[Pineda88\], on the bounding box or, of wide triangles, on the interval of each row. A
//! sample stands in the middle of its cell.
//!
//! # Invariant
//! Corners stay below [`LIMIT`] in magnitude, so that no product overflows.

use std::ops::Range;

/// Steps of the grid of corners in a sample, as a power of two: a corner moves by at most 2^-16 samples.
pub(super) const SUBDIVISION_BITS: u32 = 15;

/// Corners on the grid are less than this in magnitude: differences stay below 2^31 and edge functions below
/// 2^63.
pub(super) const LIMIT: i32 = 1 << 30;

const STEP: i64 = 1 << SUBDIVISION_BITS;

/// A position in samples from the middle of the image, on the grid. Rounds halves away from zero, so that
/// mirrored positions stay mirrored.
#[inline]
pub(super) fn snap(from_middle: f64) -> i32 {
    const BOUND: f64 = (LIMIT / 2) as f64;
    (from_middle * STEP as f64).round().clamp(-BOUND, BOUND) as i32
}

/// First sample at or after a place on the grid.
#[inline]
pub(super) fn first_sample(place: i32) -> i32 {
    ((i64::from(place) + (STEP / 2 - 1)) >> SUBDIVISION_BITS) as i32
}

/// Samples of a window: columns and rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) x: Range<u32>,
    pub(super) y: Range<u32>,
}

impl Window {
    pub(super) fn area(&self) -> u64 {
        u64::from(self.x.end.saturating_sub(self.x.start))
            * u64::from(self.y.end.saturating_sub(self.y.start))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.x.is_empty() || self.y.is_empty()
    }

    pub(super) fn meet(&self, other: &Window) -> Window {
        let both = |a: &Range<u32>, b: &Range<u32>| a.start.max(b.start)..a.end.min(b.end);
        Window { x: both(&self.x, &other.x), y: both(&self.y, &other.y) }
    }
}

/// A triangle on the grid, `x` to the right and `y` downward from the upper left corner of the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Footprint {
    corners: [[i32; 2]; 3],
    /// Twice the signed area; positive if the corners turn from `x` toward `y`.
    area: i64,
    /// Columns and rows of all samples that may be covered.
    low: [u32; 2],
    high: [u32; 2],
}

impl Footprint {
    /// None if no sample of an image can be covered.
    #[inline]
    pub(super) fn new(corners: [[i32; 2]; 3], [width, height]: [u32; 2]) -> Option<Self> {
        let [a, b, c] = corners;
        let area = cross(a, b, c);
        let span = |axis: usize, count: u32| {
            let least = a[axis].min(b[axis]).min(c[axis]);
            let most = a[axis].max(b[axis]).max(c[axis]);
            let end = first_sample(most).saturating_add(1).clamp(0, count as i32);
            (first_sample(least).clamp(0, count as i32) as u32, end as u32)
        };
        let ((left, right), (top, bottom)) = (span(0, width), span(1, height));
        let covers = area != 0 && left < right && top < bottom;
        covers.then_some(Self { corners, area, low: [left, top], high: [right, bottom] })
    }

    /// Whether the corners turn from `x` toward `y`.
    #[inline]
    pub(super) fn is_positive(&self) -> bool {
        self.area > 0
    }

    #[inline]
    pub(super) fn window(&self) -> Window {
        Window { x: self.low[0]..self.high[0], y: self.low[1]..self.high[1] }
    }

    /// All covered samples of a window: column, row, weights of the corners.
    #[inline]
    pub(super) fn cover(&self, window: &Window, mut visit: impl FnMut(u32, u32, [f64; 3])) {
        let window = window.meet(&self.window());
        if window.is_empty() {
            return;
        }
        let [a, b, c] = self.corners;
        let (x, y) = (window.x.start, window.y.start);
        let mut edges = [(b, c), (c, a), (a, b)].map(|(from, to)| Edge::new(from, to, self.area < 0, x, y));
        let whole = 1.0 / self.area.unsigned_abs() as f64;
        let width = i64::from(window.x.end - x);
        for row in window.y.clone() {
            let (mut first, mut end) = (0, width);
            if width > WIDE {
                for edge in &edges {
                    edge.narrow(&mut first, &mut end);
                }
            }
            let mut e = [0, 1, 2].map(|k| edges[k].value + first * edges[k].right);
            for column in first..end {
                if (0..3).all(|k| e[k] >= edges[k].least) {
                    visit(x + column as u32, row, e.map(|e| e as f64 * whole));
                }
                for k in 0..3 {
                    e[k] += edges[k].right;
                }
            }
            for edge in &mut edges {
                edge.value += edge.down;
            }
        }
    }
}

/// Width in samples from which the interval of a row is computed, by divisions, instead of tried. Chosen by
/// trial.
const WIDE: i64 = 8;

#[inline]
fn cross(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i64 {
    let d = |p: [i32; 2], axis: usize| i64::from(p[axis]) - i64::from(a[axis]);
    d(b, 0) * d(c, 1) - d(b, 1) * d(c, 0)
}

/// Edge function of a side, at a sample, with its changes from sample to sample; not negative inside.
#[derive(Clone, Copy, Debug)]
struct Edge {
    value: i64,
    right: i64,
    down: i64,
    /// 0 where a sample on the edge belongs to the triangle, else 1.
    least: i64,
}

impl Edge {
    #[inline]
    fn new(from: [i32; 2], to: [i32; 2], reversed: bool, x: u32, y: u32) -> Self {
        let [from, to] = if reversed { [to, from] } else { [from, to] };
        let middle = |at: u32| ((at << SUBDIVISION_BITS) + (1 << (SUBDIVISION_BITS - 1))) as i32;
        let (dx, dy) = (i64::from(to[0]) - i64::from(from[0]), i64::from(to[1]) - i64::from(from[1]));
        let owns = dy > 0 || (dy == 0 && dx < 0);
        Self {
            value: cross(from, to, [middle(x), middle(y)]),
            right: -dy * STEP,
            down: dx * STEP,
            least: i64::from(!owns),
        }
    }

    /// Narrows an interval of columns, counted from that of `value`, to those where the function is at least
    /// `least`.
    #[inline]
    fn narrow(&self, first: &mut i64, end: &mut i64) {
        let missing = self.least - self.value;
        match self.right {
            0 if missing > 0 => *end = *first,
            0 => {}
            step if step > 0 => *first = (*first).max(-(-missing).div_euclid(step)),
            step => *end = (*end).min((-missing).div_euclid(-step) + 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [40, 30];

    /// Every sample's signed count, by the definition: integer edge functions on the whole image.
    fn counts(triangles: &[[[i32; 2]; 3]]) -> Vec<i32> {
        let mut counts = vec![0; (SIZE[0] * SIZE[1]) as usize];
        for &corners in triangles {
            let Some(footprint) = Footprint::new(corners, SIZE) else { continue };
            let window = Window { x: 0..SIZE[0], y: 0..SIZE[1] };
            footprint.cover(&window, |x, y, weights| {
                assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)), "{weights:?}");
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                counts[(y * SIZE[0] + x) as usize] += if footprint.is_positive() { 1 } else { -1 };
            });
        }
        counts
    }

    fn random(state: &mut u64) -> i32 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 40) as i32
    }

    #[test]
    fn signed_coverage_of_a_closed_surface_vanishes() {
        let mut state = 1;
        for round in 0..400 {
            // Few different places, so that samples lie on edges and corners, and triangles have no area.
            let grain = [1 << 14, 1 << 15, 3, 1][round % 4];
            let mut corner = || {
                [random(&mut state) % (45 << 15), random(&mut state) % (35 << 15)].map(|v| v / grain * grain)
            };
            let [a, b, c, d] = [corner(), corner(), corner(), corner()];
            let tetrahedron = [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
            assert!(counts(&tetrahedron).iter().all(|&count| count == 0), "{tetrahedron:?}");
            assert_eq!(counts(&[[a, b, c]]), counts(&[[b, c, a]]));
        }
    }

    #[test]
    fn wide_triangles_are_covered_as_narrow_ones() {
        let mut state = 7;
        for _ in 0..200 {
            let mut corner =
                || [random(&mut state) % (60 << 15) - (9 << 15), random(&mut state) % (40 << 15)];
            let corners = [corner(), corner(), corner()];
            let Some(footprint) = Footprint::new(corners, SIZE) else { continue };
            let (mut whole, mut parts) = (Vec::new(), Vec::new());
            footprint.cover(&Window { x: 0..SIZE[0], y: 0..SIZE[1] }, |x, y, w| {
                whole.push((y, x, w.map(f64::to_bits)))
            });
            for left in (0..SIZE[0]).step_by(3) {
                let strip = Window { x: left..left + 3, y: 0..SIZE[1] };
                footprint.cover(&strip, |x, y, w| parts.push((y, x, w.map(f64::to_bits))));
            }
            parts.sort_unstable();
            assert_eq!(whole, parts);
        }
    }

    #[test]
    fn corners_at_the_limit_do_not_overflow() {
        let far = snap(f64::INFINITY) + (1 << 28);
        assert!(far < LIMIT);
        let footprint = Footprint::new([[far, far], [-far, far], [far, -far]], [1 << 14; 2]);
        let mut count = 0_u64;
        let window = Window { x: 0..1 << 14, y: 7..9 };
        footprint.expect("it covers everything").cover(&window, |_, _, _| count += 1);
        assert_eq!(count, 2 << 14);
        assert!(snap(f64::NAN) == 0 && snap(-0.5 / 32768.0) == -snap(0.5 / 32768.0));
    }
}
