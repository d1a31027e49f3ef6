//! Shadows of solids on the smoke: the depth along the light of the first solid, a [`DepthMap`].
//!
//! Texels subdivide the columns of the shadow texture. A texel holds the depth of the first triangle that
//! covers its middle, by the rule of the rasteriser; between texels the answer lit or not is interpolated,
//! not the depth.

use glam::DVec3;
use rayon::prelude::*;

use super::MAX_SIDE;
use super::clip::{Corner, Polygon};
use super::light_space::Lattice;
use super::raster::{Footprint, Window, snap};

/// Rows of texels that a thread takes at once.
const BAND: usize = 16;

/// Depths in lattice coordinates, infinite where there is no solid.
#[derive(Debug)]
pub(super) struct DepthMap {
    depths: Vec<f32>,
    size: [usize; 2],
    /// Texels along a side of a voxel.
    texels: f32,
}

impl DepthMap {
    /// The map of triangles in scaled coordinates; none if none of them can cast a shadow on the smoke.
    /// Texels are larger than asked for where a side would have more than [`MAX_SIDE`] of them.
    pub(super) fn new(lattice: &Lattice, triangles: &[[DVec3; 3]], texels: u32) -> Option<Self> {
        if lattice.is_empty() || triangles.is_empty() {
            return None;
        }
        // Voxels along a side are at most 4096, a quarter of the most texels.
        let texels = texels.min(MAX_SIDE / lattice.size[0].max(lattice.size[1]) as u32);
        let pieces: Vec<Piece> = triangles
            .par_iter()
            .with_min_len(1024)
            .flat_map_iter(|triangle| pieces(lattice, triangle, texels))
            .collect();
        if pieces.is_empty() {
            return None;
        }
        let [width, height] = map_size(lattice, texels);
        let size = [width as usize, height as usize];
        let mut depths = vec![f32::INFINITY; size[0] * size[1]];
        depths.par_chunks_mut(size[0] * BAND).enumerate().for_each(|(band, depths)| {
            let first = (band * BAND) as u32;
            let rows = first..first + (depths.len() / size[0]) as u32;
            let window = Window { x: 0..width, y: rows.clone() };
            for piece in pieces.iter().filter(|piece| piece.footprint.meets_rows(&rows)) {
                piece.footprint.cover(&window, |x, y, weights| {
                    let depth: f64 = (0..3).map(|k| weights[k] * piece.depths[k]).sum();
                    let texel = &mut depths[(y - first) as usize * size[0] + x as usize];
                    *texel = texel.min(depth as f32);
                });
            }
        });
        Some(Self { depths, size, texels: texels as f32 })
    }

    /// How much of the surroundings of a point, in lattice coordinates, is before all solids.
    #[inline]
    pub(super) fn lit(&self, [x, y, z]: [f32; 3]) -> f32 {
        let ((i, next_i, u), (j, next_j, v)) =
            (between(x * self.texels, self.size[0]), between(y * self.texels, self.size[1]));
        let lit = |i: usize, j: usize| f32::from(u8::from(z <= self.depths[j * self.size[0] + i]));
        let upper = (1.0 - u) * lit(i, j) + u * lit(next_i, j);
        let lower = (1.0 - u) * lit(i, next_j) + u * lit(next_i, next_j);
        (1.0 - v) * upper + v * lower
    }
}

/// The two texels with middles next to a coordinate, and the part of the way between them.
#[inline]
fn between(coordinate: f32, count: usize) -> (usize, usize, f32) {
    let inside = (coordinate - 0.5).max(0.0).min((count - 1) as f32);
    let texel = (inside as usize).min(count - 1);
    (texel, (texel + 1).min(count - 1), inside - texel as f32)
}

/// A part of a triangle, seen along the light.
struct Piece {
    footprint: Footprint,
    depths: [f64; 3],
}

/// Texels along both sides, at most [`MAX_SIDE`].
fn map_size(lattice: &Lattice, texels: u32) -> [u32; 2] {
    [lattice.size[0] as u32 * texels, lattice.size[1] as u32 * texels]
}

/// The parts of a triangle that lie before the end of the lattice and over it.
fn pieces(lattice: &Lattice, triangle: &[DVec3; 3], texels: u32) -> Vec<Piece> {
    let [nx, ny, nz] = lattice.size.map(|n| n as f64);
    let placed = triangle.map(|p| lattice.place(p));
    let far = placed.iter().all(|p| p.z >= nz);
    let beside = [(0, nx), (1, ny)]
        .into_iter()
        .any(|(axis, end)| placed.iter().all(|p| p[axis] <= 0.0) || placed.iter().all(|p| p[axis] >= end));
    if far || beside {
        return Vec::new();
    }
    let mut polygon = Polygon::triangle(placed.map(|point| Corner { point, value: point.z }));
    let mut cut = polygon;
    // A voxel of margin, so that snapping to the grid does not uncover a texel at the border.
    for (axis, end) in [(0, nx + 1.0), (1, ny + 1.0)] {
        polygon.cut(|p| p[axis] + 1.0, |p| p[axis] = -1.0, &mut cut);
        cut.cut(|p| end - p[axis], |p| p[axis] = end, &mut polygon);
    }
    let size = map_size(lattice, texels);
    let place = |point: DVec3| {
        let texels = f64::from(texels);
        let at = |v: f64, n: u32| snap(v * texels - 0.5 * f64::from(n)) + ((n as i32) << 14);
        [at(point.x, size[0]), at(point.y, size[1])]
    };
    let fan = |pair: &[Corner]| {
        let corners = [polygon.corners()[0], pair[0], pair[1]];
        let footprint = Footprint::new(corners.map(|c| place(c.point)), size)?;
        Some(Piece { footprint, depths: corners.map(|c| c.value) })
    };
    polygon.corners().get(1..).unwrap_or_default().windows(2).filter_map(fan).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_plane_casts_a_shadow_with_a_narrow_edge() {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let lattice = Lattice { axes, origin: DVec3::ZERO, spacing: 1.0, size: [8, 8, 8] };
        let triangle = [DVec3::new(4.0, -1e9, 3.0), DVec3::new(4.0, 1e9, 3.0), DVec3::new(-1e9, 0.0, 3.0)];
        let map = DepthMap::new(&lattice, &[triangle], 4).expect("it lies before the smoke");
        for y in [0.0, 3.3, 8.0] {
            assert_eq!([2.0, 3.8].map(|x| map.lit([x, y, 3.5])), [0.0; 2]);
            assert_eq!([2.0, 3.8].map(|x| map.lit([x, y, 2.5])), [1.0; 2]);
            assert_eq!([4.2, 7.0].map(|x| map.lit([x, y, 3.5])), [1.0; 2]);
            assert_eq!(map.lit([4.0, y, 3.5]), 0.5);
        }
        assert!(DepthMap::new(&lattice, &[triangle.map(|p| p + 6.0 * DVec3::Z)], 4).is_none());
    }
}
