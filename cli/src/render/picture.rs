//! [`render`]: a scene to an image, strip by strip.
//!
//! Method: visibility buffers of several samples a pixel, shaded once visible, then filtered to pixels by a
//! tent a little wider than a pixel. Strips are independent and their size does not depend on the number of threads.

use super::camera::View;
use super::caption::Layout;
use super::color::{Rgb, dither};
use super::floor::Floor;
use super::glow::Glow;
use super::image::Image;
use super::light::Lights;
use super::model::Model;
use super::raster::Window;
use super::scene::{MAX_SIDE, RenderError, Scene, Shading};
use super::screen::{Screen, Strips};
use super::shade::{self, Facet, Sample, Shader};
use super::surface::Surface;
use rayon::prelude::*;

/// Pixel rows of a strip: its buffers stay in the cache.
const STRIP_ROWS: u32 = 16;
/// Translucent surfaces drawn behind each other at most.
const PEELS: usize = 6;
/// Relative depth by which a highlighted triangle comes before others in the same place.
const NEARER: f32 = 1.0 + 2e-6;
/// No triangle.
const NONE: u32 = u32::MAX;

/// Draws a scene.
///
/// The same scene gives the same bits for any number of threads.
///
/// # Errors
/// [`RenderError`]: nothing is allocated for a picture that is refused.
pub(crate) fn render(scene: &Scene<'_>) -> Result<Image, RenderError> {
    check(scene)?;
    let [width, height] = scene.size;
    let model = Model::of(scene)?;
    let view = View::of(scene, &model)?;
    let surface = Surface::of(&model, &view, scene.cut);
    let samples = scene.samples as usize;
    let strips = Strips {
        samples: scene.samples as i32,
        rows: STRIP_ROWS as i32 * scene.samples as i32,
        apron: filter(samples).0 as i32,
        count: height.div_ceil(STRIP_ROWS) as usize,
    };
    let screen = Screen::of(&model, &surface, &view, strips);
    let lights = Lights::of(&model, &surface, &view, shade::key_direction(), samples * samples);
    let shader = Shader::new(scene, &model, &surface.positions, &lights, view);
    let glow = Glow::of(&model, &surface, &view);
    let floor = if scene.floor { Floor::of(&model, &surface, &view, &lights) } else { None };
    let painter =
        Painter { scene, model: &model, view, strips, screen: &screen, shader: &shader, glow, floor };
    let mut pixels = vec![[0; 3]; width as usize * height as usize];
    pixels
        .par_chunks_mut(width as usize * STRIP_ROWS as usize)
        .enumerate()
        .for_each(|(strip, rows)| painter.paint(strip, rows));
    let mut image = Image { width, height, pixels };
    if let Some(layout) = Layout::of(&scene.caption, scene.size) {
        layout.draw(&mut image);
    }
    Ok(image)
}

fn check(scene: &Scene<'_>) -> Result<(), RenderError> {
    let [width, height] = scene.size;
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(RenderError::Size { width, height });
    }
    let needed = memory_estimate(scene);
    if needed > scene.max_memory {
        return Err(RenderError::Memory { width, height, needed, allowed: scene.max_memory });
    }
    let within = |name, value: f64, low: f64, high: f64, range| {
        let fault = RenderError::Parameter { name, value, range };
        if (low..=high).contains(&value) { Ok(()) } else { Err(fault) }
    };
    within("samples", f64::from(scene.samples), 1.0, 4.0, "1 to 4")?;
    if let Some(cut) = scene.cut {
        within("cut axis", cut.axis as f64, 0.0, 2.0, "0, 1 or 2 for x, y or z")?;
        within("cut value", cut.value, f64::MIN, f64::MAX, "a finite number")?;
    }
    for l in &scene.layers {
        within("opacity", l.style.opacity, f64::MIN_POSITIVE, 1.0, "above 0, at most 1")?;
        within("see_through", l.style.see_through, 0.0, 1.0, "0 to 1")?;
        if let Some(e) = l.style.edges {
            within("edge width", e.width, 0.0, 1000.0, "0 to 1000 pixels")?;
            within("edge opacity", e.opacity, 0.0, 1.0, "0 to 1")?;
        }
        if let Shading::Smooth { crease_degrees } = l.style.shading {
            within("crease angle", crease_degrees, 0.0, 180.0, "0 to 180 degrees")?;
        }
    }
    Ok(())
}

