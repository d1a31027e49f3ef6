//! [`Lights`]: how much light reaches a point.
//!
//! Method: the surface is drawn as depth maps \[Williams78\] along directions spread over the whole sphere (a Fibonacci
//! lattice) for the light of the sky, and along a cone for the key light, the sun of the picture. A point sees a light if
//! nothing in its map is nearer. Each sample of a pixel asks its own share of the maps, so a pixel, the mean of its samples,
//! has asked them all: soft shadows at the price of hard ones.
//!
//! Promises: each map is drawn by one thread in order of triangles, so the same bits for any number of threads.
//! Does not promise: shadows finer than a texel of a map.

use super::camera::View;
use super::model::Model;
use super::raster::{Corner, Window, triangle};
use super::surface::Surface;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Texels along the side of a sky map, at most, and pixels of the shorter side of the picture for each.
const SKY_SIDE: i32 = 512;
const PIXELS_A_TEXEL: f64 = 1.7;
/// Texels of a key map for each of a sky map.
const KEY_FINER: i32 = 2;
/// Sky maps that one sample asks. Fewer on large meshes, where drawing the maps would be most of the work.
const SKY_SHARE: usize = 8;
const SKY_SHARE_LARGE: usize = 4;
const LARGE: usize = 300_000;
/// Half-angle of the key light, in degrees: softens shadow edges.
const KEY_SPREAD: f64 = 5.0;
/// A point is moved off its surface by this many texels, and must be hidden by more than as many, to be in shadow.
const OFFSET: f32 = 1.4;
const BIAS: f32 = 0.6;
/// Sky shadows are asked about within this many texels of a point, along the surface.
const JITTER: f32 = 3.0;
/// Golden angle, 180 (3 - sqrt 5) degrees in radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Nearest depths toward one direction.
struct Map {
    /// Toward the light.
    direction: Vec3,
    /// Axes across, scaled to texels.
    across: [Vec3; 2],
    side: i32,
    depths: Vec<f32>,
}

/// What casts shadows, from the middle of the scene in radii.
struct Solid<'a> {
    positions: Vec<Vec3>,
    whole: &'a [u32],
    pieces: Vec<[Vec3; 3]>,
}

/// Visibility of the sky and of the key light.
pub(super) struct Lights {
    centre: Vec3,
    radius: f32,
    up: Vec3,
    /// By sample of a pixel, `share` each.
    sky: Vec<Map>,
    share: usize,
    /// Texels along the side of a sky map.
    side: i32,
    /// One a sample of a pixel.
    key: Vec<Map>,
}

impl Map {
    fn of(model: &Model, solid: &Solid<'_>, direction: DVec3, side: i32) -> Self {
        let across = direction.any_orthonormal_vector();
        let along = direction.cross(across);
        let middle = 0.5 * side as f32;
        let axes = [across, along].map(|v| (v * f64::from(middle)).as_vec3());
        let direction = direction.as_vec3();
        let corner = |q: Vec3| {
            let at = |axis: Vec3| f64::from(q.dot(axis) + middle);
            Corner::snap(at(axes[0]), at(axes[1]), f64::from(q.dot(direction)))
        };
        let mut depths = vec![f32::NEG_INFINITY; (side * side) as usize];
        let window = Window { x: (0, side), y: (0, side) };
        let mut draw = |corners: [Corner; 3]| {
            triangle(corners, window, |x, y, depth| {
                let at = &mut depths[(y * side + x) as usize];
                *at = at.max(depth);
            });
        };
        let corners: Vec<Corner> = solid.positions.iter().map(|&q| corner(q)).collect();
        for &t in solid.whole {
            draw(model.corners(&corners, t));
        }
        for &piece in &solid.pieces {
            draw(piece.map(corner));
        }
        Self { direction, across: axes, side, depths }
    }

    /// Whether the light reaches `q` (from the centre, in radii).
    #[inline]
    fn lit(&self, q: Vec3) -> bool {
        let middle = 0.5 * self.side as f32;
        let (x, y) = ((q.dot(self.across[0]) + middle) as i32, (q.dot(self.across[1]) + middle) as i32);
        self.reaches(x, y, q.dot(self.direction) + BIAS / middle)
    }

    #[inline]
    fn reaches(&self, x: i32, y: i32, depth: f32) -> bool {
        let inside = (0..self.side).contains(&x) && (0..self.side).contains(&y);
        !inside || self.depths[(y * self.side + x) as usize] <= depth
    }

    /// Share of light, between the four nearest texels.
    #[inline]
    fn smooth(&self, q: Vec3) -> f32 {
        let middle = 0.5 * self.side as f32;
        let (x, y) = (q.dot(self.across[0]) + middle - 0.5, q.dot(self.across[1]) + middle - 0.5);
        // Made positive, so that the cast rounds down.
        let [x0, y0] = [x, y].map(|v| (v + 8192.0) as i32 - 8192);
        let (fx, fy) = (x - x0 as f32, y - y0 as f32);
        let depth = q.dot(self.direction) + BIAS / middle;
        let at = |dx, dy| if self.reaches(x0 + dx, y0 + dy, depth) { 1.0 } else { 0.0 };
        (at(0, 0) * (1.0 - fx) + at(1, 0) * fx) * (1.0 - fy) + (at(0, 1) * (1.0 - fx) + at(1, 1) * fx) * fy
    }
}

