//! Text as a body: strokes of a pen, extruded: [`Text`]; and the strokes themselves: [`strokes`].
//!
//! # Method
//! Each character is a few polylines (`glyphs.rs`). With `d` the distance in the plane to the nearest of them, `r` the radius of the pen,
//! `h` half of the depth of the flat part and `z` the height above the middle plane:
//! ```text
//! flat ends      rectangle: q = (d - r, |z| - h),  |max(q, 0)| + min(max(q), 0)
//! rounded ends   tube:      |(d, max(|z| - h, 0))| - r
//! ```
//! Outside, both are distances to the body. Inside they are bounds: where strokes cross, the nearest border is that of the union of
//! strokes, which may be farther away than that of the nearest stroke.
//!
//! # Complexity
//! Linear in the number of strokes, and in the segments of those strokes whose boxes are near enough to matter.

mod glyphs;

pub use glyphs::{CAPITAL, GAP, Stroke, glyph};

use glam::{DVec2, DVec3};

use crate::field::error::{FieldError, require, require_length, require_length_or_zero};
use crate::field::{ScalarField, direction};
use crate::spatial::Box3;

/// Most characters of a text: a few pages, some 50,000 strokes.
pub const MAX_CHARACTERS: usize = 10_000;

/// Distance of lines in heights of capitals.
const LEADING: f64 = 1.9;

/// The strokes of words in the plane, with capitals of height 1. Lines, separated by `\n`, go down; each is centred, and so is the whole.
///
/// ```
/// use welter_meshing::field::text::strokes;
/// let l = strokes("l");
/// assert_eq!((l.len(), l[0].len()), (1, 2));
/// assert_eq!((l[0][0].y, l[0][1].y), (0.5, -0.5));
/// assert_eq!(strokes(" ").len(), 0);
/// ```
#[must_use]
pub fn strokes(words: &str) -> Vec<Vec<DVec2>> {
    let lines: Vec<&str> = words.split('\n').collect();
    let height = 1.0 + LEADING * (lines.len() - 1) as f64;
    let unit = 1.0 / f64::from(CAPITAL);
    let mut all = Vec::new();
    for (row, line) in lines.iter().enumerate() {
        let baseline = 0.5 * height - 1.0 - LEADING * row as f64;
        // Widths and the gap stand apart, so that the sum of whole numbers is not rounded.
        let advances: f64 = line.chars().map(|c| f64::from(glyph(c).0)).sum();
        let gap = f64::from(GAP);
        let mut x = -0.5 * (advances + gap * line.chars().count().saturating_sub(1) as f64);
        for c in line.chars() {
            let (advance, strokes) = glyph(c);
            all.extend(strokes.into_iter().map(|stroke| {
                let place =
                    |p: [f32; 2]| DVec2::new((x + f64::from(p[0])) * unit, baseline + f64::from(p[1]) * unit);
                stroke.points.into_iter().map(place).collect()
            }));
            x += f64::from(advance) + gap;
        }
    }
    all
}

/// How the extrusion ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Caps {
    /// Flat faces with sharp edges.
    #[default]
    Flat,
    /// As round as the pen: the body of a ball moved along the strokes, and through the depth.
    Rounded,
}

/// Parameters of [`Text`]. Words run along x, lines down along -y, the depth is along z; the middle is at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct TextShape {
    /// What it says: printable ASCII, others are drawn as `?`; `\n` begins a line. Default: `welter`.
    pub words: String,
    /// Height of capitals, from the middle of the lowest stroke to that of the highest, a positive length. Default: 1.
    pub height: f64,
    /// Radius of the pen, a positive length. Default: 0.08.
    pub pen_radius: f64,
    /// Depth of the whole body, a positive length, with rounded caps at least twice the radius of the pen. Default: 0.3.
    pub depth: f64,
    /// How it ends in front and behind. Default: flat.
    pub caps: Caps,
}

impl Default for TextShape {
    fn default() -> Self {
        Self { words: "welter".to_owned(), height: 1.0, pen_radius: 0.08, depth: 0.3, caps: Caps::Flat }
    }
}

/// Words drawn by a pen and extruded: see the head of the module.
///
/// Its gradient on a stroke is taken along +y, inside of flat ends that of the nearer face.
///
/// ```
/// use welter_meshing::{DVec3, field::{ScalarField, Text, TextShape}};
/// let text = Text::new(&TextShape { words: "I".into(), ..TextShape::default() })?;
/// assert!((text.value(DVec3::ZERO) + 0.08).abs() < 1e-15);
/// assert!((text.value(DVec3::X) - 0.92).abs() < 1e-15);
/// # Ok::<(), welter_meshing::field::FieldError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Text {
    strokes: Vec<Polyline>,
    pen_radius: f64,
    /// Half of the depth, less the radius of the pen where caps are rounded.
    half_depth: f64,
    caps: Caps,
}

