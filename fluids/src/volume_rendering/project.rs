//! Triangles as the camera sees them: clipped to what lies before the eye, placed on the grid of the
//! rasteriser.
//!
//! Promises: a vertex is placed once, so neighbours stay neighbours; where an edge is clipped, both its
//! triangles get the same point. A triangle that cannot cover a pixel is left out, which changes no pixel.
//! What is interpolated is divided by the depth, so that it is linear in the image \[Blinn77\].
//!
//! Method: clipping to a pyramid with its apex in the eye, wider than the image. Everything in it lies before
//! the eye, so no near plane is needed; where the pyramid cuts a surface, that is beside the image or in the
//! eye itself.

use glam::DVec3;
use rayon::prelude::*;

use super::MAX_SIDE;
use super::camera::View;
use super::clip::{Corner, Polygon};
use super::raster::{Footprint, SUBDIVISION_BITS, snap};

/// From the middle of the image to the sides of the pyramid, in pixels: the image reaches half as far.
const GUARD: f64 = MAX_SIDE as f64;

/// Depths, in units of the largest coordinate, are taken as no less, so that their inverses are finite.
const LEAST_DEPTH: f64 = f64::from_bits((1023 - 600) << 52);

/// A triangle, or part of it, in the image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) footprint: Footprint,
    /// One over the depth of each corner.
    inverse_depth: [f64; 3],
    /// The value of each corner over its depth.
    value_over_depth: [f64; 3],
    /// Place of the triangle in the list.
    pub(super) triangle: u32,
}

impl Piece {
    /// Whether the ray enters what is behind the triangle's front, that from which its corners are seen
    /// counterclockwise.
    #[inline]
    pub(super) fn enters(&self) -> bool {
        // Seen with y downward, counterclockwise corners turn from y toward x.
        !self.footprint.is_positive()
    }

    /// Depth and value at weights of the corners.
    #[inline]
    pub(super) fn at(&self, weights: [f64; 3]) -> (f64, f64) {
        let sum =
            |values: &[f64; 3]| weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2];
        let depth = 1.0 / sum(&self.inverse_depth);
        (depth, depth * sum(&self.value_over_depth))
    }
}

/// A vertex as the camera sees it.
#[derive(Clone, Copy, Debug)]
struct Placed {
    corner: Corner,
    on_grid: [i32; 2],
    inverse_depth: f64,
    /// Whether it lies in the pyramid.
    inside: bool,
}

impl Placed {
    fn new(view: &View, corner: Corner) -> Self {
        let inverse_depth = 1.0 / corner.point.z.max(LEAST_DEPTH);
        let at = |v: f64, pixels: u32| {
            snap(v * inverse_depth * view.focal) + ((pixels as i32) << (SUBDIVISION_BITS - 1))
        };
        let on_grid = [at(corner.point.x, view.width), at(corner.point.y, view.height)];
        let inside = (0..4).all(|side| within(view, side, corner.point) > 0.0);
        Self { corner, on_grid, inverse_depth, inside }
    }
}

/// Above 0 on the inner side of a side of the pyramid.
#[inline]
fn within(view: &View, side: usize, p: DVec3) -> f64 {
    let across = if side < 2 { p.x } else { p.y };
    let outward = if side.is_multiple_of(2) { across } else { -across };
    GUARD * p.z - view.focal * outward
}

/// The pieces of triangles, in their order. `values` has one number a vertex, or none at all, which means 0.
pub(super) fn project<T: Fn(usize) -> [u32; 3] + Sync>(
    view: &View,
    positions: &[DVec3],
    values: &[f64],
    triangles: T,
    count: usize,
) -> Vec<Piece> {
    let place = |(vertex, &position): (usize, &DVec3)| {
        let value = values.get(vertex).copied().unwrap_or(0.0);
        Placed::new(view, Corner { point: view.place(position), value })
    };
    let vertices: Vec<Placed> = positions.par_iter().with_min_len(1024).enumerate().map(place).collect();
    let chunks: Vec<Vec<Piece>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut pieces = Vec::with_capacity(CHUNK);
            for triangle in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                let corners = triangles(triangle).map(|v| vertices[v as usize]);
                add(view, corners, triangle as u32, &mut pieces);
            }
            pieces
        })
        .collect();
    chunks.concat()
}

