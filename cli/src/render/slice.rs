//! Pictures of numbers in a plane: a colour map with contour lines, [`Slice`].
//!
//! Each pixel has the colour of the interpolated number at its middle; blue is below the level and orange above, as far from white as the
//! number is from the level. Contour lines by marching squares at multiples of a round step, that of the level itself thick.

use super::caption::{Layout, cover_segment};
use super::color::Rgb;
use super::color_map::ColorMap;
use super::image::Image;
use super::scene::Caption;
use rayon::prelude::*;
use welter_meshing::grid::Samples;
use welter_meshing::isosurface::{IsosurfaceError, MarchingSquares, marching_squares};
use welter_meshing::{DVec2, Monitor};

/// Contours wanted on each side of the level: enough to see slopes, few enough to tell lines apart.
const CONTOURS: f64 = 8.0;
/// Radius of lines in shares of the shorter side of the picture, and at least in pixels.
const LEVEL_LINE: f32 = 0.0022;
const OTHER_LINE: f32 = 0.0007;
const LEAST_RADIUS: f32 = 0.5;
/// How dark lines other than that of the level are.
const OTHER_DARKNESS: f32 = 0.45;
/// Free space around the plane in shares of the shorter side.
const MARGIN: f32 = 0.03;
const PAPER: [u8; 3] = [250, 250, 248];
const INK: [u8; 3] = [28, 32, 40];

/// What is drawn.
pub(crate) struct Slice<'a> {
    pub(crate) samples: &'a Samples<2>,
    /// The number whose contour is thick.
    pub(crate) level: f64,
    /// What the two axes of the plane are called, to the right and up.
    pub(crate) axes: [&'a str; 2],
    pub(crate) title: String,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
}

/// The picture, and the step between contours.
pub(crate) fn slice(slice: &Slice<'_>) -> Result<(Image, f64), IsosurfaceError> {
    let values = slice.samples.values().iter().filter(|v| v.is_finite());
    let reach = values.map(|v| (v - slice.level).abs()).fold(0.0, f64::max);
    let step = round_step(reach / CONTOURS);
    let caption = caption(slice, reach, step);
    let [width, height] = slice.size;
    let pixels = vec![PAPER; width as usize * height as usize];
    let mut image = Image { width, height, pixels };
    let layout = Layout::of(&caption, slice.size);
    let sheet = Sheet::new(slice, layout.as_ref().map_or(0.0, Layout::height));
    sheet.color(&mut image, slice, reach);
    for (level, is_main) in levels(slice.level, reach, step) {
        let contours = marching_squares(
            slice.samples,
            &MarchingSquares { level, ..Default::default() },
            &Monitor::none(),
        )?;
        let place = |v: u32| sheet.pixel(contours.positions[v as usize]);
        let segments: Vec<_> = contours.segments.iter().map(|s| s.map(place)).collect();
        let short = width.min(height) as f32;
        let share = if is_main { LEVEL_LINE } else { OTHER_LINE };
        let darkness = if is_main { 1.0 } else { OTHER_DARKNESS };
        ink(&mut image, &segments, (share * short).max(LEAST_RADIUS), darkness);
    }
    let [(left, top), (right, bottom)] = [sheet.corner, sheet.far_corner].map(|c| (c[0], c[1]));
    let frame = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
    let frame: Vec<_> = frame.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    ink(&mut image, &frame, LEAST_RADIUS, 1.0);
    if let Some(layout) = layout {
        layout.draw(&mut image);
    }
    Ok((image, step))
}

/// The levels of contours, the main one last, so that it lies above the others.
fn levels(main: f64, reach: f64, step: f64) -> Vec<(f64, bool)> {
    if step == 0.0 {
        return vec![(main, true)];
    }
    // `reach / step` is at most 20, so nothing is rounded away.
    let count = (reach / step).floor() as i32;
    let others = (-count..=count).filter(|&k| k != 0).map(|k| (main + f64::from(k) * step, false));
    others.chain([(main, true)]).collect()
}

/// The smallest of 1, 2 or 5 times a power of ten that is at least `least`; 0 for 0.
fn round_step(least: f64) -> f64 {
    if !(least > 0.0 && least.is_finite()) {
        return 0.0;
    }
    let power = libm::pow(10.0, libm::log10(least).floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= least).unwrap_or(10.0);
    factor * power
}

fn caption(slice: &Slice<'_>, reach: f64, step: f64) -> Caption {
    let grid = slice.samples.grid();
    let (min, max) = (grid.origin(), grid.max());
    let number = crate::numbers::number;
    let axis = |k: usize| format!("{} from {} to {}", slice.axes[k], number(min[k]), number(max[k]));
    let extent = format!("{} (right), {} (up)", axis(0), axis(1));
    let contours = format!("contours every {}, thick at {}", number(step), number(slice.level));
    let ends = [slice.level - reach, slice.level + reach].map(number);
    Caption {
        title: slice.title.clone(),
        lines: vec![(None, extent), (None, contours)],
        scale: Some((ColorMap::Diverging, ends)),
    }
}

/// Where the plane is on the picture.
struct Sheet {
    /// Upper left and lower right corner in pixels.
    corner: [f32; 2],
    far_corner: [f32; 2],
    origin: DVec2,
    /// Pixels a unit of length.
    scale: f64,
}

