//! [`Glow`]: a halo around highlighted triangles, so that even one smaller than a pixel, or hidden, is found.
//!
//! Method: their edges are marked in a pixel mask; the halo falls off with the distance to the nearest mark, exact up to the
//! radius (by columns, then rows).

use super::camera::View;
use super::clip;
use super::color::Rgb;
use super::model::Model;
use super::shade::Shader;
use super::surface::Surface;
use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

/// Radius of the halo as a share of the shorter side of the picture, and at least in pixels.
const RADIUS: f64 = 0.011;
const LEAST_RADIUS: f64 = 4.0;
/// Opacity of the halo at the mark.
const STRENGTH: f64 = 0.45;

/// Halo over a picture.
pub(super) struct Glow {
    width: usize,
    height: usize,
    /// 255 stands for `STRENGTH`.
    halo: Vec<u8>,
    /// A highlighted triangle, whose layer gives the colour.
    source: u32,
}

impl Glow {
    /// `None` if nothing is highlighted.
    pub(super) fn of(model: &Model, surface: &Surface, view: &View) -> Option<Self> {
        let source = model.highlighted.iter().position(|&h| h)? as u32;
        let (width, height) = (view.size.x as usize, view.size.y as usize);
        let mut mask = Mask { width, height, marks: vec![false; width * height] };
        let before_eye = DVec4::new(0.0, 0.0, -1.0, -1e-4);
        let mut outline = |corners: [DVec3; 3]| {
            clip::clip(corners, &[before_eye], |part| {
                let [a, b, c] = part.map(|p| view.project(p));
                mask.line(a, b);
                mask.line(b, c);
                mask.line(c, a);
            });
        };
        for &t in surface.whole.iter().filter(|&&t| model.highlighted[t as usize]) {
            outline(model.corners(&surface.positions, t));
        }
        for piece in surface.pieces.iter().filter(|p| model.highlighted[p.source as usize]) {
            outline(piece.corners);
        }
        let radius = (RADIUS * view.size.min_element()).max(LEAST_RADIUS);
        Some(Self { width, height, halo: mask.halo(radius), source })
    }

    /// Opacity at a point of the picture, in pixels.
    pub(super) fn at(&self, x: f64, y: f64) -> f32 {
        let place = |v: f64, n: usize| (v.max(0.0) as usize).min(n - 1);
        let value = self.halo[place(y, self.height) * self.width + place(x, self.width)];
        f32::from(value) * (STRENGTH as f32 / 255.0)
    }

    /// Its colour.
    pub(super) fn color(&self, shader: &Shader<'_>) -> Rgb {
        shader.style(self.source).accent
    }
}

struct Mask {
    width: usize,
    height: usize,
    marks: Vec<bool>,
}

impl Mask {
    /// Marks the pixels at half-pixel steps along a line.
    fn line(&mut self, a: DVec2, b: DVec2) {
        let size = DVec2::new(self.width as f64, self.height as f64);
        let Some((a, b)) = within(a, b, size) else { return };
        let steps = ((b - a).length() * 2.0).ceil().max(1.0);
        for i in 0..=steps as usize {
            let p = a + (b - a) * (i as f64 / steps);
            let (x, y) = (p.x as usize, p.y as usize);
            if x < self.width && y < self.height {
                self.marks[y * self.width + x] = true;
            }
        }
    }

    fn halo(&self, radius: f64) -> Vec<u8> {
        let reach = radius.ceil() as usize;
        let far = reach as u16 + 1;
        let (width, height) = (self.width, self.height);
        // Distance to the nearest mark in the same column: down, then up.
        let mut column = vec![far; width * height];
        for y in 0..height {
            for x in 0..width {
                let above = if y > 0 { column[(y - 1) * width + x] } else { far };
                column[y * width + x] = if self.marks[y * width + x] { 0 } else { far.min(above + 1) };
            }
        }
        for y in (0..height.saturating_sub(1)).rev() {
            for x in 0..width {
                column[y * width + x] = column[y * width + x].min(column[(y + 1) * width + x] + 1);
            }
        }
        let falloff = |squared: u32| {
            let t = (1.0 - f64::from(squared).sqrt() / radius).max(0.0);
            (255.0 * t * t) as u8
        };
        let mut halo = vec![0; width * height];
        halo.par_chunks_mut(width).zip(column.par_chunks(width)).for_each(|(out, near)| {
            if near.iter().all(|&d| d >= far) {
                return;
            }
            for (x, value) in out.iter_mut().enumerate() {
                let first = x.saturating_sub(reach);
                let squared = near[first..(x + reach + 1).min(width)]
                    .iter()
                    .enumerate()
                    .map(|(i, &d)| {
                        let dx = (first + i).abs_diff(x) as u32;
                        dx * dx + u32::from(d) * u32::from(d)
                    })
                    .min()
                    .unwrap_or(u32::MAX);
                *value = falloff(squared);
            }
        });
        halo
    }
}

/// The part of a segment inside `[0, size]`, by Liang and Barsky's parameters.
fn within(a: DVec2, b: DVec2, size: DVec2) -> Option<(DVec2, DVec2)> {
    let d = b - a;
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        for (speed, room) in [(-d[axis], a[axis]), (d[axis], size[axis] - a[axis])] {
            if speed == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if speed > 0.0 {
                leave = leave.min(room / speed);
            } else {
                enter = enter.max(room / speed);
            }
        }
    }
    (enter <= leave).then(|| (a + d * enter, a + d * leave))
}
