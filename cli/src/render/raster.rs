//! Which samples a triangle covers.
//!
//! Promises: corners lie on a grid of [`SUBDIVISIONS`] steps a sample and every decision is made in integers, so a sample
//! on an edge or corner shared by the triangles of a surface belongs to exactly one of them (the top-left rule) and a
//! closed surface shows no gaps. The depth of a covered sample is a convex combination of the corner depths (within
//! rounding), never an extrapolation.
//!
//! Method: edge functions \[Pineda88\], on the bounding box or, of wide triangles, on the interval of each row. A sample stands in the middle of its cell.
//! Invariant: corner coordinates stay below [`LIMIT`], so no product overflows an i64; callers clip.

/// Steps of the corner grid between samples.
pub(super) const SUBDIVISIONS: i32 = 256;

/// Corner coordinates must be less than this in magnitude: 2^29, so that an edge function stays below 2^62.
pub(super) const LIMIT: f64 = (1 << 29) as f64;

/// A corner on the grid. Larger depths are nearer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Corner {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) depth: f32,
}

impl Corner {
    /// The corner nearest to a position in samples. The position must be within `LIMIT / SUBDIVISIONS`.
    #[inline]
    pub(super) fn snap(x: f64, y: f64, depth: f64) -> Self {
        // Made positive, so that the cast rounds down.
        let nearest = |v: f64| (v * f64::from(SUBDIVISIONS) + (0.5 + 2.0 * LIMIT)) as i32 - 2 * LIMIT as i32;
        Self { x: nearest(x), y: nearest(y), depth: depth as f32 }
    }
}

/// Samples `x.0 <= x < x.1`, `y.0 <= y < y.1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) x: (i32, i32),
    pub(super) y: (i32, i32),
}

/// First sample at or after a grid coordinate.
#[inline]
pub(super) fn first_sample(grid: i32) -> i32 {
    (grid + (SUBDIVISIONS / 2 - 1)).div_euclid(SUBDIVISIONS)
}

/// Edge function of a -> b: twice the signed area of (a, b, sample), as a value and its steps along x and y.
struct Edge {
    value: i64,
    step_x: i64,
    step_y: i64,
    /// 0 where a sample on the edge belongs to the triangle, else 1.
    least: i64,
}

impl Edge {
    /// At the sample `(x, y)`, for a triangle that winds so that its inside is positive.
    #[inline]
    fn new(a: Corner, b: Corner, x: i32, y: i32) -> Self {
        let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
        let s = i64::from(SUBDIVISIONS);
        let px = i64::from(x) * s + s / 2 - i64::from(a.x);
        let py = i64::from(y) * s + s / 2 - i64::from(a.y);
        // Of two triangles on either side of an edge exactly one sees it pointing this way.
        let owned = dy < 0 || (dy == 0 && dx > 0);
        Self { value: dx * py - dy * px, step_x: -dy * s, step_y: dx * s, least: i64::from(!owned) }
    }
}

