//! One picture from particles to the planes: [`render_particles`].
//!
//! Bands of rows go in parallel, each in tiles. A pixel depends on its own ray and on the slices, which are the same for the whole
//! image, so the picture does not depend on the bands or the threads.

use std::time::Instant;

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::{Cancelled, Monitor};

use super::super::camera::View;
use super::super::light_space::Lattice;
use super::super::picture::scale_of;
use super::super::pixels::Planes;
use super::super::raster::Window;
use super::super::resolve::Stretch;
use super::super::scattering::{Ray, Sampling, Travelled};
use super::super::shadow::{Scratch, Shadow};
use super::super::{Image, InteriorRule, Picture, RenderError, RenderParameters, RenderSeconds};
use super::columns::{Columns, Slices};
use super::discs::Disc;
use super::{ParticleScene, deposit, kernel};

/// Rows that a thread draws at once, and the columns of a tile, so that its slices stay in the cache.
const SIDE: usize = 16;

/// What was done for a picture of particles.
#[must_use]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ParticleReport {
    /// Particles that may cover a pixel.
    pub in_view: usize,
    /// Particles on all rays, one counted as often as rays meet it.
    pub met: u64,
    /// Most particles on one ray.
    pub most_met: u32,
    /// Pixels whose ray meets a particle.
    pub covered_pixels: u64,
    /// Voxels of the shadow texture along its axes; zeros if there is no particle.
    pub shadow_size: [usize; 3],
    /// Seconds that the stages took.
    pub seconds: RenderSeconds,
}

/// The picture of smoke that is given by particles, and what was done for it.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::marker_particles::fill;
/// use welter_fluids::volume_rendering::*;
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}, surface::measure::signed_volume};
///
/// let ball = sphere(&Sphere { edge_length: 0.2, ..Sphere::default() })?;
/// let positions = fill(&ball, 20_000, 0, &Monitor::none())?;
/// let scene = ParticleScene {
///     positions: &positions,
///     ages: &[],
///     particle_volume: signed_volume(&ball) / 20_000.0,
///     radius_rel: 2.0,
///     camera: Camera::toward(DVec3::new(0.0, 0.0, 8.0), DVec3::ZERO),
///     light: Light::default(),
///     medium: Medium::white(0.5),
///     background: [0.0; 3],
/// };
/// let parameters = RenderParameters { width: 65, height: 65, shadow_resolution: 32, ..Default::default() };
/// let (picture, report) = render_particles(&scene, &parameters, &Monitor::none())?;
/// // Through the middle of a ball of radius 1 the optical depth is 0.5 times 2.
/// assert!((picture.alpha.at(32, 32) - (1.0 - (-1.0_f32).exp())).abs() < 0.01);
/// assert!(picture.scatter.at(32, 32) < picture.alpha.at(32, 32));
/// assert_eq!(report.in_view, 20_000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RenderError`]: parameters or scene out of range, or a cancelled operation.
pub fn render_particles(
    scene: &ParticleScene<'_>,
    parameters: &RenderParameters,
    monitor: &Monitor<'_>,
) -> Result<(Picture, ParticleReport), RenderError> {
    parameters.validate()?;
    scene.validate()?;
    let start = Instant::now();
    let size = DVec3::splat(scene.radius());
    let scale = scale_of(scene.positions.iter().chain([&scene.camera.eye, &size]));
    let radius = scene.radius() * scale;
    let extinction = (scene.medium.extinction / scale).min(f64::MAX);
    let positions: Vec<DVec3> = scene.positions.iter().map(|&p| p * scale).collect();

    let stage = monitor.stage("shadow texture", 1);
    let shadow = shadow(scene, parameters, &positions, radius, extinction)?;
    let shadow_size = shadow.lattice().size;
    stage.advance(1);
    monitor.check()?;
    let shadow_end = start.elapsed().as_secs_f64();

    let view = View::new(&scene.camera, scale, [parameters.width, parameters.height])?;
    let disc = |(at, &center): (usize, &DVec3)| {
        Disc::new(&view, center, radius, scene.ages.get(at).copied().unwrap_or(0.0))
    };
    let discs: Vec<Disc> = positions.par_iter().enumerate().with_min_len(1024).filter_map(disc).collect();
    drop(positions);
    let projection_end = start.elapsed().as_secs_f64();

    let slices = Slices::new(&discs, radius, parameters.optical_step / extinction);
    let thickness = kernel::thickness(radius, scene.radius_rel);
    let sampling = Sampling::new(parameters);
    let easel = Easel { view, discs, slices, thickness, shadow, extinction, sampling };
    let (planes, counts) = easel.draw(scene.background.map(|c| c as f32), monitor)?;
    let pixels_end = start.elapsed().as_secs_f64();

    let picture = Picture::of(planes, parameters, &scene.light, &scene.medium);
    let seconds = RenderSeconds::of([shadow_end, projection_end, pixels_end, start.elapsed().as_secs_f64()]);
    let report = ParticleReport { in_view: easel.discs.len(), shadow_size, seconds, ..counts };
    Ok((picture, report))
}

