//! What is seen of solid objects: the first triangle along a ray, and its shade by Lambert's law.
//!
//! A point is lit if its side faces the light and no triangle of any solid is between; the ray to the light
//! starts beside the surface by 2^-32 of the size of the coordinates, so that rounding does not shade a
//! surface by itself. The length of smoke between is that along the ray to the light, by the smoke's surface.
//! Triangles are flat, and seen from both sides.

use glam::DVec3;
use welter_meshing::spatial::Bvh;
use welter_meshing::surface::TriId;

use super::camera::{View, unit};
use super::project::{Piece, project};
use super::raster::Window;
use super::shadow::{Scratch, Shadow};
use super::{Scene, Solid};

/// How far beside a surface the rays to the light start, in units of the largest coordinate.
const BESIDE: f64 = 1.0 / (1_u64 << 32) as f64;

/// The solids of a scene, ready to be seen.
pub(super) struct Solids<'a> {
    solids: &'a [Solid<'a>],
    trees: Vec<Bvh<'a>>,
    /// Of which solid a triangle in the common list is: first numbers of triangles.
    firsts: Vec<usize>,
    pieces: Vec<Piece>,
    to_light: DVec3,
    scale: f64,
    light: [f64; 3],
    ambient: [f64; 3],
}

/// The first solid surface along the rays of a tile.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    depths: Vec<f64>,
    pieces: Vec<u32>,
}

impl Surfaces {
    /// Depth of the surface that a pixel sees; infinite if none.
    pub(super) fn depth(&self, pixel: usize) -> f64 {
        self.depths[pixel]
    }

    /// Finds the surfaces in a tile, of pieces given ascending.
    pub(super) fn find(&mut self, tile: &Window, pieces: &[Piece], candidates: &[u32]) {
        let pixels = tile.area() as usize;
        self.depths.clear();
        self.depths.resize(pixels, f64::INFINITY);
        self.pieces.clear();
        self.pieces.resize(pixels, u32::MAX);
        let columns = tile.x.end - tile.x.start;
        for &index in candidates {
            let piece = &pieces[index as usize];
            piece.footprint.cover(tile, |x, y, weights| {
                let (depth, _) = piece.at(weights);
                let pixel = ((y - tile.y.start) * columns + (x - tile.x.start)) as usize;
                // Of equal depths the first triangle is seen.
                if depth < self.depths[pixel] {
                    (self.depths[pixel], self.pieces[pixel]) = (depth, index);
                }
            });
        }
    }
}

impl<'a> Solids<'a> {
    pub(super) fn new(scene: &Scene<'a>, view: &View, scale: f64) -> Self {
        let (mut firsts, mut positions, mut triangles) = (vec![0], Vec::new(), Vec::new());
        for solid in scene.solids {
            let base = positions.len() as u32;
            positions.extend(solid.mesh.positions().iter().map(|&p| p * scale));
            triangles.extend(solid.mesh.triangles().iter().map(|t| t.map(|v| base + v.0)));
            firsts.push(triangles.len());
        }
        let pieces = project(view, &positions, &[], |t| triangles[t], triangles.len());
        Self {
            solids: scene.solids,
            trees: scene.solids.iter().map(|solid| Bvh::new(solid.mesh)).collect(),
            firsts,
            pieces,
            to_light: unit(-scene.light.direction).unwrap_or(DVec3::ZERO),
            scale,
            light: scene.light.radiance,
            ambient: scene.light.ambient,
        }
    }

    /// All pieces of triangles in the image.
    pub(super) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// What is seen of the surface of a pixel, along a vector from the eye to depth 1 in the scene; none
    /// where there is no surface.
    pub(super) fn shade(
        &self,
        surfaces: &Surfaces,
        pixel: usize,
        eye: DVec3,
        ray: DVec3,
        shadow: &Shadow,
        scratch: &mut Scratch,
    ) -> Option<[f32; 3]> {
        let piece = self.pieces.get(surfaces.pieces[pixel] as usize)?;
        let at = piece.triangle as usize;
        let solid = self.firsts.partition_point(|&first| first <= at) - 1;
        let corners = self.solids[solid].mesh.corners(TriId((at - self.firsts[solid]) as u32));
        let [a, b, c] = corners.map(|p| p * self.scale);
        let normal = unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
        let normal = if normal.dot(ray) > 0.0 { -normal } else { normal };
        // The depth is that of a triangle whose corners were moved to the grid; the point is moved back onto
        // its plane.
        let seen = eye + surfaces.depth(pixel) * ray;
        let point = seen - (seen - a).dot(normal) * normal;
        let cosine = normal.dot(self.to_light);
        let mut direct = 0.0;
        if cosine > 0.0 && self.is_lit(point + BESIDE * normal) {
            direct = cosine * shadow.transmittance_of_smoke(point, scratch);
        }
        let albedo = self.solids[solid].albedo;
        Some([0, 1, 2].map(|k| (albedo[k] * (self.light[k] * direct + self.ambient[k])) as f32))
    }

    /// Whether no solid is between a point, in scaled coordinates, and the light.
    fn is_lit(&self, point: DVec3) -> bool {
        let origin = point / self.scale;
        self.trees.iter().all(|tree| tree.ray_hits(origin, self.to_light).is_empty())
    }
}