/// Calls `plot(x, y, depth)` for every sample in the window that the triangle covers, whichever way it winds.
#[inline]
pub(super) fn triangle(corners: [Corner; 3], window: Window, mut plot: impl FnMut(i32, i32, f32)) {
    let [a, mut b, mut c] = corners;
    let x0 = first_sample(a.x.min(b.x).min(c.x)).max(window.x.0);
    let x1 = first_sample(a.x.max(b.x).max(c.x).saturating_add(1)).min(window.x.1);
    let y0 = first_sample(a.y.min(b.y).min(c.y)).max(window.y.0);
    let y1 = first_sample(a.y.max(b.y).max(c.y).saturating_add(1)).min(window.y.1);
    if x0 >= x1 || y0 >= y1 {
        return;
    }
    let twice_area = (i64::from(b.x) - i64::from(a.x)) * (i64::from(c.y) - i64::from(a.y))
        - (i64::from(b.y) - i64::from(a.y)) * (i64::from(c.x) - i64::from(a.x));
    if twice_area == 0 {
        return;
    }
    if twice_area < 0 {
        (b, c) = (c, b);
    }
    let (mut ea, mut eb, mut ec) =
        (Edge::new(b, c, x0, y0), Edge::new(c, a, x0, y0), Edge::new(a, b, x0, y0));
    let scale = 1.0 / twice_area.abs() as f64;
    let depth = f64::from(a.depth);
    let (to_b, to_c) = ((f64::from(b.depth) - depth) * scale, (f64::from(c.depth) - depth) * scale);
    if x1 - x0 <= NARROW {
        for y in y0..y1 {
            let (mut va, mut vb, mut vc) = (ea.value, eb.value, ec.value);
            for x in x0..x1 {
                if va >= ea.least && vb >= eb.least && vc >= ec.least {
                    plot(x, y, (depth + (vb as f64 * to_b + vc as f64 * to_c)) as f32);
                }
                va += ea.step_x;
                vb += eb.step_x;
                vc += ec.step_x;
            }
            ea.value += ea.step_y;
            eb.value += eb.step_y;
            ec.value += ec.step_y;
        }
        return;
    }
    let mut bounds = [Bound::new(&ea), Bound::new(&eb), Bound::new(&ec)];
    let width = i64::from(x1 - x0);
    for y in y0..y1 {
        let (mut first, mut end) = (0, width);
        for bound in &mut bounds {
            bound.narrow(&mut first, &mut end);
        }
        if first < end {
            let (mut vb, mut vc) = (eb.value + first * eb.step_x, ec.value + first * ec.step_x);
            for x in first..end {
                plot(x0 + x as i32, y, (depth + (vb as f64 * to_b + vc as f64 * to_c)) as f32);
                vb += eb.step_x;
                vc += ec.step_x;
            }
        }
        eb.value += eb.step_y;
        ec.value += ec.step_y;
    }
}

/// Triangles at most this many samples wide are tried sample by sample; wider ones, which may be slivers across the whole
/// picture, by the interval of each row.
const NARROW: i32 = 8;

/// The bound that an edge sets to the samples of a row, counted from the first column: `numerator / divisor` rounded,
/// kept as quotient and remainder from row to row so that there is no division in the loop.
struct Bound {
    quotient: i64,
    /// In `0..divisor`.
    remainder: i64,
    step: [i64; 2],
    divisor: i64,
    side: Side,
}

/// Which samples of a row an edge admits.
#[derive(Clone, Copy)]
enum Side {
    /// Those at or after `ceil(numerator / divisor)`.
    After,
    /// Those at or before `floor(numerator / divisor)`.
    Before,
    /// All while the numerator (the quotient, the divisor being 1) is not negative, else none: the edge is horizontal.
    AllOrNone,
}

impl Bound {
    fn new(edge: &Edge) -> Self {
        let inside = edge.value - edge.least;
        let (numerator, step, divisor, side) = match edge.step_x.signum() {
            1 => (-inside, -edge.step_y, edge.step_x, Side::After),
            -1 => (inside, edge.step_y, -edge.step_x, Side::Before),
            _ => (inside, edge.step_y, 1, Side::AllOrNone),
        };
        Self {
            quotient: numerator.div_euclid(divisor),
            remainder: numerator.rem_euclid(divisor),
            step: [step.div_euclid(divisor), step.rem_euclid(divisor)],
            divisor,
            side,
        }
    }