/// About how many bytes [`render`] needs at most.
pub(crate) fn memory_estimate(scene: &Scene<'_>) -> u64 {
    let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
    let samples = u64::from(scene.samples.min(4));
    let strip = u64::from(scene.size[0]) * u64::from(STRIP_ROWS + 2) * samples * samples;
    let threads = rayon::current_num_threads() as u64;
    let vertices: u64 = scene.layers.iter().map(|l| l.positions.len() as u64).sum();
    let triangles: u64 = scene.layers.iter().map(|l| l.triangles.len() as u64).sum();
    let maps = samples * samples * 12 * (1 << 20);
    // An image, a halo; per sample colour, depth and id of each peel; arrays of the model, the screen and the normals.
    pixels * 5 + strip * threads * (12 + 16 + 8 * PEELS as u64) + vertices * 120 + triangles * 100 + maps
}

/// Weights of the samples from `-reach` on around the middle of a pixel, as `(reach, weights)`; they sum to 1 and are
/// symmetric. For an even number of samples a pixel the middle lies between samples `-1` and `0`.
fn filter(samples: usize) -> (usize, Vec<f32>) {
    // Half the width of the tent, in pixels.
    const HALF_WIDTH: f64 = 0.92;
    let reach = samples / 2 + 1;
    let middle = if samples.is_multiple_of(2) { -0.5 } else { 0.0 };
    let end = reach as i32 - i32::from(samples.is_multiple_of(2));
    let at = |i: i32| (1.0 - ((f64::from(i) - middle) / samples as f64).abs() / HALF_WIDTH).max(0.0);
    let weights: Vec<f64> = (-(reach as i32)..=end).map(at).collect();
    let sum: f64 = weights.iter().sum();
    (reach, weights.iter().map(|w| (w / sum) as f32).collect())
}

struct Painter<'a> {
    scene: &'a Scene<'a>,
    model: &'a Model,
    view: View,
    strips: Strips,
    screen: &'a Screen,
    shader: &'a Shader<'a>,
    glow: Option<Glow>,
    floor: Option<Floor>,
}

/// Nearest triangle and its depth, for each sample of a strip.
struct Visible {
    depth: Vec<f32>,
    source: Vec<u32>,
}

