//! Smoke along the rays of a tile, by slices of depth.
//!
//! Slices are the same for the whole image: planes at right angles to the line of sight of its middle. They are half a radius apart, or
//! as far as smoke of density 1 has the optical depth between samples of the light, whichever is less; if that is too many of them, as
//! many as there may be. What a particle adds to a slice is exact, and the sum of all slices is the column through it; within a slice
//! the smoke counts as even.

use super::super::camera::View;
use super::super::raster::Window;
use super::discs::Disc;
use super::kernel::part_before;

/// Most slices of a picture: those of a tile stay in the cache.
const MOST_SLICES: usize = 1024;

/// Where slices are, in depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slices {
    near: f64,
    thickness: f64,
    count: usize,
    radius: f64,
}

impl Slices {
    /// Slices no thicker than half a radius and a limit, which may be infinite.
    pub(super) fn new(discs: &[Disc], radius: f64, limit: f64) -> Self {
        let near = discs.iter().fold(f64::INFINITY, |near, disc| near.min(disc.center.z - radius)).max(0.0);
        let far = discs.iter().fold(near, |far, disc| far.max(disc.center.z + radius));
        let whole = far - near;
        // The cast saturates.
        let count = ((whole / limit.min(0.5 * radius)).ceil() as usize).clamp(1, MOST_SLICES);
        Self { near, thickness: whole / count as f64, count, radius }
    }

    /// The slice that holds a depth.
    fn of(&self, depth: f64) -> usize {
        (((depth - self.near) / self.thickness) as usize).min(self.count - 1)
    }

    /// The depth where a slice begins.
    pub(super) fn begin(&self, slice: usize) -> f64 {
        self.near + slice as f64 * self.thickness
    }
}

/// The smoke on the rays of one tile after the other; keeps its memory.
#[derive(Debug, Default)]
pub(super) struct Columns {
    /// The first slice that is held.
    first: usize,
    /// How many slices are held.
    held: usize,
    /// Length of smoke in each slice held, those of a pixel together.
    lengths: Vec<f64>,
    /// Length and length times age, of each pixel.
    sums: Vec<[f64; 2]>,
    /// Particles on each ray.
    met: Vec<u32>,
}

/// The smoke on a ray.
pub(super) struct Column<'a> {
    /// The slice of the first length.
    pub(super) first: usize,
    pub(super) lengths: &'a [f64],
    pub(super) age: f64,
    /// How many particles the ray meets.
    pub(super) met: u32,
}

impl Columns {
    /// Finds the smoke of a tile, of discs of which the middle of the densest column has a thickness.
    pub(super) fn find(
        &mut self,
        tile: &Window,
        view: &View,
        slices: &Slices,
        thickness: f64,
        discs: &[Disc],
        candidates: &[u32],
    ) {
        let radius = slices.radius;
        let depths = || candidates.iter().map(|&disc| discs[disc as usize].center.z);
        let near = depths().fold(f64::INFINITY, f64::min) - radius;
        let far = depths().fold(0.0, f64::max) + radius;
        let pixels = tile.area() as usize;
        self.first = slices.of(near);
        self.held = slices.of(far).max(self.first) - self.first + 1;
        self.lengths.clear();
        self.lengths.resize(pixels * self.held, 0.0);
        self.sums.clear();
        self.sums.resize(pixels, [0.0; 2]);
        self.met.clear();
        self.met.resize(pixels, 0);
        let columns = tile.x.end - tile.x.start;
        for &index in candidates {
            let disc = &discs[index as usize];
            let window = disc.window().meet(tile);
            for y in window.y.clone() {
                for x in window.x.clone() {
                    let pixel = ((y - tile.y.start) * columns + (x - tile.x.start)) as usize;
                    self.add(pixel, disc, view.ray(x, y), thickness, slices);
                }
            }
        }
    }

    /// Adds what a particle has on the ray of a pixel.
    #[inline]
    fn add(&mut self, pixel: usize, disc: &Disc, ray: glam::DVec3, thickness: f64, slices: &Slices) {
        let square = ray.dot(ray);
        let nearest = disc.center.dot(ray) / square;
        let away = disc.center - nearest * ray;
        let within = 1.0 - away.dot(away) / (slices.radius * slices.radius);
        if within.is_nan() || within <= 0.0 {
            return;
        }
        let root = within.sqrt();
        // Half of the chord, in depth.
        let half = slices.radius * root / square.sqrt();
        let (begin, end) = ((nearest - half).max(0.0), nearest + half);
        if end <= begin {
            return;
        }
        let whole = thickness * within * within * root;
        let inverse = 1.0 / half;
        let mut before = part_before((begin - nearest) * inverse);
        let sum = whole * (1.0 - before);
        self.met[pixel] += 1;
        self.sums[pixel][0] += sum;
        self.sums[pixel][1] += sum * disc.age;
        let lengths = &mut self.lengths[pixel * self.held..][..self.held];
        // Rounding could place an end of the chord beside the ball.
        let last = self.first + self.held - 1;
        let (first, last) =
            (slices.of(begin).clamp(self.first, last), slices.of(end).clamp(self.first, last));
        for slice in first..last {
            let until = part_before((slices.begin(slice + 1) - nearest) * inverse);
            lengths[slice - self.first] += whole * (until - before);
            before = until;
        }
        lengths[last - self.first] += whole * (1.0 - before);
    }

    /// The smoke of a pixel, counted in the tile.
    pub(super) fn of(&self, pixel: usize) -> Column<'_> {
        let [length, aged] = self.sums[pixel];
        Column {
            first: self.first,
            lengths: &self.lengths[pixel * self.held..][..self.held],
            age: if length > 0.0 { aged / length } else { 0.0 },
            met: self.met[pixel],
        }
    }
}