/// Triangles that a thread takes at once.
const CHUNK: usize = 4096;

fn add(view: &View, corners: [Placed; 3], triangle: u32, pieces: &mut Vec<Piece>) {
    if corners.iter().all(|c| c.inside) {
        pieces.extend(piece(view, corners, triangle));
        return;
    }
    if (0..4).any(|side| corners.iter().all(|c| within(view, side, c.corner.point) <= 0.0)) {
        return;
    }
    let mut polygon = Polygon::triangle(corners.map(|c| c.corner));
    for side in 0..4 {
        polygon.clone().cut(|p| within(view, side, p), |_| (), &mut polygon);
    }
    let placed: Vec<Placed> = polygon.corners().iter().map(|&c| Placed::new(view, c)).collect();
    for pair in placed.get(1..).unwrap_or_default().windows(2) {
        pieces.extend(piece(view, [placed[0], pair[0], pair[1]], triangle));
    }
}

fn piece(view: &View, corners: [Placed; 3], triangle: u32) -> Option<Piece> {
    let footprint = Footprint::new(corners.map(|c| c.on_grid), [view.width, view.height])?;
    let inverse_depth = corners.map(|c| c.inverse_depth);
    let value_over_depth = corners.map(|c| c.corner.value * c.inverse_depth);
    Some(Piece { footprint, inverse_depth, value_over_depth, triangle })
}

#[cfg(test)]
mod tests {
    use super::super::Camera;
    use super::super::raster::Window;
    use super::*;

    fn view() -> View {
        let camera = Camera::toward(DVec3::ZERO, DVec3::NEG_Z);
        View::new(&camera, 1.0, [40, 30]).expect("it looks along -z")
    }

    #[test]
    fn depth_and_value_are_those_of_the_plane_of_the_triangle() {
        let view = view();
        let positions =
            [DVec3::new(-9.0, -8.0, -4.0), DVec3::new(11.0, -7.0, -9.0), DVec3::new(0.0, 30.0, -20.0)];
        let values = positions.map(|p| 3.0 + p.x - 0.5 * p.z);
        let pieces = project(&view, &positions, &values, |_| [0, 1, 2], 1);
        let normal = (positions[1] - positions[0]).cross(positions[2] - positions[0]);
        let mut count = 0;
        for piece in &pieces {
            assert!(piece.enters(), "its corners are seen counterclockwise");
            piece.footprint.cover(&Window { x: 0..40, y: 0..30 }, |x, y, weights| {
                let (depth, value) = piece.at(weights);
                let ray = view.turned_back(view.ray(x, y));
                let exact = normal.dot(positions[0]) / normal.dot(ray);
                assert!((depth - exact).abs() < 1e-4 * exact, "{depth} {exact}");
                let point = exact * ray;
                assert!((value - (3.0 + point.x - 0.5 * point.z)).abs() < 1e-3);
                count += 1;
            });
        }
        assert!(count > 500, "{count}");
    }

    #[test]
    fn triangles_around_the_eye_are_cut_before_it() {
        let view = view();
        // Below the eye and through the plane of the eye, to infinity for the image.
        let positions =
            [DVec3::new(-9.0, -1.0, 5.0), DVec3::new(9.0, -1.0, 5.0), DVec3::new(0.0, -1.0, -50.0)];
        let pieces = project(&view, &positions, &[], |_| [0, 1, 2], 1);
        assert!(!pieces.is_empty());
        let mut rows = [0; 30];
        for piece in &pieces {
            piece.footprint.cover(&Window { x: 0..40, y: 0..30 }, |_, y, _| rows[y as usize] += 1);
        }
        assert_eq!(rows[..15], [0; 15], "nothing is above the horizon");
        assert_eq!(rows[29], 40, "the lowest row is full");
        let behind = positions.map(|p| p + 60.0 * DVec3::Z);
        assert!(project(&view, &behind, &[], |_| [0, 1, 2], 1).is_empty());
        let through = [DVec3::ZERO, DVec3::new(1.0, 0.0, -1.0), DVec3::new(0.0, 1.0, -1.0)];
        assert!(project(&view, &through, &[], |_| [0, 1, 2], 1).len() < 3);
    }
}
