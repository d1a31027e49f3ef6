//! [`Floor`]: soft shadows on a plane under the scene.
//!
//! Method: the light that reaches the nodes of a square grid on the plane, from all light maps at once, smoothed by two box
//! filters (so that the finitely many lights do not show) and interpolated bilinearly. The shadow fades toward the rim of
//! the grid. The plane itself is invisible: it only darkens the backdrop.

use super::camera::View;
use super::light::Lights;
use super::model::Model;
use super::surface::Surface;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Nodes along a side of the grid, and half its length in scene radii.
const SIDE: usize = 512;
const REACH: f32 = 2.8;
/// Radius of each box filter, in nodes: about 1/30 of the scene radius.
const BLUR: usize = 3;
/// Share of the backdrop's light that a fully hidden point keeps, and how the rest splits into sky and key light.
const DARKEST: f32 = 0.40;
const KEY_SHARE: f32 = 0.36;

/// A plane in view coordinates, `up . p = height`, and the light on it.
pub(super) struct Floor {
    up: DVec3,
    height: f64,
    /// Middle of the grid, and axes that take an offset to nodes.
    middle: Vec3,
    axes: [Vec3; 2],
    light: Vec<f32>,
}

impl Floor {
    /// Below the lowest point of the surface; `None` if the eye is not above it or there is no surface.
    pub(super) fn of(model: &Model, surface: &Surface, view: &View, lights: &Lights) -> Option<Self> {
        let up = view.up;
        let whole = surface.whole.par_iter().flat_map_iter(|&t| model.corners(&surface.positions, t));
        let pieces = surface.pieces.iter().flat_map(|p| p.corners).map(|p| up.dot(p));
        let lowest = whole.map(|p| up.dot(p)).reduce(|| f64::INFINITY, f64::min);
        let height = pieces.fold(lowest, f64::min);
        if !(height < -1e-3 && height.is_finite()) {
            return None;
        }
        let (centre, radius) = lights.extent();
        let up32 = up.as_vec3();
        let middle = centre + up32 * (height as f32 - up32.dot(centre));
        let (across, along) = up.any_orthonormal_pair();
        let node = 2.0 * REACH * radius / SIDE as f32;
        let axes = [across.as_vec3(), along.as_vec3()];
        let mut light: Vec<f32> = (0..SIDE * SIDE)
            .into_par_iter()
            .map(|i| {
                let [a, b] = [i % SIDE, i / SIDE].map(|k| k as f32 + 0.5 - 0.5 * SIDE as f32);
                let rim = (1.0 - (a * a + b * b).sqrt() / (0.5 * SIDE as f32)).clamp(0.0, 0.5) * 2.0;
                if rim == 0.0 {
                    return 1.0;
                }
                let [sky, key] = lights.on_floor(middle + axes[0] * (a * node) + axes[1] * (b * node), up32);
                let hidden = (1.0 - KEY_SHARE) * (1.0 - sky) + KEY_SHARE * (1.0 - key);
                1.0 - (1.0 - DARKEST) * hidden * rim * rim * (3.0 - 2.0 * rim)
            })
            .collect();
        for _ in 0..2 {
            light = blurred_rows_transposed(&blurred_rows_transposed(&light));
        }
        Some(Self { up, height, middle, axes: axes.map(|a| a / node), light })
    }

    /// Share of the backdrop's light at the point of the floor along a ray from the eye.
    #[inline]
    pub(super) fn light(&self, ray: DVec3) -> f32 {
        let slope = self.up.dot(ray);
        if slope >= -1e-6 {
            return 1.0;
        }
        let offset = (ray * (self.height / slope)).as_vec3() - self.middle;
        let [x, y] = self.axes.map(|axis| axis.dot(offset) + 0.5 * SIDE as f32 - 0.5);
        let inside = |v: f32| v > 0.0 && v < (SIDE - 1) as f32;
        if !inside(x) || !inside(y) {
            return 1.0;
        }
        let (i, j) = (x as usize, y as usize);
        let (fx, fy) = (x - i as f32, y - j as f32);
        let at = |i: usize, j: usize| self.light[j * SIDE + i];
        (at(i, j) * (1.0 - fx) + at(i + 1, j) * fx) * (1.0 - fy)
            + (at(i, j + 1) * (1.0 - fx) + at(i + 1, j + 1) * fx) * fy
    }
}

/// Box filter along rows, transposed.
fn blurred_rows_transposed(values: &[f32]) -> Vec<f32> {
    let scale = 1.0 / (2 * BLUR + 1) as f32;
    (0..SIDE * SIDE)
        .into_par_iter()
        .map(|i| {
            let (row, x) = (i % SIDE, (i / SIDE).clamp(BLUR, SIDE - 1 - BLUR));
            values[row * SIDE + x - BLUR..][..2 * BLUR + 1].iter().sum::<f32>() * scale
        })
        .collect()
}
