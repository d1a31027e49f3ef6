//! Text on a picture: [`Layout`].
//!
//! Strokes of even width with round ends: a pixel's ink is its distance to the nearest stroke, so text is smooth at any size.

use super::color::Rgb;
use super::image::Image;
use super::scene::Caption;
use std::ops::Range;
use welter_meshing::field::text::{CAPITAL, GAP, glyph};

/// Height of capitals in the title and in the lines, as shares of the shorter side of the picture, and at least in pixels.
const TITLE: f32 = 0.024;
const LINE: f32 = 0.0165;
const LEAST: f32 = 6.0;
/// Distance from one baseline to the next, in heights of capitals, and of the text from the edges in lines' capitals.
const LEADING: f32 = 2.1;
const MARGIN: f32 = 2.4;
/// Width of strokes in heights of capitals.
const PEN: f32 = 0.125;
/// Pictures smaller than this get no text.
const LEAST_PICTURE: u32 = 160;
/// Colour of the ink.
const INK: [u8; 3] = [52, 58, 68];

/// Where the text of a caption stands.
pub(super) struct Layout<'a> {
    caption: &'a Caption,
    title: f32,
    line: f32,
    margin: f32,
}

impl<'a> Layout<'a> {
    /// `None` if there is no text or no room.
    pub(super) fn of(caption: &'a Caption, size: [u32; 2]) -> Option<Self> {
        let short = size[0].min(size[1]);
        if (caption.title.is_empty() && caption.lines.is_empty() && caption.scale.is_none())
            || short < LEAST_PICTURE
        {
            return None;
        }
        let height = |share: f32| (share * short as f32).max(LEAST);
        let layout =
            Self { caption, title: height(TITLE), line: height(LINE), margin: MARGIN * height(LINE) };
        // Half of the picture at most.
        (layout.height() < 0.5 * size[1] as f32).then_some(layout)
    }

    /// Rows at the bottom of the picture that it takes.
    pub(super) fn height(&self) -> f32 {
        let rows = self.caption.lines.len() + usize::from(self.caption.scale.is_some());
        let title = if self.caption.title.is_empty() { 0.0 } else { self.title };
        self.margin + title + rows as f32 * LEADING * self.line
    }

    /// Draws it.
    pub(super) fn draw(&self, image: &mut Image) {
        let ink = Rgb::of_bytes(INK);
        let room = image.width as f32 - 2.0 * self.margin;
        let mut baseline = image.height as f32 - self.margin;
        if let Some((map, [low, high])) = &self.caption.scale {
            let x = self.text(image, low, [self.margin, baseline], self.line, room, ink) + self.line;
            let width = (12.0 * self.line).min(room);
            for row in 0..self.line as usize {
                for column in 0..width as usize {
                    let color = map.at((column as f64 + 0.5) / f64::from(width));
                    blend(image, x as usize + column, (baseline as usize).saturating_sub(row), color, 1.0);
                }
            }
            self.text(image, high, [x + width + self.line, baseline], self.line, room, ink);
            baseline -= LEADING * self.line;
        }
        for (swatch, text) in self.caption.lines.iter().rev() {
            let mut x = self.margin;
            if let Some(color) = swatch {
                let radius = 0.5 * self.line;
                let middle = [x + radius, baseline - radius];
                stroke(image, &[middle, middle], radius, *color);
                x += 1.9 * self.line;
            }
            self.text(image, text, [x, baseline], self.line, room, ink);
            baseline -= LEADING * self.line;
        }
        if !self.caption.title.is_empty() {
            self.text(image, &self.caption.title, [self.margin, baseline], self.title, room, ink);
        }
    }

    /// Writes from the left end of a baseline as far as there is room; returns where it ended.
    fn text(&self, image: &mut Image, text: &str, at: [f32; 2], capital: f32, room: f32, ink: Rgb) -> f32 {
        let scale = capital / CAPITAL;
        let end = self.margin + room;
        let mut x = at[0];
        for c in text.chars() {
            let (width, strokes) = glyph(c);
            if x + width * scale > end {
                break;
            }
            for s in strokes {
                let points: Vec<[f32; 2]> =
                    s.points.iter().map(|p| [x + p[0] * scale, at[1] - p[1] * scale]).collect();
                stroke(image, &points, 0.5 * PEN * capital, ink);
            }
            x += (width + GAP) * scale;
        }
        x
    }
}

