//! Columns that solids cover as a whole: where all of a column is before the solids, or all in their shadow.
//!
//! # What it promises
//! A way that is said to be lit is behind no triangle, and one that is said to be dark is behind one
//! everywhere but at places that measure nothing. Most ways through the smoke are one or the other, and need
//! no look at single triangles.
//!
//! # Method
//! Where what triangles cover across the light ends, there is an edge that they do not cover on both sides: a
//! rim. So a column without a rim whose middle is covered is covered everywhere, and dark behind the deepest
//! of its triangles. An edge is no rim if it has two triangles, on opposite sides as seen from the light.
//! Edges are told by the positions of their ends.
//!
//! # Complexity
//! Sorting the edges; else linear in the triangles, the edges and the columns that they pass.

use glam::DVec3;
use rayon::prelude::*;

use super::columns::{Columns, Grid};
use super::occluders::{Lit, fans, over};
use super::prisms::{Prism, at_side, narrow, side};

/// How far beside a rim, in voxels, columns count as passed by it. Places of rims within [`FAR`] are exact to
/// much less.
const MARGIN: f64 = 1.0 / 1024.0;

/// With a corner of a triangle so many voxels away, no column counts as covered.
const FAR: f64 = (1_u64 << 32) as f64;

/// What holds for whole columns.
#[derive(Debug)]
pub(super) struct Cover {
    grid: Grid,
    /// The depth up to which all is lit, and that from which all is dark.
    depths: Vec<[f64; 2]>,
}

/// An edge by its ends, ordered, and the triangle it belongs to.
type Edge = ([u64; 3], [u64; 3], u32);