impl Painter<'_> {
    fn paint(&self, strip: usize, rows: &mut [[u8; 3]]) {
        let Strips { samples, apron, .. } = self.strips;
        let width = self.scene.size[0] as i32;
        let height = (rows.len() / width as usize) as i32;
        let top = strip as i32 * self.strips.rows;
        let window =
            Window { x: (-apron, width * samples + apron), y: (top - apron, top + height * samples + apron) };
        let colors = self.samples(strip, window);
        self.filter(window, strip * STRIP_ROWS as usize, &colors, rows);
    }

    /// Colours of all samples in the window.
    fn samples(&self, strip: usize, window: Window) -> Vec<Rgb> {
        let columns = (window.x.1 - window.x.0) as usize;
        let mut peels = vec![self.nearest(strip, window, None)];
        let translucent = self.scene.layers.iter().any(|l| l.style.opacity < 1.0);
        while translucent && peels.len() < PEELS {
            let behind = self.nearest(strip, window, peels.last());
            if behind.source.iter().all(|&s| s == NONE) {
                break;
            }
            peels.push(behind);
        }
        let hidden = self.model.any_highlighted.then(|| self.highlighted(strip, window));
        let mut facets: Vec<Option<Facet>> = (0..PEELS + 1).map(|_| None).collect();
        let mut colors = Vec::with_capacity(peels[0].source.len());
        let n = self.strips.samples;
        for y in window.y.0..window.y.1 {
            for x in window.x.0..window.x.1 {
                let i = colors.len();
                debug_assert_eq!(i / columns, (y - window.y.0) as usize);
                let [px, py] = [x, y].map(|v| (f64::from(v) + 0.5) / f64::from(n));
                let index = (y.rem_euclid(n) * n + x.rem_euclid(n)) as usize;
                // A row has fewer than 2^16 + 8 samples.
                let seed = (y as u32).wrapping_mul(65_539).wrapping_add(x as u32);
                let at = Sample { x: px, y: py, index, seed };
                colors.push(self.color(&peels, hidden.as_ref(), &mut facets, i, at));
            }
        }
        colors
    }

    fn color(
        &self,
        peels: &[Visible],
        hidden: Option<&Visible>,
        facets: &mut [Option<Facet>],
        i: usize,
        at: Sample,
    ) -> Rgb {
        let mut ready = |slot: usize, source: u32| -> (Rgb, f32) {
            let place = &mut facets[slot];
            if place.as_ref().is_none_or(|f| f.source != source) {
                *place = None;
            }
            let facet = place.get_or_insert_with(|| self.shader.facet(source));
            let shade =
                if slot == PEELS { self.shader.ghost(facet, at) } else { self.shader.color(facet, at) };
            (shade, facet.opacity)
        };
        let mut below = 1.0;
        let mut color = Rgb::BLACK;
        for (slot, peel) in peels.iter().enumerate() {
            if peel.source[i] == NONE {
                break;
            }
            let (shade, opacity) = ready(slot, peel.source[i]);
            color = color + shade * (below * opacity);
            below *= 1.0 - opacity;
            if below < 1e-3 {
                break;
            }
        }
        if below > 0.0 {
            color = color + self.backdrop(at.x, at.y) * below;
        }
        let first = peels[0].source[i];
        if let Some(hidden) = hidden {
            let bright = first != NONE && self.model.highlighted[first as usize];
            if !bright {
                if let Some(glow) = &self.glow {
                    let halo = glow.at(at.x, at.y);
                    if halo > 0.0 {
                        color = color.mix(glow.color(self.shader), halo);
                    }
                }
                if hidden.source[i] != NONE && first != NONE {
                    let through = self.shader.style(hidden.source[i]).see_through as f32;
                    let (shade, _) = ready(PEELS, hidden.source[i]);
                    color = color.mix(shade, through);
                }
            }
        }
        color
    }

    fn backdrop(&self, x: f64, y: f64) -> Rgb {
        let background = &self.scene.background;
        let t = (y / f64::from(self.scene.size[1])).clamp(0.0, 1.0) as f32;
        let color = background.top.mix(background.bottom, t);
        match &self.floor {
            Some(floor) => color * floor.light(self.view.ray(x, y)),
            None => color,
        }
    }

    /// The nearest triangles, or the nearest behind those already found. Of equally near ones the first.
    fn nearest(&self, strip: usize, window: Window, before: Option<&Visible>) -> Visible {
        let columns = (window.x.1 - window.x.0) as usize;
        let size = columns * (window.y.1 - window.y.0) as usize;
        let mut found = Visible { depth: vec![0.0; size], source: vec![NONE; size] };
        let highlighted = &self.model.highlighted;
        self.screen.scan(
            self.model,
            strip,
            window,
            |_| true,
            |x, y, depth, source| {
                let i = (y - window.y.0) as usize * columns + (x - window.x.0) as usize;
                let depth = if highlighted[source as usize] { depth * NEARER } else { depth };
                if let Some(before) = before {
                    let last = (before.depth[i], before.source[i]);
                    if last.1 == NONE || depth > last.0 || (depth == last.0 && source <= last.1) {
                        return;
                    }
                }
                if depth > found.depth[i] || (depth == found.depth[i] && source < found.source[i]) {
                    found.depth[i] = depth;
                    found.source[i] = source;
                }
            },
        );
        found
    }

    /// The nearest highlighted triangles, hidden or not.
    fn highlighted(&self, strip: usize, window: Window) -> Visible {
        let columns = (window.x.1 - window.x.0) as usize;
        let size = columns * (window.y.1 - window.y.0) as usize;
        let mut found = Visible { depth: vec![0.0; size], source: vec![NONE; size] };
        let wanted = |source: u32| self.model.highlighted[source as usize];
        self.screen.scan(self.model, strip, window, wanted, |x, y, depth, source| {
            let i = (y - window.y.0) as usize * columns + (x - window.x.0) as usize;
            if depth > found.depth[i] {
                found.depth[i] = depth;
                found.source[i] = source;
            }
        });
        found
    }

    /// Samples to pixels.
    fn filter(&self, window: Window, top: usize, colors: &[Rgb], rows: &mut [[u8; 3]]) {
        let columns = (window.x.1 - window.x.0) as usize;
        let samples = self.scene.samples as usize;
        let width = self.scene.size[0] as usize;
        let (reach, weights) = filter(samples);
        let first = samples / 2;
        // Across each sample row, then down.
        let mut across = vec![Rgb::BLACK; width * (colors.len() / columns)];
        for (line, out) in colors.chunks_exact(columns).zip(across.chunks_exact_mut(width)) {
            for (x, pixel) in out.iter_mut().enumerate() {
                // Sample 0 of the pixel stands `reach` (the apron) into the line.
                let taps = &line[x * samples + first..][..weights.len()];
                *pixel = taps.iter().zip(&weights).fold(Rgb::BLACK, |sum, (&c, &w)| sum + c * w);
            }
        }
        debug_assert_eq!(reach, self.strips.apron as usize);
        for (y, out) in rows.chunks_exact_mut(width).enumerate() {
            for (x, pixel) in out.iter_mut().enumerate() {
                let sum = weights
                    .iter()
                    .enumerate()
                    .fold(Rgb::BLACK, |sum, (i, &w)| sum + across[(y * samples + first + i) * width + x] * w);
                *pixel = sum.to_bytes_dithered(dither(x, top + y));
            }
        }
    }
}
