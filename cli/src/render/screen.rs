//! [`Screen`]: the surface projected to the sample grid and sorted into horizontal strips.

use super::camera::View;
use super::clip::{self, Plane};
use super::model::Model;
use super::raster::{Corner, LIMIT, SUBDIVISIONS, Window, triangle};
use super::surface::Surface;
use glam::{DVec3, DVec4};
use rayon::prelude::*;

/// Nearest visible distance, at unit size.
const NEAR: f64 = 1e-4;

/// Triangles on the sample grid, by strip.
pub(super) struct Screen {
    /// Every vertex; meaningful where `plain`.
    corners: Vec<Corner>,
    /// Triangles that had to be clipped, with the triangle they come from.
    clipped: Vec<([Corner; 3], u32)>,
    /// For each strip, ascending: triangles by id, then `triangle count + index` into `clipped`.
    bins: Vec<Vec<u32>>,
}

/// Strips of the sample grid: strip `i` holds rows `i * rows - apron` to `(i + 1) * rows + apron`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strips {
    /// Samples a pixel along each axis.
    pub(super) samples: i32,
    /// Sample rows of a strip without its apron.
    pub(super) rows: i32,
    /// Samples beyond the edge on every side that a filter reads.
    pub(super) apron: i32,
    /// How many.
    pub(super) count: usize,
}

impl Screen {
    /// Projects.
    pub(super) fn of(model: &Model, surface: &Surface, view: &View, strips: Strips) -> Self {
        let samples = f64::from(strips.samples);
        // Guard planes: the grid must hold what is not clipped. A slope of `reach` projects to half the grid.
        let reach = 0.5 * LIMIT / f64::from(SUBDIVISIONS) / (samples * view.focal);
        let planes: [Plane; 5] = [
            DVec4::new(0.0, 0.0, -1.0, -NEAR),
            DVec4::new(1.0, 0.0, -reach, 0.0),
            DVec4::new(-1.0, 0.0, -reach, 0.0),
            DVec4::new(0.0, 1.0, -reach, 0.0),
            DVec4::new(0.0, -1.0, -reach, 0.0),
        ];
        let plain = |p: DVec3| planes.iter().all(|&plane| clip::signed(plane, p) >= 0.0);
        let snap = |p: DVec3| {
            let at = view.project(p) * samples;
            Corner::snap(at.x, at.y, -1.0 / p.z)
        };
        let corners: Vec<(Corner, bool)> = surface
            .positions
            .par_iter()
            .map(|&p| if plain(p) { (snap(p), true) } else { (Corner::default(), false) })
            .collect();
        let mut screen =
            Self { corners: Vec::new(), clipped: Vec::new(), bins: vec![Vec::new(); strips.count] };
        for &t in &surface.whole {
            let found = model.corners(&corners, t);
            if found.iter().all(|c| c.1) {
                screen.sort(t, found.map(|c| c.0), strips);
            } else {
                let clipped = &mut screen.clipped;
                clip::clip(model.corners(&surface.positions, t), &planes, |part| {
                    clipped.push((part.map(snap), t))
                });
            }
        }
        for piece in &surface.pieces {
            let clipped = &mut screen.clipped;
            clip::clip(piece.corners, &planes, |part| clipped.push((part.map(snap), piece.source)));
        }
        for i in 0..screen.clipped.len() {
            screen.sort((model.triangles.len() + i) as u32, screen.clipped[i].0, strips);
        }
        screen.corners = corners.into_iter().map(|c| c.0).collect();
        screen
    }

    fn sort(&mut self, item: u32, corners: [Corner; 3], strips: Strips) {
        let [a, b, c] = corners.map(|c| c.y.div_euclid(SUBDIVISIONS));
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let first = (low - strips.apron).div_euclid(strips.rows).max(0);
        let last = (high + strips.apron).div_euclid(strips.rows).min(strips.count as i32 - 1);
        for strip in first..=last {
            self.bins[strip as usize].push(item);
        }
    }

    /// Calls `plot(x, y, depth, triangle)` for each sample of a strip that each triangle covers, in order of triangles.
    pub(super) fn scan(
        &self,
        model: &Model,
        strip: usize,
        window: Window,
        mut wanted: impl FnMut(u32) -> bool,
        mut plot: impl FnMut(i32, i32, f32, u32),
    ) {
        for &item in &self.bins[strip] {
            let (corners, source) = match (item as usize).checked_sub(model.triangles.len()) {
                None => (model.corners(&self.corners, item), item),
                Some(i) => self.clipped[i],
            };
            if wanted(source) {
                triangle(corners, window, |x, y, depth| plot(x, y, depth, source));
            }
        }
    }
}
