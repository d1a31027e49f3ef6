//! The planes of a picture, drawn in bands of rows in parallel, each in tiles.
//!
//! A pixel depends on nothing but its own ray, so the picture does not depend on the bands or the threads.

use std::ops::Range;

use rayon::prelude::*;
use welter_meshing::{Cancelled, Monitor};

use super::camera::View;
use super::crossings::{Crossings, divide};
use super::project::Piece;
use super::raster::Window;
use super::resolve::{stretches, winding_in_eye};
use super::scattering::{Ray, Sampling, Travelled};
use super::shadow::{Scratch, Shadow};
use super::solids::{Solids, Surfaces};
use super::{Image, InteriorRule};

/// Rows that a thread draws at once. Chosen by trial: fewer repeat the search for triangles, more leave
/// threads idle.
const BAND: usize = 16;

/// Columns of a tile, so that its crossings stay in the cache. Chosen by trial.
const TILE: usize = 64;

/// All that pixels are made from.
pub(super) struct Studio<'a> {
    pub(super) view: View,
    /// The smoke's surface in the image.
    pub(super) pieces: Vec<Piece>,
    pub(super) solids: Solids<'a>,
    pub(super) shadow: Shadow,
    /// In scaled coordinates.
    pub(super) extinction: f64,
    pub(super) rule: InteriorRule,
    pub(super) sampling: Sampling,
    pub(super) background: [f32; 3],
}

/// The planes before blur and composition.
pub(super) struct Planes {
    pub(super) alpha: Image<f32>,
    pub(super) scatter: Image<f32>,
    pub(super) age: Image<f32>,
    pub(super) backdrop: Image<[f32; 3]>,
}

/// What was met on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) crossings: u64,
    pub(super) most_crossings: usize,
    pub(super) covered: u64,
    pub(super) inside: u64,
}

impl Counts {
    fn add(&mut self, other: &Counts) {
        self.crossings += other.crossings;
        self.most_crossings = self.most_crossings.max(other.most_crossings);
        self.covered += other.covered;
        self.inside += other.inside;
    }
}

/// The rows of a band in each plane.
struct Band<'a> {
    first: usize,
    alpha: &'a mut [f32],
    scatter: &'a mut [f32],
    age: &'a mut [f32],
    backdrop: &'a mut [[f32; 3]],
}

/// Which of all pieces, by their first rows and those after their last, may cover some rows.
fn meeting(all_rows: &[[u32; 2]], rows: &Range<u32>) -> Vec<u32> {
    let all = (0_u32..).zip(all_rows);
    all.filter(|(_, [start, end])| *start < rows.end && *end > rows.start).map(|(index, _)| index).collect()
}

impl Studio<'_> {
    pub(super) fn draw(&self, monitor: &Monitor<'_>) -> Result<(Planes, Counts), Cancelled> {
        let (width, height) = (self.view.width as usize, self.view.height as usize);
        let plane = || Image::filled(width, height, 0.0);
        let backdrop = Image::filled(width, height, self.background);
        let mut planes = Planes { alpha: plane(), scatter: plane(), age: plane(), backdrop };
        let chunk = width * BAND;
        let all_rows = [&self.pieces, self.solids.pieces()].map(|pieces: &[Piece]| {
            pieces.iter().map(|piece| piece.footprint.window().y).map(|rows| [rows.start, rows.end]).collect()
        });
        let bands = planes.alpha.pixels_mut().par_chunks_mut(chunk);
        let bands = bands.zip(planes.scatter.pixels_mut().par_chunks_mut(chunk));
        let bands = bands.zip(planes.age.pixels_mut().par_chunks_mut(chunk));
        let bands = bands.zip(planes.backdrop.pixels_mut().par_chunks_mut(chunk));
        let stage = monitor.stage("pixels", height.div_ceil(BAND) as u64);
        let draw = |(index, (((alpha, scatter), age), backdrop))| {
            stage.check()?;
            let counts =
                self.draw_band(Band { first: index * BAND, alpha, scatter, age, backdrop }, &all_rows);
            stage.advance(1);
            Ok(counts)
        };
        let all = bands.enumerate().map(draw).collect::<Result<Vec<Counts>, Cancelled>>()?;
        let mut counts = Counts::default();
        all.iter().for_each(|of_band| counts.add(of_band));
        Ok((planes, counts))
    }

    fn draw_band(&self, mut band: Band<'_>, all_rows: &[Vec<[u32; 2]>; 2]) -> Counts {
        let width = self.view.width as usize;
        let rows = band.first as u32..(band.first + band.alpha.len() / width) as u32;
        let (smoke, solids) = (meeting(&all_rows[0], &rows), meeting(&all_rows[1], &rows));
        let mut counts = Counts::default();
        if smoke.is_empty() && solids.is_empty() {
            return counts;
        }
        let (mut crossings, mut surfaces) = (Crossings::default(), Surfaces::default());
        for left in (0..width).step_by(TILE) {
            let window = Window { x: left as u32..(left + TILE).min(width) as u32, y: rows.clone() };
            divide(&window, &self.pieces, &smoke, &mut |tile, candidates| {
                crossings.find(tile, &self.pieces, candidates);
                surfaces.find(tile, self.solids.pieces(), &solids);
                self.draw_tile(tile, &crossings, &surfaces, &mut band, &mut counts);
            });
        }
        counts
    }

    fn draw_tile(
        &self,
        tile: &Window,
        crossings: &Crossings,
        surfaces: &Surfaces,
        band: &mut Band<'_>,
        counts: &mut Counts,
    ) {
        let lattice = self.shadow.lattice();
        let origin = lattice.place(self.view.eye).to_array();
        let (mut pixel, mut scratch) = (0, Scratch::default());
        for y in tile.y.clone() {
            for x in tile.x.clone() {
                let along = self.view.ray(x, y);
                let ray = self.view.turned_back(along);
                let at = (y as usize - band.first) * self.view.width as usize + x as usize;
                let surface =
                    self.solids.shade(surfaces, pixel, self.view.eye, ray, &self.shadow, &mut scratch);
                if let Some(color) = surface {
                    band.backdrop[at] = color;
                }
                let met = crossings.of(pixel);
                if !met.is_empty() {
                    counts.crossings += met.len() as u64;
                    counts.most_crossings = counts.most_crossings.max(met.len());
                    counts.covered += 1;
                    counts.inside += u64::from(winding_in_eye(met) != 0);
                    let ray = Ray {
                        origin,
                        direction: lattice.turn(ray).to_array(),
                        optical_depth: self.extinction * along.length(),
                    };
                    let mut travelled = Travelled::start();
                    stretches(met, surfaces.depth(pixel), self.rule, |stretch| {
                        travelled.pass(&stretch, &ray, &self.shadow, &self.sampling, &mut scratch);
                    });
                    band.alpha[at] = travelled.alpha() as f32;
                    band.scatter[at] = travelled.scatter() as f32;
                    band.age[at] = travelled.age() as f32;
                }
                pixel += 1;
            }
        }
    }
}