    /// Narrows `first..end` of the current row, then goes on to the next row.
    #[inline]
    fn narrow(&mut self, first: &mut i64, end: &mut i64) {
        match self.side {
            Side::After => *first = (*first).max(self.quotient + i64::from(self.remainder > 0)),
            Side::Before => *end = (*end).min(self.quotient + 1),
            Side::AllOrNone if self.quotient < 0 => *end = *first,
            Side::AllOrNone => {}
        }
        self.quotient += self.step[0];
        self.remainder += self.step[1];
        if self.remainder >= self.divisor {
            self.remainder -= self.divisor;
            self.quotient += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window { x: (0, 40), y: (0, 40) };

    fn at(x: f64, y: f64) -> Corner {
        Corner::snap(x, y, 1.0)
    }

    fn count(triangles: &[[Corner; 3]]) -> Vec<u32> {
        let mut hits = vec![0; 1600];
        for &t in triangles {
            triangle(t, WINDOW, |x, y, _| hits[(y * 40 + x) as usize] += 1);
        }
        hits
    }

    #[test]
    fn a_right_triangle_covers_the_samples_below_its_diagonal() {
        let hits = count(&[[at(2.0, 2.0), at(8.0, 2.0), at(2.0, 8.0)]]);
        for y in 0..40 {
            for x in 0..40 {
                let inside = x >= 2 && y >= 2 && (x + y + 1) < 10;
                let on_diagonal = x >= 2 && y >= 2 && x + y + 1 == 10;
                if !on_diagonal {
                    assert_eq!(hits[y * 40 + x] == 1, inside, "{x} {y}");
                }
            }
        }
    }

    /// Fans whose spokes and centre pass through samples: each sample once, for every winding of each triangle.
    #[test]
    fn shared_edges_and_corners_are_covered_once() {
        let centre = at(20.5, 20.5);
        let ring: Vec<Corner> = [
            (4.5, 4.5),
            (20.5, 2.5),
            (36.5, 4.5),
            (38.5, 20.5),
            (36.5, 36.5),
            (20.5, 38.5),
            (4.5, 36.5),
            (2.5, 20.5),
        ]
        .map(|(x, y)| at(x, y))
        .to_vec();
        for winding in 0..256u32 {
            let fan: Vec<_> = (0..8)
                .map(|i| {
                    let (p, q) = (ring[i], ring[(i + 1) % 8]);
                    if winding >> i & 1 == 0 { [centre, p, q] } else { [q, p, centre] }
                })
                .collect();
            let hits = count(&fan);
            assert!(hits.iter().all(|&h| h <= 1));
            for y in 6..35 {
                for x in 6..35 {
                    assert_eq!(hits[y * 40 + x], 1, "{x} {y} winding {winding}");
                }
            }
        }
    }

    #[test]
    fn abutting_quads_tile_without_gap_or_overlap() {
        let mut triangles = Vec::new();
        for i in 0..8 {
            for j in 0..8 {
                let [x, y] = [i, j].map(|v| f64::from(v) * 5.0);
                let (p, q, r, s) = (at(x, y), at(x + 5.0, y), at(x + 5.0, y + 5.0), at(x, y + 5.0));
                triangles.push([p, q, r]);
                triangles.push([p, r, s]);
            }
        }
        assert!(count(&triangles).iter().all(|&h| h == 1));
    }

    /// Wide triangles of every slope against the definition, sample by sample.
    #[test]
    fn rows_of_wide_triangles_hold_the_samples_of_the_edge_functions() {
        let mut state = 7u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            // Half of the corners stand on samples, so that ties are met.
            let v = (state >> 16) as i32 % (48 * SUBDIVISIONS) - 4 * SUBDIVISIONS;
            if state >> 9 & 1 == 0 { v } else { v / SUBDIVISIONS * SUBDIVISIONS + SUBDIVISIONS / 2 }
        };
        let mut wide = 0;
        for i in 0..4000 {
            let mut t: [Corner; 3] = std::array::from_fn(|_| Corner { x: next(), y: next(), depth: 1.0 });
            if i % 3 == 0 {
                t[2].y = t[1].y;
            }
            let [a, mut b, mut c] = t;
            let area =
                i64::from(b.x - a.x) * i64::from(c.y - a.y) - i64::from(b.y - a.y) * i64::from(c.x - a.x);
            if area < 0 {
                (b, c) = (c, b);
            }
            let hits = count(&[t]);
            for (k, &hit) in hits.iter().enumerate() {
                let inside = [(a, b), (b, c), (c, a)].into_iter().all(|(p, q)| {
                    let e = Edge::new(p, q, k as i32 % 40, k as i32 / 40);
                    e.value >= e.least
                });
                assert_eq!(hit == 1, inside && area != 0, "{t:?} {k}");
            }
            wide += usize::from(hits.iter().sum::<u32>() > 100);
        }
        assert!(wide > 500);
    }

    #[test]
    fn the_largest_coordinates_do_not_overflow() {
        let far = (LIMIT as i32) - 1;
        let corner = |x, y| Corner { x, y, depth: 1.0 };
        let hits = count(&[[corner(-far, -far), corner(far, -far), corner(0, far)]]);
        assert!(hits.iter().all(|&h| h == 1));
    }

    #[test]
    fn depth_is_linear_and_within_the_corners() {
        let corners =
            [Corner::snap(0.0, 0.0, 1.0), Corner::snap(40.0, 0.0, 5.0), Corner::snap(0.0, 40.0, 1.0)];
        triangle(corners, WINDOW, |x, _, depth| {
            assert!((depth - (1.0 + (x as f32 + 0.5) * 0.1)).abs() < 1e-5);
            assert!((1.0..=5.0).contains(&depth));
        });
    }
}