/// The shadow texture of particles in scaled coordinates. Densities add up, as they do along rays.
fn shadow(
    scene: &ParticleScene<'_>,
    parameters: &RenderParameters,
    positions: &[DVec3],
    radius: f64,
    extinction: f64,
) -> Result<Shadow, RenderError> {
    let (light, resolution) = (scene.light.direction, parameters.shadow_resolution);
    let lattice = Lattice::enclosing(positions.iter().copied(), radius, light, resolution)?;
    let mut volumes = Vec::new();
    if !lattice.is_empty() {
        let centers: Vec<DVec3> = positions.iter().map(|&p| lattice.place_inside(p)).collect();
        let radius = radius / lattice.spacing;
        let side = radius / scene.radius_rel;
        volumes = deposit::volumes(&centers, radius, side * side * side, lattice.size);
    }
    Ok(Shadow::of_volumes(lattice, &volumes, extinction, InteriorRule::Multiplicity))
}

/// All that pixels are made from, in scaled coordinates.
struct Easel {
    view: View,
    discs: Vec<Disc>,
    slices: Slices,
    /// Of the middle of a particle.
    thickness: f64,
    shadow: Shadow,
    extinction: f64,
    sampling: Sampling,
}

/// The rows of a band in the planes.
struct Band<'a> {
    first: usize,
    alpha: &'a mut [f32],
    scatter: &'a mut [f32],
    age: &'a mut [f32],
}

impl Easel {
    fn draw(
        &self,
        background: [f32; 3],
        monitor: &Monitor<'_>,
    ) -> Result<(Planes, ParticleReport), Cancelled> {
        let (width, height) = (self.view.width as usize, self.view.height as usize);
        let plane = || Image::filled(width, height, 0.0);
        let backdrop = Image::filled(width, height, background);
        let mut planes = Planes { alpha: plane(), scatter: plane(), age: plane(), backdrop };
        let rows: Vec<[u16; 2]> = self.discs.iter().map(Disc::rows).collect();
        let chunk = width * SIDE;
        let bands = planes.alpha.pixels_mut().par_chunks_mut(chunk);
        let bands = bands.zip(planes.scatter.pixels_mut().par_chunks_mut(chunk));
        let bands = bands.zip(planes.age.pixels_mut().par_chunks_mut(chunk));
        let stage = monitor.stage("pixels", height.div_ceil(SIDE) as u64);
        let draw = |(index, ((alpha, scatter), age))| {
            stage.check()?;
            let report = self.draw_band(Band { first: index * SIDE, alpha, scatter, age }, &rows);
            stage.advance(1);
            Ok(report)
        };
        let all = bands.enumerate().map(draw).collect::<Result<Vec<ParticleReport>, Cancelled>>()?;
        let mut report = ParticleReport::default();
        for of_band in all {
            report.met += of_band.met;
            report.most_met = report.most_met.max(of_band.most_met);
            report.covered_pixels += of_band.covered_pixels;
        }
        Ok((planes, report))
    }

    fn draw_band(&self, mut band: Band<'_>, all_rows: &[[u16; 2]]) -> ParticleReport {
        let width = self.view.width as usize;
        let rows = band.first as u32..(band.first + band.alpha.len() / width) as u32;
        let meets = |[first, end]: &[u16; 2]| u32::from(*first) < rows.end && u32::from(*end) > rows.start;
        let all = (0_u32..).zip(all_rows);
        let candidates: Vec<u32> = all.filter(|(_, rows)| meets(rows)).map(|(disc, _)| disc).collect();
        let mut report = ParticleReport::default();
        let (mut columns, mut in_tile) = (Columns::default(), Vec::new());
        for left in (0..width).step_by(SIDE) {
            let tile = Window { x: left as u32..(left + SIDE).min(width) as u32, y: rows.clone() };
            let meets = |disc: &&u32| !self.discs[**disc as usize].window().meet(&tile).is_empty();
            in_tile.clear();
            in_tile.extend(candidates.iter().filter(meets));
            if !in_tile.is_empty() {
                columns.find(&tile, &self.view, &self.slices, self.thickness, &self.discs, &in_tile);
                self.draw_tile(&tile, &columns, &mut band, &mut report);
            }
        }
        report
    }

    fn draw_tile(&self, tile: &Window, columns: &Columns, band: &mut Band<'_>, report: &mut ParticleReport) {
        let lattice = self.shadow.lattice();
        let origin = lattice.place(self.view.eye).to_array();
        let (mut pixel, mut scratch) = (0, Scratch::default());
        for y in tile.y.clone() {
            for x in tile.x.clone() {
                let column = columns.of(pixel);
                pixel += 1;
                if column.met == 0 {
                    continue;
                }
                report.met += u64::from(column.met);
                report.most_met = report.most_met.max(column.met);
                report.covered_pixels += 1;
                let along = self.view.ray(x, y);
                let far = along.length();
                let direction = lattice.turn(self.view.turned_back(along)).to_array();
                let ray = Ray { origin, direction, optical_depth: self.extinction * far };
                let mut travelled = Travelled::start();
                for (slice, &length) in (column.first..).zip(column.lengths) {
                    let (near, end) = (self.slices.begin(slice), self.slices.begin(slice + 1));
                    // A difference of two parts may round to less than nothing.
                    if length > 0.0 && end > near {
                        let density = length / (far * (end - near));
                        let stretch = Stretch { near, far: end, age: 0.0, density };
                        travelled.pass(&stretch, &ray, &self.shadow, &self.sampling, &mut scratch);
                    }
                }
                let at = (y as usize - band.first) * self.view.width as usize + x as usize;
                band.alpha[at] = travelled.alpha() as f32;
                band.scatter[at] = travelled.scatter() as f32;
                band.age[at] = column.age as f32;
            }
        }
    }
}
