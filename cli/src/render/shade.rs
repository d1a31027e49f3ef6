//! [`Shader`]: the colour of a sample of a triangle.
//!
//! Method: with the eye at the origin and `n_i = v_j x v_k` for each edge opposite to corner i, a ray d meets the plane of
//! the triangle with barycentric coordinates proportional to `n_i . d` \[Olano97\]: perspective-correct attributes, and the
//! distance in the picture to an edge line is `|n_i . d|` over the length of the first two components of `n_i`.
//! Light: a key light with soft shadow, a sky with soft occlusion, a fill and a rim light without shadow, a little
//! specular reflection \[Blinn77\].

use super::camera::View;
use super::color::Rgb;
use super::light::Lights;
use super::model::Model;
use super::normals;
use super::scene::{Edges, Field, Paint, Scene, Shading, Style};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Toward the key, fill and rim light in view coordinates: over the viewer's left shoulder, from the right, from behind.
const KEY: DVec3 = DVec3::new(-0.55, 0.75, 0.62);
const FILL: Vec3 = Vec3::new(0.80, 0.10, 0.60);
const RIM: Vec3 = Vec3::new(0.45, 0.55, -0.80);
/// Strengths, relative to a white surface fully lit at 1.
const KEY_LIGHT: Rgb = Rgb::new(0.84, 0.81, 0.76);
const SKY_LIGHT: Rgb = Rgb::new(0.42, 0.42, 0.44);
const FILL_LIGHT: Rgb = Rgb::new(0.15, 0.13, 0.11);
const RIM_LIGHT: Rgb = Rgb::new(0.16, 0.16, 0.17);
/// Share of the sky's light that stands for what surfaces send each other where no sky is seen.
const BETWEEN: f32 = 0.16;
const SPECULAR: f32 = 0.09;
/// Share of its own colour that a highlighted triangle shows without light.
const GLOW: f32 = 0.35;

/// Toward the key light, of unit length.
pub(super) fn key_direction() -> DVec3 {
    KEY.normalize()
}

/// A point of the picture that is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// In pixels, y downward.
    pub(super) x: f64,
    pub(super) y: f64,
    /// Number among the samples of its pixel.
    pub(super) index: usize,
    /// Different for every sample of a picture.
    pub(super) seed: u32,
}

impl Sample {
    /// Two numbers in [-1, 1], scattered by a permuted congruential step \[ONeill14\].
    fn jitter(&self) -> [f32; 2] {
        let state = self.seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        let word = (word >> 22) ^ word;
        [word & 0xffff, word >> 16].map(|v| v as f32 * (1.0 / 32_768.0) - 1.0)
    }
}

/// What shading needs to know of all triangles.
pub(super) struct Shader<'a> {
    model: &'a Model,
    positions: &'a [DVec3],
    lights: &'a Lights,
    view: View,
    layers: Vec<LayerShader<'a>>,
}

struct LayerShader<'a> {
    first_vertex: usize,
    first_triangle: usize,
    style: Style,
    paint: Paint<'a>,
    /// Colour table and range of a field.
    colors: Vec<Rgb>,
    range: [f64; 2],
    /// Empty for flat shading.
    normals: Vec<[Vec3; 3]>,
}

/// A triangle made ready for many samples.
pub(super) struct Facet {
    pub(super) source: u32,
    layer: usize,
    /// `v_j x v_k`.
    edge: [DVec3; 3],
    /// Pixels a unit of `edge . d`.
    pixels: [f64; 3],
    /// Facet normal and corner normals, toward the eye.
    side: Vec3,
    corners: [Vec3; 3],
    /// Surface colour at the corners, or the positions in the colour table.
    albedo: Albedo,
    /// Opacity of edge lines.
    line: f32,
    pub(super) opacity: f32,
}

enum Albedo {
    Flat(Rgb),
    Field([f64; 3]),
    Glowing(Rgb),
}

impl<'a> Shader<'a> {
    pub(super) fn new(
        scene: &Scene<'a>,
        model: &'a Model,
        positions: &'a [DVec3],
        lights: &'a Lights,
        view: View,
    ) -> Self {
        let layers = scene
            .layers
            .iter()
            .zip(&model.starts)
            .map(|(l, &(first_vertex, first_triangle))| {
                let normals = match l.style.shading {
                    Shading::Flat => Vec::new(),
                    Shading::Smooth { crease_degrees } => normals::corner_normals(
                        model,
                        positions,
                        first_triangle,
                        l.triangles.len(),
                        crease_degrees,
                    ),
                };
                let (colors, range) = match l.paint {
                    Paint::Plain | Paint::Triangles(_) => (Vec::new(), [0.0, 1.0]),
                    Paint::VertexField(f) | Paint::TriangleField(f) => (f.map.table(), range(&f)),
                };
                LayerShader {
                    first_vertex,
                    first_triangle,
                    style: l.style,
                    paint: l.paint,
                    colors,
                    range,
                    normals,
                }
            })
            .collect();
        Self { model, positions, lights, view, layers }
    }