impl Sheet {
    fn new(slice: &Slice<'_>, reserved: f32) -> Self {
        let grid = slice.samples.grid();
        let (min, max) = (DVec2::from_array(grid.origin()), DVec2::from_array(grid.max()));
        let [width, height] = slice.size.map(|side| side as f32);
        let margin = MARGIN * width.min(height);
        let room = [(width - 2.0 * margin).max(1.0), (height - reserved - 2.0 * margin).max(1.0)];
        let scale = (f64::from(room[0]) / (max.x - min.x)).min(f64::from(room[1]) / (max.y - min.y));
        let size = [((max.x - min.x) * scale) as f32, ((max.y - min.y) * scale) as f32];
        let corner = [0.5 * (width - size[0]), margin + 0.5 * (room[1] - size[1])];
        Self { corner, far_corner: [corner[0] + size[0], corner[1] + size[1]], origin: min, scale }
    }

    fn pixel(&self, point: DVec2) -> [f32; 2] {
        let p = (point - self.origin) * self.scale;
        [self.corner[0] + p.x as f32, self.far_corner[1] - p.y as f32]
    }

    fn point(&self, x: f64, y: f64) -> DVec2 {
        let right = x - f64::from(self.corner[0]);
        let up = f64::from(self.far_corner[1]) - y;
        self.origin + DVec2::new(right, up) / self.scale
    }

    fn color(&self, image: &mut Image, slice: &Slice<'_>, reach: f64) {
        let table = ColorMap::Diverging.table();
        let width = image.width as usize;
        let columns = self.corner[0].round() as usize..(self.far_corner[0].round() as usize).min(width);
        let rows =
            self.corner[1].round() as usize..(self.far_corner[1].round() as usize).min(image.height as usize);
        image.pixels.par_chunks_mut(width).enumerate().for_each(|(row, pixels)| {
            if !rows.contains(&row) {
                return;
            }
            for column in columns.clone() {
                let point = self.point(column as f64 + 0.5, row as f64 + 0.5);
                let value = slice.samples.interpolate(point.to_array()) - slice.level;
                let t = if reach > 0.0 { 0.5 + 0.5 * (value / reach).clamp(-1.0, 1.0) } else { 0.5 };
                // 256 colours are as many as can be told apart; infinite minus infinite is NaN and drawn as the level.
                let index = if t.is_nan() { 128.0 } else { t * 255.0 };
                pixels[column] = table[index as usize].to_bytes();
            }
        });
    }
}

/// Draws segments as one line, so that joints are no darker than the rest.
fn ink(image: &mut Image, segments: &[[[f32; 2]; 2]], radius: f32, darkness: f32) {
    let mut cover = vec![0.0_f32; image.pixels.len()];
    for [a, b] in segments {
        cover_segment(&mut cover, [image.width, image.height], *a, *b, radius);
    }
    let ink = Rgb::of_bytes(INK);
    for (pixel, cover) in image.pixels.iter_mut().zip(cover) {
        if cover > 0.0 {
            *pixel = Rgb::of_bytes(*pixel).mix(ink, cover * darkness).to_bytes();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::grid::Grid2;

    #[test]
    fn steps_are_round_and_no_smaller_than_asked() {
        for (least, step) in [(1.0, 1.0), (1.1, 2.0), (0.021, 0.05), (6.0, 10.0), (0.0, 0.0), (f64::NAN, 0.0)]
        {
            assert!((round_step(least) - step).abs() <= 1e-15 * step, "{least}: {}", round_step(least));
        }
    }

    #[test]
    fn inside_is_blue_outside_is_orange_and_the_level_is_dark() {
        let grid = Grid2::new([-1.0; 2], 0.125, [16, 16]).unwrap();
        let values = (0..grid.node_count()).map(|n| grid.position(grid.node_at(n)).x).collect();
        let samples = Samples::new(grid, values);
        let view =
            Slice { samples: &samples, level: 0.0, axes: ["x", "y"], title: String::new(), size: [600, 600] };
        let (image, step) = slice(&view).unwrap();
        assert_eq!(step, 0.2);
        let [left, right] = [100, 500].map(|x| image.pixel(x, 200));
        assert!(left[2] > left[0] + 50 && right[0] > right[2] + 50, "{left:?} {right:?}");
        let darkest = (295..305).map(|x| image.pixel(x, 200)).min_by_key(|p| p[0]).unwrap();
        assert_eq!(darkest, INK);
        assert_eq!(image.pixel(1, 1), PAPER);
    }

    #[test]
    fn values_that_are_no_finite_numbers_are_drawn() {
        let grid = Grid2::new([0.0; 2], 1.0, [2, 1]).unwrap();
        let values = vec![0.0, f64::INFINITY, -1.0, f64::NEG_INFINITY, 2.0, 1.0];
        let samples = Samples::new(grid, values);
        let view =
            Slice { samples: &samples, level: 0.5, axes: ["y", "z"], title: "t".into(), size: [200, 180] };
        assert!(slice(&view).is_ok());
        let flat = Samples::new(grid, vec![0.5; 6]);
        assert_eq!(slice(&Slice { samples: &flat, ..view }).unwrap().1, 0.0);
    }
}