/// A polyline of a pen of this radius.
fn stroke(image: &mut Image, points: &[[f32; 2]], radius: f32, color: Rgb) {
    let (columns, rows) = pixels_near(points, radius, [image.width, image.height]);
    for y in rows {
        for x in columns.clone() {
            let p = [x as f32 + 0.5, y as f32 + 0.5];
            let squared = points.windows(2).map(|s| to_segment(p, s[0], s[1])).fold(f32::INFINITY, f32::min);
            let cover = ink(squared, radius);
            if cover > 0.0 {
                blend(image, x, y, color, cover);
            }
        }
    }
}

/// Raises the share of ink of each pixel, row by row, to what a segment drawn by a pen of this radius gives it.
pub(super) fn cover_segment(cover: &mut [f32], size: [u32; 2], a: [f32; 2], b: [f32; 2], radius: f32) {
    let (columns, rows) = pixels_near(&[a, b], radius, size);
    for y in rows {
        for x in columns.clone() {
            let share = ink(to_segment([x as f32 + 0.5, y as f32 + 0.5], a, b), radius);
            let pixel = &mut cover[y * size[0] as usize + x];
            *pixel = pixel.max(share);
        }
    }
}

/// The columns and rows that a pen of this radius may touch.
fn pixels_near(points: &[[f32; 2]], radius: f32, size: [u32; 2]) -> (Range<usize>, Range<usize>) {
    let reach = radius + 1.0;
    let bound = |axis: usize, most: u32| {
        let values = points.iter().map(|p| p[axis]);
        let low = values.clone().fold(f32::INFINITY, f32::min) - reach;
        let high = values.fold(f32::NEG_INFINITY, f32::max) + reach;
        (low.max(0.0) as usize)..((high.max(0.0) as usize + 1).min(most as usize))
    };
    (bound(0, size[0]), bound(1, size[1]))
}

/// The share of ink at a squared distance from the middle of a stroke.
fn ink(squared: f32, radius: f32) -> f32 {
    (radius + 0.5 - squared.sqrt()).clamp(0.0, 1.0) * (2.0 * radius).min(1.0)
}

/// Squared distance of a point to a segment.
fn to_segment(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
    let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = d[0] * d[0] + d[1] * d[1];
    let t = if length > 0.0 { ((q[0] * d[0] + q[1] * d[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    let r = [q[0] - d[0] * t, q[1] - d[1] * t];
    r[0] * r[0] + r[1] * r[1]
}

fn blend(image: &mut Image, x: usize, y: usize, color: Rgb, cover: f32) {
    if x < image.width as usize
        && let Some(pixel) = image.pixels.get_mut(y * image.width as usize + x)
    {
        *pixel = Rgb::of_bytes(*pixel).mix(color, cover).to_bytes();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(caption: &Caption, size: [u32; 2]) -> Image {
        let pixels = vec![[255; 3]; (size[0] * size[1]) as usize];
        let mut image = Image { width: size[0], height: size[1], pixels };
        if let Some(layout) = Layout::of(caption, size) {
            layout.draw(&mut image);
        }
        image
    }

    #[test]
    fn a_full_stop_is_a_dot_on_the_baseline_and_a_long_text_stays_in_the_margins() {
        let caption = |text: &str| Caption { title: text.into(), ..Caption::default() };
        let dot = page(&caption("."), [400, 400]);
        let dark: Vec<usize> = (0..160_000).filter(|&i| dot.pixels[i] != [255; 3]).collect();
        assert!((1..30).contains(&dark.len()));
        let long = page(&caption(&"MMMM ".repeat(100)), [400, 300]);
        let dark: Vec<usize> = (0..120_000).filter(|&i| long.pixels[i] != [255; 3]).collect();
        assert!(dark.len() > 500 && dark.iter().all(|i| (10..390).contains(&(i % 400))));
    }

    #[test]
    fn small_pictures_stay_clean() {
        let caption = Caption { title: "title".into(), ..Caption::default() };
        assert!(page(&caption, [100, 100]).pixels.iter().all(|&p| p == [255; 3]));
    }
}