/// A stroke and the corners of its box.
#[derive(Clone, Debug)]
struct Polyline {
    points: Vec<DVec2>,
    min: DVec2,
    max: DVec2,
}

impl Text {
    /// Lays out the words.
    ///
    /// # Errors
    /// [`FieldError`] for a parameter out of range, and for words of which nothing is seen or which are too long.
    pub fn new(shape: &TextShape) -> Result<Self, FieldError> {
        let &TextShape { ref words, height, pen_radius, depth, caps } = shape;
        require_length("height", height)?;
        require_length("pen_radius", pen_radius)?;
        require_length_or_zero("depth", depth)?;
        let least = if caps == Caps::Rounded { 2.0 * pen_radius } else { 0.0 };
        let deep = depth > 0.0 && depth >= least;
        require(deep, "depth", depth, "positive, with rounded caps at least twice pen_radius")?;
        let characters = words.chars().count();
        if characters > MAX_CHARACTERS {
            return Err(FieldError::TextTooLong { characters, limit: MAX_CHARACTERS });
        }
        let strokes: Vec<Polyline> = strokes(words)
            .into_iter()
            .map(|stroke| {
                let points: Vec<DVec2> = stroke.into_iter().map(|p| height * p).collect();
                let min = points.iter().fold(DVec2::INFINITY, |a, &b| a.min(b));
                let max = points.iter().fold(DVec2::NEG_INFINITY, |a, &b| a.max(b));
                Polyline { points, min, max }
            })
            .collect();
        if strokes.is_empty() {
            return Err(FieldError::NoStrokes);
        }
        Ok(Self { strokes, pen_radius, half_depth: 0.5 * (depth - least), caps })
    }

    /// The vector from the nearest point of the strokes, in the plane; of points at the same distance the first's.
    fn relative_to_strokes(&self, point: DVec2) -> DVec2 {
        let (mut nearest, mut squared) = (DVec2::NAN, f64::INFINITY);
        for stroke in &self.strokes {
            let beside = (stroke.min - point).max(point - stroke.max).max(DVec2::ZERO);
            if beside.length_squared() >= squared {
                continue;
            }
            for ends in stroke.points.windows(2) {
                let along = ends[1] - ends[0];
                let parameter = (point - ends[0]).dot(along) / along.length_squared();
                // NaN, for a segment of no length, counts as 0.
                let parameter = if parameter > 0.0 { parameter.min(1.0) } else { 0.0 };
                let from = point - (ends[0] + along * parameter);
                if from.length_squared() < squared {
                    (nearest, squared) = (from, from.length_squared());
                }
            }
        }
        nearest
    }
}

impl ScalarField for Text {
    fn value(&self, point: DVec3) -> f64 {
        let across = self.relative_to_strokes(point.truncate()).length();
        let along = point.z.abs() - self.half_depth;
        if across.is_nan() || along.is_nan() {
            return f64::NAN;
        }
        match self.caps {
            Caps::Flat => {
                let across = across - self.pen_radius;
                let (x, y) = (across.max(0.0), along.max(0.0));
                (x * x + y * y).sqrt() + across.max(along).min(0.0)
            }
            Caps::Rounded => {
                let along = along.max(0.0);
                (across * across + along * along).sqrt() - self.pen_radius
            }
        }
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let from = self.relative_to_strokes(point.truncate());
        let outward = direction(from.extend(0.0), DVec3::Y);
        let up = if point.z < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
        let along = point.z.abs() - self.half_depth;
        match self.caps {
            Caps::Flat => {
                let across = from.length() - self.pen_radius;
                let inside = if across >= along { outward } else { up };
                direction(across.max(0.0) * outward + along.max(0.0) * up, inside)
            }
            Caps::Rounded => direction(from.extend(0.0) + along.max(0.0) * up, outward),
        }
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let min = self.strokes.iter().fold(DVec2::INFINITY, |a, s| a.min(s.min));
        let max = self.strokes.iter().fold(DVec2::NEG_INFINITY, |a, s| a.max(s.max));
        let reach = self.pen_radius + level;
        let depth = match self.caps {
            Caps::Flat => self.half_depth + level,
            Caps::Rounded => self.half_depth + reach,
        };
        let around = Box3 { min: (min - reach).extend(-depth), max: (max + reach).extend(depth) };
        Some(if reach < 0.0 || around.is_empty() { Box3::EMPTY } else { around })
    }
}
