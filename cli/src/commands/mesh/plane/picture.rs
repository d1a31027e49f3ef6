//! A mesh of an area from above: [`draw`].
//!
//! Each copy of a region has a colour. Where several quadrilaterals lie on one cell it is striped in the colours of all of them.

use crate::codes::Code;
use crate::commands::mesh::Args;
use crate::failure::Failure;
use crate::picture::distinct;
use crate::render::Image;
use crate::{machine, numbers};
use rayon::prelude::*;
use welter_meshing::volumetric::plane::{AreaMesh, ClosedPolylines};
use welter_meshing::{Cancelled, DVec2, Monitor};

/// Share of the picture that the grid takes at most.
const FILLED: f64 = 0.94;
/// Width of stripes in pixels, along a row.
const STRIPE: u32 = 7;
/// Cells of fewer pixels have no lines between them.
const LEAST_CELL: f64 = 8.0;
/// Sides of the dots that make up the curves, in pixels.
const PEN: u32 = 2;
const PAPER: [u8; 3] = [255, 255, 255];
const INK: [u8; 3] = [33, 37, 45];

/// From the plane to pixels: `x` to the right, `y` up.
#[derive(Clone, Copy)]
struct View {
    /// Pixels for each unit of length.
    scale: f64,
    middle: DVec2,
    size: [u32; 2],
}

impl View {
    /// The whole grid.
    fn of(area: &AreaMesh, size: [u32; 2]) -> Self {
        let [low, high] = [area.mesh.grid().origin(), area.mesh.grid().max()].map(DVec2::from_array);
        let [width, height] = size.map(f64::from);
        let scale = FILLED * (width / (high.x - low.x)).min(height / (high.y - low.y));
        Self { scale, middle: 0.5 * low + 0.5 * high, size }
    }

    /// The point at the middle of a pixel.
    fn point(&self, [x, y]: [u32; 2]) -> DVec2 {
        let [width, height] = self.size.map(f64::from);
        let from_middle = DVec2::new(f64::from(x) + 0.5 - 0.5 * width, 0.5 * height - f64::from(y) - 0.5);
        self.middle + from_middle / self.scale
    }

    /// A point in pixels from the upper left corner.
    fn pixel(&self, p: DVec2) -> DVec2 {
        let [width, height] = self.size.map(f64::from);
        let from_middle = (p - self.middle) * self.scale;
        DVec2::new(0.5 * width + from_middle.x, 0.5 * height - from_middle.y)
    }
}

/// A failure if the picture takes more memory than is free.
pub(super) fn affordable(args: &Args) -> Result<(), Box<Failure>> {
    let [width, height] = args.picture_size;
    let needed = 3 * u64::from(width) * u64::from(height);
    match machine::available_memory().filter(|&free| needed > free) {
        None => Ok(()),
        Some(free) => {
            let what = format!(
                "a picture of {width} x {height} pixels may take {}, and {} are free",
                numbers::bytes(needed),
                numbers::bytes(free)
            );
            Err(Failure::new(Code::OverMemory, what).help("--picture-size 1200x900"))
        }
    }
}

/// Draws a mesh and its curves.
pub(super) fn draw(
    curves: &ClosedPolylines,
    area: &AreaMesh,
    size: [u32; 2],
    monitor: &Monitor<'_>,
) -> Result<Image, Cancelled> {
    let view = View::of(area, size);
    let [width, height] = size;
    let mut pixels = vec![PAPER; width as usize * height as usize];
    let stage = monitor.stage("drawing", u64::from(height));
    pixels.par_chunks_mut(width as usize).zip(0..height).try_for_each(|(row, y)| {
        stage.check()?;
        for (pixel, x) in row.iter_mut().zip(0..) {
            if let Some(color) = color(area, &view, [x, y]) {
                *pixel = color;
            }
        }
        stage.advance(1);
        Ok(())
    })?;
    let mut image = Image { width, height, pixels };
    for segment in 0..curves.len() as u32 {
        monitor.check()?;
        line(&mut image, curves.segment(segment).map(|p| view.pixel(p)));
    }
    Ok(image)
}