impl Cover {
    /// From all triangles that may cast a shadow, in lattice coordinates, and what was made of them.
    pub(super) fn new(columns: &Columns, triangles: &[[DVec3; 3]], [nx, ny]: [usize; 2]) -> Self {
        let grid = *columns.grid();
        let mut cover = Self { grid, depths: vec![[f64::INFINITY, f64::NEG_INFINITY]; grid.count()] };
        for triangle in triangles {
            let over = over([nx, ny], triangle);
            let depths = over.corners().iter().map(|corner| corner.point.z);
            let (near, far) =
                depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), z| (near.min(z), far.max(z)));
            for part in fans(&over) {
                let Some(prism) = Prism::new(&part) else { continue };
                let [a, b, c] = part;
                let bounds = [a.min(b).min(c), a.max(b).max(c)];
                grid.meeting(&prism, &bounds, |column| {
                    let [least, most] = &mut cover.depths[column];
                    (*least, *most) = (least.min(near), most.max(far));
                });
            }
        }
        cover.open_rims(triangles, [nx, ny]);
        cover.depths.par_iter_mut().with_min_len(1024).enumerate().for_each(|(column, [_, far])| {
            let middle = grid.middle(column);
            let mut all = columns.at(middle.x, middle.y).iter();
            if !all.any(|&index| columns.prism(index).is_below(middle)) {
                *far = f64::INFINITY;
            }
        });
        cover
    }

    /// How much of a way is lit, if that holds for all of its columns; else parts may be.
    #[inline]
    pub(super) fn lit(&self, from: DVec3, to: DVec3) -> Lit {
        let (low, high) = (from.min(to), from.max(to));
        let (mut lit, mut dark) = (true, true);
        self.grid.between(low, high, |column| {
            let [near, far] = self.depths[column];
            lit &= high.z <= near;
            dark &= low.z >= far;
        });
        match (lit, dark) {
            (true, _) => Lit::All,
            (false, true) => Lit::Nothing,
            (false, false) => Lit::Parts,
        }
    }

    /// Marks the columns that a rim passes as not covered.
    fn open_rims(&mut self, triangles: &[[DVec3; 3]], across: [usize; 2]) {
        if triangles.iter().flatten().any(|p| p.abs().max_element().is_nan() || p.abs().max_element() > FAR) {
            self.depths.iter_mut().for_each(|[_, far]| *far = f64::INFINITY);
            return;
        }
        let key = |p: DVec3| p.to_array().map(f64::to_bits);
        let of = |(index, &[a, b, c]): (usize, &[DVec3; 3])| {
            [[a, b], [b, c], [c, a]].map(|[p, q]| {
                let (p, q) = (key(p), key(q));
                (p.min(q), p.max(q), index as u32)
            })
        };
        let mut edges: Vec<Edge> = triangles.par_iter().enumerate().flat_map_iter(of).collect();
        edges.par_sort_unstable();
        for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let ends = [same[0].0, same[0].1].map(|bits| DVec3::from_array(bits.map(f64::from_bits)));
            let beyond = |edge: &Edge| {
                // The side of the corners that are not on the edge, whose own side is 0 up to rounding.
                let line = side(ends[0], ends[1]);
                let others = triangles[edge.2 as usize].into_iter().filter(|&corner| !ends.contains(&corner));
                others.map(|corner| at_side(&line, corner)).next().unwrap_or(0.0)
            };
            let inner = match same {
                [a, b] => {
                    let (a, b) = (beyond(a), beyond(b));
                    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
                }
                _ => false,
            };
            if !inner {
                self.open(ends, across);
            }
        }
    }

    /// Marks the columns that a segment passes as not covered.
    fn open(&mut self, [p, q]: [DVec3; 2], [nx, ny]: [usize; 2]) {
        let (most_x, most_y) = (nx as f64 + MARGIN, ny as f64 + MARGIN);
        let mut whole = [0.0, 1.0];
        let meets = narrow(&mut whole, p.x + MARGIN, q.x + MARGIN)
            && narrow(&mut whole, most_x - p.x, most_x - q.x)
            && narrow(&mut whole, p.y + MARGIN, q.y + MARGIN)
            && narrow(&mut whole, most_y - p.y, most_y - q.y);
        if !meets || whole[0] > whole[1] {
            return;
        }
        let [start, end] = whole.map(|at| p + at * (q - p));
        let (low, high) = (start.min(end) - MARGIN, start.max(end) + MARGIN);
        let (grid, depths) = (self.grid, &mut self.depths);
        grid.rows(low.y, high.y, |[upper, lower]| {
            let mut part = [0.0, 1.0];
            let (upper, lower) = (upper - MARGIN, lower + MARGIN);
            if narrow(&mut part, start.y - upper, end.y - upper)
                && narrow(&mut part, lower - start.y, lower - end.y)
                && part[0] <= part[1]
            {
                let [a, b] = part.map(|at| start + at * (end - start));
                let middle = 0.5 * (upper + lower);
                let [low, high] =
                    [a.x.min(b.x) - MARGIN, a.x.max(b.x) + MARGIN].map(|x| DVec3::new(x, middle, 0.0));
                grid.between(low, high, |column| depths[column][1] = f64::INFINITY);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::light_space::Lattice;
    use super::super::occluders::Occluders;
    use super::*;

    /// What is said of whole ways is what the triangles say of them.
    #[test]
    fn covered_ways_are_dark_and_clear_ways_are_lit() {
        let mut state = 21_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let lattice = Lattice { axes, origin: DVec3::ZERO, spacing: 1.0, size: [40, 30, 20] };
        let mut said = [0; 3];
        for round in 0..30 {
            // A rough sheet of triangles with holes, partly over the lattice.
            let mut point = |i: usize, j: usize| {
                let bump = DVec3::new(random(), random(), 6.0 * random());
                DVec3::new(-3.0 + 7.0 * i as f64, -2.0 + 6.0 * j as f64, 4.0) + bump
            };
            let points: Vec<Vec<DVec3>> = (0..7).map(|j| (0..7).map(|i| point(i, j)).collect()).collect();
            let mut triangles = Vec::new();
            for j in 0..6 {
                for i in 0..6 {
                    let [a, b, c, d] =
                        [points[j][i], points[j][i + 1], points[j + 1][i + 1], points[j + 1][i]];
                    triangles.extend([[a, b, c], [c, a, d]].into_iter().filter(|_| random() > 0.1));
                }
            }
            if round % 3 == 0 {
                triangles.push([DVec3::splat(-1e3), DVec3::new(1e3, -9e2, 9.0), DVec3::new(5.0, 7.0, 25.0)]);
            }
            let occluders = Occluders::new(&lattice, &triangles).expect("they lie over the lattice");
            for _ in 0..2000 {
                let from = DVec3::new(40.0 * random(), 30.0 * random(), 20.0 * random());
                let step = DVec3::new(random() - 0.5, random() - 0.5, random() - 0.5);
                let to = (from + step).clamp(DVec3::ZERO, DVec3::new(40.0, 30.0, 20.0));
                let cover = occluders.cover().lit(from, to);
                said[cover as usize] += 1;
                let mut spans = Default::default();
                let exact = occluders.lit_by_triangles(from, to, &mut spans);
                assert!(cover == Lit::Parts || cover == exact, "{round}: {from} {to} {cover:?} {exact:?}");
            }
        }
        assert!(said.iter().all(|&count| count > 5000), "{said:?}");
    }
}
