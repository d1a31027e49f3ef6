//! Pictures of surfaces: a small deterministic renderer on the CPU.
//!
//! What it computes: a [`Scene`] of triangle meshes to an [`Image`], with soft shadows, highlighted triangles that show
//! through what hides them, edges, cuts and colour maps.
//! Promises: the same bits for any number of threads (fixed strips, ordered merges, `libm` for what feeds pixels); no gaps
//! along shared edges; every finite coordinate is drawn, from subnormal to 1e308; a picture that is too large is refused
//! before it is allocated.
//! Does not promise: physical light, or the order of translucent surfaces beyond the sixth.
//! Method: see `raster`, `light`, `shade`, `picture`.
//! Complexity: O(triangles + samples), each times a small number of light maps.

mod camera;
mod caption;
mod clip;
mod color;
mod color_map;
mod floor;
mod glow;
mod image;
mod light;
mod model;
mod normals;
mod picture;
mod raster;
mod scene;
mod screen;
mod shade;
mod slice;
mod surface;
#[cfg(test)]
mod tests;

pub(crate) use camera::toward_eye;
pub(crate) use color::Rgb;
#[allow(unused_imports)] // for the commands that compute fields
pub(crate) use color_map::ColorMap;
pub(crate) use image::Image;
pub(crate) use picture::{memory_estimate, render};
#[allow(unused_imports)] // for the commands that compute fields
pub(crate) use scene::{Background, Field};
pub(crate) use scene::{
    Camera, Caption, Cut, Edges, Layer, MAX_SIDE, Paint, RenderError, Scene, Shading, Style, Up,
};
pub(crate) use slice::{Slice, slice};