/// The colour of the mesh at a pixel; none beside it.
fn color(area: &AreaMesh, view: &View, [x, y]: [u32; 2]) -> Option<[u8; 3]> {
    let grid = area.mesh.grid();
    let at = (view.point([x, y]) - DVec2::from_array(grid.origin())) / grid.spacing();
    let [nx, ny] = grid.cells();
    if !(at.x >= 0.0 && at.y >= 0.0 && at.x < f64::from(nx) && at.y < f64::from(ny)) {
        return None;
    }
    let cell = grid.cell_index([at.x as u32, at.y as u32]) as u64;
    let cells = area.mesh.cells();
    let first = cells.partition_point(|&other| other < cell);
    let count = cells[first..].iter().take_while(|&&other| other == cell).count();
    let stripe = ((x + y) / STRIPE) as usize;
    let quadrilateral = first + stripe.checked_rem(count)?;
    let color = distinct(area.copies[quadrilateral] as usize);
    let side = view.scale * grid.spacing();
    let to_line = (at - at.round()).abs().min_element() * side;
    let is_line = side >= LEAST_CELL && to_line < 0.5;
    Some(if is_line { color.map(|byte| byte / 4 * 3) } else { color })
}

/// A line of dots from one pixel to another.
fn line(image: &mut Image, [a, b]: [DVec2; 2]) {
    let steps = (b - a).abs().max_element().ceil().max(1.0);
    for step in 0..=steps as u32 {
        let p = a + (b - a) * (f64::from(step) / steps);
        // What lies beside the picture comes to lie on its edge, and there is nothing of the curves.
        let [left, top] = [p.x, p.y].map(|at| (at - 0.5 * f64::from(PEN - 1)).max(0.0) as u32);
        for y in top..(top + PEN).min(image.height) {
            for x in left..(left + PEN).min(image.width) {
                image.pixels[y as usize * image.width as usize + x as usize] = INK;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::volumetric::plane::mesh_area;
    use welter_meshing::volumetric::{Resolution, VolumeParameters};

    #[test]
    fn sheets_over_one_another_are_stripes() {
        let square = |x: f64| [[x, x], [x + 2.0, x], [x + 2.0, x + 2.0], [x, x + 2.0]].map(DVec2::from_array);
        let positions = [square(0.0), square(1.0)].concat();
        let curves =
            ClosedPolylines::new(positions, vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]]).expect("two squares");
        let parameters =
            VolumeParameters { resolution: Resolution::Spacing(0.25), ..VolumeParameters::default() };
        let area = mesh_area(&curves, &parameters, &Monitor::none()).expect("a mesh");
        let size = [300, 200];
        let image = draw(&curves, &area, size, &Monitor::none()).expect("nobody stops it");
        let view = View::of(&area, size);
        // The colours of a small square around a point.
        let colors = |x: f64, y: f64| {
            let at = view.pixel(DVec2::new(x, y));
            let [x, y] = [at.x as u32, at.y as u32];
            let mut colors: Vec<[u8; 3]> =
                (0..28).map(|k| image.pixel(x - 7 + k % 14, y - 1 + k / 14)).collect();
            colors.retain(|&color| color == distinct(0) || color == distinct(1));
            colors.sort_unstable();
            colors.dedup();
            colors
        };
        assert_eq!(colors(0.5, 0.5), [distinct(0)]);
        assert_eq!(colors(2.5, 2.5), [distinct(0)]);
        assert_eq!(colors(1.5, 1.5).len(), 2);
        assert_eq!(colors(2.7, 0.3), [[0; 3]; 0]);
        assert_eq!(image.pixel(0, 0), PAPER);
        for corner in 0..curves.len() as u32 {
            let at = view.pixel(curves.segment(corner)[0]);
            assert_eq!(image.pixel(at.x as u32, at.y as u32), INK, "{at}");
        }
    }
}