impl Lights {
    /// Draws all maps. `key` points toward the key light; `samples` a pixel.
    pub(super) fn of(model: &Model, surface: &Surface, view: &View, key: DVec3, samples: usize) -> Self {
        let centre = view.of_model(DVec3::ZERO);
        let radius = model.half_extent.length().max(1e-3) * 1.01;
        let large = model.triangles.len() > LARGE;
        let share = if large { SKY_SHARE_LARGE } else { SKY_SHARE };
        let count = share * samples;
        let side = ((view.size.min_element() / PIXELS_A_TEXEL) as i32).clamp(32, SKY_SIDE);
        let polar = |z: f64, turn: f64| {
            let ring = (1.0 - z * z).max(0.0).sqrt();
            DVec3::new(ring * libm::cos(turn), ring * libm::sin(turn), z)
        };
        let sky = (0..count).map(|i| {
            // Sample `i / share` gets every `samples`-th point of the lattice.
            let i = (i % share) * samples + i / share;
            (polar(1.0 - (2 * i + 1) as f64 / count as f64, i as f64 * GOLDEN_ANGLE), side)
        });
        let (across, along) = key.any_orthonormal_pair();
        let cap = 1.0 - libm::cos(KEY_SPREAD.to_radians());
        let cone = (0..samples).map(|i| {
            let q = polar(1.0 - cap * (i as f64 + 0.5) / samples as f64, i as f64 * GOLDEN_ANGLE);
            ((across * q.x + along * q.y + key * q.z).normalize(), KEY_FINER * side)
        });
        let directions: Vec<(DVec3, i32)> = sky.chain(cone).collect();
        let relative = |p: DVec3| ((p - centre) * radius.recip()).as_vec3();
        let solid = Solid {
            positions: surface.positions.par_iter().map(|&p| relative(p)).collect(),
            whole: &surface.whole,
            pieces: surface.pieces.iter().map(|p| p.corners.map(relative)).collect(),
        };
        let mut sky: Vec<Map> = directions
            .into_par_iter()
            .map(|(direction, side)| Map::of(model, &solid, direction, side))
            .collect();
        let key = sky.split_off(count);
        Self { centre: centre.as_vec3(), radius: radius as f32, up: view.up.as_vec3(), sky, share, side, key }
    }

    /// Radiance of the sky in a direction, relative: bright above, some light from the floor.
    #[inline]
    fn radiance(&self, direction: Vec3) -> f32 {
        0.6 + 0.4 * direction.dot(self.up)
    }

    /// Light of the unhidden sky on a surface with this normal (radiance integrated against the cosine, over pi).
    #[inline]
    pub(super) fn open_sky(&self, normal: Vec3) -> f32 {
        0.6 + 0.4 * (2.0 / 3.0) * normal.dot(self.up)
    }

    /// Shares of sky and key light that reach a point with this shading normal, for one of the samples of a pixel.
    /// `jitter` in [-1, 1] turns the edges of sky shadows into grain too fine to see.
    pub(super) fn reaching(&self, point: Vec3, normal: Vec3, sample: usize, jitter: [f32; 2]) -> [f32; 2] {
        let q = (point - self.centre) / self.radius;
        let off = |texels: i32| q + normal * (2.0 * OFFSET / texels as f32);
        let (across, along) = normal.any_orthonormal_pair();
        let at =
            off(self.side) + (across * jitter[0] + along * jitter[1]) * (2.0 * JITTER / self.side as f32);
        let (mut seen, mut all) = (0.0, 1e-6);
        for map in &self.sky[sample * self.share..][..self.share] {
            let weight = normal.dot(map.direction);
            if weight > 0.0 {
                let weight = weight * self.radiance(map.direction);
                all += weight;
                if map.lit(at) {
                    seen += weight;
                }
            }
        }
        let key = &self.key[sample];
        let key = if normal.dot(key.direction) > 0.0 { key.smooth(off(KEY_FINER * self.side)) } else { 0.0 };
        [(seen + 1e-6) / all, key]
    }

    /// Shares of sky and key light that reach a point of a floor with this normal, from all maps.
    pub(super) fn on_floor(&self, point: Vec3, up: Vec3) -> [f32; 2] {
        let q = (point - self.centre) / self.radius;
        let (mut seen, mut all) = (0.0, 1e-6);
        for map in &self.sky {
            let weight = up.dot(map.direction).max(0.0) * self.radiance(map.direction);
            all += weight;
            if weight > 0.0 && map.lit(q) {
                seen += weight;
            }
        }
        let lit = self.key.iter().filter(|map| map.lit(q)).count();
        [(seen + 1e-6) / all, lit as f32 / self.key.len() as f32]
    }

    /// Middle and radius of a ball around the scene.
    pub(super) fn extent(&self) -> (Vec3, f32) {
        (self.centre, self.radius)
    }
}
