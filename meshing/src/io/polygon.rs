//! Polygons into triangles: [`Triangulator`].
//!
//! Promises: n corners give n - 2 triangles whose directed edges are the polygon's own, once each, and inner edges once
//! in each direction, so a closed, oriented surface of polygons gives a closed, oriented surface of triangles. No vertex is
//! added, moved or merged. A polygon that is simple in the projection along its normal is covered without overlap, whether
//! convex or not: signs are exact. Does not promise: anything about overlap for a polygon that is not simple there, has
//! more than [`EAR_CLIPPING_LIMIT`] corners, hides its ears, or has corners not yet read or not finite; those become a fan.
//!
//! Method: project along the longest component of the Newell normal \[Tampieri92\]. Where each triangle of the fan from the
//! first corner turns as the polygon does, the fan is taken; else ears are clipped \[Meisters75\], an ear being a corner
//! that turns with the polygon and whose closed triangle holds no reflex corner.
//! Complexity: O(n) for a fan, at most O(n^2) with ears: a polygon whose ears are that well hidden becomes a fan.

use glam::DVec3;
use welter_predicates::{Sign, orient2d};

/// Largest polygon whose ears are clipped: the quadratic worst case stays within a tenth of a second for one polygon.
const EAR_CLIPPING_LIMIT: usize = 2048;
/// Corners looked at, at most, as a multiple of n^2: each corner is tried once at first, and two for each ear clipped,
/// makes 3; the rest is for polygons that are not simple, whose ears have to be sought again.
const WORK: usize = 6;

/// Scratch space, kept from polygon to polygon.
#[derive(Default)]
pub(super) struct Triangulator {
    points: Vec<[f64; 2]>,
    /// Corners not yet clipped form a ring.
    next: Vec<usize>,
    previous: Vec<usize>,
    reflex: Vec<bool>,
    ear: Vec<bool>,
    /// Corners that may still be looked at.
    work: usize,
}

impl Triangulator {
    /// Appends the triangles of the polygon `corners` (at least three) to `triangles`.
    pub(super) fn triangulate(
        &mut self,
        positions: &[DVec3],
        corners: &[u32],
        triangles: &mut Vec<[u32; 3]>,
    ) {
        let first = triangles.len();
        if !self.project(positions, corners) || self.fan_is_proper() {
            fan(corners, triangles);
        } else if corners.len() > EAR_CLIPPING_LIMIT || !self.clip_ears(corners, triangles) {
            triangles.truncate(first);
            fan(corners, triangles);
        }
    }

    /// Projects so that the polygon turns counter-clockwise; `false` where it has no usable normal.
    fn project(&mut self, positions: &[DVec3], corners: &[u32]) -> bool {
        let at = |k: usize| positions.get(corners[k] as usize).copied();
        self.points.clear();
        let Some(origin) = at(0) else { return false };
        let mut extent = 0.0_f64;
        for k in 0..corners.len() {
            match at(k) {
                // halves, so that no difference overflows; the comparison fails for NaN
                Some(p) if p.is_finite() => extent = extent.max((p * 0.5 - origin * 0.5).abs().max_element()),
                _ => return false,
            }
        }
        let scaled = |k: usize| at(k).map_or(DVec3::ZERO, |p| (p * 0.5 - origin * 0.5) / extent);
        let mut normal = DVec3::ZERO;
        let mut from = scaled(corners.len() - 1);
        for k in 0..corners.len() {
            let to = scaled(k);
            normal += from.cross(to);
            from = to;
        }
        let size = normal.abs();
        let longest = size.max_element();
        if longest.is_nan() || longest <= 0.0 {
            return false;
        }
        let axis = if size.x == longest {
            0
        } else if size.y == longest {
            1
        } else {
            2
        };
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (u, v) = if normal[axis] > 0.0 { (u, v) } else { (v, u) };
        self.points.extend((0..corners.len()).filter_map(at).map(|p| [p[u], p[v]]));
        true
    }

    fn fan_is_proper(&self) -> bool {
        let p = &self.points;
        (2..p.len()).all(|k| orient2d(p[0], p[k - 1], p[k]) == Sign::Positive)
    }

    /// Clips ears until a triangle is left; `false` where none is found or the work is more than allowed.
    fn clip_ears(&mut self, corners: &[u32], triangles: &mut Vec<[u32; 3]>) -> bool {
        let n = corners.len();
        self.work = WORK * n * n;
        self.next.clear();
        self.next.extend((0..n).map(|k| (k + 1) % n));
        self.previous.clear();
        self.previous.extend((0..n).map(|k| (k + n - 1) % n));
        self.reflex.clear();
        self.reflex.resize(n, false);
        for k in 0..n {
            self.reflex[k] = self.turn(k) != Sign::Positive;
        }
        self.ear.clear();
        self.ear.resize(n, false);
        for k in 0..n {
            self.ear[k] = self.is_ear(k);
        }
        let mut at = 1;
        for left in (4..=n).rev() {
            let Some(ear) = self.find_ear(at, left) else { return false };
            let (before, after) = (self.previous[ear], self.next[ear]);
            triangles.push([corners[before], corners[ear], corners[after]]);
            self.next[before] = after;
            self.previous[after] = before;
            for k in [before, after] {
                self.reflex[k] = self.turn(k) != Sign::Positive;
            }
            for k in [before, after] {
                self.ear[k] = self.is_ear(k);
            }
            at = after;
        }
        triangles.push([corners[self.previous[at]], corners[at], corners[self.next[at]]]);
        true
    }

    /// The first ear from corner `at` on in a ring of `left` corners.
    fn find_ear(&mut self, mut at: usize, left: usize) -> Option<usize> {
        for _ in 0..left {
            if self.ear[at] {
                return Some(at);
            }
            at = self.next[at];
        }
        // Clipping an ear can free only its neighbours in a simple polygon; in another it may have freed any corner.
        for _ in 0..left {
            if self.work == 0 {
                return None;
            }
            if self.is_ear(at) {
                return Some(at);
            }
            at = self.next[at];
        }
        None
    }

    fn turn(&self, k: usize) -> Sign {
        orient2d(self.points[self.previous[k]], self.points[k], self.points[self.next[k]])
    }

    fn is_ear(&mut self, k: usize) -> bool {
        if self.reflex[k] {
            return false;
        }
        let [a, b, c] = [self.previous[k], k, self.next[k]].map(|i| self.points[i]);
        let low = [0, 1].map(|i| a[i].min(b[i]).min(c[i]));
        let high = [0, 1].map(|i| a[i].max(b[i]).max(c[i]));
        let mut other = self.next[self.next[k]];
        while other != self.previous[k] {
            self.work = self.work.saturating_sub(1);
            let p = self.points[other];
            let boxed = low[0] <= p[0] && p[0] <= high[0] && low[1] <= p[1] && p[1] <= high[1];
            // A corner at the same place as one of the ear (the two ends of a slit) does not block it.
            if boxed && self.reflex[other] && p != a && p != b && p != c && covers(a, b, c, p) {
                return false;
            }
            other = self.next[other];
        }
        true
    }
}

/// Whether the closed counter-clockwise triangle covers the point.
fn covers(a: [f64; 2], b: [f64; 2], c: [f64; 2], p: [f64; 2]) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| orient2d(from, to, p) != Sign::Negative)
}

fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
}