    /// Style of the layer of a triangle.
    pub(super) fn style(&self, source: u32) -> &Style {
        &self.layers[self.model.layer(source)].style
    }

    /// Prepares a triangle.
    pub(super) fn facet(&self, source: u32) -> Facet {
        let index = self.model.layer(source);
        let layer = &self.layers[index];
        let v = self.model.corners(self.positions, source);
        let edge = [v[1].cross(v[2]), v[2].cross(v[0]), v[0].cross(v[1])];
        let determinant = v[0].dot(edge[0]);
        let front = determinant < 0.0;
        let toward = if front { 1.0f32 } else { -1.0 };
        let side = normals::facet(v).as_vec3() * toward;
        let corners = match layer.normals.get(source as usize - layer.first_triangle) {
            Some(normals) => normals.map(|n| n * toward),
            None => [side; 3],
        };
        let pixels = edge.map(|n| self.view.focal / (n.x * n.x + n.y * n.y).sqrt().max(f64::MIN_POSITIVE));
        let highlighted = self.model.highlighted[source as usize];
        let line = layer.style.edges.map_or(0.0, |e| {
            let mut heights: [f64; 3] =
                std::array::from_fn(|i| (determinant / v[i].z.min(-1e-9)).abs() * pixels[i]);
            heights.sort_by(f64::total_cmp);
            line_opacity(&e, heights[1])
        });
        Facet {
            source,
            layer: index,
            edge,
            pixels,
            side,
            corners,
            albedo: layer.albedo(self.model, source, front, highlighted),
            line,
            opacity: if highlighted { 1.0 } else { layer.style.opacity as f32 },
        }
    }

    /// Colour of a hidden highlighted facet, seen through others: its own light only, dimmer where it turns away.
    pub(super) fn ghost(&self, facet: &Facet, at: Sample) -> Rgb {
        let Albedo::Glowing(accent) = facet.albedo else { return self.color(facet, at) };
        let ray = self.view.ray(at.x, at.y);
        let facing = facet.side.dot(-ray.normalize_or_zero().as_vec3()).clamp(0.0, 1.0);
        accent * (0.85 + 0.3 * facing)
    }

    /// Colour of a facet at a sample.
    pub(super) fn color(&self, facet: &Facet, at: Sample) -> Rgb {
        let ray = self.view.ray(at.x, at.y);
        let e = facet.edge.map(|n| n.dot(ray));
        let sum = e[0] + e[1] + e[2];
        // Seen edge on, or a sample that the grid gave to a triangle it just misses: clamped into the triangle.
        let inverse = if sum.abs() > f64::MIN_POSITIVE { 1.0 / sum } else { 0.0 };
        let b = e.map(|v| (v * inverse).clamp(0.0, 1.0));
        let total = b[0] + b[1] + b[2];
        let b = if total > 0.0 { b.map(|v| v / total) } else { [1.0 / 3.0; 3] };
        let v = self.model.corners(self.positions, facet.source);
        let point = (v[0] * b[0] + v[1] * b[1] + v[2] * b[2]).as_vec3();
        let w = b.map(|v| v as f32);
        let n = facet.corners;
        let normal = (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).normalize_or_zero();
        let (albedo, glow) = match facet.albedo {
            Albedo::Flat(c) => (c, 0.0),
            Albedo::Glowing(c) => (c, GLOW),
            Albedo::Field(t) => {
                (self.layers[facet.layer].field(t[0] * b[0] + t[1] * b[1] + t[2] * b[2]), 0.0)
            }
        };
        // Lifted toward the smooth surface that the corner normals suggest [Hanika21]: else a coarse mesh shadows itself.
        let lift = (0..3).fold(Vec3::ZERO, |sum, i| {
            let below = (point - v[i].as_vec3()).dot(n[i]).min(0.0);
            sum - n[i] * (w[i] * below)
        });
        let mut color = self.lit(albedo, point, point + lift, normal, at) * (1.0 - glow) + albedo * glow;
        if facet.line > 0.0
            && let Some(edges) = self.layers[facet.layer].style.edges
        {
            let sides = (0..3).filter(|&i| edges.sides[i]);
            let distance = sides.map(|i| e[i].abs() * facet.pixels[i]).fold(f64::INFINITY, f64::min);
            // Half of the line lies on either side of the edge.
            let cover = (0.5 * edges.width - distance + 0.25).clamp(0.0, 0.5) * 2.0;
            // In shadow a line stays darker than the surface.
            let ink = edges.color.least(color * 0.4);
            color = color.mix(ink, cover as f32 * facet.line);
        }
        color
    }

    fn lit(&self, albedo: Rgb, point: Vec3, lifted: Vec3, normal: Vec3, at: Sample) -> Rgb {
        let toward_eye = (-point).normalize_or_zero();
        let key = key_direction().as_vec3();
        let [sky_seen, key_seen] = self.lights.reaching(lifted, normal, at.index, at.jitter());
        // Light between surfaces reaches into cavities.
        let sky_seen = BETWEEN + (1.0 - BETWEEN) * sky_seen;
        let key_light = normal.dot(key).max(0.0) * key_seen;
        let fill = (normal.dot(FILL) * 0.5 + 0.5).max(0.0) * sky_seen;
        let rim = normal.dot(RIM).max(0.0) * sky_seen;
        let light = SKY_LIGHT * (self.lights.open_sky(normal) * sky_seen)
            + KEY_LIGHT * key_light
            + FILL_LIGHT * fill
            + RIM_LIGHT * rim;
        let half = (key + toward_eye).normalize_or_zero();
        let x = normal.dot(half).max(0.0);
        let x = x * x;
        let x = x * x;
        let x = x * x;
        let x = x * x;
        let specular = SPECULAR * x * x * key_seen;
        tone(albedo * light + Rgb::new(specular, specular, specular))
    }
}

/// Bends light above the knee so that it still shows differences: x (1 + x / w^2) / (1 + x) \[Reinhard02\] above it, which is
/// smooth at the knee and reaches full light at w.
fn tone(c: Rgb) -> Rgb {
    const KNEE: f32 = 0.7;
    const FULL: f32 = 2.2;
    let bend = |v: f32| {
        let x = ((v - KNEE) / (1.0 - KNEE)).clamp(0.0, FULL);
        v.min(KNEE) + (1.0 - KNEE) * x * (1.0 + x / (FULL * FULL)) / (1.0 + x)
    };
    Rgb::new(bend(c.r), bend(c.g), bend(c.b))
}

/// Fades lines where triangles are not much wider than they.
fn line_opacity(edges: &Edges, height: f64) -> f32 {
    let x = ((height / edges.width.max(0.1) - 2.0) / 6.0).clamp(0.0, 1.0);
    (edges.opacity * x * x * (3.0 - 2.0 * x)) as f32
}

fn range(field: &Field<'_>) -> [f64; 2] {
    field.range.unwrap_or_else(|| {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = field
            .values
            .par_iter()
            .filter(|v| v.is_finite())
            .fold(|| none, |[low, high], &v| [low.min(v), high.max(v)])
            .reduce(|| none, |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        if low <= high { [low, high] } else { [0.0, 1.0] }
    })
}

impl LayerShader<'_> {
    fn albedo(&self, model: &Model, source: u32, front: bool, highlighted: bool) -> Albedo {
        let local = source as usize - self.first_triangle;
        if highlighted {
            return Albedo::Glowing(self.style.accent);
        }
        if !front {
            return Albedo::Flat(self.style.back);
        }
        match self.paint {
            Paint::Plain => Albedo::Flat(self.style.front),
            Paint::Triangles(colors) => Albedo::Flat(Rgb::of_bytes(colors[local])),
            Paint::TriangleField(f) => Albedo::Flat(self.field(self.place(f.values[local]))),
            Paint::VertexField(f) => Albedo::Field(
                model.triangles[source as usize]
                    .map(|v| self.place(f.values[v as usize - self.first_vertex])),
            ),
        }
    }

    /// Position of a value in its range; halves keep the difference from overflowing.
    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let span = 0.5 * high - 0.5 * low;
        if span > 0.0 { ((0.5 * value - 0.5 * low) / span).clamp(0.0, 1.0) } else { 0.5 }
    }

    fn field(&self, t: f64) -> Rgb {
        if t.is_nan() { Rgb::of_bytes([128, 128, 128]) } else { self.colors[(t * 255.0 + 0.5) as usize] }
    }
}
